#include "study/design/design.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <utility>

#include "core/random.h"

namespace chironomia::study {
namespace {

// Streams of one seed, so that a change to one draw leaves the others alone.
enum Stream : std::uint64_t {
    kClipStream = 1,
    kConditionStream,
    kPageStream,
    kRowStream,
    kSideStream,
    kPlaceStream
};

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed, std::uint64_t stream) {
    std::vector<std::size_t> items(count);
    std::iota(items.begin(), items.end(), 0u);
    Random random(seed, stream);
    random.shuffle(items);
    return items;
}

void mirror(std::vector<std::size_t>& places) {
    std::reverse(places.begin(), places.end());
}

// The first row of Williams' design: 0, 1, P - 1, 2, P - 2, ... The differences of its neighbours are all
// different, so in the rows made by adding 1, 2, ... modulo P every page follows every other equally often.
std::vector<std::size_t> first_row(std::size_t pages) {
    std::vector<std::size_t> row = {0};
    for (std::size_t step = 1; row.size() < pages; ++step) {
        row.push_back(step);
        if (row.size() < pages) row.push_back(pages - step);
    }
    return row;
}

std::size_t count_rows(std::size_t pages) {
    if (pages == 1) return 1;
    return pages % 2 == 0 ? pages : 2 * pages;
}

// Row `number` of Williams' design. An odd number of pages also needs the rows backwards; they alternate.
std::vector<std::size_t> williams_row(std::size_t pages, std::size_t number) {
    std::vector<std::size_t> row = first_row(pages);
    const bool odd = pages % 2 == 1;
    const std::size_t shift = odd ? number / 2 : number;
    for (std::size_t& page : row) page = (page + shift) % pages;
    if (odd && number % 2 == 1) std::reverse(row.begin(), row.end());
    return row;
}

std::size_t block_of(const DesignShape& shape, std::size_t clip) {
    return shape.block_of_clip.empty() ? 0 : shape.block_of_clip[clip];
}

std::size_t count_clips(const DesignShape& shape, std::size_t block) {
    std::size_t count = 0;
    for (std::size_t clip = 0; clip < shape.clips; ++clip) count += block_of(shape, clip) == block;
    return count;
}

// Pages of a block in the sequence that sheets take their pages from: round by round, each with every clip
// once, while the groups take turns. Where a clip would meet a group again before it met all others, the groups skip a
// turn.
std::vector<DesignPage> draw_sequence(const DesignShape& shape, std::size_t block, std::uint64_t seed) {
    const std::size_t groups = shape.groups.size();
    const std::vector<std::size_t> group_at = shuffled(groups, seed, kConditionStream);
    std::vector<std::size_t> clips = shuffled(shape.clips, seed, kClipStream);
    std::erase_if(clips, [&](std::size_t clip) { return block_of(shape, clip) != block; });

    const bool whole = count_shown(shape, block) == clips.size() * groups;
    const bool drawn = shape.sides == SideRule::per_page || shape.sides == SideRule::mirror;
    const std::size_t first_turn = Random(seed, kSideStream).below(2);
    const std::size_t meeting = std::lcm(clips.size(), groups);
    std::vector<std::size_t> shown(groups, 0);
    Random places(seed, kPlaceStream + 1000 * block);
    std::vector<DesignPage> sequence;
    for (std::size_t i = 0; i < clips.size() * groups; ++i) {
        const std::size_t group = group_at[(i + i / meeting) % groups];
        DesignPage page{.clip = clips[i % clips.size()], .places = shape.groups[group], .block = block};
        // Sheets of all pages see each condition of a clip on either side; sheets of some pages see each
        // group in turn.
        const std::size_t turn = first_turn + (whole ? i % clips.size() : shown[group]);
        if (drawn && turn % 2 == 1) mirror(page.places);
        if (shape.sides == SideRule::rotate) places.shuffle(page.places);
        ++shown[group];
        sequence.push_back(std::move(page));
    }
    return sequence;
}

// How many sheets of a block lead its pages, all of which they show, through the positions, and where places rotate the
// conditions of each page through the places.
std::size_t sheets_of_whole_block(const DesignShape& shape, std::size_t pages) {
    const std::size_t rows = count_rows(pages);
    if (shape.sides != SideRule::rotate) return rows;
    return std::lcm(rows, count_rows(shape.groups.front().size()));
}

// Of Williams' design of the longest sheets.
std::size_t most_rows(const DesignShape& shape) {
    std::size_t most = 1;
    for (std::size_t block = 0; block < count_blocks(shape); ++block)
        most = std::max(most, count_rows(count_shown(shape, block)));
    return most;
}

std::size_t ways_of(const DesignShape& shape) {
    return shape.sides == SideRule::mirror ? 2 : 1;
}

// The sheets of one block.
class SheetDraw {
  public:
    SheetDraw(const DesignShape& shape, std::size_t block, std::size_t first_page, std::uint64_t seed)
        : shape_(shape), block_(block), seed_(seed), first_page_(first_page) {
        shown_ = count_shown(shape, block);
        clips_ = count_clips(shape, block);
        pages_ = clips_ * shape.groups.size();
        name_of_row_ = draw_names();
        times_shown_.assign(pages_, 0);
    }

