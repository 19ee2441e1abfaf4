#include "study/models/learned_engine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "skinning/motion/motion_file.h"
#include "skinning/signal/late_beginning.h"
#include "skinning/signal/resample.h"
#include "study/models/style_engine.h"
#include "synth/corpus/face_features.h"
#include "synth/features/pitch.h"
#include "synth/features/speech_features.h"
#include "synth/features/speech_units.h"
#include "synth/learning.h"
#include "synth/speech/channels.h"
#include "synth/text/bert_encoder.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

constexpr double kDyadFps = 25;
constexpr std::array<int, 5> kDyadUnits{1, 2, 4, 6, 12};
constexpr std::size_t kDyadAngles = DyadPerson::kFace - kDyadUnits.size();  // of gaze and head

bool needs_partner(const std::string& model) {
    return model == "amii";
}

bool needs_style(const std::string& model) {
    return model == "zs-mstm" || model == "mix-stage";
}

Json description_of(const fs::path& checkpoint) {
    return ask_to_learn(
        {{"verb", "describe"}, {"checkpoint", fs::absolute(checkpoint).lexically_normal().string()}});
}

// Another model would read these inputs wrongly, or not find its own. Both versions of ZS-MSTM are one engine.
void check_model(const Json& described, const fs::path& checkpoint, const std::string& model) {
    const std::string held = described.at("model").get<std::string>();
    if (held == model || (model == "zs-mstm" && held.starts_with("zs-mstm-"))) return;
    throw Error(format("{}: it holds {}, but --engine is {}; give a checkpoint of that model",
                       checkpoint.string(), held, model));
}

// A model that learned the vectors of another encoder cannot use these.
void check_encoder(const Json& described, const fs::path& checkpoint, const TextEncoder& encoder) {
    const std::string learned = described.at("text_encoder").get<std::string>();
    if (learned == encoder.name) return;
    throw Error(format("{}: it has learned words as vectors of \"{}\", and these would be of \"{}\"; {}",
                       checkpoint.string(), learned, encoder.name,
                       encoder.weights.empty() ? "give BERT's folder with --bert" : "leave out --bert"));
}

// Whether the model can take whose style it is by a file, by a corpus, or by a name alone.
void check_style(const LearnedEngine& engine) {
    const bool is_name =
        !style_job(*engine.style_of).contains("file") && !style_job(*engine.style_of).contains("corpus");
    if (is_name == (engine.model == "mix-stage")) return;
    throw Error(
        is_name
            ? format("--style-of {}: says in no file and no corpus whose style it is; give FILE.h5, an "
                     "interval of PATS, or CORPUS:SPEAKER",
                     *engine.style_of)
            : format("--style-of {}: mix-stage knows the speakers that it has learned from by their names "
                     "alone; give one of those, or take --engine zs-mstm",
                     *engine.style_of));
}

void ask_to_animate(const fs::path& checkpoint, const JobFolder& folder, const LearnedEngine& engine) {
    Json job = {{"verb", "animate"},
                {"checkpoint", fs::absolute(checkpoint).lexically_normal().string()},
                {"inputs", folder.inputs().string()},
                {"out", folder.result().string()},
                {"threads", engine.threads},
                {"quiet", engine.quiet},
                {"options", Json::object()}};
    if (engine.style_of) {
        job["style"] = style_job(*engine.style_of);
        if (engine.model == "zs-mstm") job["options"]["segments"] = engine.style_segments;
    }
    if (engine.content_of)
        job["content"] = {{"file", fs::absolute(*engine.content_of).lexically_normal().string()}};
    ask_to_learn(job);
}

// The words of all units, each unit an utterance of its own.
struct SpokenUnits {
    std::vector<std::vector<std::string>> utterances;
    std::vector<std::string> words;  // (N) of all
    std::vector<double> times;       // (N, 2) [s]
};

