// Every preset's example from the plan to the results: built without pictures, served over HTTP to two
// participants who answer every page, exported in every form, and analysed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "core/files/files.h"
#include "study/analysis/analysis.h"
#include "study/analysis/rehearsal.h"
#include "study/build/build.h"
#include "study/exports/export_study.h"
#include "study/plan/presets.h"
#include "study/record/key.h"
#include "study/server/answers_file.h"
#include "study/server/serve.h"
#include "tests/study/fake_maker.h"
#include "tests/study/raw_client.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::FakeMaker;
using ::testing::HasSubstr;
using testing::RawClient;
using testing::source_dir;
using testing::TemporaryFolder;

class SmallStudy : public ::testing::Test {
  protected:
    // The plan of the example, small, after a change.
    template <typename Change>
    void build(const std::string& preset, Change change) {
        const fs::path samples = folder_ / "samples";
        fs::copy(source_dir() / "assets/samples", samples, fs::copy_options::recursive);
        Json plan = read_json(samples / "plans" / (preset + ".json"));
        plan["render"]["size"] = {160, 90};
        plan["render"]["fps"] = 10;
        // The clips last 2 s: what is said in them must be short.
        if (with_preset(plan, "").contains("checks")) plan["checks"]["instruction"] = "{answer}";
        change(plan);
        write_json(samples / "plans/tiny.json", plan);
        build_study(read_plan(samples / "plans/tiny.json"), {.out = study(), .seed = 11, .quiet = true},
                    FakeMaker().maker());
    }

    fs::path study() const { return folder_ / "study"; }
    fs::path answers() const { return folder_ / "answers.json"; }

    bool has_checks() const {
        const Json key = read_json(study() / "private/key.json");
        return std::any_of(key["pages"].begin(), key["pages"].end(),
                           [](const Json& page) { return page["kind"] == "check"; });
    }

    // One of the two answers every check wrongly.
    Json two_raters() const {
        return analysis::rehearse_study(
            {.study = study(), .participants = 2, .failing = has_checks() ? 0.5 : 0});
    }

    static Json answer_to(const Json& question) {
        if (question["kind"] == "choice") return question["options"][0]["id"];
        if (question["kind"] == "number")
            return question.contains("least") && question["least"].is_number() ? question["least"] : Json(30);
        if (question["kind"] == "rating") return 1;
        if (question["kind"] == "text") return "nothing";
        return question["least"];
    }

    Json questionnaire() const {
        Json values = Json::object();
        const Json pages = read_json(study() / "public/pages.json");
        for (const Json& question : pages["questionnaire"]) values[question["id"]] = answer_to(question);
        return values;
    }

    static Json post(int port, const std::string& path, const Json& body) {
        const auto answer = RawClient(port).post(path, body);
        EXPECT_EQ(answer->status, 200) << path << answer->body;
        return answer->json();
    }

    void walk(int port, const Json& rater, const Json& begun) {
        ASSERT_EQ(begun["sheet"], rater["sheet"]);
        for (std::size_t number = 0; number < rater["answers"].size(); ++number) {
            post(port, "/api/answer",
                 {{"session", begun["session"]}, {"number", number}, {"answer", rater["answers"][number]}});
        }
        post(port, "/api/finish", {{"session", begun["session"]}, {"questionnaire", questionnaire()}});
    }

    // Whether the server counts each of the two as failed.
    std::vector<bool> walk_both() {
        server::StudyServer server({.study = study(), .port = 0});
        std::thread serving([&] { server.run(); });
        // Both begin before one has failed and left the sheet to the next.
        const Json raters = two_raters();
        std::vector<Json> begun;
        for (const Json& rater : raters)
            begun.push_back(post(server.port(), "/api/begin", {{"participant", rater["participant"]}}));
        for (std::size_t i = 0; i < 2; ++i) walk(server.port(), raters[i], begun[i]);
        server.stop();
        serving.join();
        server::write_answers(study(), {}, answers());
        server::AnswerStore store(server::default_database(study()), server::Database::Use::read,
                                  read_study_pages(study() / "public/pages.json").study);
        std::vector<bool> failed;
        for (const server::Participant& participant : store.participants())
            failed.push_back(participant.failed);
        return failed;
    }

    void expect_files_written_as_they_were_read() {
        const fs::path pages = study() / "public/pages.json";
        write_json(folder_ / "again.json", to_json(read_study_pages(pages)));
        EXPECT_EQ(read_text(folder_ / "again.json"), read_text(pages));
        const fs::path key = study() / "private/key.json";
        write_study_key(folder_ / "again.json", read_study_key(key));
        EXPECT_EQ(read_text(folder_ / "again.json"), read_text(key));
    }

    // A form may say that it cannot express a study, and nothing else.
    void export_all() {
        for (const ExportForm form : {ExportForm::hemvip, ExportForm::hemvip2, ExportForm::webmushra,
                                      ExportForm::jspsych, ExportForm::qualtrics}) {
            const fs::path out = folder_ / std::to_string(static_cast<int>(form));
            try {
                export_study({.study = study(), .out = out, .form = form, .video_url = "https://v.example/"});
                EXPECT_TRUE(fs::exists(out / "private/mapping.json"));
            } catch (const Error& refusal) {
                EXPECT_THAT(refusal.what(), HasSubstr("cannot express this study"));
            }
        }
    }

    TemporaryFolder folder_;
};

class EveryPreset : public SmallStudy, public ::testing::WithParamInterface<std::string> {};

// The server sends away exactly the participants that the analysis leaves out.
TEST_P(EveryPreset, IsWrittenAsItWasReadServedAnsweredExportedAndAnalysed) {
    build(GetParam(), [](Json&) {});
    expect_files_written_as_they_were_read();
    const std::vector<bool> failed = walk_both();
    ASSERT_EQ(failed.size(), 2u);
    EXPECT_EQ(std::count(failed.begin(), failed.end(), true), has_checks() ? 1 : 0);
    export_all();
    const analysis::Analysis analysis = analysis::analyse(
        {.study = study(), .answers = {answers()}, .resampling = {.samples = 100, .seed = 1}});
    ASSERT_EQ(analysis.data.raters.size(), 2u);
    const ExclusionRules& rules = analysis.data.rules;
    for (std::size_t rater = 0; rater < 2; ++rater)
        EXPECT_EQ(analysis.data.raters[rater].failed.size() >= rules.failed_checks, failed[rater]);
    write_analysis(analysis, folder_ / "results");
    EXPECT_TRUE(fs::exists(folder_ / "results/report.html"));
}

// A number without limits, asked of a page and at the end.
TEST_F(SmallStudy, MayAskForANumberWithoutLimits) {
    const Json open = {{"id", "count"}, {"kind", "number"}, {"text", "How many gestures did you count?"}};
    build("thesis-3d-factors", [&](Json& plan) {
        plan["questions"] = Json::array({open});
        plan["questionnaire"] = Json::array({{{"id", "age"}, {"kind", "number"}, {"text", "Your age"}}});
        plan["checks"] = {{"count", 0}};
    });
    walk_both();
    export_all();
    EXPECT_EQ(analysis::analyse(
                  {.study = study(), .answers = {answers()}, .resampling = {.samples = 100, .seed = 1}})
                  .data.raters.size(),
              2u);
}

std::string as_identifier(const ::testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::vector<std::string> names_of_presets() {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) names.push_back(preset.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryPreset, ::testing::ValuesIn(names_of_presets()), as_identifier);

}  // namespace
}  // namespace chironomia::study
