#include "synth/motor/clearance.h"

#include <algorithm>
#include <cmath>

#include "synth/body/agent_body.h"
#include "synth/motor/body_gap.h"

namespace chironomia {
namespace {

using Place = glm::dvec3;

constexpr double kSigma = 0.08;          // of what is moved, in time [s]
constexpr int kRounds = 12;              // of moving and looking again
constexpr double kGain = 1.8;            // of a move, of which smoothing takes a part
constexpr double kSkin = 0.012;          // kept from the body, cloth and slack [m]
constexpr double kApart = 0.01;          // kept between hands [m]
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

// What of an arm could touch: the joints and balls along its bones.
struct ArmBody {
    Place shoulder, elbow, wrist;
    std::array<Ball, 2> upper;    // moved by the swivel alone
    std::array<Ball, 3> forearm;  // from the elbow on
    std::array<Ball, 5> hand;
    ArmAngles angles;
};

ArmBody body_of(const ArmPoint& point, double closed, ArmSide side) {
    const ArmTurns turns = turns_of(state_of(point), side);
    const ArmChain chain = chain_of(turns, side);
    const Place elbow(chain.elbow), wrist(chain.wrist), shoulder(chain.shoulder);
    const double outward = side == ArmSide::left ? 1 : -1;
    const auto at_hand = [&](double along, double palmward, double thumbward) {
        return wrist + Place(chain.hand * Vec3(outward * along, -palmward, thumbward));
    };
    ArmBody body{.shoulder = shoulder,
                 .elbow = elbow,
                 .wrist = wrist,
                 .upper = {},
                 .forearm = {},
                 .hand = {},
                 .angles = turns.angles};
    body.upper = {Ball{glm::mix(shoulder, elbow, 0.75), 0.03}, Ball{elbow, 0.032}};
    body.forearm = {Ball{glm::mix(elbow, wrist, 0.33), 0.043}, Ball{glm::mix(elbow, wrist, 0.67), 0.038},
                    Ball{wrist, kWrist}};
    body.hand = {Ball{at_hand(0.055, 0, 0.01), 0.024}, Ball{at_hand(0.1, 0, 0.028), 0.02},
                 Ball{at_hand(0.09, 0, -0.034), 0.018},
                 Ball{at_hand(0.185 - 0.1 * closed, 0.05 * closed, 0.01), 0.014},
                 Ball{at_hand(0.14 - 0.06 * closed, 0.045 * closed, -0.036), 0.014}};
    return body;
}

// How the arm has to move for one moment.
struct Push {
    Place wrist{0};
    double swivel = 0;
};

void push_ball(Push& push, double& deepest, const Ball& ball) {
    const Gap gap = gap_to_body(ball.centre);
    const double depth = ball.radius + kSkin - gap.distance;
    if (depth <= deepest) return;
    deepest = depth;
    push.wrist = gap.away * depth;
}

// The turn of the elbow about the line from shoulder to wrist that takes a ball on it out of the body, as far
// as the upper arm turns.
double swivel_out(const ArmBody& body, ArmSide side) {
    const Place line = normalize(body.wrist - body.shoulder);
    const double outward = side == ArmSide::left ? 1 : -1;
    double turn = 0, deepest = 0;
    for (const Ball& ball : body.upper) {
        const Gap gap = gap_to_body(ball.centre);
        const double depth = ball.radius - gap.distance;
        if (depth <= deepest) continue;
        deepest = depth;
        // A growing swivel of the left arm turns the elbow from down to +x, about the line.
        const Place moved = cross(line, ball.centre - body.shoulder) * outward;
        const double gain = dot(moved, gap.away);
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

// Both hands out of each other, each by half.
void part_hands(const std::array<ArmBody, 2>& arms, std::array<Push, 2>& pushes) {
    if (distance(arms[0].wrist, arms[1].wrist) > 0.5) return;
    double deepest = 0;
    Place way{0};
    const auto meet = [&](const Ball& a, const Ball& b) {
        const Place between = a.centre - b.centre;
        const double depth = a.radius + b.radius + kApart - length(between);
        if (depth <= deepest) return;
        deepest = depth;
        way = normalize(between + Place(0.01, 0, 0)) * (depth / 2);
    };
    const auto balls = [](const ArmBody& arm) {
        return std::array<Ball, 7>{arm.forearm[1], arm.forearm[2], arm.hand[0], arm.hand[1],
                                   arm.hand[2],    arm.hand[3],    arm.hand[4]};
    };
    for (const Ball& a : balls(arms[0]))
        for (const Ball& b : balls(arms[1])) meet(a, b);
    pushes[0].wrist += way;
    pushes[1].wrist -= way;
}

// `value` below `most`, ever more gently as it comes near.
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

// How both arms should move at one moment, if they were not to move smoothly.
std::array<ArmPoint, 2> pushes_at(const ArmGrid& grid, std::size_t n) {
    const std::array<ArmBody, 2> arms = {body_of(grid.arms[0][n], grid.closed[0][n], ArmSide::left),
                                         body_of(grid.arms[1][n], grid.closed[1][n], ArmSide::right)};
    std::array<Push, 2> pushes = {push_of(arms[0], ArmSide::left), push_of(arms[1], ArmSide::right)};
    part_hands(arms, pushes);
    std::array<ArmPoint, 2> moves;
    for (std::size_t arm = 0; arm < 2; ++arm)
        moves[arm] = {.wrist = pushes[arm].wrist * kGain, .swivel = pushes[arm].swivel};
    return moves;
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
    const std::size_t count = grid.arms[0].size();
    for (const ArmSide side : kArmSides)
        for (ArmPoint& point : grid.arms[index_of(side)]) point.wrist = within_reach(point, side);

    const int reach = static_cast<int>(3 * kSigma * grid.rate);
    const std::vector<double> weights = gaussian(kSigma * grid.rate, reach);
    std::vector<bool> unsure(count, true);  // what was not found clear since it moved last
    for (int round = 0; round < kRounds; ++round) {
        std::array<std::vector<ArmPoint>, 2> moves{std::vector<ArmPoint>(count),
                                                   std::vector<ArmPoint>(count)};
        std::vector<bool> moved(count, false);
        for (std::size_t n = 0; n < count; ++n) {
            if (!unsure[n]) continue;
            const std::array<ArmPoint, 2> pushes = pushes_at(grid, n);
            if (pushes[0] == ArmPoint{} && pushes[1] == ArmPoint{}) continue;
            for (int i = -reach; i <= reach; ++i) {
                const auto at = static_cast<std::ptrdiff_t>(n) + i;
                if (at < 0 || at >= static_cast<std::ptrdiff_t>(count)) continue;
                const auto k = static_cast<std::size_t>(at);
                moved[k] = true;
                for (std::size_t arm = 0; arm < 2; ++arm)
                    moves[arm][k] =
                        moves[arm][k] + pushes[arm] * weights[static_cast<std::size_t>(i + reach)];
            }
        }
        for (std::size_t arm = 0; arm < 2; ++arm)
            for (std::size_t n = 0; n < count; ++n)
                if (moved[n]) grid.arms[arm][n] = grid.arms[arm][n] + moves[arm][n];
        unsure = moved;
    }
    for (const ArmSide side : kArmSides)
        for (ArmPoint& point : grid.arms[index_of(side)]) point.wrist = within_reach(point, side);
}

}  // namespace chironomia
