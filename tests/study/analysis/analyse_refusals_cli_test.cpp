// What chironomia study analyse refuses of answers, or makes one of, because it would count otherwise than was meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/files/files.h"
#include "tests/study/analysis/sample_study.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

constexpr const char* kHeader =
    "user,input_code,model_a,model_b,winner,is_strong,juiceOptions,juiceOtherReason\n";
constexpr const char* kComposed = "\u00c9ric";  // NFC
constexpr const char* kApart = "E\u0301ric";    // NFD

class AnalyseCarefully : public ::testing::Test {
  protected:
    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    Outcome analyse(const std::vector<std::string>& files, bool with_study = false) {
        std::vector<std::string> words = {"study", "analyse"};
        if (with_study) words.push_back(in("study"));
        words.push_back("--answers");
        words.insert(words.end(), files.begin(), files.end());
        words.insert(words.end(), {"--out", in("out"), "--samples", "100"});
        return run_chironomia(words);
    }

    std::string refusal_of(const std::vector<std::string>& files, bool with_study = false) {
        const Outcome outcome = analyse(files, with_study);
        EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
        return outcome.err;
    }

    // Of battles.csv with these lines.
    std::string refusal_of_lines(const std::string& lines, bool with_study = false) {
        write_text(in("battles.csv"), kHeader + lines);
        return refusal_of({in("battles.csv")}, with_study);
    }

    Outcome analyse_lines(const std::string& lines, bool with_study = false) {
        write_text(in("battles.csv"), kHeader + lines);
        return analyse({in("battles.csv")}, with_study);
    }

    void write_study(const SampleStudy& sample = {}) { write_sample_study(sample, in("study")); }

    // Two simulated raters answer, as `change` has it.
    std::vector<std::string> answers(const std::function<void(Json& all)>& change) {
        const Outcome rehearsal =
            run_chironomia({"study", "rehearse", in("study"), "--participants", "2", "--failing", "0",
                            "--seed", "1", "--out", in("answers.json")});
        EXPECT_EQ(rehearsal.exit_code, 0) << rehearsal.err;
        Json all = read_json(in("answers.json"));
        change(all);
        write_json(in("answers.json"), all);
        return {in("answers.json")};
    }

    // Votes on the first pages of a sheet, by the tokens of videos as the sheet shows them; of checks the expected
    // answer, "right slightly".
    std::string lines_of_sheet(const std::string& user, std::size_t sheet, std::size_t count,
                               bool with_checks = true) const {
        const Json key = read_json(in("study/private/key.json")),
                   pages = read_json(in("study/public/pages.json"));
        std::string lines;
        for (const Json& shown : pages["sheets"][sheet]["pages"]) {
            const Json& page = key["pages"][shown[0].get<std::size_t>()];
            if (count == 0 || (page["kind"] == "check" && !with_checks)) continue;
            const auto video = [&](std::size_t side) {
                return page["places"][shown[1][side].get<std::size_t>()]["video"].get<std::string>();
            };
            lines += format("{},x,{},{},model_b,False,[],\n", user, video(0), video(1));
            --count;
        }
        return lines;
    }

    TemporaryFolder folder_;
};

TEST_F(AnalyseCarefully, RefusesAFileThatIsNamedTwice) {
    write_text(in("all/a.csv"), std::string(kHeader) + "u1,c1,ours,base,model_a,True,[],\n");
    std::filesystem::create_symlink(in("all/a.csv"), in("link.csv"));
    const std::string file = in("all/a.csv");
    for (const std::string& again : {file, in("all/../all/a.csv"), in("all"), in("link.csv")}) {
        EXPECT_THAT(refusal_of({file, again}), HasSubstr(": is the same file as " + file +
                                                         ", which is named before it; name each file once"))
            << again;
    }
}

