#include "server/store/sqlite/connection.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <new>
#include <thread>

#include "server/runtime/memory.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {
namespace {

/// Runs `work`, turning SQLite's errors into the store's.
template <class Work>
auto guarded(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_BUSY || error.getErrorCode() == SQLITE_LOCKED)
      throw StoreError("another program has locked the store", false, true);
    if (error.getErrorCode() == SQLITE_NOMEM || error.getExtendedErrorCode() == SQLITE_IOERR_NOMEM) {
      open_memory_reserve();
      throw std::bad_alloc();
    }
    // The shared memory of the log is a file, too.
    const bool full = error.getErrorCode() == SQLITE_FULL || error.getExtendedErrorCode() == SQLITE_IOERR_SHMSIZE;
    throw StoreError(full ? std::string("no space left for the store") : std::string("store: ") + error.what(), full);
  }
}

}  // namespace

Query::~Query() {
  statement_->tryReset();
  try {
    statement_->clearBindings();
  } catch (const SQLite::Exception&) {  // cannot fail on a reset statement
  }
}

Query& Query::operator<<(std::int64_t value) {
  guarded([&] { statement_->bind(++bound_, value); });
  return *this;
}
Query& Query::operator<<(double value) {
  guarded([&] { statement_->bind(++bound_, value); });
  return *this;
}
Query& Query::operator<<(std::string_view text) {
  guarded([&] { statement_->bind(++bound_, std::string(text)); });
  return *this;
}
Query& Query::operator<<(const std::optional<std::string>& text) {
  guarded([&] { text ? statement_->bind(++bound_, *text) : statement_->bind(++bound_); });
  return *this;
}
Query& Query::operator<<(std::optional<std::int64_t> value) {
  guarded([&] { value ? statement_->bind(++bound_, *value) : statement_->bind(++bound_); });
  return *this;
}
Query& Query::operator<<(std::optional<double> value) {
  guarded([&] { value ? statement_->bind(++bound_, *value) : statement_->bind(++bound_); });
  return *this;
}
Query& Query::blob(std::string_view bytes) {
  guarded([&] { statement_->bindNoCopy(++bound_, bytes.data(), static_cast<int>(bytes.size())); });
  return *this;
}

bool Query::step() {
  return guarded([&] { return statement_->executeStep(); });
}
int Query::run() {
  return guarded([&] { return statement_->exec(); });
}
int Query::one_int() {
  step();
  return static_cast<int>(integer(0));
}

std::int64_t Query::integer(int column) const { return statement_->getColumn(column).getInt64(); }
double Query::number(int column) const { return statement_->getColumn(column).getDouble(); }
std::string Query::text(int column) const { return statement_->getColumn(column).getString(); }
std::string_view Query::bytes(int column) const {
  const SQLite::Column value = statement_->getColumn(column);
  const auto* data = static_cast<const char*>(value.getBlob());
  return {data, static_cast<std::size_t>(value.getBytes())};
}
bool Query::null(int column) const { return statement_->getColumn(column).isNull(); }
std::optional<std::string> Query::optional_text(int column) const {
  return null(column) ? std::nullopt : std::optional(text(column));
}
std::optional<std::int64_t> Query::optional_integer(int column) const {
  return null(column) ? std::nullopt : std::optional(integer(column));
}

struct SqliteConnection::State {
  State(const std::string& path, int flags) : database(path, flags) {
    sqlite3_busy_handler(database.getHandle(), &State::wait, this);
  }
  /// Waits for a lock that another program has; returns 0 when that takes too long.
  static int wait(void* self, int before) {
    auto& state = *static_cast<State*>(self);
    const auto now = std::chrono::steady_clock::now();
    if (before == 0) state.waiting_since = now;
    if (now - state.waiting_since >= std::chrono::milliseconds(state.patience_ms)) return 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(before + 1, 25)));
    return 1;
  }
  SQLite::Database database;
  std::atomic<std::int64_t> patience_ms{5000};
  std::chrono::steady_clock::time_point waiting_since;
  std::map<std::string, SQLite::Statement, std::less<>> statements;
};

