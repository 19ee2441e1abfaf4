// Texts with markup, the times of words, dialogs, and what trackers and corpora write.
#include "core/error.h"
#include "synth/corpus/pickled_texts.h"
#include "synth/corpus/record_files.h"
#include "synth/features/opensmile_csv.h"
#include "synth/gestures/lexicon.h"
#include "synth/markup/markup.h"
#include "synth/predictions.h"
#include "synth/presence/dialog_file.h"
#include "synth/speakers/speakers.h"
#include "synth/speech/timed_words.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

constexpr double kSoundSeconds = 10;  // longer than what the seeds say

void read_markup(const FuzzInput& input, MarkupLanguage language) {
    parse_marked_text({.text = std::string(input.text())}, language);
}

void read_pickle(const FuzzInput& input) {
    if (!pickled_texts(input.text())) throw Error("the pickle is no list of texts");
}

// Behind the bundled shapes of hands, which all lexicons use.
void read_lexicon_file(const FuzzInput& input) {
    const std::filesystem::path files[] = {source_dir() / "synth/gestures/lexicon/shapes.json", input.file()};
    read_lexicon(files);
}

void read_opensmile_table(const FuzzInput& input) {
    parse_opensmile(input.text(), "x.csv", OpenSmileSet::speech);
}

const AddFuzzReader kPlain({"plain_text", "x.txt",
                            [](const FuzzInput& input) { read_markup(input, MarkupLanguage::plain); }});
const AddFuzzReader kAplm({"aplm", "x.aplm",
                           [](const FuzzInput& input) { read_markup(input, MarkupLanguage::aplm); }});
const AddFuzzReader kBml({"bml", "x.bml",
                          [](const FuzzInput& input) { read_markup(input, MarkupLanguage::bml); }});
const AddFuzzReader kSsml({"ssml", "x.ssml",
                           [](const FuzzInput& input) { read_markup(input, MarkupLanguage::ssml); }});
const AddFuzzReader kWords({"word_times", "x.words",
                            [](const FuzzInput& input) { read_timed_words(input.file(), kSoundSeconds); }});
const AddFuzzReader kDialog({"dialog", "x.json", [](const FuzzInput& input) { read_dialog(input.file()); }});
const AddFuzzReader kSpeaker({"speaker", "x.json",
                              [](const FuzzInput& input) { read_speaker(input.file()); }});
const AddFuzzReader kLexicon({"lexicon", "x.json", read_lexicon_file});
const AddFuzzReader kOpenSmile({"opensmile", "x.csv", read_opensmile_table});
const AddFuzzReader kPickle({"pickle", "x.pkl", read_pickle});
const AddFuzzReader kInterval({"interval", "x.h5", [](const FuzzInput& input) {
                                   read_interval_file(input.file(), "x", "oliver");
                               }});
const AddFuzzReader kPredictions({"predictions", "x.h5",
                                  [](const FuzzInput& input) { read_predictions(input.file()); }});

}  // namespace
}  // namespace chironomia::testing
