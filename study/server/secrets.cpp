#include "study/server/secrets.h"

#include <sys/random.h>

#include <array>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study::server {

// The only place where randomness does not come from the study's seed: nobody who knows the seed, or one session, may
// be able to compute another session. Nothing that is shown depends on it.
std::string draw_secret() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw Error("the system gives no random bytes; a server cannot hand out sessions without them");
    }
    std::string secret;
    for (const unsigned char byte : bytes) secret += format("{:02x}", byte);
    return secret;
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
    // Reads every letter of `a`; a shorter `b` is read again from its beginning.
    unsigned difference = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const char other = b.empty() ? '\0' : b[i % b.size()];
        difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i] ^ other));
    }
    return difference == 0;
}

}  // namespace chironomia::study::server