SqliteConnection::SqliteConnection(const std::string& path, bool writer, int max_pages) {
  guarded([&] {
    const int flags = SQLite::OPEN_READWRITE | SQLite::OPEN_NOMUTEX | (writer ? SQLite::OPEN_CREATE : 0);
    state_ = std::make_unique<State>(path, flags);
    auto& database = state_->database;
    if (writer) {
      // A new file gives free pages back to the disk, piece by piece; see expire(). In an older one this would write.
      const auto pages = database.execAndGet("PRAGMA page_count").getInt64();
      if (pages == 0) database.exec("PRAGMA auto_vacuum = INCREMENTAL");
      SQLite::Statement wal(database, "PRAGMA journal_mode = WAL");
      wal.executeStep();
      if (wal.getColumn(0).getString() != "wal")
        throw StoreError("the store's file system does not support SQLite's WAL", false);
      // A log that grew while another program read is cut when it begins again.
      database.exec("PRAGMA journal_size_limit = 8388608");
    }
    database.exec("PRAGMA synchronous = FULL");
    // Removing a job would take all rows of its series in the same transaction; see leftovers.hpp.
    database.exec("PRAGMA foreign_keys = OFF");
    database.exec("PRAGMA temp_store = MEMORY");  // a statement's own journal must not need a disk that is full
    if (!writer) database.exec("PRAGMA query_only = ON");
    if (max_pages > 0) database.tryExec("PRAGMA max_page_count = " + std::to_string(max_pages));
  });
}

SqliteConnection::~SqliteConnection() = default;

std::chrono::milliseconds SqliteConnection::patience(std::chrono::milliseconds patience) {
  return std::chrono::milliseconds(state_->patience_ms.exchange(patience.count()));
}

Query SqliteConnection::query(std::string_view sql) {
  auto found = state_->statements.find(sql);
  if (found == state_->statements.end()) {
    guarded([&] {
      found = state_->statements.emplace(std::string(sql), SQLite::Statement(state_->database, std::string(sql))).first;
    });
  }
  return Query(found->second);
}

void SqliteConnection::execute(const char* sql) {
  guarded([&] { state_->database.exec(sql); });
}

std::string SqliteConnection::blob_part(BlobColumn column, std::int64_t row, std::size_t offset, std::size_t bytes) {
  return guarded([&] {
    sqlite3* const database = state_->database.getHandle();
    sqlite3_blob* handle = nullptr;
    const int opened = sqlite3_blob_open(database, "main", column.table, column.column, row, 0, &handle);
    const std::unique_ptr<sqlite3_blob, decltype(&sqlite3_blob_close)> blob(handle, sqlite3_blob_close);
    if (opened == SQLITE_ERROR) throw StoreError("the text is gone: the job was deleted", false);
    std::string out(bytes, '\0');
    const int read = opened != SQLITE_OK
                         ? opened
                         : sqlite3_blob_read(blob.get(), out.data(), static_cast<int>(bytes), static_cast<int>(offset));
    if (read != SQLITE_OK) throw SQLite::Exception(database, read);
    return out;
  });
}

bool SqliteConnection::allocate(std::int64_t bytes) noexcept {
  // Steps only here: a checkpoint would round the file's size up to one with a hole, where no page has its place.
  sqlite3* const database = state_->database.getHandle();
  sqlite3_int64 size = bytes;
  int step = 256 << 10, none = 0;
  sqlite3_file_control(database, "main", SQLITE_FCNTL_CHUNK_SIZE, &step);
  const bool done = sqlite3_file_control(database, "main", SQLITE_FCNTL_SIZE_HINT, &size) == SQLITE_OK;
  sqlite3_file_control(database, "main", SQLITE_FCNTL_CHUNK_SIZE, &none);
  return done;
}

void SqliteConnection::rollback() noexcept {
  // A full disk may have rolled back already.
  if (sqlite3_get_autocommit(state_->database.getHandle()) == 0) state_->database.tryExec("ROLLBACK");
}

}  // namespace bahnwerk::server
