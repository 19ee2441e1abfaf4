// Takes something away from this process for a while.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace chironomia::testing {

// Lowers a limit of the system while it lives. With RLIMIT_FSIZE writing fails as on a full disk.
class LowLimit {
  public:
    LowLimit(__rlimit_resource what, rlim_t limit) : what_(what) {
        ::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(what_, &before_);
        rlimit low = before_;
        low.rlim_cur = limit;
        ::setrlimit(what_, &low);
    }
    ~LowLimit() { ::setrlimit(what_, &before_); }
    LowLimit(const LowLimit&) = delete;
    LowLimit& operator=(const LowLimit&) = delete;

  private:
    __rlimit_resource what_;
    rlimit before_{};
};

}  // namespace chironomia::testing
