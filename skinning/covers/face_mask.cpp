#include "skinning/covers/face_mask.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/body/rest.h"
#include "skinning/covers/cover.h"
#include "skinning/face_region/head_scan.h"

namespace chironomia {
namespace {

// All numbers of the mask are ours.
// The outline, as seen from the middle of the face inside the head [rad]: a superellipse.
constexpr float kHalfWidth = float(73 * kDegree);
constexpr float kUnderChin = float(8 * kDegree);
constexpr float kExponent = 2.4f;

constexpr float kClearance = 0.03f;  // between skin and mask, of the height of the face
constexpr float kSunk = 0.14f;       // how deep the rim ends in the head, of the same
constexpr float kWrap = 0.72f;       // from here to the rim, 1, the mask comes down to the head
constexpr float kCovered = 0.9f;     // what lies within is left out

// Skin that the neck moves along stays, so that none is missing under the chin when the head tilts.
constexpr float kRigid = 0.95f;  // least weight of the head for skin that is left out

constexpr int kMapSide = 72;  // of the map of the skin's distances [cells]
constexpr int kRings = 22;    // of the mask's mesh, from its middle to the rim
constexpr int kAround = 72;   // vertices of a ring

// A direction from the middle of the face: to the person's left, and up [rad].
struct Direction {
    float across = 0;
    float up = 0;
};

Direction direction_of(const Vec3& from) {
    return {std::atan2(from.x, from.z), std::atan2(from.y, std::hypot(from.x, from.z))};
}

Vec3 along(const Direction& direction) {
    const float level = std::cos(direction.up);
    return {level * std::sin(direction.across), std::sin(direction.up), level * std::cos(direction.across)};
}

// The rounded outline: 0 in its middle, 1 at the rim.
struct Outline {
    float middle_up = 0;    // [rad]
    float half_height = 1;  // [rad]

    Vec2 place(const Direction& direction) const {
        return {direction.across / kHalfWidth, (direction.up - middle_up) / half_height};
    }
    float ring(const Direction& direction) const {
        const Vec2 at = glm::abs(place(direction));
        return std::pow(std::pow(at.x, kExponent) + std::pow(at.y, kExponent), 1 / kExponent);
    }
    Direction at(float ring, float angle) const {
        const auto rounded = [](float value) {
            return std::copysign(std::pow(std::abs(value), 2 / kExponent), value);
        };
        return {ring * rounded(std::cos(angle)) * kHalfWidth,
                middle_up + ring * rounded(std::sin(angle)) * half_height};
    }
};

// How far the head reaches in every direction around the outline, even on both sides.
class RadialMap {
  public:
    RadialMap(const Outline& outline, float empty) : outline_(outline) {
        values_.fill(0);
        empty_ = empty;
    }

    void add(const Vec3& from) {
        const Direction direction = direction_of(from);
        if (from.z <= 0) return;
        for (const float side : {1.0f, -1.0f}) {
            const Vec2 cell = cell_of({side * direction.across, direction.up});
            if (cell.x < 0 || cell.y < 0 || cell.x > kMapSide - 1 || cell.y > kMapSide - 1) continue;
            float& value = values_[index(static_cast<int>(cell.x + 0.5f), static_cast<int>(cell.y + 0.5f))];
            value = std::max(value, length(from));
        }
    }

    // Directions that nothing was seen in take the mean of their neighbours; then all are evened out.
    void finish() {
        for (int pass = 0; pass < kMapSide; ++pass) spread();
        for (float& value : values_) value = value > 0 ? value : empty_;
        for (int pass = 0; pass < 6; ++pass) even_out();
    }

    float at(const Direction& direction) const {
        const Vec2 cell = glm::clamp(cell_of(direction), Vec2(0), Vec2(kMapSide - 1.001f));
        const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
        const Vec2 part = cell - glm::floor(cell);
        const auto value = [&](int i, int j) { return values_[index(x + i, y + j)]; };
        return glm::mix(glm::mix(value(0, 0), value(1, 0), part.x),
                        glm::mix(value(0, 1), value(1, 1), part.x), part.y);
    }

  private:
    // The map reaches a little beyond the rim.
    static constexpr float kReach = 1.12f;

    Vec2 cell_of(const Direction& direction) const {
        return (outline_.place(direction) / kReach * 0.5f + 0.5f) * static_cast<float>(kMapSide - 1);
    }
    static size_t index(int x, int y) { return static_cast<size_t>(y * kMapSide + x); }