TEST_F(AnalyseCarefully, RefusesALineThatComesTwice) {
    const std::string line = "u1,c1,ours,base,model_a,True,[],\n",
                      other = "u1,c2,ours,base,model_a,True,[],\n";
    EXPECT_THAT(
        refusal_of_lines(line + other + line),
        HasSubstr("battles.csv:4: is the same as line 2; remove one of them, or if they are two votes, "
                  "add a column in which they differ, such as their times"));
    write_text(in("timed.csv"),
               "time,user,input_code,model_a,model_b,winner,is_strong,juiceOptions,juiceOtherReason\n"
               "1," +
                   line + "2," + line);
    const Outcome timed = analyse({in("timed.csv")});
    EXPECT_EQ(timed.exit_code, 0) << timed.err;
    EXPECT_EQ(read_json(in("out/analysis.json"))["strict"]["preferences"][0]["votes"], 2);
}

TEST_F(AnalyseCarefully, RefusesAPageThatIsVotedOnMoreOftenThanItAsks) {
    write_study();
    const std::string lines = lines_of_sheet("v0", 0, 8), first = lines.substr(0, lines.find('\n') + 1);
    std::string tie = first;
    tie.replace(tie.find("model_b"), 7, "tie");
    EXPECT_THAT(
        refusal_of_lines(lines + tie, true),
        HasSubstr("battles.csv:10: \"v0\" voted on page \"0000000000000000\" in line 2 already; remove one "
                  "of the two"));
    // Without sound and with it.
    Json pages = read_json(in("study/public/pages.json"));
    for (Json& page : pages["pages"]) page["passes"].push_back(page["passes"][0]);
    write_json(in("study/public/pages.json"), pages);
    EXPECT_EQ(analyse_lines(lines + tie, true).exit_code, 0);
}

TEST_F(AnalyseCarefully, RefusesAPageOfHemvipThatIsAnsweredTwice) {
    const Json page = {
        {"type", "video"},
        {"id", "p1"},
        {"responses", {{{"stimulus", "ours"}, {"score", 40}}, {{"stimulus", "base"}, {"score", 4}}}}};
    Json other = page;
    other["id"] = "p2";
    write_json(in("h.json"), {{{"userId", "u1"}, {"trials", {page, other, page}}}});
    EXPECT_THAT(
        refusal_of({in("h.json")}),
        HasSubstr("h.json: [0].trials[2]: page \"p1\" is answered a second time, first in [0].trials[0]; "
                  "remove one answer, or give two pages names of their own"));
}

// Of eight pages two are checks. Who has left early voted on four.
TEST_F(AnalyseCarefully, ExcludesVotersWhoLeftEarly) {
    write_study();
    const auto strict = [&](const std::string& lines) {
        const Outcome outcome = analyse_lines(lines, true);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    };
    const std::string whole = lines_of_sheet("v0", 0, 8), early = lines_of_sheet("v1", 1, 4);
    const std::string known = strict(whole + early);
    EXPECT_THAT(known, HasSubstr("2 participants: 1 counted by the strict rule, 2 by the lenient one"));
    EXPECT_THAT(known, HasSubstr("  v1: did not finish\n"));
    EXPECT_THAT(known, Not(HasSubstr("is not known")));
    EXPECT_THAT(read_text(in("out/participants.csv")), HasSubstr("v1,no,4,"));
    // Files that never have checks do not lack them.
    EXPECT_THAT(strict(lines_of_sheet("v0", 0, 8, false) + lines_of_sheet("v1", 1, 3, false)),
                AllOf(HasSubstr("1 counted by the strict rule"), HasSubstr("  v1: did not finish\n"),
                      HasSubstr("These files have no attention checks of the study: nobody is excluded for "
                                "failing one.")));
    // Names of conditions, and videos of two sheets.
    EXPECT_THAT(
        strict("v2,c1,ours,baseline,tie,,[],\n" + lines_of_sheet("v3", 0, 2) + lines_of_sheet("v4", 0, 2) +
               "v4,c1,ours,baseline,tie,,[],\n"),
        HasSubstr("Whether 2 participants finished is not known, because their lines do not name the videos "
                  "of a sheet of the study: they count as if they had."));
    EXPECT_THAT(
        analyse_lines("u1,c1,ours,base,tie,,[],\n").out,
        HasSubstr("These files do not say which checks were failed, nor who did not finish: nobody is "
                  "excluded."));
}

