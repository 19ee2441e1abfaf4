// Conversations of two people, as the NoXi corpus has them.
#include <algorithm>
#include <array>
#include <cassert>

#include "core/text.h"
#include "synth/corpus/make/corpus_settings.h"
#include "synth/corpus/make/face.h"
#include "synth/corpus/make/jobs.h"
#include "synth/corpus/make/speech.h"
#include "synth/corpus/make/tables.h"
#include "synth/expressive.h"
#include "synth/features/speech_features.h"
#include "synth/markup/functions.h"
#include "synth/presence/turns.h"

namespace chironomia {
namespace {

constexpr std::array<int, 5> kUnits = {1, 2, 4, 6, 12};
static_assert(TrackedFace::kGaze + TrackedFace::kHead + kUnits.size() == DyadPerson::kFace);

struct Dyad {
    const CorpusOrder& order;
    const Lexicon& lexicon;
    std::string id;
    std::array<CorpusSpeaker, 2> people;  // the expert, the novice
    Coupling coupling;
    double seconds = 0;
    Split split = Split::train;
    std::uint64_t seed = 0;
};

using Acts = std::vector<std::string_view>;

const Acts kOpenings = {"Conventional-opening"}, kClosings = {"Conventional-closing", "Thanking"};
const Acts kQuestions = {"Wh-Question", "Yes-No-Question", "Open-Question", "Or-Clause", "Tag-Question"};
const Acts kReplies = {"Yes answers", "No answers",    "Agree/Accept", "Appreciation",
                       "Hedge",       "Repeat-phrase", "Quotation",    "Response Acknowledgement"};
const Acts kStatements = {"Statement-non-opinion", "Statement-opinion", "Quotation", "Hedge",
                          "Rhetorical-Questions"};

// What two people say to each other about one topic.
class Conversation {
  public:
    Conversation(const Dyad& dyad, Random random) : dyad_(dyad), random_(random) {
        const std::vector<std::string>& topics = bundled_grammar().topics_of.at("host");
        topic_ = topics[random_.below(static_cast<std::uint32_t>(topics.size()))];
    }

    // The turn `number`, and whether it is one of the last.
    std::vector<Sentence> turn(std::size_t number, bool ends) {
        if (ends) return {sentence(number, kClosings)};
        if (number < 2) return {sentence(number, kOpenings), sentence(number, kStatements)};
        std::vector<Sentence> said = {sentence(number, kReplies)};
        const bool is_expert = number % 2 == 0;
        const std::size_t statements = is_expert ? 1 + random_.below(3) : 1 + random_.below(2);
        for (std::size_t i = 0; i < statements; ++i) said.push_back(sentence(number, kStatements));
        if (random_.uniform() < (is_expert ? 0.4 : 0.7)) said.push_back(sentence(number, kQuestions));
        return said;
    }

  private:
    Sentence sentence(std::size_t turn, const Acts& acts) {
        const CorpusSpeaker& speaker = dyad_.people[turn % 2];
        return say(bundled_grammar(),
                   {.genre = "host", .topic = topic_, .idiolect = speaker.idiolect, .dialog_acts = acts},
                   random_);
    }