    // The mean of the values around a cell; 0 if there are none.
    float mean_around(const std::array<float, kMapSide * kMapSide>& values, int x, int y) const {
        float sum = 0;
        int count = 0;
        for (int j = std::max(0, y - 1); j <= std::min(kMapSide - 1, y + 1); ++j) {
            for (int i = std::max(0, x - 1); i <= std::min(kMapSide - 1, x + 1); ++i) {
                if (values[index(i, j)] <= 0) continue;
                sum += values[index(i, j)];
                ++count;
            }
        }
        return count == 0 ? 0 : sum / static_cast<float>(count);
    }
    void spread() {
        const auto before = values_;
        for (int y = 0; y < kMapSide; ++y) {
            for (int x = 0; x < kMapSide; ++x) {
                if (before[index(x, y)] <= 0) values_[index(x, y)] = mean_around(before, x, y);
            }
        }
    }
    void even_out() {
        const auto before = values_;
        for (int y = 0; y < kMapSide; ++y) {
            for (int x = 0; x < kMapSide; ++x) values_[index(x, y)] = mean_around(before, x, y);
        }
    }

    Outline outline_;
    float empty_ = 0;
    std::array<float, kMapSide * kMapSide> values_{};
};

// A smooth surface over the outline: r = sum of c_ij across^2i up^j. Few terms, so that no feature of the
// face shows.
class Shell {
  public:
    static constexpr int kTerms = 9;
    using Terms = std::array<double, kTerms>;

    static Terms terms(const Vec2& place) {
        const double x = double(place.x) * place.x, y = place.y;
        return {1, y, y * y, y * y * y, x, x * y, x * y * y, x * x, x * x * y};
    }

    double at(const Vec2& place) const {
        const Terms values = terms(place);
        double sum = 0;
        for (size_t i = 0; i < kTerms; ++i) sum += coefficients[i] * values[i];
        return sum;
    }

    Terms coefficients{};
};

// Solves the normal equations by elimination with pivots.
Shell::Terms solve(std::array<std::array<double, Shell::kTerms + 1>, Shell::kTerms> rows) {
    constexpr size_t n = Shell::kTerms;
    for (size_t column = 0; column < n; ++column) {
        size_t pivot = column;
        for (size_t row = column; row < n; ++row) {
            if (std::abs(rows[row][column]) > std::abs(rows[pivot][column])) pivot = row;
        }
        std::swap(rows[column], rows[pivot]);
        for (size_t row = 0; row < n; ++row) {
            if (row == column) continue;
            const double factor = rows[row][column] / rows[column][column];
            for (size_t i = column; i <= n; ++i) rows[row][i] -= factor * rows[column][i];
        }
    }
    Shell::Terms solution{};
    for (size_t i = 0; i < n; ++i) solution[i] = rows[i][n] / rows[i][i];
    return solution;
}

struct Sample {
    Vec2 place{0};
    double radius = 0;  // [m]
};

std::vector<Sample> samples_of(const RadialMap& map, const Outline& outline) {
    constexpr int kSteps = 20;
    std::vector<Sample> samples;
    for (int ring = 0; ring <= kSteps; ++ring) {
        for (int around = 0; around < 2 * kSteps; ++around) {
            const Direction direction =
                outline.at(static_cast<float>(ring) / kSteps, kPi * static_cast<float>(around) / kSteps);
            samples.push_back({outline.place(direction), map.at(direction)});
        }
    }
    return samples;
}

// Lies close over the samples: least squares in which what sticks out counts much more, then a lift until
// nothing does.
Shell shell_over(const std::vector<Sample>& samples) {
    Shell shell;
    for (int pass = 0; pass < 8; ++pass) {
        std::array<std::array<double, Shell::kTerms + 1>, Shell::kTerms> rows{};
        for (const Sample& sample : samples) {
            const bool sticks_out = pass > 0 && sample.radius > shell.at(sample.place);
            const double weight = sticks_out ? 60 : 1;
            const Shell::Terms terms = Shell::terms(sample.place);
            for (size_t i = 0; i < Shell::kTerms; ++i) {
                for (size_t j = 0; j < Shell::kTerms; ++j) rows[i][j] += weight * terms[i] * terms[j];
                rows[i][Shell::kTerms] += weight * terms[i] * sample.radius;
            }
        }
        shell.coefficients = solve(rows);
    }
    double lift = 0;
    for (const Sample& sample : samples) lift = std::max(lift, sample.radius - shell.at(sample.place));
    shell.coefficients[0] += lift;
    return shell;
}

class MaskMaker {
  public:
    MaskMaker(const Avatar& avatar, const FaceRegion& face)
        : avatar_(avatar),
          face_(face),
          scan_(*scan_head(avatar, face.head)),
          middle_(face.middle.x, face.chin.y + 0.5f * face.height, face.middle.z),
          outline_(outline()),
          map_(outline_, 0.5f * face.height) {
        measure();
        shell_ = shell_over(samples_of(map_, outline_));
    }

    Cover mask() const;
    std::vector<char> covered(size_t surface) const;

