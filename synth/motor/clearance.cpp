#include "synth/motor/clearance.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "synth/body/agent_body.h"
#include "synth/motor/body_distance.h"

namespace chironomia {
namespace {

using Place = glm::dvec3;

// All numbers here are ours.
constexpr double kSigma = 0.08;          // of what is moved, in time [s]
constexpr int kRounds = 16;              // of moving and looking again
constexpr double kGain = 1.2;            // of a move, of which smoothing takes a part
constexpr double kSkin = 0.012;          // distance kept from the body, for cloth and tolerance [m]
constexpr double kWrist = 0.03;          // radius [m]
constexpr double kRotationSlack = 0.08;  // of the limit of the upper arm [rad]

ArmState state_of(const ArmPoint& point) {
    return {.wrist = Vec3(point.wrist),
            .swivel = static_cast<float>(point.swivel),
            .twist = static_cast<float>(point.bends.x),
            .flexion = static_cast<float>(point.bends.y),
            .deviation = static_cast<float>(point.bends.z)};
}

struct Ball {
    Place centre{0};
    double radius = 0;
};

// A place in the frame of a hand [m]; a hand that closes brings it nearer to the wrist and towards the palm.
struct HandPlace {
    double along = 0, thumbward = 0;               // from the wrist to the fingers; towards the thumb
    double closed_along = 0, closed_palmward = 0;  // moves of a fist
};
constexpr HandPlace kPalm{0.055, 0.01}, kThumb{0.1, 0.028}, kEdge{0.09, -0.034}, kKnuckles{0.102, 0};
constexpr HandPlace kFingers{0.145, 0.01, -0.04, 0.035}, kFingertips{0.185, 0.01, -0.1, 0.05};
constexpr HandPlace kLittleTip{0.14, -0.036, -0.06, 0.045};

// Shares of the way from shoulder to elbow, and from elbow to wrist.
constexpr double kAboveElbow = 0.75, kUpperForearm = 0.33, kLowerForearm = 0.67;

// Radii of what keeps out of the body, and of the bones in it, which the other hand may touch [m].
struct ArmRadii {
    double above_elbow = 0.01, elbow = 0.02, upper_forearm = 0.035, lower_forearm = 0.038;
    double palm = 0.024, thumb = 0.02, edge = 0.018, fingertips = 0.014, little_tip = 0.014;
};
struct BoneRadii {
    double forearm = 0.03, wrist = 0.021, palm = 0.016, thumb = 0.012, knuckles = 0.012, edge = 0.011;
    double fingers = 0.01, fingertips = 0.008, little_tip = 0.008;
};
constexpr ArmRadii kSkinRadii{};
constexpr BoneRadii kBoneRadii{};

// What of an arm could touch: the joints and balls along its bones.
struct ArmBody {
    Place shoulder, elbow, wrist;
    std::array<Ball, 2> upper;    // moved by the swivel alone
    std::array<Ball, 3> forearm;  // from the elbow on
    std::array<Ball, 5> hand;
    std::array<Ball, 9> bones;  // of forearm and hand, no thicker than they are: hands may touch
    ArmAngles angles;
};

ArmBody body_of(const ArmPoint& point, double closed, ArmSide side) {
    const ArmTurns turns = turns_of(state_of(point), side);
    const ArmChain chain = chain_of(turns, side);
    const Place elbow(chain.elbow), wrist(chain.wrist), shoulder(chain.shoulder);
    const double outward = side == ArmSide::left ? 1 : -1;
    const auto at_hand = [&](const HandPlace& place) {
        const double along = place.along + place.closed_along * closed;
        return wrist +
               Place(chain.hand * Vec3(outward * along, -(place.closed_palmward * closed), place.thumbward));
    };
    ArmBody body{.shoulder = shoulder,
                 .elbow = elbow,
                 .wrist = wrist,
                 .upper = {},
                 .forearm = {},
                 .hand = {},
                 .bones = {},
                 .angles = turns.angles};
    const ArmRadii& skin = kSkinRadii;
    body.upper = {Ball{glm::mix(shoulder, elbow, kAboveElbow), skin.above_elbow}, Ball{elbow, skin.elbow}};
    body.forearm = {Ball{glm::mix(elbow, wrist, kUpperForearm), skin.upper_forearm},
                    Ball{glm::mix(elbow, wrist, kLowerForearm), skin.lower_forearm}, Ball{wrist, kWrist}};
    body.hand = {Ball{at_hand(kPalm), skin.palm}, Ball{at_hand(kThumb), skin.thumb},
                 Ball{at_hand(kEdge), skin.edge}, Ball{at_hand(kFingertips), skin.fingertips},
                 Ball{at_hand(kLittleTip), skin.little_tip}};
    const BoneRadii& bones = kBoneRadii;
    body.bones = {Ball{body.forearm[1].centre, bones.forearm}, Ball{wrist, bones.wrist},
                  Ball{body.hand[0].centre, bones.palm},       Ball{body.hand[1].centre, bones.thumb},
                  Ball{at_hand(kKnuckles), bones.knuckles},    Ball{body.hand[2].centre, bones.edge},
                  Ball{at_hand(kFingers), bones.fingers},      Ball{body.hand[3].centre, bones.fingertips},
                  Ball{body.hand[4].centre, bones.little_tip}};
    return body;
}

// How the arm has to move for one moment.
struct Push {
    Place wrist{0};
    double swivel = 0;
};

void push_ball(Push& push, double& deepest, const Ball& ball) {
    const SignedDistance skin = signed_distance_to_body(ball.centre);
    const double depth = ball.radius + kSkin - skin.distance;
    if (depth <= deepest) return;
    deepest = depth;
    push.wrist = skin.away * depth;
}

// The turn of the elbow about the line from shoulder to wrist that takes a ball on it out of the body, as far
// as the upper arm turns.
double swivel_out(const ArmBody& body, ArmSide side) {
    const Place line = normalize(body.wrist - body.shoulder);
    const double outward = side == ArmSide::left ? 1 : -1;
    double turn = 0, deepest = 0;
    for (const Ball& ball : body.upper) {
        const SignedDistance skin = signed_distance_to_body(ball.centre);
        const double depth = ball.radius - skin.distance;
        if (depth <= deepest) continue;
        deepest = depth;
        // A growing swivel of the left arm turns the elbow from down to +x, about the line.
        const Place moved = cross(line, ball.centre - body.shoulder) * outward;
        const double gain = dot(moved, skin.away);
        turn = depth * gain / (gain * gain + 1e-3);
    }
    // The swivel turns the upper arm by the same angle.
    const double most = double(kArmLimits.most_rotation) - kRotationSlack;
    return std::clamp(std::clamp(turn, -0.3, 0.3), -most - body.angles.rotation, most - body.angles.rotation);
}

Push push_of(const ArmBody& body, ArmSide side) {
    Push push;
    double deepest = 0;
    for (const Ball& ball : body.forearm) push_ball(push, deepest, ball);
    for (const Ball& ball : body.hand) push_ball(push, deepest, ball);
    push.swivel = swivel_out(body, side);
    return push;
}

// Where two hands overlap at one moment.
struct Meeting {
    double depth = 0;  // [m]; 0: they do not
    Place way{0};      // unit: the shortest for the left hand out of the right one
    Place palms{0};    // from the right palm to the left one [m]
};

Meeting meeting_of(const ArmBody& left, const ArmBody& right) {
    Meeting meeting{.palms = left.hand[0].centre - right.hand[0].centre};
    if (length(meeting.palms) > 0.5) return meeting;
    for (const Ball& a : left.bones) {
        for (const Ball& b : right.bones) {
            const Place between = a.centre - b.centre;
            const double depth = a.radius + b.radius - length(between);
            if (depth <= meeting.depth) continue;
            meeting.depth = depth;
            meeting.way = normalize(between + Place(1e-4, 0, 0));
        }
    }
    return meeting;
}

// Hands that come out of a meeting on the other side of each other pass on one side of their way, where they
// are nearest to it: pushed back at first and on at last they would go through each other.
void let_pass(std::span<Meeting> meetings) {
    const Place before = meetings.front().palms, behind = meetings.back().palms;
    if (dot(before, behind) > 0) return;
    const Place along = normalize(behind - before + Place(1e-4, 0, 0));
    const auto beside = [&](const Place& v) { return v - along * dot(v, along); };
    // In doubt the left hand passes before the right one.
    Place aside = beside(Place(0, 0.003, 0.01));
    for (const Meeting& meeting : meetings) aside += beside(meeting.palms) / double(meetings.size());
    if (length(aside) < 1e-6) return;
    for (Meeting& meeting : meetings) meeting.way = normalize(aside);
}

// A soft limit: `value` approaches `most` more slowly the nearer it is.
double below(double value, double most, double softness) {
    const double room = (most - value) / softness;
    return room > 30 ? value : most - softness * std::log1p(std::exp(room));
}

// The wrist where its elbow can bend for it.
Place within_reach(const ArmPoint& point, ArmSide side) {
    const Place shoulder(chain_of(turns_of(state_of(point), side), side).shoulder);
    const Place way = point.wrist - shoulder;
    const double arm = agent_arm_length(), d = length(way);
    const double held = -below(-below(d, 0.978 * arm, 0.006 * arm), -0.29 * arm, 0.01 * arm);
    return shoulder + way * (held / d);
}

// Weights of sum 1 at -reach ... reach.
std::vector<double> gaussian(double sigma, int reach) {
    std::vector<double> weights;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
        sum += weights.emplace_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    for (double& weight : weights) weight /= sum;
    return weights;
}

// Each round looks for contacts at all times and moves the arms out of them, spread smoothly over the times around.
class Rounds {
  public:
    explicit Rounds(ArmGrid& grid)
        : grid_(grid),
          count_(grid.arms[0].size()),
          reach_(static_cast<int>(3 * kSigma * grid.rate)),
          weights_(gaussian(kSigma * grid.rate, reach_)),
          unsure_(count_, true) {}

