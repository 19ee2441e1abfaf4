// SQLite: a database file, and statements with their values. What went wrong is an Error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace chironomia::study::server {

class Statement;

class Database {
  public:
    enum class Use {
        write,  // made if it is not there; a change is on the disk when its transaction is committed
        read,   // must be there; sees what others have committed
    };

    // Throws Error if the file cannot be opened, or is no database.
    Database(const std::filesystem::path& file, Use use);

    // A statement with ?1, ?2, ... for its values. Throws Error if it is wrong.
    Statement prepare(std::string_view sql);

    // Statements without results, parted by semicolons. Throws Error if one fails, such as on a full disk.
    void run(const std::string& sql);

    // Writes all that was committed into the file itself and empties the log beside it, so that nothing that was
    // deleted stays there. False if somebody else is reading; then the log is emptied later.
    bool empty_log();

    // Throws Error if the file, or the log beside it, was moved, deleted or replaced since it was opened: what is written
    // then goes where nobody finds it. Of a database that is open for writing.
    void check_place() const;

    bool in_transaction() const;
    bool is_locked() const;  // whether the last statement failed because another program changes the database
    [[noreturn]] void complain(std::string_view what) const;

  private:
    struct Close {
        void operator()(sqlite3* handle) const;
    };
    std::unique_ptr<sqlite3, Close> handle_;
    std::filesystem::path file_;
    std::uint64_t log_inode_ = 0;
};

// Must not outlive its database.
class Statement {
  public:
    Statement(Database& database, sqlite3_stmt* handle) : database_(&database), handle_(handle) {}

    Statement& bind(int place, std::int64_t value);
    Statement& bind(int place, const std::string& value);
    Statement& bind(int place, const std::optional<std::string>& value);

    // Goes to the next row; false when there is none. Throws Error if the statement fails.
    bool step();

    // Columns of the row count from 0.
    std::int64_t integer(int column) const;
    std::string text(int column) const;
    bool is_null(int column) const;

  private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    Database* database_;
    std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace chironomia::study::server