TEST_F(AnalyseCarefully, RefusesValuesThatAPassDoesNotAsk) {
    SampleStudy sample;
    sample.questions.push_back({{"id", "natural"}, {"kind", "rating"}, {"text", "?"}, {"points", 7}});
    write_study(sample);
    Json pages = read_json(in("study/public/pages.json"));
    for (Json& page : pages["pages"])
        page["passes"] = {{{"sound", false}, {"questions", {0}}}, {{"sound", true}, {"questions", {1}}}};
    write_json(in("study/public/pages.json"), pages);
    EXPECT_THAT(
        refusal_of(answers([](Json& all) { all[1]["answers"][3]["values"]["realism"] = 2; }), true),
        HasSubstr(
            "answers.json: participant simulated-2: pass 1 of page \"0000000000000002\" has the value 2 "
            "for \"realism\", which it does not ask; remove it, or give the answers to this build of "
            "the study"));
}

TEST_F(AnalyseCarefully, RefusesPagesThatTheSheetDoesNotShow) {
    write_study();
    Json pages = read_json(in("study/public/pages.json"));
    pages["sheets"][0]["pages"].erase(0);
    write_json(in("study/public/pages.json"), pages);
    EXPECT_THAT(
        refusal_of(answers([](Json& all) {
                       Json more = all[0]["answers"][0];
                       more["page"] = "0000000000000000";
                       more["videos"] = {"0000000000000000", "0000000000000001"};
                       all[0]["answers"].push_back(more);
                   }),
                   true),
        HasSubstr("answers.json: participant simulated-1: page \"0000000000000000\" is answered, but sheet 0 "
                  "does not show it; give the answers to this build of the study"));
    EXPECT_THAT(
        refusal_of(answers([](Json& all) {
                       Json& videos = all[0]["answers"][1]["videos"];
                       std::swap(videos[0], videos[1]);
                   }),
                   true),
        HasSubstr("participant simulated-1: page \"0000000000000002\" has the videos 0000000200000001, "
                  "0000000200000000 from left to right, but sheet 0 shows 0000000200000000, "
                  "0000000200000001; give the answers to this build of the study"));
}

TEST_F(AnalyseCarefully, RefusesVotesOffTheScaleOfTheStudy) {
    SampleStudy sample;
    Json& answers = sample.questions[0]["answers"];
    answers = {"left", "equal", "right"};
    sample.expected = {{"realism", 1}};
    write_study(sample);
    const std::string slightly = "u1,c1,ours,baseline,model_a,False,[],\n",
                      strong = "u1,c2,ours,baseline,model_a,True,[],\n",
                      tie = "u1,c3,ours,baseline,tie,,[],\n";
    EXPECT_THAT(
        refusal_of_lines(slightly + strong, true),
        HasSubstr(
            "battles.csv:3: is_strong is \"True\", but \"realism\" has 3 answers, none of them stronger "
            "than another; \"False\" is needed, or nothing"));
    EXPECT_EQ(analyse_lines(slightly + tie, true).exit_code, 0);
    answers = {"left", "right"};
    write_study(sample);
    EXPECT_THAT(
        refusal_of_lines(slightly + tie, true),
        HasSubstr("battles.csv:3: winner is \"tie\", but \"realism\" has 2 answers, none of them in the "
                  "middle; model_a or model_b is needed"));
    EXPECT_THAT(refusal_of_lines(strong, true), HasSubstr("battles.csv:2: is_strong is \"True\""));
    EXPECT_EQ(analyse_lines(slightly, true).exit_code, 0);
}

