// A study in one archive, as `study pack` writes it and as other programs read it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "core/files/files.h"
#include "core/files/zip_archive.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/server/answers_file.h"
#include "tests/study/process.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;
using testing::write_sample_study;

class PackedStudy : public ::testing::Test {
  protected:
    PackedStudy() {
        write_sample_study(study(), {.trials = 2, .checks = 0, .sheets = 2}, {{"participants", 3}});
    }

    fs::path study() const { return folder_ / "study"; }
    fs::path archive() const { return folder_ / "study.zip"; }

    Outcome pack(const std::vector<std::string>& more = {}) {
        std::vector<std::string> words = {"study", "pack", study().string(), "--out", archive().string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    }

    void add_participants() {
        server::AnswerStore store(server::default_database(study()), server::Database::Use::write,
                                  "3f0c9a5b1e2d4c68");
        const StudyPages pages = read_study_pages(study() / "public/pages.json");
        for (const char* name : {"ada", "grace"}) {
            store.add({.session = format("session of {}", name),
                       .name = name,
                       .arrived_with = format("{{\"PROLIFIC_PID\": \"{}\"}}", name),
                       .browser = "Mozilla"});
            const Json entry = testing::sample_entry(pages, steps_of_sheet(pages, 0)[0], "smooth");
            store.add(server::StoredAnswer{.participant = store.find_by_name(name).front().id,
                                           .number = 0,
                                           .entry = entry.dump(),
                                           .received = 1});
        }
    }

    // The archive as our own reader sees it.
    std::map<std::string, std::string> content() const {
        const std::vector<std::byte> bytes = read_bytes(archive());
        const ZipReader reader(bytes, archive().string());
        std::map<std::string, std::string> files;
        for (std::size_t i = 0; i < reader.size(); ++i) {
            const std::vector<std::byte> file = reader.read(i, 1 << 20, reader.name(i));
            files[reader.name(i)] = std::string(reinterpret_cast<const char*>(file.data()), file.size());
        }
        return files;
    }

    TemporaryFolder folder_;
};

TEST_F(PackedStudy, IsReadableByItsOwnerAloneWithTheKey) {
    EXPECT_EQ(pack({"--with-key"}).exit_code, 0);
    EXPECT_EQ(static_cast<int>(fs::status(archive()).permissions()), 0600);
    fs::permissions(archive(), static_cast<fs::perms>(0644));
    fs::rename(archive(), folder_ / "elsewhere.zip");
    fs::create_symlink("elsewhere.zip", archive());
    EXPECT_EQ(pack({"--with-key"}).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(archive()));
    EXPECT_EQ(static_cast<int>(fs::status(archive()).permissions()), 0644) << "as what is replaced";
}

TEST_F(PackedStudy, HoldsThePublicHalfAndNothingOfTheKey) {
    add_participants();
    const Outcome outcome = pack();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("without the key; --with-key adds private/"));
    const auto files = content();
    for (const auto& [name, text] : files) {
        EXPECT_FALSE(name.starts_with("private/")) << name;
        for (const char* secret : {"\"ours\"", "secret", "ada"})
            EXPECT_THAT(text, Not(HasSubstr(secret))) << name;
    }
    const Json manifest = Json::parse(files.at("archive.json"));
    EXPECT_EQ(manifest["format"], "chironomia archive 1");
    EXPECT_EQ(manifest["study"], "3f0c9a5b1e2d4c68");
    EXPECT_EQ(manifest["key"], false);
    EXPECT_EQ(manifest["files"].size() + 2, files.size()) << "all but the two lists themselves";
    for (const Json& file : manifest["files"]) {
        const std::string& text = files.at(file["path"]);
        EXPECT_EQ(file["sha256"], sha256(text));
        EXPECT_EQ(file["bytes"], text.size());
        EXPECT_EQ(text, read_text(study() / file["path"].get<std::string>()));
    }
}

TEST_F(PackedStudy, HoldsTheKeyAndNumberedAnswersWhenAsked) {
    add_participants();
    const Outcome outcome = pack({"--with-key", "--with-answers"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("2 participants by number"));
    const auto files = content();
    EXPECT_EQ(files.at("private/key.json"), read_text(study() / "private/key.json"));
    EXPECT_EQ(files.at("private/plan.json"), read_text(study() / "private/plan.json"));
    const std::string& answers = files.at("answers.json");
    for (const char* personal : {"ada", "grace", "Mozilla", "session"})
        EXPECT_THAT(answers, Not(HasSubstr(personal)));
    const Json all = Json::parse(answers);
    EXPECT_EQ(all[1]["participant"], "p-2");
    EXPECT_EQ(all[1]["answers"][0]["reasons"]["realism"]["other"], "smooth");
}

TEST_F(PackedStudy, HasTheSameBytesAtAnyTimeInAnyZone) {
    ASSERT_EQ(pack({"--with-key"}).exit_code, 0);
    const std::string first = read_text(archive());
    fs::remove(archive());
    for (const auto& entry : fs::recursive_directory_iterator(study()))
        fs::last_write_time(entry, fs::file_time_type::clock::now());
    setenv("TZ", "Asia/Kolkata", 1);
    const Outcome again = pack({"--with-key"});
    unsetenv("TZ");
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(read_text(archive()), first);
}

// Not our own reader: Debian's Python unpacks it, and coreutils compare the sums.
TEST_F(PackedStudy, IsReadAndProvedByOtherPrograms) {
    ASSERT_EQ(pack({"--with-key"}).exit_code, 0);
    const std::string command = format(
        "cd '{}' && /usr/bin/python3 -m zipfile -e study.zip out && cd out && sha256sum --quiet --strict -c SHA256SUMS",
        folder_.path().string());
    EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(PackedStudy, IsRefusedWhereTheStudyIsDamagedOrHasNoAnswers) {
    const Outcome none = pack({"--with-answers"});
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_THAT(none.err, HasSubstr("answers.sqlite: there is no database of answers"));
    write_json(study() / "private/manifest.json",
               {{"outputs", {{{"path", "public/style.css"}, {"sha256", "00ff"}, {"bytes", 8}}}}});
    const Outcome changed = pack();
    EXPECT_EQ(changed.exit_code, 3);
    EXPECT_THAT(changed.err, HasSubstr("public/style.css: has the SHA-256 " + sha256("body {}\n") +
                                       ", private/manifest.json says 00ff"));
    EXPECT_FALSE(fs::exists(archive()));
    write_json(study() / "private/manifest.json", {{"outputs", {5}}});
    const Outcome damaged = pack();
    EXPECT_EQ(damaged.exit_code, 3);
    EXPECT_THAT(damaged.err, HasSubstr("manifest.json: outputs[0]: is 5"));
    fs::remove(study() / "private/manifest.json");
    fs::create_directory(folder_ / "full");
    const Outcome full = testing::run_chironomia_with_file_limit(
        1000, {"study", "pack", study().string(), "--out", (folder_ / "full/a.zip").string()});
    EXPECT_EQ(full.exit_code, 3);
    EXPECT_THAT(full.err, HasSubstr("a.zip: cannot be written"));
    EXPECT_TRUE(fs::is_empty(folder_ / "full"));
}

}  // namespace
}  // namespace chironomia::study
