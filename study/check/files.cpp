#include "study/check/files.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <sys/stat.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/files/wav_file.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/build/blinding.h"
#include "study/build/pages.h"
#include "study/build/study_files.h"
#include "study/clip/tones.h"
#include "study/plan/attention.h"
#include "study/plan/secret_names.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

fs::path public_folder(const StudyRecord& study) {
    return StudyFolder{study.folder}.open();
}

bool is_known(const std::string& name, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool shares_a_video(const KeyPage& page) {
    return page.places.size() > 1 && page.places[0].video == page.places[1].video;
}

// The videos of a page, by their tokens.
std::vector<std::string> videos_of(const KeyPage& page) {
    if (shares_a_video(page)) return {page.places.front().video};
    std::vector<std::string> tokens;
    for (const KeyPlace& place : page.places) tokens.push_back(place.video);
    return tokens;
}

std::vector<std::size_t> conditions_of(const KeyPage& page) {
    std::vector<std::size_t> conditions;
    for (const KeyPlace& place : page.places) conditions.push_back(place.condition);
    return conditions;
}

// What is wrong with a page of the key, or "".
std::string fault_of_page(const StudyRecord& study, const KeyPage& page) {
    for (const KeyPlace& place : page.places) {
        const KeyVideo& video = video_named(study.key, place.video);
        const std::vector<std::size_t> expected =
            shares_a_video(page) ? conditions_of(page) : std::vector<std::size_t>{place.condition};
        if (video.clip != page.clip || video.conditions != expected) {
            return format("video {} is clip \"{}\", {}; clip \"{}\", {} is needed", video.token, video.clip,
                          names_of(study.key.conditions, video.conditions), page.clip,
                          names_of(study.key.conditions, expected));
        }
    }
    return "";
}

// An archive keeps one date for all files. Unpacking gives them that date in the local time zone, or the time at
// which each is unpacked, and that is in the order of the names, which are hashes. Returns what is wrong, or "".
std::string fault_of_unpacked_times(const fs::path& folder) {
    std::string before;
    fs::file_time_type time = fs::file_time_type::min();
    for (const std::string& name : list_files(folder)) {
        const fs::file_time_type own = fs::last_write_time(folder / name);
        if (own < time)
            return format(
                "{} is older than {}, which was packed before it; unpack the archive again, one file after the "
                "other",
                name, before);
        before = name;
        time = own;
    }
    return "";
}

std::string counted(std::size_t count, std::string_view thing) {
    return format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

// What a page shows, whoever stands where.
std::pair<std::string, std::set<std::size_t>> shown_by(const KeyPage& page) {
    const std::vector<std::size_t> conditions = conditions_of(page);
    return {page.clip, {conditions.begin(), conditions.end()}};
}

std::size_t distance_of(std::size_t a, std::size_t b) {
    return a > b ? a - b : b - a;
}

// The trials of the key as a design of numbers, and their pages among all.
struct Trials {
    Design design;
    std::vector<std::size_t> trial_of_page;  // of others kNoTrial
};
constexpr std::size_t kNoTrial = static_cast<std::size_t>(-1);

Trials trials_of(const StudyRecord& study) {
    Trials trials;
    std::map<std::string_view, std::size_t> clips;
    for (const std::string& clip : study.key.clips) clips.emplace(clip, clips.size());
    for (const KeyPage& page : study.key.pages) {
        trials.trial_of_page.push_back(page.kind == PageKind::trial ? trials.design.pages.size() : kNoTrial);
        if (page.kind != PageKind::trial) continue;
        const auto clip = clips.find(page.clip);
        trials.design.pages.push_back({.clip = clip == clips.end() ? clips.size() : clip->second,
                                       .places = conditions_of(page),
                                       .block = page.block});
    }
    for (const Sheet& sheet : study.pages.sheets) {
        Sheet& seen = trials.design.sheets.emplace_back();
        for (const Showing& shown : sheet.pages) {
            const std::size_t trial = trials.trial_of_page.at(shown.page);
            if (trial == kNoTrial) continue;
            Showing& page = seen.pages.emplace_back(Showing{.page = trial, .order = shown.order});
            // One video that shows both figures has one place, but the page has two.
            if (page.order.size() == 1 && trials.design.pages[trial].places.size() == 2) page.order = {0, 1};
        }
        if (!seen.pages.empty()) seen.block = trials.design.pages[seen.pages.front().page].block;
    }
    return trials;
}

// What is wrong with the sheets, or "".
std::string fault_of_sheets(const StudyRecord& study) {
    if (study.pages.pages.size() != study.key.pages.size()) return "pages.json has other pages than the key";
    for (std::size_t i = 0; i < study.pages.sheets.size(); ++i) {
        for (const Showing& shown : study.pages.sheets[i].pages) {
            const KeyPage& page = study.key.pages[shown.page];
            if (page.kind == PageKind::practice)
                return format("order {}: page {} is for practice", i + 1, page.token);
            if (shown.order.size() != videos_of(page).size()) {
                return format("order {}: page {} shows {} of {} videos", i + 1, page.token,
                              shown.order.size(), videos_of(page).size());
            }
        }
    }
    return "";
}

// Whether both show the same conditions on the same clips at the same places, page by page.
bool same_sheet(const Design& a, const Sheet& of_a, const Design& b, const Sheet& of_b) {
    if (of_a.pages.size() != of_b.pages.size()) return false;
    for (std::size_t i = 0; i < of_a.pages.size(); ++i) {
        if (of_a.pages[i].order != of_b.pages[i].order) return false;
        if (a.pages[of_a.pages[i].page] != b.pages[of_b.pages[i].page]) return false;
    }
    return true;
}

bool same_sheets(const Design& a, const Design& b) {
    if (a.sheets.size() != b.sheets.size()) return false;
    for (std::size_t i = 0; i < a.sheets.size(); ++i) {
        if (!same_sheet(a, a.sheets[i], b, b.sheets[i])) return false;
    }
    return true;
}

// What is wrong with the places of pages where they rotate and participants take the orders again and again, or "".
// Earlier versions of the program made so few orders that this favoured conditions.
std::string fault_of_orders_taken_again(const StudyRecord& study, const Design& design) {
    DesignShape shape = study.key.shape;
    if (shape.each_clip_once || shape.pages_per_sheet) return "";
    const std::size_t orders = design.sheets.size(), participants = study.key.participants.value_or(0);
    // Of any number of participants, what one round of the orders leaves adds up.
    const std::vector<std::size_t> apart =
        places_apart(participants > 0 ? taken_in_turn(design, participants) : design);
    const std::size_t most = *std::max_element(apart.begin(), apart.end());
    const std::size_t limit = participants > 0 ? place_limit(shape.groups.front().size()) : 0;
    if (most <= limit) return "";
    return format(
        "{} leave the conditions of a page {} apart at its places{}, at most {} is balanced; build the study {}",
        counted(orders, "order"), most,
        participants > 0 ? format(" after {} participants", participants) : " each time that all are taken",
        limit,
        study.plan.contains("orders") ? format("with \"orders\": {}, or without \"orders\"",
                                               usual_sheets(shape, study.key.participants))
                                      : format("again, as this version of the program makes {} orders",
                                               usual_sheets(shape, study.key.participants)));
}

// What is wrong with the places of pages where they rotate, or "".
std::string fault_of_places(const StudyRecord& study, const Trials& trials) {
    const std::vector<std::size_t> apart = places_apart(trials.design);
    for (std::size_t i = 0; i < study.key.pages.size(); ++i) {
        const std::size_t trial = trials.trial_of_page[i];
        if (trial == kNoTrial) continue;
        const std::size_t limit = place_limit(study.key.pages[i].places.size());
        if (apart[trial] > limit)
            return format("page {}: its conditions stand at its places {} apart, at most {} is balanced",
                          study.key.pages[i].token, apart[trial], limit);
    }
    return fault_of_orders_taken_again(study, trials.design);
}

// What sides are balanced over, and how far.
std::string balance_of(const DesignShape& shape) {
    if (shape.sides == SideRule::rotate)
        return format("at each place of a page to within {} over all orders, not for each participant",
                      place_limit(shape.groups.front().size()));
    if (shape.sides == SideRule::per_page)
        return "each either way to within 1 for each participant, a page always the same way";
    return "each either way to within 1";
}

// What the plan says of attention checks, as far as it takes to make them again.
Plan plan_of_checks(const StudyRecord& study) {
    Plan plan;
    plan.file = StudyFolder{study.folder}.plan();
    const JsonValue whole(study.plan, plan.file.string());
    plan.questions = read_questions(whole.at("questions"), 1);
    const auto checks = whole.find("checks");
    if (!checks) return plan;
    plan.checks.count = static_cast<std::size_t>(checks->at("count").integer(0, 1000));
    plan.checks.instruction = checks->at("instruction").text();
    plan.checks.instruction_of_video = checks->at("instruction_of_video").text();
    return plan;
}

// Whether a check of the plan has the instruction of this page's video and the expected answers of this page.
bool is_check_of(const Plan& plan, const StudyRecord& study, const KeyPage& page) {
    constexpr std::string_view kMark = "{answer}";
    const bool can_be_made =
        plan.checks.instruction.find(kMark) != std::string::npos &&
        plan.checks.instruction_of_video.find(kMark) != std::string::npos &&
        std::any_of(plan.questions.begin(), plan.questions.end(),
                    [](const Question& question) { return instructed_answer(question).has_value(); });
    if (!can_be_made) return false;
    for (std::size_t place = 0; place < page.places.size(); ++place) {
        const std::string& instruction = video_named(study.key, page.places[place].video).instruction;
        if (instruction.empty()) continue;
        for (std::size_t variant = 0; variant < plan.checks.count; ++variant) {
            const AttentionCheck check = make_check(plan, variant, place, page.places.size());
            if (check.instruction == instruction && check.expected == page.expected) return true;
        }
    }
    return false;
}

// The first key of an object that is not among `known`, or "".
std::string unknown_key(const Json& object, const std::vector<std::string>& known) {
    if (!object.is_object()) return "";
    for (const auto& [key, value] : object.items()) {
        if (!is_known(key, known)) return key;
    }
    return "";
}

// The first key of pages.json that docs/study_files.md does not know, or "".
std::string unknown_key_of_pages(const Json& pages) {
    std::string found = unknown_key(
        pages, {"format",     "study",         "language",     "title",   "texts",     "layout",
                "one_by_one", "width",         "height",       "sound",   "questions", "shuffle_questions",
                "skip_after", "pages",         "instructions", "consent", "training",  "sound_check",
                "sheets",     "questionnaire", "completion"});
    const auto look = [&](const Json& object, const std::vector<std::string>& known) {
        if (found.empty()) found = unknown_key(object, known);
    };
    look(pages.at("consent"), {"text", "agree"});
    look(pages.at("training"), {"text", "pages"});
    look(pages.at("sound_check"), {"files", "choices"});
    look(pages.at("completion"), {"url", "code", "declined_url"});
    for (const Json& page : pages.at("pages")) {
        look(page, {"id", "videos", "seconds", "caption", "passes"});
        for (const Json& pass : page.at("passes")) look(pass, {"sound", "questions"});
    }
    for (const Json& sheet : pages.at("sheets")) look(sheet, {"pages"});
    return found;
}

// One text, or a list of paragraphs, as a page shows it.
Json shown_text(const Json& written) {
    return written.is_array() ? Json(join(written.get<std::vector<std::string>>(), "\n")) : written;
}

// What participants read and are asked, by the keys of pages.json, as the plan has it.
Json frame_of_plan(const Json& plan) {
    const Json& size = plan.at("render").at("size");
    return {{"title", plan.at("title")},
            {"language", plan.at("language")},
            {"texts", plan.value("texts", Json::object())},
            {"layout", plan.at("layout")},
            {"one_by_one", plan.value("presentation", "") == "one after the other"},
            {"width", size.at(0)},
            {"height", size.at(1)},
            {"shuffle_questions", plan.at("shuffle_questions")},
            {"skip_after", plan.value("skip_after", Json())},
            {"instructions", shown_text(plan.at("instructions"))},
            {"questions", plan.at("questions")},
            {"questionnaire", plan.value("questionnaire", Json::array())}};
}

// What participants read of each clip, by its id.
std::map<std::string, Json> captions_of(const Json& plan) {
    std::map<std::string, Json> captions;
    for (const Json& clip : plan.at("clips")) captions.emplace(clip.at("id"), clip.value("caption", ""));
    return captions;
}

// What participants read and the plan does not say, as a key of pages.json, or "".
std::string difference_from_plan(const StudyRecord& study) {
    const Json frame = frame_of_plan(study.plan);
    for (const auto& [key, value] : frame.items()) {
        if (study.public_pages.at(key) != value) return key;
    }
    for (const char* key : {"consent", "training"}) {
        const Json& shown = study.public_pages.at(key);
        const Json text = shown.is_object() ? shown.at("text") : Json("");
        if (text != shown_text(study.plan.value(key, Json("")))) return key;
    }
    const Json& pages = study.public_pages.at("pages");
    const std::map<std::string, Json> captions = captions_of(study.plan);
    for (std::size_t i = 0; i < pages.size() && i < study.key.pages.size(); ++i) {
        const auto caption = captions.find(study.key.pages[i].clip);
        if (caption == captions.end() || pages[i].at("caption") != caption->second)
            return format("pages[{}].caption", i);
    }
    return "";
}

}  // namespace

Proof check_files_unchanged(const StudyRecord& study) {
    constexpr std::string_view kProperty = "every file is as it was built";
    for (const ListedFile& file : study.outputs) {
        const fs::path path = study.folder / file.path;
        if (!fs::is_regular_file(path)) return no(kProperty, format("{} is missing", file.path));
        if (sha256_of_file(path) != file.sha256) return no(kProperty, format("{} has changed", file.path));
    }
    return yes(kProperty, format("{} files", study.outputs.size()));
}

Proof check_nothing_else_public(const StudyRecord& study) {
    constexpr std::string_view kProperty = "public/ holds nothing else";
    std::set<std::string> listed = {"clips"};
    for (const ListedFile& file : study.outputs) {
        if (file.path.starts_with("public/")) listed.insert(file.path.substr(7));
    }
    const fs::path folder = public_folder(study);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        if (entry.is_symlink()) return no(kProperty, format("{} is a link", name));
        if (listed.count(name) == 0) return no(kProperty, format("{} is in no list", name));
    }
    for (std::size_t i = 0; i < study.pages.sounds.size(); ++i) {
        const std::string& name = study.pages.sounds[i];
        if (fs::is_regular_file(folder / name) && read_text(folder / name) != to_wav(make_tones(i + 1)))
            return no(kProperty, format("{} is not this program's own sound", name));
    }
    return yes(kProperty, format("{} files", listed.size() - 1));
}

