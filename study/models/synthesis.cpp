#include "study/models/synthesis.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "synth/gestures/lexicon.h"
#include "synth/markup/functions.h"
#include "synth/markup/script_words.h"
#include "synth/planner/plan_gestures.h"
#include "synth/presence/dialog_file.h"
#include "synth/presence/turns.h"
#include "synth/speakers/languages.h"
#include "synth/speakers/speakers.h"
#include "synth/speech/accents.h"
#include "synth/speech/align.h"
#include "synth/speech/channels.h"
#include "synth/speech/said_phonemes.h"
#include "synth/speech/said_stress.h"
#include "synth/speech/silent_words.h"
#include "synth/speech/speak.h"
#include "synth/speech/timed_words.h"

namespace chironomia::study {
namespace {

constexpr double kFirstShown = 1.5;  // of gestures shown one after the other [s]
constexpr double kShownApart = 3.0;  // [s]
constexpr double kShownWord = 0.3;   // how long the word of one is [s]
constexpr int kSilenceRate = 22050;  // [Hz]

Audio silence(double seconds, int rate) {
    return {
        .rate = rate, .channels = 1, .samples = std::vector<float>(static_cast<std::size_t>(seconds * rate))};
}

Lexicon read_lexicons(const std::vector<std::filesystem::path>& more) {
    std::vector<std::filesystem::path> files = bundled_lexicon_files();
    files.insert(files.end(), more.begin(), more.end());
    return read_lexicon(files);
}

std::vector<std::string> ids_of(const Lexicon& lexicon) {
    std::vector<std::string> ids;
    for (const Gesture& gesture : lexicon.gestures) ids.push_back(gesture.id);
    return ids;
}

bool has_script(const SynthesisJob& job) {
    return job.source || !job.script.empty();
}

// A table that was given for a script would be read aloud for hours.
void refuse_table(const MarkupSource& source) {
    constexpr std::size_t kFew = 50;  // as many numbers may be a text about them
    constexpr double kShare = 0.8;
    std::size_t words = 0, numbers = 0;
    for (const std::string_view part : split_words(source.text)) {
        for (const std::string_view word : split(part, ',')) {
            words += word.empty() ? 0 : 1;
            numbers += parse_number(word) ? 1 : 0;
        }
    }
    if (numbers <= kFew || static_cast<double>(numbers) < kShare * static_cast<double>(words)) return;
    throw Error(
        format("{}: {} of its {} words are numbers, so it is a table and no text that somebody says; give a "
               "text, or a recording with --speech",
               source.name, numbers, words));
}

MarkedText parse_any(const SynthesisJob& job, const std::string& language_of_words) {
    MarkupSource source = job.source ? *job.source : read_markup_source(job.script, job.option);
    refuse_table(source);
    source.language = language_of_words;
    if (!job.language) return parse_marked_text(source);
    MarkedText text = parse_marked_text(source, *job.language);
    const MarkupLanguage looks_like = recognise_markup(source.text);
    if (job.language == MarkupLanguage::plain && looks_like != MarkupLanguage::plain) {
        text.notes.push_back(
            format("{}: its tags are spoken as words; give it by --{}", source.name, name_of(looks_like)));
    }
    return text;
}

// Names of gestures are checked where gestures are planned.
MarkedText parse(const SynthesisJob& job, const std::string& language_of_words, const Lexicon& lexicon) {
    MarkedText text = parse_any(job, language_of_words);
    if (!job.learned || job.fill) check_gesture_names(text, lexicon);
    return text;
}

// What parts a word of a recording from the next one, as a script would write it. 0.2 s parts the units of a
// talk (Fares 2023, chapter 4.1); 0.6 s for a sentence is ours, as voices of espeak-ng pause between two.
std::string_view sign_of_pause(double seconds) {
    constexpr double kClause = 0.2, kSentence = 0.6;
    return seconds >= kSentence ? "." : seconds >= kClause ? "," : "";
}

// The words of a recording as plain text, with the punctuation of their file; where it has none, with that of pauses.
MarkedText parse_words(const TimedWords& timed, const std::filesystem::path& file,
                       const std::string& language) {
    const bool has_signs = std::ranges::any_of(timed.written, is_punctuated);
    std::string text;
    for (std::size_t w = 0; w < timed.words.size(); ++w) {
        if (w > 0 && !has_signs) text += sign_of_pause(timed.words[w].start - timed.words[w - 1].end);
        text += (w > 0 ? " " : "") + (has_signs ? timed.written[w] : timed.words[w].text);
    }
    return parse_marked_text(
        {.text = std::move(text), .name = file.string(), .language = language, .is_heard = true},
        MarkupLanguage::plain);
}

// What a synthetic voice says.
Speech spoken(const MarkedText& text, const Speaker& speaker) {
    const SpokenTurn only{.person = 0, .speech = speak(text, speaker.voice)};
    return place_turns(std::span(&only, 1), {.at_edges = kSilence})[0];
}

// Each gesture for itself, with its name for a word that nobody says.
Speech shown_gestures(const std::string& ids, const Lexicon& lexicon) {
    std::vector<std::string> names = ids_of(lexicon);
    if (ids != "all" && !find_gesture(lexicon, ids)) {
        const auto near = nearest_name(ids, names);
        throw Error(format("--gesture {}: there is no such gesture; {}", ids,
                           near ? format("did you mean \"{}\"?", *near) : "write one of " + join(names)));
    }
    if (ids != "all") names = {ids};
    Speech speech{.audio =
                      silence(kFirstShown + kShownApart * static_cast<double>(names.size()), kSilenceRate)};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double when = kFirstShown + kShownApart * static_cast<double>(i);
        speech.words.push_back({.text = names[i], .start = when - kShownWord, .end = when});
        Mark mark{
            .kind = MarkKind::gesture, .value = names[i], .first_word = i, .end_word = i + 1, .weight = 1};
        mark.manner[Expressivity::overall_activation] = 1;
        mark.times.stroke_end = {.word = {}, .offset = when};
        speech.marks.push_back(std::move(mark));
    }
    return speech;
}

// Of a recording whose words nobody knows: what it stresses is all there is to show.
Mark emphasis_on(std::size_t word) {
    return {.kind = MarkKind::emphasis,
            .value = "medium",
            .first_word = word,
            .end_word = word + 1,
            .weight = default_weight(MarkKind::emphasis, "medium")};
}

Speech heard(Audio sound, const std::string& language) {
    constexpr double kBefore = 0.1, kBehind = 0.15;  // of a stressed syllable around its peak [s]
    const std::vector<double> accents = accents_of(sound);
    Speech speech{.audio = std::move(sound), .language = language};
    for (std::size_t i = 0; i < accents.size(); ++i) {
        const double start = std::max(accents[i] - kBefore, i == 0 ? 0.0 : speech.words.back().end);
        speech.words.push_back({.text = "", .start = start, .end = accents[i] + kBehind});
        speech.marks.push_back(emphasis_on(i));
    }
    return speech;
}

// Marks what a recording stresses where its words alone show nothing for a while.
void mark_stresses(Speech& speech) {
    // Ours: the bundled texts have a gesture in 4 s, and the generic agent shows what weighs above a half.
    constexpr double kWhile = 2;    // before and after [s]
    constexpr double kShown = 0.5;  // a weight
    // An act on more words than that is shown on the most important of them, which has a mark of its own.
    constexpr std::size_t kLocal = 2;
    const auto is_near = [&](const Mark& mark, double time) {
        const std::size_t words = mark.end_word - mark.first_word;
        return mark.weight > kShown && words >= 1 && words <= kLocal &&
               speech.words[mark.first_word].start < time + kWhile &&
               speech.words[mark.end_word - 1].end > time - kWhile;
    };
    for (const double accent : accents_of(speech.audio)) {
        const auto word = std::ranges::find_if(
            speech.words, [&](const SpokenWord& each) { return each.start <= accent && accent < each.end; });
        if (word == speech.words.end() ||
            std::ranges::any_of(speech.marks, [&](const Mark& mark) { return is_near(mark, accent); }))
            continue;
        speech.marks.push_back(emphasis_on(static_cast<std::size_t>(word - speech.words.begin())));
    }
    std::ranges::stable_sort(speech.marks, {}, &Mark::first_word);
}

// Of somebody who says nothing.
Speech unspoken(double seconds) {
    return {.audio = silence(seconds, kSilenceRate)};
}

bool only_listens(const SynthesisJob& job) {
    return job.learned && job.learned->user_speech && !has_script(job) && job.gestures.empty() &&
           !job.recording;
}

// The language of a recording: what was asked for, else what the file of its words says, else the speaker's.
std::string language_of(const SynthesisJob& job, const TimedWords& timed, const std::string& of_speaker,
                        std::vector<std::string>& notes) {
    const auto tongue = [](const std::string& name) { return name.substr(0, name.find_first_of("-_")); };
    if (job.spoken_language || timed.language.empty() || tongue(timed.language) == tongue(of_speaker))
        return of_speaker;
    notes.push_back(
        format("{}: its words are in \"{}\", as it says, and not in the speaker's \"{}\"; --language "
               "sets another",
               job.words->string(), timed.language, of_speaker));
    return timed.language;
}

Speech recorded(const SynthesisJob& job, const std::string& of_speaker, const Lexicon& lexicon,
                std::vector<std::string>& notes) {
    const Audio whole = read_audio(*job.recording);
    if (job.channel == SpeechChannel::mean)
        if (auto note = note_of_two_voices(whole, *job.recording, "--speech-channel left or right takes one"))
            notes.push_back(std::move(*note));
    Audio sound = take_channel(whole, job.channel, *job.recording);
    if (!job.words) {
        if (has_script(job)) {
            throw Error(
                format("{}: it has a script, but nobody knows when its words are said; give them with "
                       "--words (TextGrid, ELAN, WebVTT, CSV or JSON)",
                       job.recording->string()));
        }
        Speech speech = heard(std::move(sound), of_speaker);
        notes.push_back(format("{}: {}", job.recording->string(),
                               job.learned && !job.fill ? "its words are not known"
                               : speech.words.empty()
                                   ? "no speech is heard in it, and nothing is gestured"
                                   : "its words are not known; gestures go with what is stressed"));
        return speech;
    }
    TimedWords timed = read_timed_words(*job.words, sound.duration(), job.words_speaker);
    if (timed.words.empty()) {
        throw Error(
            format("{}: it holds phonemes and no words, as label files of HTK are read; give the words as a "
                   "table or a TextGrid",
                   job.words->string()));
    }
    notes.insert(notes.end(), timed.notes.begin(), timed.notes.end());
    for (std::string& doubt : doubts_of_word_times({timed.words, *job.words, sound, *job.recording}))
        notes.push_back(std::move(doubt));
    const std::string language = language_of(job, timed, of_speaker, notes);
    const MarkedText text =
        has_script(job) ? parse(job, language, lexicon) : parse_words(timed, *job.words, language);
    notes.insert(notes.end(), text.notes.begin(), text.notes.end());
    Speech speech = align(text, {.audio = std::move(sound),
                                 .language = language,
                                 .words = std::move(timed.words),
                                 .phonemes = std::move(timed.phonemes)});
    return with_said_phonemes(with_said_stress(std::move(speech), text, notes), text, notes);
}

// Less than one gesture in 10 s is ours: the bundled texts have one in 4 s.
void note_few_gestures(Synthesized& made) {
    constexpr double kSparse = 10;  // [s]
    const double seconds = duration(made.performed.motion);
    const std::size_t gestures = made.performed.gestures.size();
    const double activation = made.speaker.manner[Expressivity::overall_activation];
    if (made.speech.words.empty() || seconds < kSparse ||
        static_cast<double>(gestures) * kSparse >= seconds || activation == 1)
        return;
    made.notes.push_back(format(
        "{} {} in {:.0f} s: few words weigh more than {:g}; raise --oac above {:g} to show lighter ones",
        gestures, gestures == 1 ? "gesture" : "gestures", seconds, 1 - activation, activation));
}

// Gestures that are on their way when the motion ends, as a recording may end with its last word.
void note_cut_gestures(Synthesized& made) {
    const double end = duration(made.performed.motion);
    for (const PlacedGesture& placed : made.performed.gestures) {
        double back = 0;
        for (const ArmTimes& arm : placed.arms) back = std::max(back, arm.retracted ? arm.rest : 0);
        if (back <= end) continue;
        made.notes.push_back(format(
            "gesture \"{}\" would be back at rest at {:.2f} s, but the speech ends at {:.2f} s and cuts it off; a "
            "recording with silence behind its last word leaves room for it",
            made.gestures[placed.gesture], back, end));
    }
}

Json manner_of(const Manner& manner) {
    Json json = Json::object();
    for (std::size_t i = 0; i < kExpressivities; ++i)
        json[std::string(symbol_of(static_cast<Expressivity>(i)))] = manner.values[i];
    return json;
}

Json words_of(const Speech& speech) {
    Json list = Json::array();
    for (const SpokenWord& word : speech.words)
        list.push_back({{"word", word.text}, {"start", word.start}, {"end", word.end}});
    return list;
}

Json marks_of(const Speech& speech) {
    Json list = Json::array();
    for (const Mark& mark : speech.marks) {
        list.push_back({{"kind", std::string(name_of(mark.kind))},
                        {"value", mark.value},
                        {"words", {mark.first_word, mark.end_word}},
                        {"weight", mark.weight}});
    }
    return list;
}

Json arm_of(const ArmTimes& arm) {
    if (!arm.moves) return nullptr;
    return {{"begin", arm.begin},
            {"ready", arm.ready},
            {"release", arm.release},
            {"rest", arm.rest},
            {"retracted", arm.retracted}};
}

Json gestures_of(const Synthesized& made) {
    Json list = Json::array();
    for (const PlacedGesture& placed : made.performed.gestures) {
        Json strokes = Json::array();
        for (const PlacedStroke& stroke : placed.strokes) {
            strokes.push_back({{"start", stroke.start},
                               {"end", stroke.end},
                               {"accent", stroke.accent},
                               {"repeated", stroke.repeated}});
        }
        list.push_back({{"gesture", made.gestures[placed.gesture]},
                        {"function", placed.function},
                        {"strokes", std::move(strokes)},
                        {"left", arm_of(placed.arms[0])},
                        {"right", arm_of(placed.arms[1])}});
    }
    return list;
}

Json signals_of(const Behaviours& behaviours) {
    Json list = Json::array();
    for (const Signal& signal : behaviours.signals) {
        list.push_back({{"signal", std::string(name_of(signal.kind))},
                        {"start", signal.start},
                        {"peak", signal.peak},
                        {"hold", signal.hold},
                        {"end", signal.end},
                        {"amount", signal.amount}});
    }
    return list;
}

}  // namespace

