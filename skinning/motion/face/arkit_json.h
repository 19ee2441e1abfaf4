// Faces as ARKit's 52 coefficients in JSON, as the recordings of BEAT have them, and what models that learned from
// these write:
//     {"names": ["browDownLeft", ...], "frames": [{"weights": [0.1, ...], "time": 0.0166, "rotation": []}, ...]}
// A coefficient means what it means in a table (arkit_csv.h). Without a time of each frame the rate is that of
// {"metadata": {"fps": 30}}, as LAM-Audio2Expression writes it, or set by hand. "rotation" is left out, which a note
// says where it holds numbers: its writers do not say what turns.
#pragma once

#include <optional>
#include <string>

#include "core/body/motion.h"
#include "core/files/json.h"

namespace chironomia {

bool holds_arkit(const Json& json);

// `where` is the file's name. Throws Error with the frame if it lacks a weight or a time that others have, if one is no
// number, or a weight lies outside of 0 to 1.
Motion face_of_arkit_json(const Json& json, const std::string& where, std::optional<double> fps);

}  // namespace chironomia
