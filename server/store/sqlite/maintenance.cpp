/// Backup and check of a store's file, by another process than the one that owns it: both read only.
#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "server/store/sqlite/commands.hpp"
#include "server/store/sqlite/connection.hpp"
#include "server/store/sqlite/migrate.hpp"

namespace bahnwerk::server {
namespace {

std::string path_of(const std::string& url) {
  check_store(url);
  const std::string path = url.substr(7);
  if (!std::filesystem::exists(path)) throw StoreError("there is no store " + path, false);
  return path;
}

StoreError failed(const std::string& what, const std::string& path) {
  return {"cannot " + what + " " + path + ": " + std::strerror(errno), errno == ENOSPC};
}

/// Makes the file, or a folder's entries, durable.
void sync(const std::string& path) {
  const int file = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && ::fsync(file) == 0;
  if (file >= 0) ::close(file);
  if (!done) throw failed("write", path);
}

/// The file of an unfinished backup, which is removed with the object.
struct Part {
  explicit Part(std::string name) : path(std::move(name)) {
    remove();
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) throw failed("make", path);
    ::close(file);
  }
  ~Part() { remove(); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  void remove() const {
    for (const char* end : {"", "-journal", "-wal", "-shm"}) ::unlink((path + end).c_str());
  }
  const std::string path;
};

}  // namespace

namespace sqlite {

BackUp back_up(const std::string& url, const std::string& file) {
  const std::string path = path_of(url);
  std::error_code same;
  if (std::filesystem::equivalent(path, file, same)) throw StoreError(file + " is the store itself", false);
  const Part part(file + ".part");
  BackUp made;
  try {
    constexpr int patience = 60'000;  // ms
    SQLite::Database source(path, SQLite::OPEN_READWRITE, patience);
    source.exec("PRAGMA query_only = ON");
    SQLite::Database copy(part.path, SQLite::OPEN_READWRITE, patience);
    copy.exec("PRAGMA synchronous = OFF");  // synchronized below, as a whole
    {
      // All pages in one step are one transaction: with several the copy would begin again after each commit.
      SQLite::Backup backup(copy, source);
      while (backup.executeStep(-1) != SQLITE_DONE) ::usleep(10'000);
    }
    SQLite::Statement jobs(copy, "SELECT sum(jobs) FROM job_counts");
    if (jobs.executeStep()) made.jobs = static_cast<std::size_t>(jobs.getColumn(0).getInt64());
  } catch (const SQLite::Exception& error) {
    throw StoreError("the backup of " + path + " failed: " + error.what(), error.getErrorCode() == SQLITE_FULL);
  }
  sync(part.path);
  made.bytes = static_cast<std::size_t>(std::filesystem::file_size(part.path));
  if (std::rename(part.path.c_str(), file.c_str()) != 0) throw failed("make", file);
  sync(std::filesystem::path(file).parent_path().string());
  return made;
}

std::vector<std::string> inspect(const std::string& url) {
  SqliteConnection connection(path_of(url), false);
  std::vector<std::string> faults;
  {
    Query pages = connection.query("PRAGMA integrity_check");
    while (pages.step())
      if (pages.text(0) != "ok") faults.push_back(pages.text(0));
  }
  if (!faults.empty()) return faults;
  const int known = static_cast<int>(migrations().size());
  int version = connection.query("PRAGMA user_version").one_int();
  bool usable = version >= known;
  try {
    version = sqlite_version(connection);
  } catch (const StoreError&) {
    usable = false;
  }
  if (!usable) {
    faults.push_back("the schema has version " + std::to_string(version) + ", this program has " +
                     std::to_string(known) + ": what jobs need is not checked");
    return faults;
  }
  const auto none = [&](const char* sql, const std::string& fault) {
    if (const int count = connection.query(sql).one_int(); count > 0)
      faults.push_back(std::to_string(count) + " " + fault);
  };
  connection.execute("BEGIN");  // all questions about one moment
  none("SELECT count(*) FROM jobs WHERE seq NOT IN (SELECT seq FROM specs)", "jobs without their document");
  none("SELECT count(*) FROM jobs WHERE state = 'succeeded' AND seq NOT IN (SELECT seq FROM results)",
       "succeeded jobs without a result");
  none(
      "SELECT count(*) FROM results WHERE row_count <> (SELECT coalesce(sum(chunks.row_count), 0) FROM chunks "
      "WHERE chunks.seq = results.seq) AND columns IS NOT NULL",
      "results whose setpoints are not complete");
  none(
      "SELECT count(*) FROM job_counts WHERE jobs <> (SELECT count(*) FROM jobs WHERE jobs.state = job_counts.state "
      "AND coalesce(jobs.owner, '') = job_counts.owner)",
      "states whose jobs are counted wrongly");
  connection.execute("COMMIT");
  return faults;
}

}  // namespace sqlite
}  // namespace bahnwerk::server
