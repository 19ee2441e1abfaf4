#include "study/design/balance.h"

#include "core/text.h"

namespace chironomia::study {
namespace {

std::string range(const CountRange& spread) {
    if (spread.least == spread.most) return format("{}", spread.least);
    return format("{} to {}", spread.least, spread.most);
}

}  // namespace

std::string balance_table(const Design& design, const std::vector<std::string>& conditions) {
    const std::vector<SideBalance> sides = count_sides(design);
    std::size_t widest = 9;
    for (const std::string& name : conditions) widest = std::max(widest, name.size());
    std::string table;
    if (!sides.empty()) {
        table += format("{:<{}}  {:<{}}  {:>15}  {:>20}  {:>22}\n", "condition", widest, "against", widest,
                        "left : right", "worst of one order", "worst of one page");
    }
    for (const SideBalance& side : sides) {
        table += format("{:<{}}  {:<{}}  {:>15}  {:>20}  {:>22}\n", conditions[side.first], widest,
                        conditions[side.second], widest, format("{} : {}", side.first_left, side.second_left),
                        format("{} apart", side.worst_sheet), format("{} apart", side.worst_page));
    }
    std::size_t least = design.sheets.front().pages.size(), most = least;
    for (const Sheet& sheet : design.sheets) {
        least = std::min(least, sheet.pages.size());
        most = std::max(most, sheet.pages.size());
    }
    table += format("A participant sees {} pages, and each of their clips this often: {}.\n",
                    range({.least = least, .most = most}), range(count_repeats(design)));
    table += format("Over all {} orders, times that each page is shown: {}, at each position: {}.\n",
                    design.sheets.size(), range(count_showings(design)), range(count_positions(design)));
    return table;
}

}  // namespace chironomia::study
