// How deep the surface of an avatar's hands and forearms is in the rest of its mesh: what is seen, measured on the
// triangles that are drawn. Shares nothing with skinning/shape, whose capsules it judges.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/body/avatar.h"
#include "tests/skinning/shape/winding_solid.h"

namespace chironomia::testing {

enum class MeshRegion {
    other,
    trunk,
    head,
    legs,
    left_upper_arm,
    left_forearm,
    left_hand,
    right_upper_arm,
    right_forearm,
    right_hand
};

std::string_view name_of(MeshRegion region);

// A piece of the surface of a hand or forearm that is inside the body or the other arm.
struct SunkenPiece {
    MeshRegion of = MeshRegion::left_hand;
    MeshRegion in = MeshRegion::trunk;  // whose surface is the nearest
    float depth = 0;                    // below that surface [m]
    float area = 0;                     // [m^2]
};

// A piece of the surface of a hand beside something that it may touch.
struct NearPiece {
    MeshRegion of = MeshRegion::left_hand;
    MeshRegion to = MeshRegion::trunk;  // whose surface is the nearest
    float gap = 0;                      // to that surface [m]; below 0 inside
    float area = 0;                     // [m^2]
    Vec3 place{0};                      // [m, world]
};

// The depth that a surface of `area` [m^2] is below, of those pieces that are in `in`; 0 where less is inside [m].
float depth_of_area(const std::vector<SunkenPiece>& pieces, float area);

// The body is what is seen of the surfaces of the first figure from outside at rest, without hair, brows and lashes:
// not the mouth, and not a waistband under a shirt. A place is inside where the generalised winding number of all that
// but the own arm is above 0.5; its depth is the distance to the nearest triangle. A forearm is not looked for in its
// own upper arm, and a hand not in the other hand, where fingers are clasped.
class MeshDepth {
  public:
    explicit MeshDepth(const Avatar& avatar);

    // Pieces of about a square centimetre.
    std::vector<SunkenPiece> sunken(const PosedMesh& mesh);

    // Pieces of hands that are no further than `most` [m] from the body or the other arm, its hand too.
    std::vector<NearPiece> near(const PosedMesh& mesh, float most);

  private:
    // A triangle for a piece of an arm's surface.
    struct Piece {
        MeshRegion region;
        Triangle triangle;
        float area;  // [m^2]
    };

    struct Box {
        Vec3 low{0}, high{0};  // [m]
    };

    // What one arm may be in.
    struct Obstacle {
        WindingSolid solid;
        std::vector<MeshRegion> regions{};  // (F)
        std::vector<Piece> pieces{};        // of the arm
    };

    std::vector<Vec3> points_of(const PosedMesh& mesh) const;
    std::vector<Box> boxes_of(const Obstacle& obstacle, const std::vector<Vec3>& points) const;
    void take_pieces(Obstacle& obstacle, std::size_t side, const std::vector<Vec3>& rest) const;

    std::vector<std::size_t> surfaces_;  // those that count
    std::vector<MeshRegion> regions_;    // (V) of all points
    std::vector<int> joints_;            // (V) that moves a point most
    std::vector<Triangle> triangles_;    // that are seen
    std::vector<Obstacle> obstacles_;    // for the left and the right arm
};

}  // namespace chironomia::testing