Proof check_key_complete(const StudyRecord& study) {
    constexpr std::string_view kProperty = "the key holds every comparison of the plan once";
    std::set<std::pair<std::string, std::set<std::size_t>>> seen;
    for (const KeyPage& page : study.key.pages) {
        const std::string fault = fault_of_page(study, page);
        if (!fault.empty()) return no(kProperty, format("page {}: {}", page.token, fault));
        if (page.kind == PageKind::trial && !seen.insert(shown_by(page)).second) {
            return no(kProperty, format("clip \"{}\" shows {} twice", page.clip,
                                        names_of(study.key.conditions, conditions_of(page))));
        }
    }
    const std::size_t expected = study.key.shape.clips * study.key.shape.groups.size();
    if (seen.size() != expected) return no(kProperty, format("{} of {} comparisons", seen.size(), expected));
    return yes(kProperty,
               format("{}, {}, {}", counted(study.key.clips.size(), "clip"),
                      counted(study.key.conditions.size(), "condition"), counted(expected, "trial")));
}

Proof check_instructions(const StudyRecord& study) {
    constexpr std::string_view kProperty =
        "instructions stand in attention checks alone, each with its answer";
    std::size_t checks = 0;
    const Plan plan = plan_of_checks(study);
    for (const KeyPage& page : study.key.pages) {
        const auto has_instruction = [&](const KeyPlace& place) {
            return !video_named(study.key, place.video).instruction.empty();
        };
        const auto instructions =
            static_cast<std::size_t>(std::count_if(page.places.begin(), page.places.end(), has_instruction));
        const bool is_check = page.kind == PageKind::check;
        checks += is_check;
        if ((instructions > 0) != is_check) {
            return no(kProperty, format("page {} is a {} with {}", page.token, to_text(page.kind),
                                        counted(instructions, "instruction")));
        }
        const bool has_answer = page.expected.is_object() && !page.expected.empty();
        if (has_answer != is_check)
            return no(kProperty, format("page {} is a {} with{} an expected answer", page.token,
                                        to_text(page.kind), has_answer ? "" : "out"));
        if (is_check && !is_check_of(plan, study, page))
            return no(kProperty, format("page {} expects {}, which is not what its instruction says",
                                        page.token, page.expected.dump()));
    }
    return yes(kProperty, counted(checks, "attention check"));
}