Synthesized synthesize(const SynthesisJob& job) {
    ExpressiveOptions options{.speaker = speaker_named(job.speaker),
                              .lexicon = read_lexicons(job.lexicons),
                              .variants = job.variants,
                              .fps = job.fps,
                              .seed = job.seed,
                              .partner = radians(job.partner_deg)};
    options.speaker.manner = overridden(options.speaker.manner, job.manner);
    if (job.voice) options.speaker.voice = *job.voice;
    if (job.spoken_language) options.speaker.voice.language = language_named(*job.spoken_language);
    std::optional<LearnedSynthesizer> learned;
    if (job.learned) learned.emplace(*job.learned);
    Synthesized made{.speaker = options.speaker, .gestures = ids_of(options.lexicon)};
    if (job.learned && job.learned->content_of) {
        made.performed.motion = learned->synthesize({});
        made.speech = unspoken(duration(made.performed.motion));
        return made;
    }
    if (learned && job.recording && job.recording == job.learned->user_speech)
        made.notes.push_back(format("{}: it is --speech and --user-speech, so both people say the same",
                                    job.recording->string()));
    if (only_listens(job)) {
        made.speech = unspoken(read_audio(*job.learned->user_speech).duration());
    } else if (!job.gestures.empty()) {
        made.speech = shown_gestures(job.gestures, options.lexicon);
    } else if (job.recording) {
        made.speech = recorded(job, options.speaker.voice.language, options.lexicon, made.notes);
        if (job.words && !has_script(job) && !learned) mark_stresses(made.speech);
    } else {
        const MarkedText text = parse(job, options.speaker.voice.language, options.lexicon);
        made.speech = spoken(text, options.speaker);
        made.notes = text.notes;
    }
    if (!learned || job.fill) made.performed = perform(made.speech, options);
    if (!learned && !job.manner[Expressivity::overall_activation]) note_few_gestures(made);
    if (!learned) note_cut_gestures(made);
    if (!learned) return made;
    Motion face = learned->synthesize(made.speech);
    made.performed.motion = job.fill ? filled(face, made.performed.motion) : std::move(face);
    return made;
}

