#include "synth/speech/helper_protocol.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::string_view kGreeting = "chironomia_speak 3";

constexpr std::array<std::string_view, 5> kOutcomes = {"spoken", "no-voices", "no-language", "no-variant",
                                                       "failed"};

// A head, line by line, and what lies after it.
class Lines {
  public:
    explicit Lines(std::string_view bytes) : rest_(bytes) {}

    // Nothing at the end.
    std::optional<std::string_view> next() {
        const std::size_t end = rest_.find('\n');
        if (end == std::string_view::npos) return std::nullopt;
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return line;
    }
    std::vector<std::string_view> next_fields() { return split(next().value_or(""), ' '); }
    bool greets() { return next() == kGreeting; }
    std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
};

std::optional<std::size_t> count_in(std::string_view field) {
    const std::optional<long long> number = parse_integer(field);
    if (!number || *number < 0) return std::nullopt;
    return static_cast<std::size_t>(*number);
}

// The numbers of a line that begins with this word.
template <std::size_t kCount>
std::optional<std::array<std::size_t, kCount>> counts_behind(std::string_view word,
                                                             const std::vector<std::string_view>& fields) {
    if (fields.size() != kCount + 1 || fields[0] != word) return std::nullopt;
    std::array<std::size_t, kCount> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto count = count_in(fields[i + 1]);
        if (!count || *count > 0x7fffffff) return std::nullopt;
        counts[i] = *count;
    }
    return counts;
}

std::string line_of(const SpeakEvent& event) {
    if (event.kind == SpeakEvent::Kind::word) return format("word {} {}\n", event.sample, event.position);
    return format("phoneme {} {} {}\n", event.sample, static_cast<int>(event.stress), event.symbol);
}

std::optional<SpeakEvent> read_event(const std::vector<std::string_view>& fields) {
    const bool is_word = fields[0] == "word";
    if (fields.size() != (is_word ? 3u : 4u)) return std::nullopt;
    const auto sample = count_in(fields[1]), number = count_in(fields[2]);
    if (!sample || !number) return std::nullopt;
    if (is_word) return SpeakEvent{.kind = SpeakEvent::Kind::word, .sample = *sample, .position = *number};
    if (fields[0] != "phoneme" || *number > 2) return std::nullopt;
    return SpeakEvent{.kind = SpeakEvent::Kind::phoneme,
                      .sample = *sample,
                      .stress = static_cast<Stress>(*number),
                      .symbol = std::string(fields[3])};
}

std::optional<std::vector<std::int16_t>> read_samples(std::string_view bytes, std::size_t count) {
    if (bytes.size() / sizeof(std::int16_t) != count || bytes.size() % sizeof(std::int16_t) != 0)
        return std::nullopt;
    std::vector<std::int16_t> samples(count);
    if (count > 0) std::memcpy(samples.data(), bytes.data(), bytes.size());
    return samples;
}

std::optional<SpeakReply> read_spoken(Lines lines, std::string_view rate_field) {
    const auto rate = count_in(rate_field);
    if (!rate || *rate == 0 || *rate > 384000) return std::nullopt;
    SpeakReply reply{.outcome = SpeakReply::Outcome::spoken, .rate = static_cast<int>(*rate)};
    for (;;) {
        const auto fields = lines.next_fields();
        if (fields[0] == "sound") {
            const auto count = fields.size() == 2 ? count_in(fields[1]) : std::nullopt;
            auto samples = count ? read_samples(lines.rest(), *count) : std::nullopt;
            if (!samples) return std::nullopt;
            reply.samples = std::move(*samples);
            return reply;
        }
        if (fields[0] == "alone") {
            reply.alone.emplace_back(fields.begin() + 1, fields.end());
            continue;
        }
        const auto event = read_event(fields);
        if (!event) return std::nullopt;
        reply.events.push_back(*event);
    }
}

std::optional<SpeakReply> read_refusal(Lines lines, std::string_view word) {
    const auto known = std::find(kOutcomes.begin() + 1, kOutcomes.end(), word);
    if (known == kOutcomes.end()) return std::nullopt;
    SpeakReply reply{.outcome = static_cast<SpeakReply::Outcome>(known - kOutcomes.begin())};
    while (const auto name = lines.next()) reply.names.emplace_back(*name);
    return reply;
}

}  // namespace

std::string to_bytes(const SpeakRequest& request) {
    const Voice& voice = request.voice;
    std::string words;
    for (const std::string& word : request.words) words += word + "\n";
    return format("{}\nvoice {} {} {}\n{} {} {} {} {}\n{}{}{}{}", kGreeting, voice.pitch, voice.rate,
                  voice.range, request.is_ssml ? "ssml" : "text", voice.language.size(), voice.variant.size(),
                  request.text.size(), words.size(), voice.language, voice.variant, request.text, words);
}

std::optional<SpeakRequest> read_request(std::string_view bytes) {
    Lines lines(bytes);
    if (!lines.greets()) return std::nullopt;
    const auto voice = counts_behind<3>("voice", lines.next_fields());
    const auto form = lines.next_fields();
    const auto lengths = counts_behind<4>(form[0], form);
    if (!voice || !lengths || (form[0] != "ssml" && form[0] != "text")) return std::nullopt;
    const auto [language, variant, text, words] = *lengths;
    const std::string_view rest = lines.rest();
    if (rest.size() != language + variant + text + words) return std::nullopt;
    SpeakRequest request{.text = std::string(rest.substr(language + variant, text)),
                         .is_ssml = form[0] == "ssml",
                         .voice = {.language = std::string(rest.substr(0, language)),
                                   .variant = std::string(rest.substr(language, variant)),
                                   .pitch = static_cast<int>((*voice)[0]),
                                   .rate = static_cast<int>((*voice)[1]),
                                   .range = static_cast<int>((*voice)[2])}};
    Lines list(rest.substr(rest.size() - words));
    while (const auto word = list.next()) request.words.emplace_back(*word);
    return request;
}

std::string to_bytes(const SpeakReply& reply) {
    const std::string_view outcome = kOutcomes[static_cast<std::size_t>(reply.outcome)];
    if (reply.outcome != SpeakReply::Outcome::spoken) {
        std::string bytes = format("{}\n{}\n", kGreeting, outcome);
        for (const std::string& name : reply.names) bytes += name + "\n";
        return bytes;
    }
    std::string bytes = format("{}\n{} {}\n", kGreeting, outcome, reply.rate);
    for (const auto& phonemes : reply.alone) {
        bytes += "alone";
        for (const std::string& phoneme : phonemes) bytes += " " + phoneme;
        bytes += "\n";
    }
    for (const SpeakEvent& event : reply.events) bytes += line_of(event);
    bytes += format("sound {}\n", reply.samples.size());
    bytes.append(reinterpret_cast<const char*>(reply.samples.data()),
                 reply.samples.size() * sizeof(std::int16_t));
    return bytes;
}

std::optional<SpeakReply> read_reply(std::string_view bytes) {
    Lines lines(bytes);
    if (!lines.greets()) return std::nullopt;
    const auto outcome = lines.next_fields();
    if (outcome.size() == 2 && outcome[0] == kOutcomes[0]) return read_spoken(lines, outcome[1]);
    return outcome.size() == 1 ? read_refusal(lines, outcome[0]) : std::nullopt;
}

}  // namespace chironomia
