// chironomia synth
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "core/error.h"
#include "core/files/wav_file.h"
#include "core/render/rate.h"
#include "core/text.h"
#include "skinning/motion/motion_hdf5.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"

namespace chironomia::study {
namespace {

struct ScriptOption {
    const char* name;
    std::optional<MarkupLanguage> language;  // none: recognised
    const char* help;
};

constexpr auto kExpressive = "expressive";

// Groups of options.
constexpr auto kOfSpeakers = "Speaker (docs/speakers.md)";
constexpr auto kReadings = "Readings of the paper (synth/README.md)";
constexpr auto kLearned = "Learned engines (docs/learning.md)";

std::vector<std::string> engine_names() {
    std::vector<std::string> names = learned_engines();
    names.insert(names.begin(), kExpressive);
    return names;
}

const std::array<ScriptOption, 5> kScripts = {{
    {"--text", MarkupLanguage::plain, "Plain text; rules find what it means to do"},
    {"--aplm", MarkupLanguage::aplm, "APLM: what the speaker means to do is marked"},
    {"--bml", MarkupLanguage::bml, "BML as GRETA writes it: gestures and when they are made"},
    {"--ssml", MarkupLanguage::ssml, "SSML: how it is spoken; rules find the rest"},
    {"--script", std::nullopt, "Any of the four, recognised by its content"},
}};

// What is said: one of the scripts, a recording, or gestures by themselves.
void add_sources(CLI::App& verb, SynthCommand& command) {
    SynthesisJob& job = command.job;
    CLI::Option_group* group = verb.add_option_group("What is said (a file, or the text itself)");
    for (const ScriptOption& script : kScripts) {
        group
            ->add_option_function<std::string>(
                script.language ? script.name : format("script,{}", script.name),
                [&job, script](const std::string& text) {
                    job.script = text;
                    job.option = script.name;
                    job.language = script.language;
                },
                script.help)
            ->type_name("TEXT");
    }
    group->add_option("--gesture", job.gestures, "No speech: one gesture of the lexicon, or all, one by one")
        ->type_name("ID|all");
    group->add_option("--dialog", command.dialog, "Two people who take turns (docs/dialogs.md)")
        ->type_name("FILE");
    group->require_option(0, 1);
    CLI::Option* speech =
        verb.add_option("--speech", job.recording, "Recorded speech, in place of a synthetic voice")
            ->type_name("WAV");
    verb.add_option("--words", job.words, "When its words are said: TextGrid, ELAN, WebVTT, CSV or JSON")
        ->type_name("W")
        ->needs(speech);
    verb.add_option("--words-speaker", job.words_speaker,
                    "Whose words those are, in a file of several people, as it names them")
        ->type_name("NAME")
        ->needs("--words");
    add_choice<SpeechChannel>(
        verb, "--speech-channel", job.channel,
        {{"mean", SpeechChannel::mean}, {"left", SpeechChannel::left}, {"right", SpeechChannel::right}})
        ->description("Which channel of it is the person's: left, right, or the mean of all [mean]")
        ->needs(speech);
}

void add_manner(CLI::App& verb, SynthesisJob& job) {
    verb.add_option("--speaker", job.speaker, "One of the bundled speakers, or a JSON file [neutral]")
        ->type_name("NAME|FILE")
        ->group(kOfSpeakers);
    verb.add_option("--language", job.spoken_language,
                    "Of the words and of the voice, as espeak-ng names it: en-us, fr, de ... [the speaker's]")
        ->type_name("L")
        ->group(kOfSpeakers);
    for (std::size_t i = 0; i < kExpressivities; ++i) {
        const auto dimension = static_cast<Expressivity>(i);
        verb.add_option(format("--{}", symbol_of(dimension)), job.manner[dimension],
                        format("{}, {:g} to 1 [the speaker's]", name_of(dimension), least_of(dimension)))
            ->type_name("X")
            ->check(CLI::Range(least_of(dimension), 1.0))
            ->group(kOfSpeakers);
    }
    verb.add_option(
            "--partner-deg", job.partner_deg,
            "How far to the person's left the partner stands whom they look at: 35 and -35 for the left and "
            "the right one of scene dyad [0]")
        ->type_name("D")
        ->check(CLI::Range(-45.0, 45.0))
        ->group(kOfSpeakers);
    verb.add_option("--lexicon", job.lexicons, "More gestures, in files of docs/gestures.md")
        ->type_name("FILE");
}

// What the paper leaves open; synth/README.md has the numbers of its ambiguities.
void add_variants(CLI::App& verb, Variants& variants) {
    add_choice<SpatialMatrix>(verb, "--spatial-reading", variants.spatial_matrix,
                              {{"scale", SpatialMatrix::scale}, {"translate", SpatialMatrix::translate}})
        ->description("The spatial extent scales the space of gestures, or shifts it [scale]")
        ->group(kReadings);
    verb.add_option("--fitts-intercept", variants.fitts_intercept,
                    "Intercept of Fitts's law, the least time of a movement [0.09]")
        ->type_name("S")
        ->check(CLI::Range(0.0, 1.0))
        ->group(kReadings);
    add_choice<TemporalSign>(verb, "--tempo-reading", variants.temporal_sign,
                             {{"fast", TemporalSign::fast}, {"printed", TemporalSign::printed}})
        ->description("A positive temporal extent is quicker, or slower as printed [fast]")
        ->group(kReadings);
    add_choice<TemporalScope>(verb, "--tempo-scope", variants.temporal_scope,
                              {{"all", TemporalScope::all}, {"stroke", TemporalScope::stroke}})
        ->description("It acts on all of a gesture, or on the stroke alone [all]")
        ->group(kReadings);
    verb.add_option("--retraction-pause", variants.retraction_threshold,
                    "Pause below which the arms stay up, at fluidity 0 [1.0]")
        ->type_name("S")
        ->check(CLI::Range(0.0, 10.0))
        ->group(kReadings);
    add_choice<FluidityMap>(verb, "--fluidity-reading", variants.fluidity_map,
                            {{"monotone", FluidityMap::monotone}, {"printed", FluidityMap::printed}})
        ->description(
            "Fluidity is the spline's continuity below 0 and smooths above it, or is the "
            "continuity throughout as printed [monotone]")
        ->group(kReadings);
    verb.add_option("--fist-gain", variants.fist_gain, "How far power 1 closes the hand to a fist [0.7]")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0))
        ->group(kReadings);
    verb.add_option(
            "--latest-at-beginning", variants.latest_at_beginning,
            "How long after its accent a gesture at the beginning may come, so that it is not dropped; "
            "beats never [0.6]")
        ->type_name("S")
        ->check(CLI::Range(0.0, 2.0))
        ->group(kReadings);
    verb.add_option("--repetition-lookahead", variants.repetition_lookahead,
                    "x of the lookahead for repetitions, above 1 [1.25]")
        ->type_name("X")
        ->check(CLI::Range(1.0, 10.0))
        ->group(kReadings);
}

