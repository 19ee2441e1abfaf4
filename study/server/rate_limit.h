// How often a client may ask, and how much at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace chironomia::study::server {

// A bucket of tokens for each client: a request takes one, and they come back at a steady rate. Any thread
// may ask.
class RateLimit {
  public:
    // `burst` requests at once, then `rate` a second. Of more than `most_clients` the one
    // whose last request is the oldest is forgotten, so that memory is bounded.
    RateLimit(double rate, double burst, std::size_t most_clients = 10'000);

    // Whether the client may go on. `now` in milliseconds that only go forward.
    bool allows(const std::string& client, std::int64_t now);

  private:
    struct Bucket {
        std::string client;
        double tokens = 0;
        std::int64_t filled = 0;  // when `tokens` was right
    };

    double rate_;
    double burst_;
    std::size_t most_clients_;
    std::mutex mutex_;
    std::list<Bucket> buckets_;  // the latest first
    std::unordered_map<std::string, std::list<Bucket>::iterator> by_client_;
};

// How many requests of a client are under way. Any thread may ask.
class ClientLimit {
  public:
    explicit ClientLimit(std::size_t most) : most_(most) {}

    // Taken until it is destroyed, which must be before its limit is.
    class Place {
      public:
        Place(ClientLimit& limit, std::string client) : limit_(&limit), client_(std::move(client)) {}
        Place(Place&& other) noexcept;
        Place& operator=(Place&& other) noexcept;
        ~Place();

      private:
        ClientLimit* limit_;  // null: moved from
        std::string client_;
    };

    // Nothing if the client has as many already as it may.
    std::optional<Place> enter(const std::string& client);

  private:
    void leave(const std::string& client);

    std::size_t most_;
    std::mutex mutex_;
    std::unordered_map<std::string, std::size_t> under_way_;
};

// The name of a client: an IPv4 address as it is, also inside of an IPv6 one; of an IPv6 address the
// network of 64 bits, because one client has all of its addresses; any other text as it is.
std::string client_of_address(const std::string& address);

}  // namespace chironomia::study::server