Proof check_videos_match_key(const StudyRecord& study) {
    constexpr std::string_view kProperty = "every video is what the key says";
    std::set<std::string> keyed;
    for (const KeyVideo& video : study.key.videos) {
        const fs::path file = public_folder(study) / video.file;
        if (!fs::is_regular_file(file)) return no(kProperty, format("{} is missing", video.file));
        if (sha256_of_file(file) != video.sha256) {
            return no(kProperty, format("{} is not clip \"{}\", {}", video.file, video.clip,
                                        names_of(study.key.conditions, video.conditions)));
        }
        keyed.insert(video.file);
    }
    for (const StudyPage& page : study.pages.pages) {
        for (const std::string& path : page.videos) {
            if (keyed.count(path) == 0) return no(kProperty, format("{} is not in the key", path));
        }
    }
    return yes(kProperty, format("{} videos", keyed.size()));
}

Proof check_page_data(const StudyRecord& study) {
    constexpr std::string_view kProperty = "the page shows what the key says";
    const fs::path index = public_folder(study) / "index.html";
    if (!fs::is_regular_file(index)) return no(kProperty, "index.html is missing");
    if (sha256_of_file(index) != sha256(make_index_page(study.public_pages))) {
        return no(kProperty, "index.html is not this program's page with the data of pages.json");
    }
    if (study.pages.pages.size() != study.key.pages.size()) {
        return no(kProperty, format("pages.json has {} pages, the key {}", study.pages.pages.size(),
                                    study.key.pages.size()));
    }
    for (std::size_t i = 0; i < study.key.pages.size(); ++i) {
        std::vector<std::string> files;
        for (const std::string& token : videos_of(study.key.pages[i]))
            files.push_back(video_named(study.key, token).file);
        const StudyPage& shown = study.pages.pages[i];
        if (shown.id != study.key.pages[i].token || shown.videos != files) {
            return no(kProperty, format("page {} of pages.json differs from the key", i + 1));
        }
    }
    return yes(kProperty, format("{} pages", study.key.pages.size()));
}

