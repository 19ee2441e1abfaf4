// Which of the people in a picture is the one of the frame before.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math.h"

namespace chironomia {

// A point that a detector saw.
struct PersonPoint {
    Vec2 place{0};         // [px]
    float confidence = 0;  // 0: not found
};

// Goes through the frames of a clip in order. All people are followed, so that somebody who stands before the one who
// is asked for is not taken for them.
class PersonTracker {
  public:
    // Of the people in the next frame the one who is followed: each person goes to the track whose points, moved on as
    // they moved before, are nearest, the nearest pair first. In the beginning the one that is seen most surely;
    // nothing where none is left for the track, as while somebody else hides the person. Of a person whom the detector
    // found twice in a frame the one that is seen more surely. `people` have the same points each, of which the first
    // `body_points` count.
    std::optional<std::size_t> choose(const std::vector<std::vector<PersonPoint>>& people,
                                      std::size_t body_points);

    std::size_t crowded() const { return crowded_; }    // frames in which there were others
    std::size_t doubtful() const { return doubtful_; }  // of them those in which another was nearly as near

    // The same in words, and in which frames the person is suddenly elsewhere.
    std::vector<std::string> notes() const;

  private:
    using Points = std::vector<PersonPoint>;

    struct Track {
        Points last;             // of the body, when the person was seen last
        Vec2 velocity{0};        // of the whole person, smoothed [px a frame]
        std::size_t unseen = 0;  // frames since then
        std::size_t apart = 0;   // frames in which the person was clearly not the one who is followed

        double distance_to(const Points& person) const;
        void go_on(const Points* person);  // nullptr: not seen
    };

    std::vector<std::optional<std::size_t>> assign(const std::vector<Points>& bodies);
    void take_surest_of_same(const std::vector<Points>& bodies,
                             std::vector<std::optional<std::size_t>>& body_of) const;
    bool leaps_to(const Points* body) const;
    void follow_others(const std::vector<Points>& bodies, const std::vector<bool>& taken);

    std::vector<Track> tracks_;  // the first is of the one who is followed; empty: nobody was seen yet
    std::size_t frames_ = 0;
    std::size_t crowded_ = 0;
    std::size_t doubtful_ = 0;
    std::vector<std::size_t> leaps_;
};

}  // namespace chironomia
