// How often a client may ask.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <unordered_map>

namespace chironomia {

// A bucket of tokens for each client: a request takes one, and they come back at a steady rate. Any thread
// may ask.
class RateLimit {
  public:
    // `burst` requests at once, then `rate` a second. Of more than `most_clients` the one unheard of for
    // longest is forgotten, so that memory is bounded.
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

}  // namespace chironomia
