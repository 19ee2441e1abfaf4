#include "synth/corpus/make_corpus.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/text.h"
#include "synth/corpus/make_jobs.h"
#include "synth/gestures/lexicon.h"

namespace chironomia {
namespace {

constexpr std::array<std::pair<CorpusSize, std::string_view>, 3> kSizes = {
    {{CorpusSize::ci, "ci"}, {CorpusSize::mini, "mini"}, {CorpusSize::full, "full"}}};

// Works through the jobs on several threads. What the first one that fails throws, run() throws.
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
    // However the waiting ends, no further job begins.
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

CorpusPlan plan_of(const CorpusOrder& order, const Lexicon& lexicon) {
    switch (order.kind) {
        case CorpusKind::talks:
            return plan_talks({.order = order, .lexicon = lexicon, .counts = talk_counts(order.size)});
        case CorpusKind::dyads:
            return plan_dyads(order, lexicon, dyad_counts(order.size));
        case CorpusKind::intervals:
            return plan_intervals(
                {.order = order, .lexicon = lexicon, .counts = interval_counts(order.size)});
    }
    return {};
}

}  // namespace

std::string_view name_of(CorpusSize size) {
    return kSizes[static_cast<std::size_t>(size)].second;
}

std::optional<CorpusSize> corpus_size_named(std::string_view name) {
    for (const auto& [size, own] : kSizes)
        if (own == name) return size;
    return std::nullopt;
}

CorpusIndex make_corpus(const CorpusOrder& order) {
    PendingOutput folder(order.folder, PendingOutput::Kind::folder);
    CorpusOrder pending = order;
    pending.folder = folder.path();
    const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    CorpusPlan plan = plan_of(pending, lexicon);
    const std::size_t threads =
        order.threads > 0 ? static_cast<std::size_t>(order.threads) : std::thread::hardware_concurrency();
    CorpusIndex index{.folder = pending.folder,
                      .kind = order.kind,
                      .text_encoder = order.text_encoder,
                      .entries = {},
                      .origin = origin_of(order, plan.speakers)};
    Progress progress(order.folder.string(), plan.unit, plan.jobs.size(), order.quiet);
    index.entries = Workers(plan.jobs).run(std::max<std::size_t>(threads, 1), progress);
    std::sort(index.entries.begin(), index.entries.end(),
              [](const CorpusEntry& a, const CorpusEntry& b) { return a.id < b.id; });
    write_corpus_index(index);
    folder.commit();
    index.folder = order.folder;
    return index;
}

}  // namespace chironomia