TEST_F(AnalyseCarefully, RefusesAReasonThatIsNamedTwice) {
    EXPECT_THAT(refusal_of_lines("u1,c1,ours,base,model_a,True,\"[\"\"smooth\"\",\"\"smooth\"\"]\",\n"),
                HasSubstr("battles.csv:2: juiceOptions names \"smooth\" twice; name each reason once"));
}

TEST_F(AnalyseCarefully, RefusesVotesOfNobody) {
    EXPECT_THAT(
        refusal_of_lines(",c1,ours,base,model_a,True,[],\n"),
        HasSubstr("battles.csv:2: user is empty, and votes of several people would count as those of one; "
                  "write who voted"));
    write_json(in("h.json"), {{"userId", " "}, {"trials", Json::array()}});
    EXPECT_THAT(refusal_of({in("h.json")}), HasSubstr("h.json: userId: is an empty text"));
}

TEST_F(AnalyseCarefully, KeepsSystemsWhoseNamesHaveAttnInThem) {
    const auto page = [](const char* type, const std::string& id, const std::string& stimulus) {
        const bool is_pair = type == std::string("videopc");
        const Json one = is_pair ? Json(true) : Json(40), two = is_pair ? Json(false) : Json(50);
        return Json{{"type", type},
                    {"id", id},
                    {"responses",
                     {{{"stimulus", stimulus}, {"score", one}}, {{"stimulus", "base"}, {"score", two}}}}};
    };
    Json trials = Json::array();
    for (const char* mark : {"attn", "attn1", "left_attn_3", "attngan", "StyleAttn", "selfattn"})
        trials.push_back(page("videopc", std::string("pair ") + mark, mark));
    for (const char* mark : {"at", "x_attn_check_40", "attn_check_7", "attngan", "attn_gan"})
        trials.push_back(page("video", std::string("sliders ") + mark, mark));
    write_json(in("h.json"), {{"userId", "u1"}, {"trials", trials}});
    const Outcome outcome = analyse({in("h.json")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr("h.json: 6 pages are checks or were reported as broken, and are left out."));
    const Json strict = read_json(in("out/analysis.json"))["strict"];
    EXPECT_EQ(strict["preferences"].size(), 3u) << strict["preferences"];
    EXPECT_EQ(strict["scores"].size(), 3u) << strict["scores"];
}

TEST_F(AnalyseCarefully, KnowsAPersonHoweverTheNameIsWritten) {
    write_study();
    const auto named = [&](const std::string& first, const std::string& second) {
        return refusal_of(answers([&](Json& all) {
                              all[0]["participant"] = first;
                              all[1]["participant"] = second;
                          }),
                          true);
    };
    EXPECT_THAT(named("abc", "abc "), HasSubstr("answers.json: participant \"abc\" is already in "));
    EXPECT_THAT(named(kComposed, kApart),
                HasSubstr(format("answers.json: participant \"{}\" is already in ", kComposed)));
    EXPECT_THAT(refusal_of(answers([](Json& all) {
                               all[0]["arrived_with"] = {{"PROLIFIC_PID", " abc"}};
                               all[1]["arrived_with"] = {{"PROLIFIC_PID", "abc "}};
                           }),
                           true),
                HasSubstr("answers.json: the PROLIFIC_PID \"abc\" is already in "));
    const std::string rest = ",ours,base,model_a,True,[],\n";
    const Outcome battles = analyse_lines(std::string(kComposed) + ",c1" + rest + kApart + ",c2" + rest +
                                          " " + kApart + " ,c3" + rest);
    EXPECT_THAT(battles.out, HasSubstr("1 participant: 1 counted")) << battles.err;
    write_json(in("h.json"), {{{"userId", kComposed}, {"trials", Json::array()}},
                              {{"userId", kApart}, {"trials", Json::array()}}});
    EXPECT_THAT(refusal_of({in("h.json")}),
                HasSubstr(format("[1].userId: \"{}\" is already in ", kComposed)));
}

}  // namespace
}  // namespace chironomia::study::analysis
