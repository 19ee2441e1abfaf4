// Faces as ARKit's 52 coefficients 0..1, a row per frame: the CSV of Live Link Face (`Timecode`,
// `BlendshapeCount`, EyeBlinkLeft, ..., HeadYaw, HeadPitch, HeadRoll, LeftEyeYaw, ...), or any table with
// these names in any case and a column of times.
//
// A coefficient k becomes the intensity 5 k of an action unit, L and R being the person's own sides:
//     browInnerUp 1        browOuterUp 2 L R     browDown 4 L R        eyeWide 5 L R     cheekSquint 6 L R
//     eyeSquint 7 L R      noseSneer 9 L R       mouthUpperUp 10 L R   mouthSmile 12 L R
//     mouthDimple 14 L R   mouthFrown 15 L R     mouthLowerDown 16 L R mouthShrugLower 17
//     mouthPucker 18       tongueOut 19          mouthStretch 20 L R   mouthFunnel 22
//     mouthPress 24 L R    mouthRollLower, mouthRollUpper 28 (the larger)
//     jawForward 29        jawLeft, jawRight 30 L R   cheekPuff 34     eyeBlink 45 L R
// after M. Ozel, "ARKit to FACS: Blendshape Cheat Sheet" (melindaozel.com), and Apple's description of each
// (ARFaceAnchor.BlendShapeLocation). jawOpen is the widest drop there is: 0.7 of it are the whole of 26
// (kWholeDrop). It parts the lips, too, and mouthClose takes them back to each other without the jaw: 8, on the
// same scale, and 25 is what jawOpen has beyond it. mouthLeft, mouthRight and mouthShrugUpper are no
// action unit; a note names them once if they occur.
//
// HeadYaw, HeadPitch and HeadRoll [rad] turn the face's own axes, ours exactly (ARFaceAnchor: x to the
// person's left, y up, z out of the face): yaw to the left, then pitch up, then roll about z, the left ear
// up. The eye columns are read alike, except that each axis counts the other way if the eyeLook
// coefficients of the same rows say so: the writers differ there. Without eye columns the gaze is the eyeLook
// coefficients, 1 being 45 degrees sideways and 30 degrees up or down (Unity Labs, Facial AR Remote,
// CharacterRigController). Columns that are 0 throughout are not known.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/motion.h"

namespace chironomia {

bool looks_like_arkit(const std::vector<std::string>& columns);

// Rows with a BlendshapeCount of 0 failed. `fps` is the number of frames in a second that time codes count;
// of a table without time codes it is the rate of the rows. Throws Error with the line for anything that
// cannot be meant.
Motion face_of_arkit(std::string_view text, const std::string& where, std::optional<double> fps);

}  // namespace chironomia