    void go() {
        look();
        for (std::size_t n = 0; n < count_; ++n) {
            std::size_t end = n;
            while (end < count_ && meetings_[end].depth > 0) ++end;
            if (end == n) continue;
            let_pass(std::span(meetings_).subspan(n, end - n));
            n = end;
        }
        spread();
    }

  private:
    void look() {
        pushes_.assign(count_, {});
        meetings_.assign(count_, {});
        for (std::size_t n = 0; n < count_; ++n) {
            if (!unsure_[n]) continue;
            const ArmBody left = body_of(grid_.arms[0][n], grid_.closed[0][n], ArmSide::left);
            const ArmBody right = body_of(grid_.arms[1][n], grid_.closed[1][n], ArmSide::right);
            pushes_[n] = {push_of(left, ArmSide::left), push_of(right, ArmSide::right)};
            meetings_[n] = meeting_of(left, right);
        }
    }

    void spread() {
        std::array<std::vector<ArmPoint>, 2> moves{std::vector<ArmPoint>(count_),
                                                   std::vector<ArmPoint>(count_)};
        unsure_.assign(count_, false);
        for (std::size_t n = 0; n < count_; ++n) {
            const Place apart = meetings_[n].way * (meetings_[n].depth / 2);
            const std::array<ArmPoint, 2> moved = {
                ArmPoint{.wrist = kGain * (pushes_[n][0].wrist + apart), .swivel = pushes_[n][0].swivel},
                ArmPoint{.wrist = kGain * (pushes_[n][1].wrist - apart), .swivel = pushes_[n][1].swivel}};
            if (moved[0] == ArmPoint{} && moved[1] == ArmPoint{}) continue;
            const auto here = static_cast<std::ptrdiff_t>(n), last = static_cast<std::ptrdiff_t>(count_) - 1;
            for (auto k = std::max<std::ptrdiff_t>(0, here - reach_); k <= std::min(last, here + reach_);
                 ++k) {
                const double weight = weights_[static_cast<std::size_t>(k - here + reach_)];
                const auto at = static_cast<std::size_t>(k);
                unsure_[at] = true;
                for (std::size_t arm = 0; arm < 2; ++arm)
                    moves[arm][at] = moves[arm][at] + moved[arm] * weight;
            }
        }
        for (std::size_t arm = 0; arm < 2; ++arm)
            for (std::size_t n = 0; n < count_; ++n) grid_.arms[arm][n] = grid_.arms[arm][n] + moves[arm][n];
    }

