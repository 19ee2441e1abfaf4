#include "study/check/check.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "study/check/attention.h"
#include "study/check/files.h"
#include "study/check/prediction.h"
#include "study/check/rebuild.h"
#include "study/check/videos.h"
#include "study/record/study_record.h"

namespace chironomia::study {

Proof yes(std::string_view property, std::string detail) {
    return {.property = std::string(property), .holds = true, .detail = std::move(detail)};
}

Proof no(std::string_view property, std::string detail) {
    return {.property = std::string(property), .holds = false, .detail = std::move(detail)};
}

bool CheckReport::passed() const {
    return std::all_of(proofs.begin(), proofs.end(),
                       [](const Proof& proof) { return proof.holds || proof.open; });
}

CheckReport check_study(const std::filesystem::path& folder, const std::optional<StudySource>& again) {
    const StudyRecord study = read_study(folder);
    const std::vector<SeenVideo> seen = see_videos(study);
    return {.folder = folder,
            .proofs = {check_files_unchanged(study),
                       check_nothing_else_public(study),
                       check_key_complete(study),
                       check_instructions(study),
                       check_videos_match_key(study),
                       check_page_data(study),
                       check_page_texts(study),
                       check_videos_whole(study, seen),
                       check_in_sync(study, seen),
                       check_tokens(study),
                       check_no_names_in_page(study),
                       check_no_names_in_videos(study),
                       check_no_tags(study, seen),
                       check_same_kind(study, seen),
                       check_same_length(study, seen),
                       check_same_size(study),
                       check_padding(study),
                       check_traces(study),
                       check_sides(study),
                       check_orders(study),
                       check_same_sound(study, seen),
                       check_same_loudness(study),
                       check_attention(study),
                       check_prediction(study),
                       check_built_again(study, again)}};
}

std::string to_text(const CheckReport& report) {
    std::size_t widest = 0;
    for (const Proof& proof : report.proofs) widest = std::max(widest, proof.property.size());
    std::string table;
    for (const Proof& proof : report.proofs) {
        table += format("{:<4} {:<{}}  {}\n",
                        proof.open    ? "open"
                        : proof.holds ? "yes"
                                      : "NO",
                        proof.property, widest, proof.detail);
    }
    return table;
}

Json to_json(const CheckReport& report) {
    Json proofs = Json::array();
    for (const Proof& proof : report.proofs) {
        proofs.push_back({{"property", proof.property},
                          {"holds", proof.open ? Json() : Json(proof.holds)},
                          {"detail", proof.detail}});
    }
    return {{"folder", report.folder.string()}, {"holds", report.passed()}, {"proofs", std::move(proofs)}};
}

}  // namespace chironomia::study