std::array<Synthesized, 2> synthesize_dialog(const DialogJob& job) {
    const DialogScript script = read_dialog(job.script);
    const ExpressiveOptions options{.speaker = {},
                                    .lexicon = read_lexicons(job.lexicons),
                                    .variants = job.variants,
                                    .fps = job.fps,
                                    .seed = job.seed};
    std::array<Synthesized, 2> made;
    std::vector<SpokenTurn> turns;
    for (const DialogTurn& turn : script.turns) {
        check_gesture_names(turn.text, options.lexicon);
        turns.push_back({turn.person, speak(turn.text, script.people[turn.person].speaker.voice)});
        std::vector<std::string>& notes = made[turn.person].notes;
        notes.insert(notes.end(), turn.text.notes.begin(), turn.text.notes.end());
    }
    std::array<Speech, 2> speeches =
        place_turns(turns, {.between = script.pause, .at_edges = std::max(script.pause, kSilence)});
    ExpressiveDialog dialog{.people = {}, .coupling = script.coupling};
    for (std::size_t i = 0; i < 2; ++i) {
        const DialogScript::Person& person = script.people[i];
        made[i].speech = speeches[i];
        made[i].speaker = person.speaker;
        made[i].gestures = ids_of(options.lexicon);
        dialog.people[i] = {std::move(speeches[i]), person.speaker, person.partner};
    }
    std::array<Performed, 2> performed = perform_dialog(dialog, options);
    for (std::size_t i = 0; i < 2; ++i) made[i].performed = std::move(performed[i]);
    return made;
}

Json score_of(const Synthesized& made) {
    return {{"format", "chironomia score 1"},
            {"speaker", made.speaker.name},
            {"manner", manner_of(made.speaker.manner)},
            {"seconds", made.speech.audio.duration()},
            {"words", words_of(made.speech)},
            {"marks", marks_of(made.speech)},
            {"accents", made.performed.behaviours.accents},
            {"gestures", gestures_of(made)},
            {"signals", signals_of(made.performed.behaviours)}};
}

}  // namespace chironomia::study
