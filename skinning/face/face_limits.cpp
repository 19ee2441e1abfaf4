#include "skinning/face/face_limits.h"

namespace chironomia {
namespace {

// The reasons are those of the rigs that are drawn after FACS (ARKit's among them): a shape is drawn from the
// neutral face, so that two that move the same skin move it twice. The shares are ours.
constexpr std::array kLimits = {
    FaceLimit{2, 4, .25f, "the lowered brow holds its tail down"},
    FaceLimit{4, 1, .35f, "1+4 draws the brows together and up at their inner ends, not down"},
    FaceLimit{4, 2, .25f, "the raised tail of the brow holds it up"},
    FaceLimit{5, 45, 1, "a lid that closes is not raised, or the eye would not shut"},
    FaceLimit{6, 7, .3f, "both raise the lower lid"},
    FaceLimit{6, 45, .5f, "the lower lid has met the upper one"},
    FaceLimit{7, 5, .4f, "the lids are drawn apart and together at once"},
    FaceLimit{7, 6, .4f, "both raise the lower lid"},
    FaceLimit{7, 45, 1, "closed lids do not narrow any more, or they would cross"},
    FaceLimit{10, 9, .5f, "both raise the upper lip beside the nose"},
    FaceLimit{10, 12, .3f, "the smile already draws the upper lip up and thin"},
    FaceLimit{12, 15, .4f, "the corner is drawn up and down"},
    FaceLimit{12, 26, .2f, "the corners of an open mouth are drawn in"},
    FaceLimit{14, 12, .6f, "both draw the corner back into the cheek"},
    FaceLimit{14, 20, .5f, "both draw the corner back into the cheek"},
    FaceLimit{15, 12, .6f, "the corner is drawn up and down"},
    FaceLimit{16, 25, .4f, "the lower lip has left the upper one"},
    FaceLimit{17, 12, .3f, "the stretched lower lip is hard to push up"},
    FaceLimit{17, 25, .5f, "the chin pushes the lower lip into the gap"},
    FaceLimit{17, 26, .7f, "the chin has gone down with the jaw"},
    FaceLimit{18, 12, .6f, "the lips are drawn wide and narrow"},
    FaceLimit{18, 20, .6f, "the lips are drawn wide and narrow"},
    FaceLimit{18, 22, .6f, "both push the lips forward"},
    FaceLimit{20, 12, .6f, "both draw the mouth wide"},
    FaceLimit{22, 12, .6f, "the lips are drawn wide and narrow"},
    FaceLimit{22, 20, .6f, "the lips are drawn wide and narrow"},
    FaceLimit{23, 12, .3f, "the smile has made the lips thin"},
    FaceLimit{23, 25, .5f, "lips that part are not pressed together"},
    FaceLimit{23, 26, .7f, "lips that part are not pressed together"},
    FaceLimit{24, 25, 1, "lips that part are not pressed together"},
    FaceLimit{24, 26, 1, "lips that part are not pressed together"},
    FaceLimit{25, 12, .25f, "the smile already parts the lips"},
    FaceLimit{25, 26, .7f, "the jaw has parted the lips; more of it shows the gums"},
    FaceLimit{28, 25, .5f, "lips rolled in cannot part"},
    FaceLimit{28, 26, .3f, "the lips are drawn over the teeth of an open mouth only so far"},
    FaceLimit{34, 25, 1, "air leaves an open mouth"},
    FaceLimit{34, 26, 1, "air leaves an open mouth"},
    FaceLimit{34, 12, .4f, "the smile draws the cheek up"},
};

}  // namespace

std::span<const FaceLimit> face_limits() {
    return kLimits;
}

UnitIntensities limited(const UnitIntensities& intensities) {
    UnitIntensities result = intensities;
    for (const FaceLimit& limit : kLimits) {
        result[static_cast<size_t>(limit.suppressed)] *=
            1 - limit.share * intensities[static_cast<size_t>(limit.suppressor)] / 5;
    }
    return result;
}

}  // namespace chironomia