void add_learned(CLI::App& verb, SynthCommand& command) {
    LearnedEngine& learned = command.learned;
    verb.add_option("--engine", learned.model, "The synthesis system [expressive]")
        ->type_name("expressive|" + join(learned_engines(), "|"))
        ->check(CLI::IsMember(engine_names()));
    verb.add_option("--checkpoint", learned.checkpoint,
                    "Of the learned engine [the bundled one; mix-stage has none]")
        ->type_name("C.safetensors")
        ->group(kLearned);
    verb.add_option("--user-face", learned.user_face, "amii: what its partner's face does")
        ->type_name("F")
        ->group(kLearned);
    verb.add_option("--user-speech", learned.user_speech, "amii: what its partner says")
        ->type_name("WAV")
        ->group(kLearned);
    verb.add_option(
            "--style-of", learned.style_of,
            "zs-mstm, mix-stage: the target speaker: an interval of PATS, a speaker of a corpus, or of "
            "mix-stage one that it has learned")
        ->type_name("FILE.h5|DIR:SPEAKER|SPEAKER")
        ->group(kLearned);
    verb.add_option(
            "--content-of", learned.content_of,
            "zs-mstm, mix-stage: an interval of PATS whose words and sound are used in place of speech")
        ->type_name("FILE.h5")
        ->group(kLearned);
    verb.add_option("--style-segments", learned.style_segments,
                    "zs-mstm: segments whose mean is the style [8]")
        ->type_name("N")
        ->check(CLI::Range(1, 10000))
        ->group(kLearned);
    verb.add_option(
            "--bert", learned.bert,
            "model1, model2, zs-mstm: vectors of words by BERT, whose model.safetensors or model.pt and "
            "vocab.txt lie in DIR [hashbert, built in]")
        ->type_name("DIR")
        ->group(kLearned);
    verb.add_option("--threads", learned.threads, "Threads that compute [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256))
        ->group(kLearned);
    verb.add_flag("--fill", command.job.fill,
                  "Mouth, blinks and hands, which the model does not know, from the expressive engine")
        ->group(kLearned);
}

// The engines that have an option: those that its help begins with, or all learned ones.
std::string engines_with(const CLI::App& verb, const std::string& option) {
    const std::string help = verb.get_option(option)->get_description();
    const std::string first = help.substr(0, help.find_first_of(",:"));
    const bool is_engine = std::ranges::find(learned_engines(), first) != learned_engines().end();
    return is_engine ? help.substr(0, help.find(':')) : join(learned_engines());
}

// A learned face has the rate of its model, and a manner only where the expressive engine fills it up.
void check_learned(const CLI::App& verb, const SynthCommand& command) {
    const bool is_learned = command.learned.model != kExpressive;
    std::vector<std::string> of_expressive = {"--fps", "--gesture", "--dialog"};
    if (!command.job.fill) {
        of_expressive.emplace_back("--lexicon");
        for (const char* group : {kOfSpeakers, kReadings})
            for (std::string& name : options_in(verb, group)) of_expressive.push_back(std::move(name));
    }
    if (command.learned.style_of && command.job.fill) {
        throw CLI::ValidationError(
            "--fill", "is of models of a face; gestures in a picture are lifted when they are rendered");
    }
    for (const std::string& name : is_learned ? of_expressive : options_in(verb, kLearned)) {
        if (verb.count(name) == 0) continue;
        throw CLI::ValidationError(
            name, is_learned ? format("is of the expressive engine, not of {}", command.learned.model)
                             : "needs a learned engine: " + engines_with(verb, name));
    }
}

// A dialog says itself who speaks, and writes all it makes into its folder.
void refuse_options_of_one(const CLI::App& verb) {
    std::vector<std::string> names = options_in(verb, kOfSpeakers);
    for (const char* name : {"--speech", "--words", "--speech-out", "--score-out"}) names.emplace_back(name);
    for (const std::string& name : names) {
        if (verb.count(name) > 0)
            throw CLI::ValidationError(name, "is for one person; a dialog's file says who speaks and how");
    }
}

// "2 words"
std::string counted(std::size_t count, std::string_view what) {
    return format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string summary(const Synthesized& made) {
    const Motion& motion = made.performed.motion;
    std::string text =
        format("{:.2f} s, {} frames at {:g} frames/s", duration(motion), motion.frames, motion.fps);
    const std::vector<SpokenWord>& words = made.speech.words;
    // Of speech whose words are not known, those are the places that are stressed.
    const bool is_known = words.empty() || !words[0].text.empty();
    text += ", " + counted(words.size(), is_known ? "word" : "stressed place");
    if (motion.joints) text += ", " + counted(made.performed.gestures.size(), "gesture");
    return text;
}

// person-0.h5, .wav and .json, and the same of the other.
int run_dialog(const SynthCommand& command) {
    const std::array<Synthesized, 2> both = synthesize_dialog({.script = command.dialog,
                                                               .lexicons = command.job.lexicons,
                                                               .variants = command.job.variants,
                                                               .fps = command.job.fps,
                                                               .seed = command.job.seed});
    for (std::size_t i = 0; i < 2; ++i) {
        const std::filesystem::path file = command.out / format("person-{}.h5", i);
        std::vector<std::string> notes = both[i].notes;
        std::ranges::copy(both[i].performed.motion.notes, std::back_inserter(notes));
        for (std::string& note : notes) note = format("person {}: {}", i, note);
        warn(notes);
        write_motion_hdf5(file, both[i].performed.motion);
        write_wav(std::filesystem::path(file).replace_extension(".wav"), both[i].speech.audio);
        write_json(std::filesystem::path(file).replace_extension(".json"), score_of(both[i]));
        print(format("{}\n{}\n", file.string(), summary(both[i])));
    }
    return kExitYes;
}

// A ratio such as 30000/1001 as a number.
std::string decimal_rate(const std::string& text) {
    const auto rate = parse_rate(text);
    return rate ? format("{}", rate->per_second()) : text;
}

}  // namespace

void add_synth(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<SynthCommand>();
    CLI::App* verb = add_verb(
        app, "synth", "Make gestures, face and speech from text or speech",
        ""
        "  $ chironomia synth --text \"Welcome! There are two ways.\" --out m.h5 --speech-out s.wav\n"
        "  $ chironomia synth talk.aplm --speaker abrupt --seed 3 --out m.h5 --speech-out s.wav\n"
        "  $ chironomia synth --speech talk.wav --words talk.TextGrid --spc 0.5 --out m.h5\n"
        "  $ chironomia synth --dialog talk.json --out talk\n"
        "  $ chironomia synth --engine model2 --text \"There are two ways.\" --fill --out m.h5 --speech-out "
        "s.wav\n"
        "  $ chironomia synth --engine amii --user-face u.csv --user-speech u.wav --out listener.h5\n"
        "  $ chironomia synth --engine zs-mstm --speech talk.wav --words talk.TextGrid --style-of people:wendy "
        "--out m.h5");
    add_learned(*verb, *command);
    add_sources(*verb, *command);
    add_manner(*verb, command->job);
    add_variants(*verb, command->job.variants);
    verb->add_option("--fps", command->job.fps, "Frames per second of the motion [30]")
        ->type_name("N")
        ->transform(decimal_rate)
        ->check(CLI::Range(1.0, 1000.0));
    add_seed(*verb, command->job.seed, "Random seed [0]");
    verb->add_option("--out", command->out, "The motion, with its labels; of a dialog a folder for all")
        ->type_name("M.h5|DIR")
        ->required();
    verb->add_option("--speech-out", command->speech_out, "The speech")->type_name("S.wav");
    verb->add_option("--score-out", command->score_out, "What is said, meant and done when, as JSON")
        ->type_name("F.json");
    verb->add_flag("--quiet", command->learned.quiet, "No progress");
    verb->callback([&result, command, verb] {
        const SynthesisJob& job = command->job;
        check_learned(*verb, *command);
        if (command->learned.model != kExpressive) command->job.learned = command->learned;
        // Without a partner the engine itself refuses.
        const LearnedEngine& learned = command->learned;
        const bool listens = learned.model == "amii" || learned.user_speech || learned.content_of;
        if (job.script.empty() && job.gestures.empty() && !job.recording && command->dialog.empty() &&
            !listens) {
            throw CLI::RequiredError(
                "--text, --aplm, --bml, --ssml, --script, --speech, --gesture or --dialog");
        }
        if (!command->dialog.empty()) refuse_options_of_one(*verb);
        if (!job.gestures.empty() && job.recording)
            throw CLI::ValidationError("--gesture", "shows gestures without speech; leave out --speech");
        if (command->learned.content_of && (!job.script.empty() || job.recording))
            throw CLI::ValidationError("--content-of",
                                       "is in place of speech and text; leave one of the two out");
        result = *command;
    });
}

int run(const SynthCommand& command) {
    if (!command.dialog.empty()) return run_dialog(command);
    if (to_lower(command.out.extension().string()) != ".h5") {
        throw Error(
            format("--out {}: a motion is written as .h5; name it so, and convert it with chironomia convert",
                   command.out.string()));
    }
    const Synthesized made = synthesize(command.job);
    warn(made.notes);
    warn(made.performed.motion.notes);
    write_motion_hdf5(command.out, made.performed.motion);
    if (command.speech_out) write_wav(*command.speech_out, made.speech.audio);
    if (command.score_out) write_json(*command.score_out, score_of(made));
    print(format("{}\n{}\n", command.out.string(), summary(made)));
    return kExitYes;
}

}  // namespace chironomia::study
