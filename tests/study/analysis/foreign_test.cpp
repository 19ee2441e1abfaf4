#include "study/analysis/foreign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "study/analysis/dataset_tables.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;

constexpr const char* kHeader =
    "user,input_code,model_a,model_b,winner,is_strong,juiceOptions,juiceOtherReason\n";

Dataset read(const std::string& name, const std::string& text) {
    const TemporaryFolder folder;
    write_text(folder / name, text);
    return read_foreign_answers({folder / name});
}

std::string refusal(const std::string& name, const std::string& text) {
    return refusal_of([&] { read(name, text); });
}

TEST(ReadForeignAnswers, ReadsBattles) {
    const std::string lines = std::string(kHeader) +
                              "u1,c1,NA,SA,model_a,True,\"[\"\"Smoothness\"\"]\",\"so, so\"\n"
                              "u1,c2,SA,NA,model_a,False,[],\n"
                              "u2,c1,SB,NA,tie,,,\n";
    const Dataset data = read("battles.csv", lines);
    ASSERT_EQ(data.conditions.size(), 3u);
    EXPECT_EQ(data.raters.size(), 2u);
    ASSERT_EQ(data.preferences.size(), 3u);
    EXPECT_EQ(data.preferences[0].strength, 2);
    EXPECT_THAT(data.preferences[0].reasons, ElementsAre("Smoothness"));
    EXPECT_EQ(data.preferences[0].other_reason, "so, so");
    // SA stood left and won slightly: NA, the first condition, lost.
    EXPECT_EQ(data.preferences[1].strength, -1);
    EXPECT_EQ(data.preferences[1].left, 1u);
    EXPECT_EQ(data.preferences[2].strength, 0);
    // What is written again is what was read.
    const Table again = table_of_battles(data, 0);
    EXPECT_THAT(table_of_battles(data, 1).rows, ::testing::IsEmpty()) << "another question";
    EXPECT_EQ(csv_header(again, {}), kHeader);
    EXPECT_EQ(read("again.csv", csv_header(again, {}) + csv_rows(again, {})).preferences[1].strength, -1);
}

// Twice the same votes would make every interval narrower.
TEST(ReadForeignAnswers, RefusesWhoVotedInTwoFiles) {
    const TemporaryFolder folder;
    for (const char* name : {"a.csv", "b.csv"})
        write_text(folder / name, std::string(kHeader) + "u1,c1,NA,SA,model_a,True,[],\n");
    EXPECT_THAT(refusal_of([&] {
                    read_foreign_answers({folder / "a.csv", folder / "b.csv"});
                }),
                HasSubstr("b.csv:2: \"u1\" voted in " + (folder / "a.csv").string() +
                          " too; give the votes of each"));
}

// As GENEA published battles_elo.csv: a byte order mark, {} where no reason was given, ties of two kinds.
TEST(ReadForeignAnswers, ReadsBattlesAsTheyWerePublished) {
    const Dataset data = read("battles_elo.csv", "\xef\xbb\xbf" + std::string(kHeader) +
                                                     "u1,c1,NA,SA,tie (bothbad),,{},\n"
                                                     "u1,c2,SA,NA,model_b,True,{},\n");
    ASSERT_EQ(data.preferences.size(), 2u);
    EXPECT_EQ(data.preferences[0].strength, 0);
    EXPECT_THAT(data.preferences[0].reasons, ::testing::IsEmpty());
    EXPECT_EQ(data.preferences[1].strength, 2);
    EXPECT_FALSE(data.questions[0].reasons);
}

TEST(ReadForeignAnswers, RefusesBytesThatAreNoUtf8) {
    const auto name = [](const std::string& bytes) {
        return refusal("b.csv", std::string(kHeader) + "u\u00e9\u20ac\U0001f600,c1,NA,SA,tie,,,\nu" + bytes +
                                    ",c1,NA,SA,tie,,,\n");
    };
    EXPECT_THAT(name("\xe9"), HasSubstr("b.csv:3: the byte 0xe9 is no UTF-8; save the file as UTF-8"));
    for (const char* bytes :
         {"\xc0\x80", "\x80", "\xed\xa0\x80", "\xe0\x80\x80", "\xf4\x90\x80\x80", "\xff", "\xe2\x82"})
        EXPECT_THAT(name(bytes), HasSubstr("b.csv:3: ")) << bytes;
}

