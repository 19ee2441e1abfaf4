// The helper program chironomia_speak: finding it, and asking it to speak.
#pragma once

#include "synth/speech/helper_protocol.h"

namespace chironomia {

// Looked for where $CHIRONOMIA_SPEAK says, or else beside the program, in lib/chironomia beside its folder,
// and where it was built. The voices are where $ESPEAK_DATA_PATH says, in a folder espeak-ng-data, or where
// espeak-ng was installed. Throws Error if the helper is not there, cannot be started or does not answer. May
// be called from several threads.
SpeakReply ask_helper(const SpeakRequest& request);

}  // namespace chironomia
