#pragma once
/// A PostgreSQL server of the test program, in a folder of its own and on a socket there, which ends with the program;
/// and databases in it. Made from Debian's package; where that is missing, tests of the store are skipped.
#include <gtest/gtest.h>
#include <libpq-fe.h>
#include <pwd.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "fixture.hpp"
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {

class PostgresServer {
 public:
  /// Returns the folder of the server's programs; empty: there is none.
  static std::filesystem::path programs() {
    std::filesystem::path best;
    std::error_code none;
    for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", none))
      if (std::filesystem::exists(version.path() / "bin" / "initdb")) best = std::max(best, version.path() / "bin");
    return best;
  }
  static bool missing() { return programs().empty(); }

  /// Returns the one server of the program, begun by the first call.
  static PostgresServer& one() {
    static PostgresServer server;
    return server;
  }

  /// Makes a database that has the store's schema, and returns its URL.
  std::string make_database() {
    const std::string name = "test" + std::to_string(++databases_);
    query("postgres", "CREATE DATABASE " + name + " TEMPLATE made");
    return url(name);
  }
  void drop_database(const std::string& url) {
    const std::size_t begin = url.rfind("dbname=") + 7;
    query("postgres", "DROP DATABASE " + url.substr(begin, url.find('&', begin) - begin) + " WITH (FORCE)");
  }
  /// Runs statements as the database's owner; returns the first value.
  static std::string run(const std::string& url, const std::string& sql) {
    const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectdb(url.c_str()), PQfinish);
    const std::unique_ptr<PGresult, decltype(&PQclear)> result(PQexec(connection.get(), sql.c_str()), PQclear);
    const auto status = PQresultStatus(result.get());
    if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK)
      throw std::runtime_error(std::string(PQerrorMessage(connection.get())) + " in " + sql);
    return PQntuples(result.get()) > 0 ? PQgetvalue(result.get(), 0, 0) : "";
  }
  std::string url(const std::string& database) const {
    return "postgresql://postgres@/?host=" + folder_.path.string() + "&dbname=" + database;
  }

 private:
  PostgresServer() {
    // The server refuses to be root's.
    if (getuid() == 0) {
      const passwd* const nobody = getpwnam("nobody");
      user_ = nobody->pw_uid;
      group_ = nobody->pw_gid;
      if (chown(folder_.path.c_str(), user_, group_) != 0) throw std::runtime_error("chown");
    }
    const std::string data = (folder_.path / "data").string(), log = (folder_.path / "log").string();
    const pid_t made = start({"initdb", "-D", data, "-U", "postgres", "-A", "trust", "-E", "UTF8", "--locale=C.UTF-8",
                              "--no-sync", "--no-instructions"});
    int status = 0;
    if (waitpid(made, &status, 0) != made || status != 0) throw std::runtime_error("initdb failed; see " + log);
    server_ = start({"postgres", "-D", data, "-k", folder_.path.string(), "-c", "listen_addresses=", "-c", "fsync=off",
                     "-c", "max_connections=200", "-c", "shared_buffers=32MB"});
    for (;;) {  // as long as it lives
      try {
        run(url("postgres"), "SELECT 1");
        break;
      } catch (const std::exception& error) {
        if (waitpid(server_, &status, WNOHANG) == server_)
          throw std::runtime_error("no server: " + std::string(error.what()));
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    }
    query("postgres", "CREATE DATABASE made");
    PostgresStore(PostgresOptions{.url = url("made"), .patience = patient()});
  }
  ~PostgresServer() {
    kill(server_, SIGQUIT);
    waitpid(server_, nullptr, 0);
  }
  void query(const std::string& database, const std::string& sql) const { run(url(database), sql); }

  pid_t start(std::vector<std::string> words) const {
    const std::string program = (programs() / words[0]).string(), log = (folder_.path / "log").string();
    const pid_t child = fork();
    if (child != 0) return child;
    if (user_ != 0 && (setgid(group_) != 0 || setuid(user_) != 0)) _exit(126);
    prctl(PR_SET_PDEATHSIG, SIGQUIT);
    if (!freopen(log.c_str(), "a", stdout) || !freopen(log.c_str(), "a", stderr) || chdir(folder_.path.c_str()) != 0)
      _exit(126);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    _exit(127);
  }

  TempFolder folder_;
  uid_t user_ = 0;
  gid_t group_ = 0;
  pid_t server_ = 0;
  int databases_ = 0;

 public:
  /// No test's verdict depends on the machine's load.
  static PostgresPatience patient() {
    return {std::chrono::minutes(5), std::chrono::minutes(5), std::chrono::minutes(5)};
  }
};

}  // namespace bahnwerk::server