    Sheet draw(std::size_t number, std::size_t count) {
        const std::size_t ways = ways_of(shape_);
        const std::size_t at = number / ways;
        Sheet sheet{.block = block_, .pages = {}};
        for (const std::size_t position : williams_row(shown_, row_of(number, count))) {
            const std::size_t index = at * shown_ + name_of_row_[position];
            const std::size_t page = index % pages_;
            // Where the sequence begins again, the sides go on taking turns.
            const bool turned = shown_ < pages_ && index / pages_ * clips_ % 2 == 1;
            sheet.pages.push_back(
                {.page = first_page_ + page, .order = order_of(page, (number % ways == 1) != turned)});
        }
        return sheet;
    }

  private:
    // Which page of a sheet each number of a row stands for. Numbers that go with one page in a round of samples
    // (row_of_sample()) keep a remainder in common.
    std::vector<std::size_t> draw_names() const {
        const std::size_t common = std::gcd(pages_, shown_), each = shown_ / common;
        const std::vector<std::size_t> remainders = shuffled(common, seed_, kRowStream);
        std::vector<std::size_t> names(shown_);
        for (std::size_t number = 0; number < shown_; ++number) {
            const std::size_t remainder = remainders[number % common];
            const auto among = shuffled(each, seed_, kRowStream + 1000 * (remainder + 1));
            names[number] = remainder + common * among[number / common];
        }
        return names;
    }

    // Which row of Williams' design orders sheet `number` of `count`.
    std::size_t row_of(std::size_t number, std::size_t count) const {
        const std::size_t ways = ways_of(shape_);
        const std::size_t at = number / ways, taken = (count + ways - 1) / ways;
        if (shown_ < pages_) return row_of_sample(at, number % ways, taken);
        // Spreads the rows evenly over the design; after its last row the first comes again.
        const std::size_t rows = count_rows(shown_);
        return taken < rows ? at * rows / taken : at % rows;
    }

    // Samples come in rounds: as many as show every page equally often. With g the common divisor of the numbers of all
    // pages and of those shown, a page stands in a round at the positions of one remainder modulo g, and a row shifted
    // by one puts it at those of the next remainder. So g rows, a round each, lead every page once through all
    // positions. Where sides are mirrored, the two sheets of the same pages take two of these rows.
    std::size_t row_of_sample(std::size_t at, std::size_t way, std::size_t taken) const {
        const std::size_t ways = ways_of(shape_), common = std::gcd(pages_, shown_), sheets = pages_ / common;
        const std::size_t round = at / sheets, rounds = (taken + sheets - 1) / sheets;
        // The rows go to both sides in the same number. If g is even, the same would come to the same side again.
        const bool again = common % 2 == 0 && round * ways / common % 2 == 1;
        const bool turned =
            round * (shown_ / common) * clips_ % 2 == 1;  // as draw() turns the sides of a round
        const std::size_t step = round * ways + (again != turned ? ways - 1 - way : way);
        const std::size_t cycle = step / common;
        // Of fewer rows than g: as far apart as can be.
        const std::size_t length = std::min(common, rounds * ways - cycle * common);
        const std::size_t turn = round / common;
        const std::size_t shift = (turn * common + step % common * common / length) % shown_;
        // An odd number of pages also needs the rows backwards.
        return shown_ % 2 == 0 ? shift : 2 * shift + turn % 2;
    }

    std::vector<std::size_t> order_of(std::size_t page, bool mirrored) {
        const std::size_t places = shape_.groups.front().size();
        std::vector<std::size_t> order(places);
        std::iota(order.begin(), order.end(), 0u);
        if (mirrored && shape_.sides == SideRule::mirror) mirror(order);
        if (shape_.sides == SideRule::rotate) {
            // Pages begin with different rows, so that a sheet shows different ones too.
            order = williams_row(places, (times_shown_[page]++ + page) % count_rows(places));
            const std::vector<std::size_t> place_named = shuffled(places, seed_, kConditionStream);
            for (std::size_t& place : order) place = place_named[place];
        }
        return order;
    }