    const Dyad& dyad_;
    Random random_;
    std::string topic_;
};

// People who talk with each other smile more than their words ask for: every few seconds.
void add_smiles(Speech& turn, Random random) {
    for (std::size_t w = random.below(3); w < turn.words.size(); w += 3 + random.below(9)) {
        Mark smile{.kind = MarkKind::emotion,
                   .value = "joy",
                   .first_word = w,
                   .end_word = w + 1,
                   .weight = 1,
                   .manner = {}};
        smile.manner[Expressivity::spatial_extent] = 2 * random.uniform() - 1;
        turn.marks.push_back(smile);
    }
    sort_marks(turn.marks);
}

std::array<Speech, 2> converse(const Dyad& dyad) {
    constexpr double kPause = 0.4, kGoodbye = 6;  // [s]
    Conversation conversation(dyad, Random(dyad.seed, 1));
    std::vector<SpokenTurn> turns;
    double time = kPause;
    for (std::size_t number = 0, last = 0; last < 2; ++number) {
        const bool ends = time > dyad.seconds - kGoodbye;
        last += ends ? 1 : 0;
        SpokenTurn turn{
            .person = number % 2,
            .speech = say_aloud(conversation.turn(number, ends), dyad.people[number % 2].speaker.voice)};
        add_smiles(turn.speech, Random(dyad.seed, 100 + number));
        time += turn.speech.audio.duration() + kPause;
        turns.push_back(std::move(turn));
    }
    return place_turns(turns, {.between = kPause, .at_edges = kPause});
}

DyadPerson person_of(const Dyad& dyad, std::size_t number, const Speech& speech, const Performed& performed) {
    const std::string& name = dyad.people[number].speaker.name;
    const FeatureTrack heard = speech_features(speech.audio);
    TrackedFace face =
        track_face(*performed.motion.face, kUnits, dyad.order.noise, Random(dyad.seed, 10 + number));
    if (dyad.order.tables) {
        write_tables(
            dyad.order.folder, format("{}_{}", dyad.id, name),
            {.face = face, .units = kUnits, .fps = DyadRecord::kFps, .speech = heard, .sound = speech.audio});
    }
    if (dyad.order.noise) face = cleaned(std::move(face));
    const std::size_t frames = face.frames();
    DyadPerson person{
        .participant = name, .role = number == 0 ? "expert" : "novice", .face = {}, .speech = {}};
    const auto append = [&](const std::vector<float>& values, std::size_t t, std::size_t width) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(t * width);
        person.face.insert(person.face.end(), first, first + static_cast<std::ptrdiff_t>(width));
    };
    for (std::size_t t = 0; t < frames; ++t) {
        append(face.gaze, t, TrackedFace::kGaze);
        append(face.head, t, TrackedFace::kHead);
        append(face.units, t, kUnits.size());
    }
    person.speech = speech_at(heard, DyadRecord::kFps, frames).values;
    return person;
}

std::vector<CorpusEntry> make_dyad(const Dyad& dyad) {
    const std::array<Speech, 2> speeches = converse(dyad);
    ExpressiveDialog dialog{.people = {}, .coupling = dyad.coupling};
    for (std::size_t i = 0; i < 2; ++i)
        dialog.people[i] = {.speech = speeches[i], .speaker = dyad.people[i].speaker, .partner = 0};
    const std::array<Performed, 2> performed = perform_dialog(dialog, {.speaker = {},
                                                                       .lexicon = dyad.lexicon,
                                                                       .variants = kCorpusVariants,
                                                                       .fps = DyadRecord::kFps,
                                                                       .seed = dyad.seed});
    DyadRecord record{
        .id = dyad.id, .people = {}, .kappa = dyad.coupling.strength, .tau = dyad.coupling.delay};
    for (std::size_t i = 0; i < 2; ++i) record.people[i] = person_of(dyad, i, speeches[i], performed[i]);
    write_dyad(dyad.order.folder, record);
    return {{.id = dyad.id,
             .speaker = format("{}+{}", record.people[0].participant, record.people[1].participant),
             .split = dyad.split,
             .seconds = static_cast<double>(record.frames()) / record.fps}};
}

}  // namespace

DyadCounts dyad_counts(CorpusSize size) {
    if (size == CorpusSize::ci) return {.dyads = 3, .seconds = 40, .people = 2, .meetings = 1};
    if (size == CorpusSize::mini) return {.dyads = 12, .seconds = 240, .people = 3, .meetings = 2};
    return {.dyads = 24, .seconds = 480, .people = 3, .meetings = 4};
}

CorpusPlan plan_dyads(const CorpusOrder& order, const Lexicon& lexicon, const DyadCounts& counts) {
    constexpr std::size_t kSeen = 16;
    const std::size_t groups = counts.dyads / counts.meetings, people = groups * counts.people;
    assert(groups > counts.validation + counts.test);
    const std::size_t seen = std::min(people, kSeen);
    CorpusPlan plan{
        .unit = "dyads", .speakers = corpus_speakers(seen, people - seen, order.seed), .jobs = {}};
    for (std::size_t i = 0; i < counts.dyads; ++i) {
        const std::size_t group = i % groups, meeting = i / groups;
        const auto person = [&](std::size_t number) {
            return plan.speakers[group * counts.people + number % counts.people];
        };
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(counts.dyads);
        // Every delay once with some strength, in no order: 5 and the number of dyads share no divisor.
        const double other =
            (static_cast<double>(i * 5 % counts.dyads) + 0.5) / static_cast<double>(counts.dyads);
        const Dyad dyad{.order = order,
                        .lexicon = lexicon,
                        .id = format("dyad_{:02}", i),
                        .people = {person(meeting), person(meeting + 1)},
                        .coupling = {.strength = 0.8 * share, .delay = 0.3 + 0.9 * other},
                        .seconds = counts.seconds,
                        .split = group < counts.validation                 ? Split::validation
                                 : group < counts.validation + counts.test ? Split::test
                                                                           : Split::train,
                        .seed = derived_seed(order.seed, 6, i)};
        for (const std::size_t number : {meeting, meeting + 1})
            plan.speakers[group * counts.people + number % counts.people].is_seen =
                dyad.split == Split::train;
        plan.jobs.push_back([dyad] { return make_dyad(dyad); });
    }
    return plan;
}

}  // namespace chironomia
