#include "study/build/composition.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "study/plan/attention.h"

namespace chironomia::study {
namespace {

// Streams of the study's seed; the design has its own.
enum Stream : std::uint64_t {
    kBlockStream = 101,
    kCheckClipStream,
    kAllPagesStream,
    kSideStream,
    kCheckPlaceStream
};

std::vector<std::size_t> judged_clips(const Plan& plan) {
    std::vector<std::size_t> clips;
    for (std::size_t i = 0; i < plan.clips.size(); ++i) {
        if (!plan.clips[i].practice) clips.push_back(i);
    }
    return clips;
}

// As the plan says, or equally many to each block by chance.
std::vector<std::size_t> blocks_of(const Plan& plan, const std::vector<std::size_t>& judged,
                                   std::uint64_t seed) {
    if (plan.participants.blocks == 1) return {};
    std::vector<std::size_t> blocks(judged.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] = i % plan.participants.blocks;
    Random random(seed, kBlockStream);
    random.shuffle(blocks);
    for (std::size_t i = 0; i < blocks.size(); ++i)
        blocks[i] = plan.clips[judged[i]].block.value_or(blocks[i]);
    return blocks;
}

SideRule side_rule_of(const Plan& plan) {
    switch (plan.layout) {
        case Layout::single:
            return SideRule::per_page;
        case Layout::parallel:
            return SideRule::rotate;
        default:
            if (plan.fixed_sides) return SideRule::fixed;
            return plan.presentation == Presentation::one_video ? SideRule::per_page : SideRule::mirror;
    }
}

std::vector<std::size_t> in_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

// Pages that are no trials have random sides, as far as their layout may move them.
std::vector<std::size_t> random_places(const Plan& plan, std::vector<std::size_t> group, Random& random) {
    if (plan.layout == Layout::parallel) random.shuffle(group);
    const bool may_turn = plan.layout != Layout::parallel && !plan.fixed_sides;
    if (may_turn && random.below(2) == 1) std::reverse(group.begin(), group.end());
    return group;
}

std::vector<PlannedPage> practice_pages(const Plan& plan, Random& sides) {
    std::vector<PlannedPage> pages;
    for (std::size_t i = 0; i < plan.clips.size(); ++i) {
        if (!plan.clips[i].practice) continue;
        const auto& group = plan.groups[pages.size() % plan.groups.size()];
        pages.push_back({.kind = PageKind::practice, .clip = i, .places = random_places(plan, group, sides)});
    }
    return pages;
}

// The instruction stands left and right in turn, never in a reference.
std::size_t place_of_notice(const Plan& plan, std::size_t variant, std::size_t places) {
    if (plan.layout == Layout::triplet) return variant % 2 == 0 ? 0 : 2;
    return variant % places;
}

std::vector<PlannedPage> check_pages(const Plan& plan, const std::vector<std::size_t>& judged,
                                     std::uint64_t seed, Random& sides) {
    std::vector<std::size_t> clips = judged;
    Random random(seed, kCheckClipStream);
    random.shuffle(clips);
    std::vector<PlannedPage> pages;
    for (std::size_t i = 0; i < plan.checks.count; ++i) {
        const auto& group = plan.groups[i % plan.groups.size()];
        const std::size_t place = place_of_notice(plan, i, group.size());
        AttentionCheck check = make_check(plan, i, place, group.size());
        pages.push_back(
            {.kind = PageKind::check,
             .clip = clips[i % clips.size()],
             .places = random_places(plan, group, sides),
             .notice = CheckNotice{.place = place,
                                   .spoken = plan.checks.kinds[i % plan.checks.kinds.size()] == "audio",
                                   .text = std::move(check.instruction)},
             .expected = std::move(check.expected)});
    }
    return pages;
}

constexpr std::size_t kFirstTrials = 3;

// The trials that follow checks of which the first one is among the first pages, if `is_early`, and the others are each
// somewhere in the middle of its share of the rest.
std::vector<std::size_t> spread_checks(std::size_t checks, std::size_t trials, bool is_early,
                                       Random& random) {
    std::vector<std::size_t> before;
    if (is_early && checks > 0) before.push_back(random.below(kFirstTrials));
    const std::size_t late = checks - before.size();
    const double begin = is_early ? 0.25 : 0;
    for (std::size_t i = 0; i < late; ++i) {
        const double share =
            (static_cast<double>(i) + 0.25 + 0.5 * random.uniform()) / static_cast<double>(late);
        before.push_back(
            static_cast<std::size_t>((begin + (1 - begin) * share) * static_cast<double>(trials)));
    }
    return before;
}

// Different ones of the first trials.
std::vector<std::size_t> early_checks(std::size_t checks, Random& random) {
    std::vector<std::size_t> before(std::max(checks, kFirstTrials));
    std::iota(before.begin(), before.end(), std::size_t{0});
    random.shuffle(before);
    before.resize(checks);
    std::ranges::sort(before);
    return before;
}

void insert_checks(Sheet& sheet, std::vector<Showing> checks, EarlyChecks at_beginning, Random& random) {
    random.shuffle(checks);
    const std::size_t trials = sheet.pages.size();
    const std::vector<std::size_t> before =  // the trial that follows each check
        at_beginning == EarlyChecks::all
            ? early_checks(checks.size(), random)
            : spread_checks(checks.size(), trials, at_beginning == EarlyChecks::first, random);
    for (std::size_t i = checks.size(); i-- > 0;)
        sheet.pages.insert(sheet.pages.begin() + static_cast<std::ptrdiff_t>(std::min(before[i], trials)),
                           checks[i]);
}

// Shuffles all pages, so that their places do not reveal their kinds.
void shuffle_all(Composition& all, std::uint64_t seed) {
    std::vector<std::size_t> from = in_order(all.pages.size());
    Random random(seed, kAllPagesStream);
    random.shuffle(from);
    std::vector<std::size_t> now_at(from.size());
    std::vector<PlannedPage> pages;
    for (std::size_t i = 0; i < from.size(); ++i) {
        now_at[from[i]] = i;
        pages.push_back(std::move(all.pages[from[i]]));
    }
    all.pages = std::move(pages);
    for (std::size_t& page : all.practice) page = now_at[page];
    for (Sheet& sheet : all.sheets) {
        for (Showing& shown : sheet.pages) shown.page = now_at[shown.page];
    }
}

// The least number of participants above that of `design` who see every page together, or none if that is a large one.
std::optional<std::size_t> participants_who_see_all(DesignShape shape, const Design& design,
                                                    std::uint64_t seed) {
    constexpr std::size_t kMostTries = 500;
    for (std::size_t more = 1; more <= kMostTries; ++more) {
        shape.sheets = design.sheets.size() + more;
        if (count_showings(draw_design(shape, seed)).least > 0) return shape.sheets;
    }
    return std::nullopt;
}

// Sheets are balanced in more than their pages, so that a page may come twice before every page has come once.
void require_all_shown(const Plan& plan, const Design& design, std::uint64_t seed) {
    if (count_showings(design).least > 0) return;
    std::size_t shown = 0;
    std::set<std::size_t> different;
    for (const Sheet& sheet : design.sheets) {
        shown += sheet.pages.size();
        for (const Showing& showing : sheet.pages) different.insert(showing.page);
    }
    const auto enough = participants_who_see_all(shape_of(plan, seed), design, seed);
    throw Error(format(
        "{}: {} {} pages together, {} of them different, so {} of the {} pages would never be shown; let "
        "\"participants\" be {}, or \"pages_per_participant\" more",
        plan.file.string(),
        design.sheets.size() == 1 ? "1 participant sees"
                                  : format("{} participants see", design.sheets.size()),
        shown, different.size(), design.pages.size() - different.size(), design.pages.size(),
        enough ? format("{}", *enough) : "more"));
}

}  // namespace

DesignShape shape_of(const Plan& plan, std::uint64_t seed) {
    const std::vector<std::size_t> judged = judged_clips(plan);
    const PlanParticipants& who = plan.participants;
    DesignShape shape{.clips = judged.size(),
                      .groups = plan.groups,
                      .sides = side_rule_of(plan),
                      .block_of_clip = blocks_of(plan, judged, seed),
                      .each_clip_once = who.each_clip_once,
                      .pages_per_sheet = who.pages_each,
                      .sheets = who.orders};
    // Where nobody sees all pages it takes a sheet for each participant to show every page equally often.
    const bool some = who.each_clip_once || who.pages_each;
    if (!shape.sheets)
        shape.sheets = some ? who.wanted.value_or(full_sheets(shape)) : usual_sheets(shape, who.wanted);
    return shape;
}

Composition compose(const Plan& plan, std::uint64_t seed) {
    Composition all;
    all.judged = judged_clips(plan);
    all.design = draw_design(shape_of(plan, seed), seed);
    require_all_shown(plan, all.design, seed);
    for (const DesignPage& page : all.design.pages)
        all.pages.push_back({.clip = all.judged[page.clip], .places = page.places, .block = page.block});
    all.sheets = all.design.sheets;

    Random sides(seed, kSideStream);
    std::vector<Showing> checks;
    for (PlannedPage& page : check_pages(plan, all.judged, seed, sides)) {
        // What a check says holds for the places as they are; with one video for both there is one place.
        const std::size_t shown = plan.presentation == Presentation::one_video ? 2 : page.places.size();
        checks.push_back({.page = all.pages.size(), .order = in_order(shown)});
        all.pages.push_back(std::move(page));
    }
    for (std::size_t i = 0; i < all.sheets.size(); ++i) {
        Random random(seed, kCheckPlaceStream + 1000 * (i + 1));
        insert_checks(all.sheets[i], checks, plan.checks.at_beginning, random);
    }
    for (PlannedPage& page : practice_pages(plan, sides)) {
        all.practice.push_back(all.pages.size());
        all.pages.push_back(std::move(page));
    }
    shuffle_all(all, seed);
    return all;
}

}  // namespace chironomia::study