Proof check_page_texts(const StudyRecord& study) {
    constexpr std::string_view kProperty = "the page says and asks what the plan does, and nothing else";
    try {
        if (const std::string key = unknown_key_of_pages(study.public_pages); !key.empty())
            return no(kProperty, format("pages.json has \"{}\", which no page needs", key));
        if (const std::string key = difference_from_plan(study); !key.empty())
            return no(kProperty, format("{} of pages.json is not what the plan says", key));
    } catch (const Json::exception&) {
        return no(kProperty, "plan.json or pages.json lacks a part, or has it in another form");
    }
    return yes(kProperty, counted(study.public_texts.size(), "text"));
}

Proof check_tokens(const StudyRecord& study) {
    constexpr std::string_view kProperty = "names are keyed hashes";
    std::vector<std::string> found = {study.key.study};
    for (const KeyVideo& video : study.key.videos) found.push_back(video.token);
    for (const KeyPage& page : study.key.pages) found.push_back(page.token);
    for (const std::string& sound : study.pages.sounds) found.push_back(fs::path(sound).stem().string());
    const std::vector<std::string> expected =
        make_tokens(study.key.secret, texts_to_name({.videos = study.key.videos.size(),
                                                     .pages = study.key.pages.size(),
                                                     .sounds = study.pages.sounds.size()}));
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] != expected[i]) return no(kProperty, format("{} should be {}", found[i], expected[i]));
    }
    for (const KeyVideo& video : study.key.videos) {
        const std::string ending = fs::path(video.file).extension().string();
        if (video.file != "clips/" + video.token + ending) {
            return no(kProperty, format("{} is not named by its token", video.file));
        }
    }
    if (study.public_pages.at("study") != study.key.study) {
        return no(kProperty, "pages.json names another study");
    }
    return yes(kProperty, format("{} names of {} digits", found.size(), kTokenDigits));
}

