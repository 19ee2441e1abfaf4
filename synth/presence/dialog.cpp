#include "synth/presence/dialog.h"

#include "synth/presence/attend.h"
#include "synth/presence/face_signals.h"

namespace chironomia {
namespace {

using Seeds = std::array<std::uint64_t, 2>;

// Both people of one dialog get different seeds.
Seeds seeds_of(std::uint64_t seed) {
    Random random(seed, 600);
    const auto draw = [&] { return (std::uint64_t{random.next()} << 32) | random.next(); };
    const std::uint64_t first = draw();
    return {first, draw()};
}

// 1 while a person has the floor, 0 while the other has it.
Curve floor_of(std::size_t person, const std::vector<FloorTime>& floors, const FrameTimes& times) {
    constexpr double kChange = 0.4;  // of the floor; ours, by eye [s]
    Curve curve(times);
    for (const FloorTime& floor : floors) {
        if (floor.person != person) continue;
        curve.add_step(floor.start - kChange, kChange, 1);
        curve.add_step(floor.end, kChange, -1);
    }
    return curve;
}

}  // namespace

std::array<IdleBody, 2> animate_dialog(const std::array<Interlocutor, 2>& people, const Coupling& coupling,
                                       const FrameTimes& times, std::uint64_t seed) {
    const Seeds seeds = seeds_of(seed);
    const std::array<std::vector<Phrase>, 2> phrases = {phrases_of(people[0].speech),
                                                        phrases_of(people[1].speech)};
    const std::vector<FloorTime> floors = floor_times(phrases);
    FrameTimes earlier = times;
    earlier.first -= coupling.delay;

    const auto carried = [&](std::size_t i) {
        const Interlocutor &person = people[i], &partner = people[1 - i];
        Curve smile = own_smile(person.behaviours.signals, times, seeds[i]);
        smile.add_product(coupling.strength, own_smile(partner.behaviours.signals, earlier, seeds[1 - i]),
                          floor_of(1 - i, floors, earlier));
        Behaviours behaviours = person.behaviours;
        behaviours.signals =
            attend(std::move(behaviours.signals), {.person = i,
                                                   .floors = floors,
                                                   .partner = {phrases[1 - i], partner.behaviours.accents},
                                                   .speaker = person.speaker,
                                                   .seed = seeds[i]});
        return animate_smiling_body({.behaviours = behaviours,
                                     .speech = person.speech,
                                     .speaker = person.speaker,
                                     .times = times,
                                     .seed = seeds[i],
                                     .partner = person.partner},
                                    smile);
    };
    return {carried(0), carried(1)};
}

}  // namespace chironomia