SpokenUnits units_of(const Speech& speech, const std::string& model) {
    std::vector<CorpusWord> words;
    for (const SpokenWord& word : speech.words) {
        if (!word.text.empty()) words.push_back({.text = word.text, .start = word.start, .end = word.end});
    }
    if (words.empty()) {
        throw Error(
            format("--engine {}: it needs to know what is said and when; give --words beside "
                   "--speech, or a text",
                   model));
    }
    SpokenUnits all;
    for (const SpeechUnit& unit : speech_units(words, "the words of the speech")) {
        all.utterances.emplace_back();
        for (const CorpusWord& word : unit.words) {
            all.utterances.back().push_back(word.text);
            all.words.push_back(word.text);
            all.times.insert(all.times.end(), {word.start, word.end});
        }
    }
    return all;
}

// Models of faces hear the pitch of words.
void check_voiced(const SpokenUnits& units, const PitchTrack& pitch) {
    const auto frame = [&](double time) {
        return std::min(pitch.f0.size(), static_cast<std::size_t>(std::lround(time * pitch.rate)));
    };
    for (std::size_t word = 0; word < units.words.size(); ++word) {
        for (std::size_t t = frame(units.times[2 * word]); t < frame(units.times[2 * word + 1]); ++t)
            if (pitch.f0[t] > 0) return;
    }
    throw Error(
        "no word of the speech is voiced, and the model hears its pitch; give a sound in which somebody speaks, "
        "and the times of its words");
}

// The inputs of Models 1 and 2 (synth/learned/faces/face_jobs.h).
void write_spoken(const fs::path& file, const Speech& speech, const SpokenUnits& units,
                  const TextEncoder& encoder) {
    std::vector<float> vectors;
    for (const std::vector<float>& rows : encoder.vectors(units.utterances))
        vectors.insert(vectors.end(), rows.begin(), rows.end());
    const PitchTrack pitch = find_pitch(speech.audio);
    check_voiced(units, pitch);
    Hdf5Writer writer(file, file.string());
    writer.write_texts("text_encoder", {encoder.name});
    writer.write_texts("words", units.words);
    writer.write_doubles("times", {units.words.size(), 2}, units.times);
    writer.write_floats("vectors", {units.words.size(), kWordVector}, vectors);
    writer.write_floats("f0", {pitch.f0.size()}, pitch.f0);
    writer.write_number("seconds", speech.audio.duration());
    writer.close();
}

// One person of a dyad at 25 frames per second, with the columns of DyadPerson.
struct PartnerTrack {
    std::vector<float> face;    // (T, 10)
    std::vector<float> speech;  // (T, 16)

    std::size_t frames() const {
        return std::min(face.size() / DyadPerson::kFace, speech.size() / DyadPerson::kSpeech);
    }
};

std::vector<float> heard(const Audio& sound) {
    const auto frames = static_cast<std::size_t>(std::ceil(sound.duration() * kDyadFps - 1e-9));
    return speech_at(speech_features(sound), kDyadFps, frames).values;
}

std::vector<float> seen(const fs::path& file, std::vector<std::string>& notes) {
    const Motion motion = resample(read_motion(file), kDyadFps);
    if (!motion.face) {
        throw Error(
            format("{}: it has no face, which --user-face must have; give a table of OpenFace or a "
                   "motion with a face",
                   file.string()));
    }
    const FaceTrack& face = *motion.face;
    if (face.head.empty()) notes.push_back(format("{}: no head turns; it is held straight", file.string()));
    if (face.gaze.empty()) notes.push_back(format("{}: no gaze; it is held straight", file.string()));
    for (const int unit : kDyadUnits) {
        const auto is_unit = [unit](const FaceChannel& channel) { return channel.unit == unit; };
        if (std::ranges::none_of(face.channels, is_unit))
            notes.push_back(format("{}: no AU{}; it is held at 0", file.string(), unit));
    }
    if (const auto first = late_beginning_of(motion)) {
        notes.push_back(format(
            "{}: its times begin at {:.6g} s, which is second 0 here; --user-speech must begin there, too",
            file.string(), *first));
    }
    const std::vector<float> units = intensities_of(face, motion.frames, kDyadUnits);
    std::vector<float> rows;
    for (std::size_t t = 0; t < motion.frames; ++t) {
        const Quat head = face.head.empty() ? Quat(1, 0, 0, 0) : face.head[t];
        const Vec2 gaze = face.gaze.empty() ? Vec2(0) : openface_gaze(face.gaze[t], head);
        const Vec3 angles = openface_angles(head);
        rows.insert(rows.end(), {gaze.x, gaze.y, angles.x, angles.y, angles.z});
        const auto first = units.begin() + static_cast<std::ptrdiff_t>(t * kDyadUnits.size());
        rows.insert(rows.end(), first, first + static_cast<std::ptrdiff_t>(kDyadUnits.size()));
    }
    return rows;
}