Proof check_no_names_in_page(const StudyRecord& study) {
    constexpr std::string_view kProperty = "no name of a condition in what participants read";
    for (const std::string& text : study.public_texts) {
        if (const auto name = find_condition(text, condition_names(study.key))) {
            return no(kProperty, format("\"{}\" stands in \"{}\"", *name, text));
        }
    }
    // The player is the same for every study, so it reveals nothing of this one. A changed player might.
    for (const PlayerFile& file : player_files()) {
        const fs::path path = public_folder(study) / file.name;
        if (!fs::is_regular_file(path)) return no(kProperty, format("{} is missing", file.name));
        if (sha256_of_file(path) != sha256(file.content)) {
            return no(kProperty, format("{} is not this program's own", file.name));
        }
    }
    return yes(kProperty,
               format("{} texts, {} conditions", study.public_texts.size(), study.key.conditions.size()));
}

Proof check_traces(const StudyRecord& study) {
    constexpr std::string_view kProperty = "times and permissions are neutral";
    std::vector<fs::path> paths = {public_folder(study)};
    for (const auto& entry : fs::recursive_directory_iterator(public_folder(study)))
        paths.push_back(entry.path());
    const bool is_unpacked = fs::exists(StudyFolder{study.folder}.archive());
    for (const fs::path& path : paths) {
        struct stat status {};
        const std::string name = path.lexically_relative(study.folder).string();
        if (::stat(path.c_str(), &status) != 0) return no(kProperty, format("{} cannot be seen", name));
        if (!is_unpacked && (status.st_mtim.tv_sec != kNeutralTime || status.st_mtim.tv_nsec != 0)) {
            return no(kProperty,
                      format("{} has a time of its own; copy with times kept, or build again", name));
        }
        if ((status.st_mode & 0777) != (fs::is_directory(path) ? 0755u : 0644u)) {
            return no(kProperty, format("{} has permissions of its own", name));
        }
    }
    if (!is_unpacked) return yes(kProperty, format("{} files and folders, 1980-01-01", paths.size()));
    const std::string fault = fault_of_unpacked_times(public_folder(study));
    if (!fault.empty()) return no(kProperty, fault);
    return yes(kProperty, format("{} files and folders, unpacked in the order of their names", paths.size()));
}

