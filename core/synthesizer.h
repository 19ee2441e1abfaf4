// The seam behind which motion is made from speech.
#pragma once

#include "core/motion.h"
#include "core/speech.h"

namespace chironomia {

class Synthesizer {
  public:
    virtual ~Synthesizer() = default;

    // The motion that goes with `speech`, as long as its sound. The same speech gives the same motion.
    // May be called from several threads.
    virtual Motion synthesize(const Speech& speech) const = 0;
};

}  // namespace chironomia
