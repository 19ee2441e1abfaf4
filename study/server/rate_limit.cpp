#include "study/server/rate_limit.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <utility>

namespace chironomia::study::server {

RateLimit::RateLimit(double rate, double burst, std::size_t most_clients)
    : rate_(rate), burst_(burst), most_clients_(most_clients) {}

bool RateLimit::allows(const std::string& client, std::int64_t now) {
    const std::lock_guard lock(mutex_);
    const auto known = by_client_.find(client);
    if (known == by_client_.end()) {
        buckets_.push_front({.client = client, .tokens = burst_, .filled = now});
        by_client_[client] = buckets_.begin();
    } else {
        buckets_.splice(buckets_.begin(), buckets_, known->second);
    }
    if (buckets_.size() > most_clients_) {
        by_client_.erase(buckets_.back().client);
        buckets_.pop_back();
    }
    Bucket& bucket = buckets_.front();
    bucket.tokens = std::min(burst_, bucket.tokens + rate_ * static_cast<double>(now - bucket.filled) / 1000);
    bucket.filled = now;
    if (bucket.tokens < 1) return false;
    bucket.tokens -= 1;
    return true;
}

ClientLimit::Place::Place(Place&& other) noexcept
    : limit_(std::exchange(other.limit_, nullptr)), client_(std::move(other.client_)) {}

ClientLimit::Place& ClientLimit::Place::operator=(Place&& other) noexcept {
    std::swap(limit_, other.limit_);
    std::swap(client_, other.client_);
    return *this;
}

ClientLimit::Place::~Place() {
    if (limit_) limit_->leave(client_);
}

std::optional<ClientLimit::Place> ClientLimit::enter(const std::string& client) {
    const std::lock_guard lock(mutex_);
    std::size_t& count = under_way_[client];
    if (count >= most_) return std::nullopt;
    ++count;
    return std::optional<Place>(std::in_place, *this, client);
}

void ClientLimit::leave(const std::string& client) {
    const std::lock_guard lock(mutex_);
    const auto found = under_way_.find(client);
    if (--found->second == 0) under_way_.erase(found);
}

std::string client_of_address(const std::string& address) {
    in6_addr six{};
    if (inet_pton(AF_INET6, address.c_str(), &six) != 1) return address;
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (IN6_IS_ADDR_V4MAPPED(&six)) {
        inet_ntop(AF_INET, &six.s6_addr[12], text.data(), text.size());
        return text.data();
    }
    std::fill(std::begin(six.s6_addr) + 8, std::end(six.s6_addr), std::uint8_t{0});
    inet_ntop(AF_INET6, &six, text.data(), text.size());
    return std::string(text.data()) + "/64";
}

}  // namespace chironomia::study::server
