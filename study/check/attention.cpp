#include "study/check/attention.h"

#include <algorithm>
#include <set>

#include "core/text.h"
#include "study/build/participant_pages.h"

namespace chironomia::study {
namespace {

// All that can be read of a page but its names: how many videos, which passes, which keys.
Json form_of(Json page) {
    page["id"] = page["id"].get<std::string>().size();
    for (Json& video : page["videos"]) video = video.get<std::string>().size();
    page.erase("seconds");
    page.erase("caption");
    return page;
}

// How pages of a sheet differ in form or share names; "" if they do not.
std::string difference_on_sheet(const Json& pages) {
    std::set<std::string> names;
    for (const Json& page : pages) {
        if (!names.insert(page["id"].get<std::string>()).second)
            return format("page {} comes twice", page["id"].get<std::string>());
        for (const Json& video : page["videos"]) {
            if (!names.insert(video.get<std::string>()).second)
                return format("{} comes twice", video.get<std::string>());
        }
        if (form_of(page) != form_of(pages.front()))
            return format("page {} is of another form than the others", page["id"].get<std::string>());
    }
    return "";
}

}  // namespace

Proof check_attention(const StudyRecord& study) {
    Proof proof{.property = "no page of a participant shows that it is an attention check",
                .holds = true,
                .detail = ""};
    const Json open = open_pages(study.public_pages);
    const auto is_open = [&](const KeyPage& page) {
        return std::any_of(open["pages"].begin(), open["pages"].end(),
                           [&](const Json& shown) { return shown["id"] == page.token; });
    };
    std::size_t checks = 0;
    for (const KeyPage& page : study.key.pages) {
        checks += page.kind == PageKind::check;
        if (page.kind == PageKind::practice || !is_open(page)) continue;
        proof.holds = false;
        proof.detail = format("page {} is given to all before they begin", page.token);
    }
    for (std::size_t sheet = 0; sheet < study.pages.sheets.size() && proof.holds; ++sheet) {
        const std::string difference =
            difference_on_sheet(pages_of_sheet(study.public_pages, sheet, study.key.secret));
        if (difference.empty()) continue;
        proof.holds = false;
        proof.detail = format("sheet {}: {}", sheet, difference);
    }
    if (proof.holds) {
        proof.detail = format("{} attention checks on {} sheets", checks, study.pages.sheets.size());
        if (checks > 0)
            proof.detail +=
                "; hidden by `study serve`, but on another host pages.json has all sheets, and comparing "
                "them reveals the checks";
    }
    return proof;
}

}  // namespace chironomia::study
