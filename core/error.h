// The one exception of the program: the outside world (a file, a format, an option) is wrong.
#pragma once

#include <stdexcept>

namespace chironomia {

// The message reads `where: what is wrong, with both values; what to do`. Only main catches it.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Ctrl-C or a polite kill. Unfinished outputs are removed on the way out.
class Interrupted : public std::runtime_error {
  public:
    Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace chironomia