// What lies beyond what the model has learned is held at its limit. In training that is one frame in fifty.
void note_unlearned(const std::vector<float>& face, const Json& described, const fs::path& file,
                    std::vector<std::string>& notes) {
    constexpr double kMuch = 0.25;  // of the frames; ours
    const Json &names = described.at("inputs"), &ranges = described.at("input_ranges");
    for (std::size_t c = 0; c < DyadPerson::kFace; ++c) {
        const Json& range = ranges.at(ranges.size() - DyadPerson::kFace + c);
        const double low = range.at(0), high = range.at(1);
        double outside = 0, frames = 0;
        for (std::size_t i = c; i < face.size(); i += DyadPerson::kFace) {
            outside += face[i] < low || face[i] > high ? 1 : 0;
            ++frames;
        }
        if (outside <= kMuch * frames) continue;
        notes.push_back(format(
            "{}: {} lies outside what the model has learned, {:.3g} to {:.3g}, in {:.0f} % of the frames, and is held "
            "at its limit there{}",
            file.string(), names.at(names.size() - DyadPerson::kFace + c).get<std::string>(), low, high,
            100 * outside / frames,
            c < 5 ? "; a partner who does not face the camera is turned to it first" : ""));
    }
}

PartnerTrack partner_of(const LearnedEngine& engine, std::vector<std::string>& notes) {
    PartnerTrack partner{.face = seen(*engine.user_face, notes), .speech = {}};
    const Audio sound = read_audio(*engine.user_speech);
    if (auto note = note_of_two_voices(sound, *engine.user_speech, "give the partner's channel as a file"))
        notes.push_back(std::move(*note));
    partner.speech = heard(sound);
    return partner;
}

// The inputs of AMII (synth/learned/dyads/dyad_jobs.h). Says in `notes` what was cut.
void write_dyad_inputs(const fs::path& file, const Speech& speech, PartnerTrack partner,
                       std::vector<std::string>& notes) {
    std::vector<float> own = heard(speech.audio);
    const std::size_t spoken = own.size() / DyadPerson::kSpeech;
    const std::size_t frames = std::min(spoken, partner.frames());
    assert(frames > 0);  // no reader gives an empty sound or motion
    if (spoken != frames || partner.frames() != frames ||
        partner.face.size() / DyadPerson::kFace != partner.speech.size() / DyadPerson::kSpeech) {
        notes.push_back(
            format("unequal lengths, cut to {:.2f} s: the agent's speech has {:.2f} s, the "
                   "user's face {:.2f} s and speech {:.2f} s",
                   double(frames) / kDyadFps, double(spoken) / kDyadFps,
                   double(partner.face.size() / DyadPerson::kFace) / kDyadFps,
                   double(partner.speech.size() / DyadPerson::kSpeech) / kDyadFps));
    }
    own.resize(frames * DyadPerson::kSpeech);
    partner.face.resize(frames * DyadPerson::kFace);
    partner.speech.resize(frames * DyadPerson::kSpeech);
    Hdf5Writer writer(file, file.string());
    writer.write_floats("speech", {frames, DyadPerson::kSpeech}, own);
    writer.make_group("user");
    writer.write_floats("user/face", {frames, DyadPerson::kFace}, partner.face);
    writer.write_floats("user/speech", {frames, DyadPerson::kSpeech}, partner.speech);
    writer.close();
}

