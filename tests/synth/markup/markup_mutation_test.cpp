// Thousands of damaged and of made texts: each is read or refused, and what is read can be written and read
// again.
#include <gmock/gmock.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/random.h"
#include "synth/markup/aplm.h"
#include "synth/markup/bml.h"
#include "tests/support/support.h"
#include "tests/synth/markup/marks_of.h"
#include "tests/synth/markup/written_markup.h"

namespace chironomia {
namespace {

std::string mutated(std::string text, Random& random) {
    const auto place = [&] { return random.below(static_cast<std::uint32_t>(text.size())); };
    const std::string kSigns = "<>/\"'&;=-+.:! \n09aT\xc3\xa9";
    for (std::uint32_t times = 1 + random.below(4); times > 0 && text.size() > 1; --times) {
        const std::size_t at = place();
        const std::size_t length = 1 + random.below(12);
        switch (random.below(5)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, text.substr(place(), length));
                break;
            case 2:
                text[at] = kSigns[random.below(static_cast<std::uint32_t>(kSigns.size()))];
                break;
            case 3:
                text[at] = static_cast<char>(random.below(256));
                break;
            default:
                text.resize(at + 1);
                break;
        }
    }
    return text;
}

void expect_sound(const MarkedText& text) {
    std::size_t at = 0;
    for (const ScriptWord& word : text.words) {
        ASSERT_LE(at, word.begin);
        ASSERT_LT(word.begin, word.end);
        ASSERT_LE(word.end, text.script.size());
        at = word.end;
    }
    for (std::size_t i = 0; i < text.marks.size(); ++i) {
        const Mark& mark = text.marks[i];
        ASSERT_LE(mark.first_word, mark.end_word);
        ASSERT_LE(mark.end_word, text.words.size());
        ASSERT_TRUE(mark.weight >= 0 && mark.weight <= 1);
        ASSERT_LE(text.marks[i > 0 ? i - 1 : 0].first_word, mark.first_word);
    }
}

TEST(MarkupMutations, AreReadOrRefused) {
    Random random(20);
    int refused = 0;
    int read = 0;
    const std::string plain =
        "Well, I don't know... Is \"this\" the BIG one? On the other hand: yes - perhaps 3.5!";
    std::vector<std::string> texts = {plain};
    for (const char* name : {"quite_well.bml", "museum.aplm", "museum.ssml"})
        texts.push_back(read_text(testing::source_dir() / "tests/fixtures/markup" / name));
    for (int i = 0; i < 8000; ++i) {
        const std::string text = mutated(texts[static_cast<std::size_t>(i) % texts.size()], random);
        try {
            expect_sound(parse_marked_text({.text = text}));
            ++read;
        } catch (const Error& error) {
            ASSERT_TRUE(std::string(error.what()).starts_with("text:")) << error.what();
            ++refused;
        }
        if (HasFatalFailure()) FAIL() << text;
    }
    EXPECT_GT(read, 1000);
    EXPECT_GT(refused, 1000);
}

// A tree of acts around words, as an author might nest them.
std::string made_acts(Random& random, int depth) {
    static const std::vector<std::string> kWords = {"one",    "été",  "Q&amp;A", "a/b",    "well...",
                                                    "(then)", "3.5,", "—",       "\"no\"!"};
    static const std::vector<std::string> kPlaces = {"<boundary type=\"LH\"/>",
                                                     "<turn type=\"give\" weight=\"0.125\"/>"};
    std::string made;
    for (std::uint32_t parts = 1 + random.below(4); parts > 0; --parts) {
        if (random.below(3) > 0) made += random.below(4) == 0 ? "" : " ";
        const std::uint32_t what = random.below(depth > 0 ? 6 : 3);
        if (what < 2) made += kWords[random.below(static_cast<std::uint32_t>(kWords.size()))];
        if (what == 2) made += kPlaces[random.below(2)];
        if (what < 3) continue;
        const auto& kinds = function_kinds();
        const FunctionKind& kind = kinds[random.below(static_cast<std::uint32_t>(kinds.size()))];
        if (kind.kind == MarkKind::boundary) continue;
        std::string attributes;
        if (!kind.values.empty())
            attributes =
                format(" type=\"{}\"",
                       kind.values[random.below(static_cast<std::uint32_t>(kind.values.size()))].value);
        if (kind.kind == MarkKind::gesture) attributes = " name=\"open&lt;\"";
        if (random.below(3) == 0) attributes += format(" weight=\"{}\"", random.uniform());
        if (random.below(3) == 0) attributes += format(" flt=\"{}\"", 2 * random.uniform() - 1);
        // Elements that end and begin in one word would cross each other.
        made += format(" <{0}{1}>word{2}</{0}>", kind.element, attributes, made_acts(random, depth - 1));
    }
    return made;
}

void expect_same(const MarkedText& again, const MarkedText& text, const std::string& written) {
    EXPECT_EQ(again.script, text.script) << written;
    EXPECT_EQ(testing::marks_in(again), testing::marks_in(text)) << written;
    EXPECT_TRUE(again.words == text.words && again.marks == text.marks) << written;
}

TEST(MarkupProperty, AplmReadsBackTheSame) {
    Random random(21);
    for (int i = 0; i < 2000 && !HasFailure(); ++i) {
        const MarkedText text = parse_aplm({.text = "<APLM>word " + made_acts(random, 4) + "</APLM>"});
        expect_sound(text);
        const std::string written = testing::to_aplm(text);
        expect_same(parse_aplm({.text = written}), text, written);
    }
}

std::string made_bml(Random& random) {
    const std::uint32_t words = 1 + random.below(6);
    const bool has_times = random.below(2) == 0;
    std::string speech = "<speech id=\"sp-1\"><text>";
    double time = 0;
    for (std::uint32_t word = 0; word < 2 * words; ++word) {
        time += random.uniform();
        speech += format("<sync id=\"T{}\"{}/>", word, has_times ? format(" time=\"{:.3f}\"", time) : "");
        if (word % 2 == 0) speech += "été,";
    }
    speech += "</text></speech>";
    for (std::uint32_t g = random.below(4); g > 0; --g) {
        const std::string sync = format("sp-1:T{}", random.below(2 * words));
        const std::vector<std::string> times = {sync, sync + format("{:+.3f}", random.uniform() - 0.5),
                                                "sp-1:end", format("{:.3f}", 5 * random.uniform())};
        speech += format("<gesture id=\"g{}\" lexeme=\"open\"", g);
        for (const char* name : {"start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end"})
            if (random.below(3) == 0) speech += format(" {}=\"{}\"", name, times[random.below(4)]);
        speech +=
            format("><description><intensity>{}</intensity><FLD.value>{}</FLD.value></description></gesture>",
                   random.uniform(), 2 * random.uniform() - 1);
    }
    return "<bml>" + speech + "</bml>";
}

// A gesture without times gets those of its words, and then keeps them.
TEST(MarkupProperty, BmlReadsBackTheSame) {
    Random random(22);
    int read = 0;
    for (int i = 0; i < 4000 && !HasFailure(); ++i) {
        const std::string made = made_bml(random);
        std::string once;
        try {
            once = testing::to_bml(parse_bml({.text = made}));
        } catch (const Error& error) {
            ASSERT_THAT(error.what(), ::testing::HasSubstr(" lies after "));
            continue;
        }
        ++read;
        const MarkedText text = parse_bml({.text = once});
        expect_sound(text);
        const std::string written = testing::to_bml(text);
        EXPECT_EQ(written, once);
        expect_same(parse_bml({.text = written}), text, written);
    }
    EXPECT_GT(read, 1000);
}

}  // namespace
}  // namespace chironomia
