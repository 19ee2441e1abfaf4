#include "synth/corpus/make/make_corpus.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include "core/cores.h"
#include "core/error.h"
#include "core/files/files.h"
#include "core/progress.h"
#include "core/text.h"
#include "synth/corpus/make/corpus_settings.h"
#include "synth/corpus/make/jobs.h"
#include "synth/corpus/make/tables.h"
#include "synth/corpus/make/unfinished_corpus.h"
#include "synth/corpus/statistics.h"

namespace chironomia {
namespace {

// Of the bundled speakers (synth/speakers/speakers.h).
constexpr long long kMostSeen = 16, kMostUnseen = 6;

// Runs the jobs on several threads. run() throws the first error that a job throws.
class Workers {
  public:
    explicit Workers(const std::vector<CorpusJob>& jobs) : jobs_(jobs) {}

    std::vector<CorpusEntry> run(std::size_t threads, Progress& progress) {
        std::vector<std::jthread> helpers;
        const StopAtEnd stop{*this};
        for (std::size_t i = 0; i < std::min(threads, jobs_.size()); ++i)
            helpers.emplace_back([this] { work(); });
        for (std::size_t done = 0; done < jobs_.size(); ++done) {
            wait_for(done + 1);
            progress.step();
        }
        return std::move(entries_);
    }

  private:
    // No further job begins, also if waiting throws.
    struct StopAtEnd {
        Workers& workers;
        ~StopAtEnd() { workers.next_ = workers.jobs_.size(); }
    };

    void work() {
        for (std::size_t job = next_++; job < jobs_.size(); job = next_++) {
            std::vector<CorpusEntry> made;
            std::exception_ptr failure;
            try {
                made = jobs_[job]();
            } catch (...) {
                failure = std::current_exception();
            }
            const std::lock_guard lock(mutex_);
            entries_.insert(entries_.end(), made.begin(), made.end());
            if (failure && !failure_) failure_ = failure;
            ++done_;
            changed_.notify_one();
        }
    }

    void wait_for(std::size_t done) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return done_ >= done || failure_; });
        if (failure_) std::rethrow_exception(failure_);
    }

    const std::vector<CorpusJob>& jobs_;
    std::atomic<std::size_t> next_ = 0;
    std::mutex mutex_;  // of all below
    std::condition_variable changed_;
    std::vector<CorpusEntry> entries_;
    std::exception_ptr failure_;
    std::size_t done_ = 0;
};

// As many speakers as the order says.
UnitCounts counts_of(const CorpusOrder& order, UnitCounts counts) {
    if (!order.speakers.counts) return counts;
    counts.seen = order.speakers.counts->seen;
    counts.unseen = order.speakers.counts->unseen;
    return counts;
}

CorpusPlan plan_of(const CorpusOrder& order, const Lexicon& lexicon) {
    switch (order.kind) {
        case CorpusKind::talks:
            return plan_talks(
                {.order = order, .lexicon = lexicon, .counts = counts_of(order, talk_counts(order.size))});
        case CorpusKind::dyads:
            return plan_dyads(order, lexicon, dyad_counts(order.size));
        case CorpusKind::intervals:
            return plan_intervals({.order = order,
                                   .lexicon = lexicon,
                                   .counts = counts_of(order, interval_counts(order.size))});
    }
    return {};
}

// All that the bytes depend on.
Json description_of(const CorpusOrder& order, const Json& origin) {
    Json description = origin;
    description["kind"] = name_of(order.kind);
    description["text_encoder"] = order.encoder.name;
    description["tables"] = order.tables;
    description["speakers"] = Json::array();
    for (const auto& [name, about] : origin.at("speakers").items()) description["speakers"].push_back(name);
    return description;
}

// The records of all pieces, those of an earlier run among them.
std::vector<CorpusEntry> make_all(const CorpusPlan& plan, const UnfinishedCorpus& unfinished,
                                  const CorpusOrder& order) {
    std::vector<CorpusEntry> entries;
    std::vector<CorpusJob> left;
    for (std::size_t piece = 0; piece < plan.jobs.size(); ++piece) {
        if (const auto made = unfinished.made(piece)) {
            entries.insert(entries.end(), made->begin(), made->end());
            continue;
        }
        left.push_back([&job = plan.jobs[piece], &unfinished, piece] {
            std::vector<CorpusEntry> made = job();
            unfinished.note(piece, made);
            return made;
        });
    }
    const auto threads = static_cast<std::size_t>(order.threads > 0 ? order.threads : available_cores());
    Progress progress(order.folder.string(), plan.unit, plan.jobs.size(), order.quiet);
    if (left.size() < plan.jobs.size()) progress.step(plan.jobs.size() - left.size());
    const std::vector<CorpusEntry> made = Workers(left).run(threads, progress);
    entries.insert(entries.end(), made.begin(), made.end());
    std::sort(entries.begin(), entries.end(),
              [](const CorpusEntry& a, const CorpusEntry& b) { return a.id < b.id; });
    return entries;
}

}  // namespace

std::string_view name_of(CorpusSize size) {
    constexpr std::array<std::string_view, 3> kNames = {"ci", "mini", "full"};
    return kNames[static_cast<std::size_t>(size)];
}

SpeakerChoice speaker_choice_of(std::string_view text) {
    SpeakerChoice choice;
    const std::vector<std::string_view> counts = split(text, '+');
    const auto seen = parse_integer(counts.front());
    if (!seen) {
        for (const std::string_view name : split(text, ',')) choice.names.emplace_back(trim(name));
        return choice;
    }
    const auto unseen = counts.size() == 1 ? std::optional<long long>(0) : parse_integer(counts.back());
    if (counts.size() > 2 || !unseen || *seen < 1 || *seen > kMostSeen || *unseen < 0 ||
        *unseen > kMostUnseen) {
        throw Error(format(
            "is \"{}\"; there are 1 to {} speakers to learn from and, behind a +, 0 to {} who are unseen: 6, "
            "or 6+2, or names: adrian,quentin",
            text, kMostSeen, kMostUnseen));
    }
    choice.counts = {static_cast<std::size_t>(*seen), static_cast<std::size_t>(*unseen)};
    return choice;
}

CorpusIndex make_corpus(const CorpusOrder& order) {
    const PendingOutput checked(order.folder, PendingOutput::Kind::folder);
    const Lexicon lexicon = read_corpus_lexicon();
    CorpusOrder pending = order;
    pending.folder = UnfinishedCorpus::folder_beside(order.folder);
    CorpusPlan plan = plan_of(pending, lexicon);
    CorpusIndex index{.folder = pending.folder,
                      .kind = order.kind,
                      .text_encoder = order.encoder.name,
                      .entries = {},
                      .origin = origin_of(order, plan.speakers)};
    UnfinishedCorpus unfinished(order.folder, description_of(order, index.origin));
    index.entries = make_all(plan, unfinished, order);
    write_corpus_index(index);
    if (order.tables) write_manifests(index);
    write_statistics(index.folder, measure_statistics(index));
    unfinished.finish(checked.final_path());
    index.folder = order.folder;
    return index;
}

}  // namespace chironomia