  private:
    Outline outline() const {
        const float chin = direction_of(face_.chin - middle_).up - kUnderChin;
        const float hairline_y = face_.chin.y + face_.height;
        const Vec3 hairline(middle_.x, hairline_y, scan_.front_at(hairline_y));
        const float top = direction_of(hairline - middle_).up;
        return {.middle_up = (chin + top) / 2, .half_height = (top - chin) / 2};
    }

    void measure();
    float radius(const Direction& direction) const;

    const Avatar& avatar_;
    const FaceRegion& face_;
    HeadScan scan_;
    Vec3 middle_;
    Outline outline_;
    RadialMap map_;
    Shell shell_;
};

// Points of the skin closer to each other than the cells of the map.
void MaskMaker::measure() {
    const Surface& skin = avatar_.surfaces[scan_.skin];
    const auto& places = scan_.rest.surfaces[scan_.skin].positions;
    const float spacing = 0.02f * face_.height;
    for (size_t i = 0; i + 2 < skin.triangles.size(); i += 3) {
        const Vec3 a = places[skin.triangles[i]] - middle_;
        const Vec3 b = places[skin.triangles[i + 1]] - middle_, c = places[skin.triangles[i + 2]] - middle_;
        const auto& carried = scan_.on_head[scan_.skin];
        if (std::min({carried[skin.triangles[i]], carried[skin.triangles[i + 1]],
                      carried[skin.triangles[i + 2]]}) < 0.5f)
            continue;
        if (std::max({a.z, b.z, c.z}) <= 0 || std::min({length(a), length(b), length(c)}) > face_.height)
            continue;
        const float longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
        const int steps = std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, 64);
        for (int j = 0; j <= steps; ++j) {
            for (int k = 0; j + k <= steps; ++k) {
                const float along_b = static_cast<float>(j) / static_cast<float>(steps);
                const float along_c = static_cast<float>(k) / static_cast<float>(steps);
                map_.add(a + along_b * (b - a) + along_c * (c - a));
            }
        }
    }
    map_.finish();
}

// Of the mask from the middle [m].
float MaskMaker::radius(const Direction& direction) const {
    const float clearance = kClearance * face_.height;
    const float skin = map_.at(direction) + clearance;
    const float shell = static_cast<float>(shell_.at(outline_.place(direction))) + clearance;
    const float wrapped = glm::smoothstep(kWrap, 1.0f, outline_.ring(direction));
    return std::max(skin, glm::mix(shell, skin, wrapped));
}

Cover MaskMaker::mask() const {
    Cover mask{.name = "face mask",
               .joint = face_.head,
               .positions = {middle_ + along(outline_.at(0, 0)) * radius(outline_.at(0, 0))},
               .triangles = {}};
    const auto add_ring = [&](float ring, float sunk) {
        for (int around = 0; around < kAround; ++around) {
            const Direction direction = outline_.at(ring, 2 * kPi * static_cast<float>(around) / kAround);
            mask.positions.push_back(middle_ + along(direction) * (radius(direction) - sunk * face_.height));
        }
    };
    for (int ring = 1; ring <= kRings; ++ring) add_ring(static_cast<float>(ring) / kRings, 0);
    // The rim again, for its edge, and where it ends inside the head.
    add_ring(1, 0);
    add_ring(1, kSunk);

    const auto vertex = [&](int ring, int around) {
        return static_cast<std::uint32_t>(1 + (ring - 1) * kAround + around % kAround);
    };
    for (int around = 0; around < kAround; ++around) {
        mask.triangles.insert(mask.triangles.end(), {0u, vertex(1, around), vertex(1, around + 1)});
        for (int ring = 1; ring <= kRings + 1; ++ring) {
            if (ring == kRings) continue;
            const auto a = vertex(ring, around), b = vertex(ring, around + 1);
            const auto c = vertex(ring + 1, around), d = vertex(ring + 1, around + 1);
            mask.triangles.insert(mask.triangles.end(), {a, c, d, a, d, b});
        }
    }
    return mask;
}

std::vector<char> MaskMaker::covered(size_t surface) const {
    std::vector<char> hidden;
    for (size_t v = 0; v < scan_.on_head[surface].size(); ++v) {
        const Vec3 from = scan_.rest.surfaces[surface].positions[v] - middle_;
        hidden.push_back(scan_.on_head[surface][v] > kRigid && from.z > 0 &&
                         outline_.ring(direction_of(from)) < kCovered);
    }
    return hidden;
}

}  // namespace

Avatar with_face_mask(Avatar avatar, const FaceRegion& face) {
    const MaskMaker maker(avatar, face);
    std::vector<std::vector<char>> hidden;
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) hidden.push_back(maker.covered(s));
    const Cover mask = maker.mask();
    for (size_t s = 0; s < hidden.size(); ++s) {
        if (!is_hair(avatar, avatar.surfaces[s])) leave_out(avatar.surfaces[s], hidden[s]);
    }
    add_cover(avatar, mask);
    return avatar;
}

}  // namespace chironomia
