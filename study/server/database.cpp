#include "study/server/database.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sqlite3.h>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study::server {

namespace {

namespace fs = std::filesystem;

// Answers are for nobody else on the machine; the files that SQLite adds take the permissions of this one. A file that
// is there is not opened: to close any descriptor of it would drop the locks that this process has on it (POSIX), and
// another program, which then takes itself for the last one, would delete the log that answers are written to.
void make_private_file(const fs::path& file) {
    const int made = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (made >= 0) close(made);
}

fs::path log_of(const fs::path& database) {
    return database.string() + "-wal";
}

// 0: there is no such file.
std::uint64_t inode_of(const fs::path& file) {
    struct stat found {};
    return stat(file.c_str(), &found) == 0 ? found.st_ino : 0;
}

}  // namespace

Database::Database(const std::filesystem::path& file, Use use) : file_(file) {
    if (use == Use::write) make_private_file(file);
    const int flags = use == Use::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(file.c_str(), &opened, flags | SQLITE_OPEN_FULLMUTEX, nullptr);
    handle_.reset(opened);  // to be closed even if it could not be opened
    if (code != SQLITE_OK) {
        throw Error(format("{}: the database cannot be opened ({}); check the path and its permissions",
                           file.string(), sqlite3_errstr(code)));
    }
    sqlite3_busy_timeout(handle_.get(), 10'000);
    // A copy may come from somebody else: no statement that it holds is run.
    for (const int what :
         {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_TRUSTED_SCHEMA})
        sqlite3_db_config(handle_.get(), what, 0, nullptr);
    if (use == Use::write) {
        // FULL: a transaction is on the disk before its commit returns, and WAL lets others read meanwhile.
        // What is deleted is overwritten with zeros.
        run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON; PRAGMA secure_delete=ON");
        prepare("SELECT count(*) FROM sqlite_master").step();  // opens the log
        log_inode_ = inode_of(log_of(file));
    }
}

void Database::Close::operator()(sqlite3* handle) const {
    sqlite3_close_v2(handle);
}

Statement Database::prepare(std::string_view sql) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(handle_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr) !=
        SQLITE_OK) {
        complain("cannot be read");
    }
    return Statement(*this, statement);
}

void Database::run(const std::string& sql) {
    if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        complain("refuses a change");
}

bool Database::empty_log() {
    Statement result = prepare("PRAGMA wal_checkpoint(TRUNCATE)");
    return result.step() && result.integer(0) == 0;
}

void Database::check_place() const {
    int moved = 0;
    sqlite3_file_control(handle_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
    const std::uint64_t log = inode_of(log_of(file_));
    if (moved == 0 && log != 0 && log == log_inode_) return;
    throw Error(format(
        "{}: the database was moved or deleted while it is in use, and takes nothing more; put it back "
        "where it was, with its log {}, or start the server again",
        file_.string(), log_of(file_).filename().string()));
}

bool Database::in_transaction() const {
    return sqlite3_get_autocommit(handle_.get()) == 0;
}

bool Database::is_locked() const {
    return sqlite3_errcode(handle_.get()) == SQLITE_BUSY;
}

void Database::complain(std::string_view what) const {
    throw Error(
        format("{}: the database {}: {}; check that the disk has space and the file is a database of answers",
               file_.string(), what, sqlite3_errmsg(handle_.get())));
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

Statement& Statement::bind(int place, std::int64_t value) {
    sqlite3_bind_int64(handle_.get(), place, value);
    return *this;
}

Statement& Statement::bind(int place, const std::string& value) {
    sqlite3_bind_text(handle_.get(), place, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    return *this;
}

Statement& Statement::bind(int place, const std::optional<std::string>& value) {
    if (value) return bind(place, *value);
    sqlite3_bind_null(handle_.get(), place);
    return *this;
}

bool Statement::step() {
    const int code = sqlite3_step(handle_.get());
    if (code == SQLITE_ROW) return true;
    if (code != SQLITE_DONE) database_->complain("fails");
    return false;
}

std::int64_t Statement::integer(int column) const {
    return sqlite3_column_int64(handle_.get(), column);
}

std::string Statement::text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
    return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column)))
                 : "";
}

bool Statement::is_null(int column) const {
    return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL;
}

}  // namespace chironomia::study::server