Motion face_motion(double fps, std::size_t frames, std::span<const int> units) {
    Motion motion{.source = "", .fps = fps, .frames = frames, .joints = {}, .keypoints = {}, .notes = {}};
    motion.face.emplace();
    for (const int unit : units) motion.face->channels.push_back({.unit = unit});
    motion.face->confidence.assign(frames, 1);
    return motion;
}

float intensity(double value) {
    return static_cast<float>(std::clamp(value, 0.0, 5.0));
}

// What Models 1 and 2 answer.
Motion read_upper_face(const Hdf5File& result) {
    const std::size_t frames = result.shape_of("units").at(0);
    const std::vector<double> units = result.read_numbers("units", {frames, IpuRecord::kUnits});
    const std::vector<double> head = result.read_numbers("head", {frames, IpuRecord::kAngles});
    Motion motion = face_motion(result.read_numbers("fps", {})[0], frames, IpuRecord::kUnitNumbers);
    for (const double unit : units) motion.face->intensities.push_back(intensity(unit));
    for (std::size_t t = 0; t < frames; ++t)
        motion.face->head.push_back(head_of_openface(Vec3(head[3 * t], head[3 * t + 1], head[3 * t + 2])));
    return motion;
}

// What AMII answers.
Motion read_dyad_face(const Hdf5File& result) {
    const std::size_t frames = result.shape_of("face").at(0);
    const std::vector<double> face = result.read_numbers("face", {frames, DyadPerson::kFace});
    Motion motion = face_motion(result.read_numbers("fps", {})[0], frames, kDyadUnits);
    for (std::size_t t = 0; t < frames; ++t) {
        const double* row = &face[t * DyadPerson::kFace];
        const Quat head = head_of_openface(Vec3(row[2], row[3], row[4]));
        motion.face->head.push_back(head);
        motion.face->gaze.push_back(gaze_of_openface(Vec2(row[0], row[1]), head));
        for (std::size_t i = kDyadAngles; i < DyadPerson::kFace; ++i)
            motion.face->intensities.push_back(intensity(row[i]));
    }
    return motion;
}

}  // namespace

const std::vector<std::string>& learned_engines() {
    static const std::vector<std::string> names = {"amii", "model1", "model2", "zs-mstm", "mix-stage"};
    return names;
}

fs::path bundled_checkpoint(const std::string& model) {
    try {
        const std::string name = model == "zs-mstm" ? "zs-mstm-1" : model;
        return find_asset(fs::path("assets/models") / (name + ".safetensors"));
    } catch (const Error&) {
        throw Error(
            format("--engine {}: no checkpoint of it is bundled with this program; train one with "
                   "chironomia train {} and give it with --checkpoint",
                   model, model));
    }
}

std::vector<std::string> learned_speakers(const fs::path& checkpoint) {
    const Json described = description_of(checkpoint);
    check_model(described, checkpoint, "mix-stage");
    return described.at("options").at("speakers").get<std::vector<std::string>>();
}

LearnedSynthesizer::LearnedSynthesizer(LearnedEngine engine) : engine_(std::move(engine)) {
    const bool has_partner = engine_.user_face && engine_.user_speech;
    if (needs_partner(engine_.model) && !has_partner) {
        throw Error(
            format("--engine {}: it adapts to what its partner does; give both --user-face and "
                   "--user-speech",
                   engine_.model));
    }
    if (!needs_partner(engine_.model) && (engine_.user_face || engine_.user_speech)) {
        throw Error(
            format("--engine {}: it knows of no partner; leave out --user-face and --user-speech, or "
                   "take --engine amii",
                   engine_.model));
    }
    if (needs_style(engine_.model) && !engine_.style_of) {
        throw Error(
            format("--engine {}: it moves in somebody's style; say whose with --style-of FILE.h5 or "
                   "--style-of CORPUS:SPEAKER",
                   engine_.model));
    }
    if (needs_style(engine_.model)) check_style(engine_);
    if (!needs_style(engine_.model) && (engine_.style_of || engine_.content_of)) {
        throw Error(format(
            "--engine {}: it has no style of others; leave out --style-of and --content-of, or take --engine zs-mstm",
            engine_.model));
    }
    checkpoint_ = engine_.checkpoint ? *engine_.checkpoint : bundled_checkpoint(engine_.model);
}