    const DesignShape& shape_;
    std::size_t block_;
    std::uint64_t seed_;
    std::size_t first_page_;
    std::size_t shown_ = 0;  // pages of a sheet
    std::size_t clips_ = 0;  // of the block
    std::size_t pages_ = 0;  // pages of the block
    std::vector<std::size_t> name_of_row_;
    std::vector<std::size_t> times_shown_;
};

// The pages get a sequence that says nothing about the clips.
void shuffle_pages(Design& design, std::uint64_t seed) {
    const std::vector<std::size_t> from = shuffled(design.pages.size(), seed, kPageStream);
    std::vector<std::size_t> now_at(from.size());
    std::vector<DesignPage> pages;
    for (std::size_t i = 0; i < from.size(); ++i) {
        now_at[from[i]] = i;
        pages.push_back(design.pages[from[i]]);
    }
    design.pages = std::move(pages);
    for (Sheet& sheet : design.sheets) {
        for (Showing& shown : sheet.pages) shown.page = now_at[shown.page];
    }
}

std::size_t difference(std::size_t a, std::size_t b) {
    return a > b ? a - b : b - a;
}

CountRange spread_of(const std::vector<std::size_t>& counts) {
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    return {.least = *least, .most = *most};
}

}  // namespace

const char* to_text(SideRule sides) {
    switch (sides) {
        case SideRule::fixed:
            return "fixed";
        case SideRule::per_page:
            return "none";
        case SideRule::mirror:
            return "mirror";
        case SideRule::rotate:
            return "rotate";
    }
    return "";
}

std::vector<std::vector<std::size_t>> all_pairs(std::size_t conditions) {
    // Places on a circle: each comes before the next half of it.
    std::vector<std::vector<std::size_t>> pairs;
    for (std::size_t a = 0; a < conditions; ++a) {
        for (std::size_t b = a + 1; b < conditions; ++b) {
            const bool near = 2 * (b - a) <= conditions;
            pairs.push_back({near ? a : b, near ? b : a});
        }
    }
    return pairs;
}

std::size_t count_blocks(const DesignShape& shape) {
    if (shape.block_of_clip.empty()) return 1;
    return *std::max_element(shape.block_of_clip.begin(), shape.block_of_clip.end()) + 1;
}

std::size_t count_shown(const DesignShape& shape, std::size_t block) {
    const std::size_t clips = count_clips(shape, block);
    const std::size_t all = shape.each_clip_once ? clips : clips * shape.groups.size();
    return std::min(all, shape.pages_per_sheet.value_or(all));
}

std::size_t full_sheets(const DesignShape& shape) {
    std::size_t most = 1;
    for (std::size_t block = 0; block < count_blocks(shape); ++block) {
        const std::size_t shown = count_shown(shape, block);
        const std::size_t pages = count_clips(shape, block) * shape.groups.size();
        const std::size_t sets = pages / std::gcd(pages, shown);
        const std::size_t rounds = std::clamp<std::size_t>(kMostSheets / sets, 1, count_rows(shown));
        most = std::max(most, shown == pages ? sheets_of_whole_block(shape, shown) : sets * rounds);
    }
    return most * ways_of(shape) * count_blocks(shape);
}

std::size_t usual_sheets(const DesignShape& shape, std::optional<std::size_t> participants) {
    const std::size_t full = full_sheets(shape);
    std::size_t most = std::min(full, kMostSheets);
    if (full > kMostSheets && shape.sides == SideRule::rotate) {
        const std::size_t round = count_rows(shape.groups.front().size()) * count_blocks(shape);
        most = std::max(round, kMostSheets / round * round);
    }
    if (!participants) return most;
    // Sheets of fewer than all rows have rows that are far apart; the first of all sheets have rows side by side.
    const std::size_t set = ways_of(shape) * count_blocks(shape);
    const std::size_t taken = (*participants + set - 1) / set * set;
    return taken < set * most_rows(shape) ? std::min(taken, most) : most;
}

