#include "synth/corpus/pats_tree.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/text.h"
#include "synth/corpus/pats_table.h"
#include "synth/corpus/record_checks.h"

namespace chironomia {
namespace {

constexpr const char* kTable = "cmu_intervals_df.csv";
// Whose styles the thesis never trains on (chapter 6), and whom it does not use at all.
constexpr std::array<std::string_view, 6> kUnseen = {"lec_evol",      "almaram", "huckabee",
                                                     "ytch_charisma", "minhaj",  "chemistry"};
constexpr std::array<std::string_view, 3> kUnused = {"colbert", "corden", "maher"};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::filesystem::path data_folder(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / kTable) ? folder : folder / "data";
}

std::set<std::string> missing_intervals(const std::filesystem::path& data) {
    const std::filesystem::path path = data / "missing_intervals.h5";
    if (!std::filesystem::exists(path)) return {};
    const std::vector<std::byte> bytes = read_bytes(path);
    const std::vector<std::string> ids = Hdf5File(bytes, path.string()).read_texts("intervals");
    return {ids.begin(), ids.end()};
}

// Reads the table row by row.
class Lister {
  public:
    explicit Lister(const std::filesystem::path& folder)
        : folder_(folder),
          table_(data_folder(folder) / kTable, {"dataset", "delta_time", "interval_id", "speaker"}),
          missing_(missing_intervals(data_folder(folder))) {}

    CorpusIndex run() {
        CorpusIndex index{.folder = folder_, .kind = CorpusKind::intervals, .text_encoder = kPatsEncoder};
        for (const CsvRow& row : table_.rows()) {
            if (auto entry = entry_in(row)) index.entries.push_back(std::move(*entry));
        }
        if (index.entries.empty()) refuse_unusable();
        index.origin["source"] = "PATS";
        for (const auto& [why, count] : left_out_) index.origin["left_out"][why] = count;
        return index;
    }

  private:
    enum Column : std::size_t { kDataset, kSeconds, kId, kSpeaker };

    std::optional<CorpusEntry> entry_in(const CsvRow& row) {
        CorpusEntry entry{.id = table_.text(row, kId), .speaker = table_.text(row, kSpeaker)};
        if (!is_plain_name(entry.id) || !is_plain_name(entry.speaker)) {
            table_.refuse(row, format("\"{}\" of \"{}\" cannot name a file; letters, digits and . _ - + can",
                                      entry.id, entry.speaker));
        }
        entry.split = split_in(row);
        entry.seconds = table_.number(row, kSeconds);
        if (!(entry.seconds > 0))
            table_.refuse(row, format("the interval lasts {} s; it must be longer than 0", entry.seconds));
        if (is_among(kUnseen, entry.speaker)) {
            if (entry.split != Split::test) return leave_out("train and dev of unseen speakers");
            entry.split = Split::unseen;
        }
        if (is_among(kUnused, entry.speaker)) return leave_out("speakers that the thesis does not use");
        if (missing_.contains(entry.id)) return leave_out("listed in missing_intervals.h5");
        if (!std::filesystem::exists(pats_file(folder_, entry.speaker, entry.id)))
            return leave_out("without a file");
        return entry;
    }

    [[noreturn]] void refuse_unusable() const {
        std::vector<std::string> reasons;
        for (const auto& [why, count] : left_out_) reasons.push_back(format("{}: {}", why, count));
        throw Error(format("{}: none of its {} intervals can be used ({}); files are looked for as {}",
                           (data_folder(folder_) / kTable).string(), table_.rows().size(), join(reasons),
                           pats_file(folder_, "SPEAKER", "ID").string()));
    }

    Split split_in(const CsvRow& row) const {
        const std::string dataset = table_.text(row, kDataset);
        if (dataset == "train") return Split::train;
        if (dataset == "dev") return Split::validation;
        if (dataset == "test") return Split::test;
        table_.refuse(row, format("the dataset is \"{}\"; train, dev or test is expected", dataset));
    }

    std::nullopt_t leave_out(const std::string& why) {
        ++left_out_[why];
        return std::nullopt;
    }

    std::filesystem::path folder_;
    PatsTable table_;
    std::set<std::string> missing_;
    std::map<std::string, std::size_t> left_out_;
};

// "0 days 00:01:02.500000", as pandas writes a stretch of time.
std::string pandas_time(double seconds) {
    const auto micros = static_cast<long long>(seconds * 1e6 + 0.5);
    const long long whole = micros / 1'000'000;
    return format("0 days {:02}:{:02}:{:02}.{:06}", whole / 3600, whole / 60 % 60, whole % 60,
                  micros % 1'000'000);
}

}  // namespace

bool holds_pats_tree(const std::filesystem::path& folder) {
    return std::filesystem::exists(data_folder(folder) / kTable);
}

CorpusIndex read_pats_tree(const std::filesystem::path& folder) {
    return Lister(folder).run();
}

std::filesystem::path pats_file(const std::filesystem::path& folder, const std::string& speaker,
                                const std::string& id) {
    return data_folder(folder) / "processed" / speaker / (id + ".h5");
}

void write_pats_table(const CorpusIndex& index) {
    std::string table = "dataset,delta_time,end_time,interval_id,speaker,start_time,video_fn,video_link\n";
    for (const CorpusEntry& entry : index.entries) {
        const char* dataset = entry.split == Split::train        ? "train"
                              : entry.split == Split::validation ? "dev"
                                                                 : "test";
        table += format("{},{},{},{},{},{},{},\n", dataset, entry.seconds,
                        pandas_time(entry.start + entry.seconds), entry.id, entry.speaker,
                        pandas_time(entry.start), entry.recording.empty() ? entry.id : entry.recording);
    }
    write_text(index.folder / "data" / kTable, table);
}

}  // namespace chironomia
