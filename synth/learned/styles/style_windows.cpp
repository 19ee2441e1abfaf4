#include "synth/learned/styles/style_windows.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "synth/corpus/records.h"

namespace chironomia {

using torch::Tensor;

namespace {

// Of a frame of a record: spectrum and words as 16-bit floats, points as floats.
constexpr std::size_t kFrameBytes = 2 * (kStyleMel + kStyleText) + 4 * (kStylePose + kStyleFace) + kStyleActs;

Tensor cut(const Tensor& rows, std::int64_t first, std::int64_t frames) {
    const std::int64_t past = std::min(first + frames, rows.size(0));
    const Tensor inside = rows.slice(0, first, past).to(torch::kFloat32);
    if (past == first + frames) return inside;
    return torch::cat({inside, inside.slice(0, -1).expand({first + frames - past, -1})});
}

// The segments of each record of a group, whatever their order.
using Group = std::vector<std::size_t>;

std::vector<Group> groups_of(const StyleRecords& records, const std::vector<StyleWindow>& windows,
                             std::size_t group_bytes, Random& random) {
    std::vector<std::vector<std::size_t>> of_entry(records.entries().size());
    for (std::size_t i = 0; i < windows.size(); ++i) of_entry[windows[i].entry].push_back(i);
    std::vector<std::size_t> order(of_entry.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);
    std::vector<Group> groups;
    std::size_t bytes = group_bytes;
    for (const std::size_t entry : order) {
        const std::size_t added = kFrameBytes * static_cast<std::size_t>(records.frames_of(entry));
        if (groups.empty() || bytes + added > group_bytes) {
            groups.emplace_back();
            bytes = 0;
        }
        bytes += added;
        groups.back().insert(groups.back().end(), of_entry[entry].begin(), of_entry[entry].end());
    }
    return groups;
}

}  // namespace

std::vector<StyleWindow> style_windows(const StyleRecords& records, std::int64_t frames, std::int64_t hop) {
    std::vector<StyleWindow> windows;
    for (std::size_t entry = 0; entry < records.entries().size(); ++entry) {
        windows.push_back({entry, 0});
        for (std::int64_t first = hop; first < records.frames_of(entry) - frames; first += hop)
            windows.push_back({entry, first});
    }
    return windows;
}

std::vector<StyleWindow> whole_windows(const StyleRecords& records, std::int64_t frames, std::int64_t hop,
                                       const std::string& of_what) {
    std::vector<StyleWindow> windows = style_windows(records, frames, hop);
    std::erase_if(windows,
                  [&](const StyleWindow& window) { return records.frames_of(window.entry) <= frames; });
    if (windows.empty()) {
        throw Error(
            format("{}: no interval is longer than a segment of {} frames ({:.1f} s); give longer ones",
                   of_what, frames, static_cast<double>(frames) / IntervalRecord::kFps));
    }
    return windows;
}

StyleSegments gather(StyleRecords& records, std::span<const StyleWindow> windows, std::int64_t frames) {
    std::vector<Tensor> mel, text, pose, face, acts;
    for (const StyleWindow& window : windows) {
        const StyleRecord& record = records.at(window.entry);
        const std::int64_t first = std::min(window.first, record.frames() - 1);
        const auto add = [&](std::vector<Tensor>& all, const Tensor& rows) {
            if (rows.defined()) all.push_back(cut(rows, first, frames));
        };
        add(mel, record.mel);
        add(text, record.text);
        add(pose, record.pose);
        add(face, record.face);
        add(acts, record.acts);
    }
    const auto stacked = [](const std::vector<Tensor>& all) {
        return all.empty() ? Tensor() : torch::stack(all);
    };
    return {.mel = stacked(mel),
            .text = stacked(text),
            .pose = stacked(pose),
            .face = stacked(face),
            .acts = acts.empty() ? Tensor() : std::get<0>(torch::stack(acts).max(1))};
}

StyleEpoch draw_epoch(const StyleRecords& records, const std::vector<StyleWindow>& windows,
                      const EpochPlan& plan, Random& random) {
    StyleEpoch epoch{.style_of = std::vector<std::size_t>(windows.size())};
    std::vector<std::size_t> order;
    for (Group& group : groups_of(records, windows, plan.group_bytes, random)) {
        random.shuffle(group);
        std::map<std::string, std::vector<std::size_t>> of_speaker;
        for (const std::size_t i : group)
            of_speaker[records.entries()[windows[i].entry].speaker].push_back(i);
        for (const std::size_t i : group) {
            const auto& others = of_speaker.at(records.entries()[windows[i].entry].speaker);
            const bool takes_itself = random.uniform() < plan.same_share;
            const std::size_t other = others[random.below(static_cast<std::uint32_t>(others.size()))];
            epoch.style_of[i] = takes_itself ? i : other;
        }
        order.insert(order.end(), group.begin(), group.end());
    }
    for (std::size_t first = 0; first < order.size(); first += plan.batch) {
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        const auto past = begin + static_cast<std::ptrdiff_t>(std::min(plan.batch, order.size() - first));
        epoch.batches.emplace_back(begin, past);
    }
    return epoch;
}

std::vector<Batch> draw_equally(const StyleRecords& records, const std::vector<StyleWindow>& windows,
                                const EqualPlan& plan, Random& random) {
    std::map<std::string, std::vector<std::size_t>> of_speaker;
    for (std::size_t i = 0; i < windows.size(); ++i)
        of_speaker[records.entries()[windows[i].entry].speaker].push_back(i);
    std::vector<Batch> batches(plan.batches);
    auto speaker = of_speaker.begin();
    for (Batch& batch : batches) {
        while (batch.size() < plan.batch) {
            const std::vector<std::size_t>& own = speaker->second;
            batch.push_back(own[random.below(static_cast<std::uint32_t>(own.size()))]);
            if (++speaker == of_speaker.end()) speaker = of_speaker.begin();
        }
    }
    return batches;
}

}  // namespace chironomia