Json LearnedSynthesizer::description() const {
    const Json described = description_of(checkpoint_);
    check_model(described, checkpoint_, engine_.model);
    return described;
}

void LearnedSynthesizer::write_inputs(const fs::path& file, const Speech& speech,
                                      std::vector<std::string>& notes) const {
    if (needs_partner(engine_.model)) {
        PartnerTrack partner = partner_of(engine_, notes);
        note_unlearned(partner.face, description(), *engine_.user_face, notes);
        return write_dyad_inputs(file, speech, std::move(partner), notes);
    }
    const SpokenUnits units = needs_style(engine_.model) ? SpokenUnits{} : units_of(speech, engine_.model);
    const Json described = description();
    const TextEncoder encoder = engine_.bert ? bert_encoder(*engine_.bert) : hashbert_encoder();
    if (described.at("text_encoder") == "") return write_style_inputs(file, speech, engine_.model, nullptr);
    check_encoder(described, checkpoint_, encoder);
    if (needs_style(engine_.model)) return write_style_inputs(file, speech, engine_.model, &encoder);
    write_spoken(file, speech, units, encoder);
}

Motion LearnedSynthesizer::synthesize(const Speech& speech) const {
    const JobFolder folder;
    std::vector<std::string> notes;
    if (engine_.content_of) {
        description();
    } else {
        write_inputs(folder.inputs(), speech, notes);
    }
    ask_to_animate(checkpoint_, folder, engine_);
    const std::string made = format("{} ({})", engine_.model, checkpoint_.filename().string());
    if (needs_style(engine_.model)) {
        Motion motion = read_styled_motion(folder.result(), engine_.model);
        motion.notes.push_back(format("gestures by {} in the style of {}", made, *engine_.style_of));
        return motion;
    }
    const std::vector<std::byte> bytes = read_bytes(folder.result());
    const Hdf5File result(bytes, format("the answer of {}", engine_.model));
    Motion motion = needs_partner(engine_.model) ? read_dyad_face(result) : read_upper_face(result);
    motion.notes.push_back(format("face and head by {}", made));
    motion.notes.insert(motion.notes.end(), notes.begin(), notes.end());
    return motion;
}

Motion filled(const Motion& face, const Motion& whole) {
    assert(face.face && whole.face);
    Motion made = resample(whole, face.fps, face.frames);
    FaceTrack& both = *made.face;
    const FaceTrack& ours = *face.face;
    // The channels of `whole` that `face` does not know, then those of `face`.
    const auto knows = [&](int unit) {
        return std::any_of(ours.channels.begin(), ours.channels.end(),
                           [unit](const FaceChannel& channel) { return channel.unit == unit; });
    };
    std::vector<std::size_t> kept;
    FaceTrack mixed{.channels = {},
                    .intensities = {},
                    .head = ours.head.empty() ? both.head : ours.head,
                    .gaze = ours.gaze.empty() ? both.gaze : ours.gaze,
                    .confidence = ours.confidence};
    for (std::size_t c = 0; c < both.channels.size(); ++c) {
        if (knows(both.channels[c].unit)) continue;
        kept.push_back(c);
        mixed.channels.push_back(both.channels[c]);
    }
    mixed.channels.insert(mixed.channels.end(), ours.channels.begin(), ours.channels.end());
    for (std::size_t t = 0; t < face.frames; ++t) {
        for (const std::size_t c : kept)
            mixed.intensities.push_back(both.intensities[t * both.channels.size() + c]);
        for (std::size_t c = 0; c < ours.channels.size(); ++c)
            mixed.intensities.push_back(ours.intensities[t * ours.channels.size() + c]);
    }
    both = std::move(mixed);
    made.notes.insert(made.notes.end(), face.notes.begin(), face.notes.end());
    made.notes.push_back("what it does not say (mouth, blinks, hands) by the expressive engine");
    return made;
}

}  // namespace chironomia::study
