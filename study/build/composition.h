// All pages of a study, and what each participant sees of them: the trials of the design, and beside them the
// pages for practice and the attention checks.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/design/design.h"
#include "study/plan/plan.h"
#include "study/record/page_kinds.h"

namespace chironomia::study {

// An instruction in the video of one place.
struct CheckNotice {
    std::size_t place = 0;
    bool spoken = false;  // otherwise burnt in as text
    std::string text;

    auto operator<=>(const CheckNotice&) const = default;
};

struct PlannedPage {
    PageKind kind = PageKind::trial;
    std::size_t clip = 0;             // of the plan
    std::vector<std::size_t> places;  // conditions from left to right
    std::size_t block = 0;
    std::optional<CheckNotice> notice{};  // of a check
    Json expected{};                      // of a check: question id -> value
};

struct Composition {
    Design design;                      // of the trials; its clips are those of `judged`
    std::vector<std::size_t> judged;    // clips of the plan
    std::vector<PlannedPage> pages;     // all, in a shuffled sequence
    std::vector<Sheet> sheets;          // indices into `pages`
    std::vector<std::size_t> practice;  // indices into `pages`, in the order of the plan
};

// What the design of a plan is drawn from.
DesignShape shape_of(const Plan& plan, std::uint64_t seed);

// Each sheet has its checks before random trials, each in its own part of the sheet; where the plan asks for early
// ones, the first or all before one of the first trials. Throws Error, naming the plan, if some page would never be
// shown.
Composition compose(const Plan& plan, std::uint64_t seed);

}  // namespace chironomia::study
