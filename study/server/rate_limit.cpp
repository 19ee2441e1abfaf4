#include "study/server/rate_limit.h"

#include <algorithm>

namespace chironomia {

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

}  // namespace chironomia