TEST(ReadForeignAnswers, RefusesBattlesThatAreNone) {
    const auto line = [](const std::string& text) { return refusal("b.csv", kHeader + text); };
    EXPECT_THAT(line("u1,c1,NA,SA,left,True,,\n"),
                HasSubstr("b.csv:2: winner is \"left\", one of model_a, model_b, tie"));
    EXPECT_THAT(line("u1,c1,NA,SA,tie,yes,,\n"), HasSubstr("is_strong is \"yes\", one of True, False"));
    EXPECT_THAT(line("u1,c1,NA,NA,tie,,,\n"), HasSubstr("model_a and model_b are both \"NA\""));
    EXPECT_THAT(line("u1,c1,NA\n"), HasSubstr("b.csv:2: 3 values, the header has 8 columns"));
    EXPECT_THAT(line("u1,c1,NA,SA,tie,,smooth,\n"),
                HasSubstr("juiceOptions is \"smooth\", a JSON list of texts is needed"));
    EXPECT_THAT(line("u1,\"c1,NA,SA,tie,,,\n"), HasSubstr("b.csv:2: a quote is opened and never closed"));
    EXPECT_THAT(line(""), HasSubstr("b.csv: no rows follow the header"));
    EXPECT_THAT(refusal("b.csv", "user\nu1\n"), HasSubstr("there is no column \"model_a\"; add it"));
}

std::string hemvip(const std::string& trials, const std::string& user = "u1") {
    return "{\"testId\":\"t\",\"userId\":\"" + user + "\",\"trials\":[" + trials + "]}";
}

TEST(ReadForeignAnswers, ReadsHemvip) {
    const Dataset data = read(
        "u1.json",
        hemvip("{\"type\":\"generic\"},{\"type\":\"video\",\"id\":\"p1\",\"responses\":[{\"stimulus\":\"A\","
               "\"score\":40},"
               "{\"stimulus\":\"B\",\"score\":71}]},"
               "{\"type\":\"videopc\",\"id\":\"p2\",\"responses\":[{\"stimulus\":\"B\",\"score\":true},"
               "{\"stimulus\":\"A\",\"score\":false}]},"
               "{\"type\":\"videopc\",\"id\":\"p3\",\"responses\":[{\"stimulus\":\"attn1\",\"score\":99},"
               "{\"stimulus\":\"A\",\"score\":99}]}"));
    ASSERT_EQ(data.scores.size(), 2u);
    EXPECT_EQ(data.cells[data.scores[1].cell], "B");
    EXPECT_EQ(data.scores[1].value, 71);
    ASSERT_EQ(data.preferences.size(), 1u);
    EXPECT_EQ(data.preferences[0].strength, -1);
    EXPECT_EQ(data.raters[0].answered, 2u);
    EXPECT_THAT(data.notes[0],
                HasSubstr("u1.json: 1 pages are checks or were reported as broken, and are left out."));
}

TEST(ReadForeignAnswers, RefusesHemvipThatIsNone) {
    const auto pair = [](const std::string& responses) {
        return refusal("u.json",
                       hemvip("{\"type\":\"videopc\",\"id\":\"p\",\"responses\":[" + responses + "]}"));
    };
    EXPECT_THAT(pair("{\"stimulus\":\"A\",\"score\":true}"),
                HasSubstr("has 1 responses, a page of type \"videopc\" has 2"));
    EXPECT_THAT(pair("{\"stimulus\":\"A\",\"score\":1},{\"stimulus\":\"B\",\"score\":true}"),
                HasSubstr("has a score that is neither true nor false"));
    EXPECT_THAT(pair("{\"stimulus\":\"A\",\"score\":true},{\"stimulus\":\"B\",\"score\":true}"),
                HasSubstr("has two scores that are true"));
    EXPECT_THAT(pair("{\"stimulus\":\"A\",\"score\":true},{\"stimulus\":\"A\",\"score\":false}"),
                HasSubstr("compares \"A\" with itself"));
    EXPECT_THAT(
        refusal(
            "u.json",
            hemvip("{\"type\":\"video\",\"id\":\"p\",\"responses\":[{\"stimulus\":\"A\",\"score\":101}]}")),
        HasSubstr("has the score 101, a number from 0 to 100 is needed"));
    EXPECT_THAT(refusal("u.json", "[" + hemvip("") + "," + hemvip("") + "]"),
                HasSubstr("userId: \"u1\" is already in"));
    EXPECT_THAT(refusal("u.json", "{\"format\":\"chironomia answers 2\"}"),
                HasSubstr("give the folder of the study"));
}

TEST(ReadForeignAnswers, FilesAreOfOneKind) {
    const TemporaryFolder folder;
    write_text(folder / "a.csv", std::string(kHeader) + "u1,c1,NA,SA,tie,,,\n");
    write_text(folder / "b.json", hemvip(""));
    EXPECT_THAT(refusal_of([&] {
                    read_foreign_answers({folder / "a.csv", folder / "b.json"});
                }),
                HasSubstr("is of another kind than the files before it; analyse them apart"));
}

}  // namespace
}  // namespace chironomia::study::analysis
