// Avatars as other people's programs make them: our own ones with other joints, names and axes.
#pragma once

#include <filesystem>

namespace chironomia::testing {

// Writes the avatar that the name of `file` says, in the rest pose and size of the bundled one:
//   makehuman.glb  neutral.glb with MakeHuman's joint names, two joints in the neck and ARKit's morph names
//   mixamo.glb     male.glb with `mixamorig:*`, rest axes along the bones, neither jaw nor eye joints;
//                  ARKit's names, with look morphs of 20 degrees on the eyeballs
//   vrm.vrm        neutral.glb as VRM 1.0: its bones and expressions are in the extension, names say nothing
//   numbered.glb   mannequin.glb with numbered joints, 19 of them, no fingers and no shoulders, below a root that
//                  turns +z up to +y; rest axes along the bones
//   large_head.glb neutral.glb with a head of 2.5 times the size, as figures of games have it
//   beside.glb     neutral.glb 0.9 m to the left of its origin and 0.4 m before it
//   sumerian.glb   neutral.glb with the joints of Amazon Sumerian's hosts (`char:def_c_hip`), two of them the neck;
//                  meshes are called after parts (`char:head`) and hang in groups beside the joints
//   rigify.glb     neutral.glb with Rigify's `DEF-` joints, each with an `ORG-` one below it that moves nothing
//   biped.glb      neutral.glb with the biped of 3ds Max (`Bip01 L UpperArm`), meshes called `Bip01 Head` and so on
void write_made_avatar(const std::filesystem::path& file);

}  // namespace chironomia::testing
