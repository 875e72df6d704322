#pragma once
/// A connection to the database with its prepared statements. Not thread-safe; errors are thrown as StoreError.
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace SQLite {
class Statement;
}

namespace bahnwerk::server {

/// A statement in use: bind with `<<` in order of the parameters, step, read columns. Reset by the destructor.
class Query {
 public:
  explicit Query(SQLite::Statement& statement) : statement_(&statement) {}
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  Query& operator<<(std::int64_t value);
  Query& operator<<(double value);
  Query& operator<<(std::string_view text);
  Query& operator<<(const std::string& text) { return *this << std::string_view(text); }
  Query& operator<<(const std::optional<std::string>& text);
  Query& operator<<(std::optional<std::int64_t> value);
  Query& operator<<(std::optional<double> value);
  Query& blob(std::string_view bytes);  ///< must outlive the statement's use

  bool step();  ///< moves to the next row; returns whether there is one
  int run();    ///< executes the statement to its end; returns the number of changed rows
  int one_int();

  std::int64_t integer(int column) const;
  double number(int column) const;
  std::string text(int column) const;
  std::string_view bytes(int column) const;  ///< valid until the next step
  bool null(int column) const;
  std::optional<std::string> optional_text(int column) const;
  std::optional<std::int64_t> optional_integer(int column) const;

 private:
  SQLite::Statement* statement_;
  int bound_ = 0;
};

/// A column of blobs in a table whose primary key is an integer.
struct BlobColumn {
  const char* table;
  const char* column;
};

class SqliteConnection {
 public:
  /// Opens (and for a writer creates) the file: WAL, synchronous=FULL. A lock of another program is waited for 5 s.
  /// `max_pages` > 0 caps the file's size, for tests of a full disk.
  SqliteConnection(const std::string& path, bool writer, int max_pages = 0);
  ~SqliteConnection();
  SqliteConnection(const SqliteConnection&) = delete;
  SqliteConnection& operator=(const SqliteConnection&) = delete;

  /// Changes how long a lock of another program is waited for, from any thread; returns the time until now.
  std::chrono::milliseconds patience(std::chrono::milliseconds patience);
  Query query(std::string_view sql);  ///< prepared once, then reused
  void execute(const char* sql);
  /// Returns `bytes` bytes from `offset` on of the blob in row `row`, without reading the rest of it. Throws StoreError
  /// if the row or the bytes do not exist.
  std::string blob_part(BlobColumn column, std::int64_t row, std::size_t offset, std::size_t bytes);
  void rollback() noexcept;  ///< rolls back an open transaction, if any
  /// Allocates that many bytes of the file on the disk, in steps of 256 KiB, before they are needed; returns false when
  /// there is no room.
  bool allocate(std::int64_t bytes) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bahnwerk::server