    ArmGrid& grid_;
    std::size_t count_;
    int reach_;                    // of a move [points]
    std::vector<double> weights_;  // over -reach ... reach
    std::vector<bool> unsure_;     // what was moved since it was found clear
    std::vector<std::array<Push, 2>> pushes_;
    std::vector<Meeting> meetings_;
};

}  // namespace

std::vector<ArmPoint> smoothed(const std::vector<ArmPoint>& points, const std::vector<double>& sigmas,
                               double rate) {
    const int count = static_cast<int>(points.size());
    std::vector<ArmPoint> means(points.size());
    std::vector<double> weights;
    double made_for = 0;
    for (int n = 0; n < count; ++n) {
        const double sigma = sigmas[static_cast<std::size_t>(n)] * rate;
        const int reach = std::max(1, static_cast<int>(std::ceil(3 * sigma)));
        if (sigma != made_for) weights = gaussian(sigma, reach);
        made_for = sigma;
        ArmPoint& mean = means[static_cast<std::size_t>(n)];
        for (int i = -reach; i <= reach; ++i)
            mean = mean + points[static_cast<std::size_t>(std::clamp(n + i, 0, count - 1))] *
                              weights[static_cast<std::size_t>(i + reach)];
    }
    return means;
}

void clear(ArmGrid& grid) {
    const auto bring_into_reach = [&] {
        for (const ArmSide side : kArmSides)
            for (ArmPoint& point : grid.arms[index_of(side)]) point.wrist = within_reach(point, side);
    };
    bring_into_reach();
    Rounds rounds(grid);
    for (int round = 0; round < kRounds; ++round) rounds.go();
    bring_into_reach();
}

}  // namespace chironomia