Design draw_design(const DesignShape& shape, std::uint64_t seed) {
    assert(shape.clips >= 1 && !shape.groups.empty() && shape.sheets.value_or(1) >= 1);
    Design design;
    std::vector<SheetDraw> draws;
    const std::size_t blocks = count_blocks(shape);
    for (std::size_t block = 0; block < blocks; ++block) {
        draws.emplace_back(shape, block, design.pages.size(), seed);
        const std::vector<DesignPage> pages = draw_sequence(shape, block, seed);
        design.pages.insert(design.pages.end(), pages.begin(), pages.end());
    }
    const std::size_t wanted = shape.sheets.value_or(usual_sheets(shape, std::nullopt));
    for (std::size_t i = 0; i < wanted; ++i) {
        const std::size_t block = i % blocks;
        const std::size_t of_block = (wanted - block + blocks - 1) / blocks;
        design.sheets.push_back(draws[block].draw(i / blocks, of_block));
    }
    shuffle_pages(design, seed);
    return design;
}

std::vector<SideBalance> count_sides(const Design& design, std::optional<std::size_t> without) {
    using Pair = std::pair<std::size_t, std::size_t>;
    struct Count {
        std::size_t ordered = 0;
        std::size_t turned = 0;
        std::size_t apart() const { return difference(ordered, turned); }
    };
    std::map<Pair, SideBalance> all;
    std::map<std::pair<Pair, std::size_t>, Count> of_page;
    for (const Sheet& sheet : design.sheets) {
        std::map<Pair, Count> of_sheet;
        for (const Showing& shown : sheet.pages) {
            const DesignPage& page = design.pages[shown.page];
            for (std::size_t i = 0; i < shown.order.size(); ++i) {
                for (std::size_t j = i + 1; j < shown.order.size(); ++j) {
                    const std::size_t left = page.places[shown.order[i]], right = page.places[shown.order[j]];
                    if (left == right || left == without || right == without) continue;
                    const Pair pair = std::minmax(left, right);
                    for (Count* count : {&of_sheet[pair], &of_page[{pair, shown.page}]})
                        ++(left < right ? count->ordered : count->turned);
                }
            }
        }
        for (const auto& [pair, count] : of_sheet) {
            SideBalance& balance = all[pair];
            balance.first_left += count.ordered;
            balance.second_left += count.turned;
            balance.worst_sheet = std::max(balance.worst_sheet, count.apart());
        }
    }
    for (const auto& [key, count] : of_page)
        all[key.first].worst_page = std::max(all[key.first].worst_page, count.apart());
    std::vector<SideBalance> list;
    for (auto& [pair, balance] : all) {
        balance.first = pair.first;
        balance.second = pair.second;
        list.push_back(balance);
    }
    return list;
}

std::vector<std::size_t> places_apart(const Design& design) {
    std::vector<std::vector<std::size_t>> counts;  // of each page by condition and place
    for (const DesignPage& page : design.pages) counts.emplace_back(page.places.size() * page.places.size());
    for (const Sheet& sheet : design.sheets) {
        for (const Showing& shown : sheet.pages) {
            for (std::size_t place = 0; place < shown.order.size(); ++place)
                ++counts[shown.page][shown.order[place] * shown.order.size() + place];
        }
    }
    std::vector<std::size_t> apart;
    for (const std::vector<std::size_t>& of_page : counts) {
        const CountRange range = spread_of(of_page);
        apart.push_back(range.most - range.least);
    }
    return apart;
}

Design taken_in_turn(const Design& design, std::size_t participants) {
    Design taken{.pages = design.pages, .sheets = {}};
    for (std::size_t i = 0; i < participants; ++i)
        taken.sheets.push_back(design.sheets[i % design.sheets.size()]);
    return taken;
}

std::size_t place_limit(std::size_t places) {
    return places % 2 == 0 ? 1 : 2;
}

CountRange count_showings(const Design& design) {
    std::vector<std::size_t> counts(design.pages.size());
    for (const Sheet& sheet : design.sheets) {
        for (const Showing& shown : sheet.pages) ++counts[shown.page];
    }
    return spread_of(counts);
}

CountRange count_positions(const Design& design) {
    std::size_t longest = 0;
    for (const Sheet& sheet : design.sheets) longest = std::max(longest, sheet.pages.size());
    std::vector<std::size_t> counts(design.pages.size() * longest);
    for (const Sheet& sheet : design.sheets) {
        for (std::size_t at = 0; at < sheet.pages.size(); ++at) ++counts[sheet.pages[at].page * longest + at];
    }
    return spread_of(counts);
}

CountRange count_repeats(const Design& design) {
    std::vector<std::size_t> counts;
    for (const Sheet& sheet : design.sheets) {
        std::map<std::size_t, std::size_t> of_clip;
        for (const Showing& shown : sheet.pages) ++of_clip[design.pages[shown.page].clip];
        for (const auto& [clip, count] : of_clip) counts.push_back(count);
    }
    return spread_of(counts);
}

}  // namespace chironomia::study