Proof check_sides(const StudyRecord& study) {
    constexpr std::string_view kProperty = "sides are balanced";
    if (const std::string fault = fault_of_sheets(study); !fault.empty()) return no(kProperty, fault);
    const Trials trials = trials_of(study);
    const Design& design = trials.design;
    const SideRule rule = study.key.shape.sides;
    if (rule == SideRule::rotate) {
        if (const std::string fault = fault_of_places(study, trials); !fault.empty())
            return no(kProperty, fault);
    }
    const std::vector<SideBalance> sides = count_sides(design, study.key.reference);
    std::size_t apart = 0;
    for (const SideBalance& pair : sides) {
        const std::string names =
            study.key.conditions[pair.first].name + " : " + study.key.conditions[pair.second].name;
        apart = std::max(apart, distance_of(pair.first_left, pair.second_left));
        if (rule == SideRule::rotate || rule == SideRule::fixed) continue;
        if (pair.worst_sheet > 1)
            return no(kProperty, format("{}: one participant sees them {} apart", names, pair.worst_sheet));
        if (rule != SideRule::per_page && pair.worst_page > 1)
            return no(kProperty, format("{}: one page is shown either way {} apart", names, pair.worst_page));
    }
    if (sides.empty()) return yes(kProperty, "one place on each page");
    if (rule == SideRule::fixed) return yes(kProperty, "fixed, as the plan asks for");
    return yes(kProperty, format("{} of conditions, {}; at most {} apart over all orders",
                                 counted(sides.size(), "pair"), balance_of(study.key.shape), apart));
}

Proof check_orders(const StudyRecord& study) {
    constexpr std::string_view kProperty = "orders are balanced";
    if (const std::string fault = fault_of_sheets(study); !fault.empty()) return no(kProperty, fault);
    const Design seen = trials_of(study).design;
    const DesignShape& shape = study.key.shape;
    const Design drawn = draw_design(shape, study.key.seed);
    if (!same_sheets(seen, drawn)) {
        return no(kProperty, format("they are not those that the seed draws{}",
                                    shape.pages_per_sheet || shape.each_clip_once
                                        ? "; of a study whose participants see a sample of the pages, "
                                          "an earlier version of the program drew others"
                                        : ""));
    }
    const CountRange positions = count_positions(drawn), showings = count_showings(drawn);
    return yes(kProperty, format("{}; each page {} to {} times, {} to {} times at each position",
                                 counted(study.pages.sheets.size(), "order"), showings.least, showings.most,
                                 positions.least, positions.most));
}

}  // namespace chironomia::study
