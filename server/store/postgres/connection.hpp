#pragma once
/// A connection to a PostgreSQL server, by libpq's asynchronous calls: each call ends at its deadline, whatever the
/// server does. After a deadline, or where the server has gone, the connection is broken and what the call did is
/// unknown.
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/store/postgres/binary_values.hpp"
#include "server/store/values.hpp"

struct pg_conn;
struct pg_result;

namespace bahnwerk::server {

/// The server refuses this user, password or database, or the store is too new for the program: it stays away until
/// somebody changes that.
struct StoreRefused : StoreAway {
  using StoreAway::StoreAway;
};

/// Two transactions were in each other's way (SQLSTATE 40001, 40P01): the call had no effect and may be repeated.
struct StoreConflict : StoreError {
  explicit StoreConflict(const std::string& what) : StoreError(what, false, true) {}
};

struct PostgresStatement {
  std::string_view sql;  ///< the same statement has the same text, so that it is prepared once
  PostgresParameters parameters = {};
};

/// Longest times of calls: those of single rows, and those of pieces of setpoints and of many rows. And the longest
/// time between answers after which this process or the server may have stood still; a process asks each second.
struct PostgresPatience {
  std::chrono::milliseconds brief{2'000}, lengthy{30'000}, silence{5'000};
};

/// Whether a connection has a session of the server to itself. A pooler gives each transaction another one: then
/// nothing is prepared, and each transaction sets what a session would keep.
enum class PostgresSession { own, pooled };

class PostgresConnection {
 public:
  /// The least version of a server that is used, in its own form: 150000 is 15.0.
  static constexpr int least_version = 150'000;

  /// Connects to the first server of the URL that answers, each of which has its share of the time: one that stands
  /// still does not keep from the next. Where one that can be written is asked for and there is none, it is one that
  /// can be read (stopgap()). Throws StoreAway, or StoreRefused where waiting does not help with any of them (password,
  /// database, version); no message has the password.
  explicit PostgresConnection(const std::string& url, PostgresPatience patience = {},
                              PostgresSession session = PostgresSession::own);
  ~PostgresConnection();
  PostgresConnection(const PostgresConnection&) = delete;
  PostgresConnection& operator=(const PostgresConnection&) = delete;

  /// Runs a prepared statement; outside of begin() and commit() it is a transaction.
  PostgresRows run(std::string_view sql, const PostgresParameters& parameters = {});
  PostgresRows run_lengthy(std::string_view sql, const PostgresParameters& parameters = {});
  /// Sends all statements at once (pipeline mode); outside of begin() and commit() they are one transaction.
  std::vector<PostgresRows> run_all(const std::vector<PostgresStatement>& statements);
  std::vector<PostgresRows> run_all_lengthy(const std::vector<PostgresStatement>& statements);
  void script(const std::string& sql);  ///< several statements without parameters
  void begin();
  void commit() { script("COMMIT"); }  ///< may take as long as a lengthy call
  void commit_briefly();               ///< after brief calls
  void rollback() noexcept;            ///< ends an open transaction, if any

  /// Returns another connection of the kind, with a patience of its own.
  std::unique_ptr<PostgresConnection> another(PostgresPatience patience) const;
  /// Lets the server work and wait as long as it wants for what is outside of transactions.
  void without_timeouts();

  /// Waits until the server has sent signals of a channel that was listened to, the descriptor `wake` can be read, or
  /// the time is over; returns the contents of the signals.
  std::vector<std::string> wait_for_signals(int wake, std::chrono::steady_clock::time_point until);

  /// Returns whether the server can only be read, as it has said last.
  bool read_only() const;
  /// Returns whether one that can be written was asked for, and this one can only be read.
  bool stopgap() const { return wants_to_write_ && read_only(); }
  bool broken() const;  ///< whether a call has failed in a way after which the connection is of no use
  bool idle();          ///< whether it can take a call: unbroken, without a transaction, not closed by the server
  std::chrono::steady_clock::time_point since() const { return since_; }  ///< when it was made
  bool used() const { return used_; }  ///< whether use() was called: what has to be done once over each has been done
  void use() { used_ = true; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  void connect(const std::string& server, Time until);
  void script(const std::string& sql, Time until);
  std::vector<PostgresRows> send(const std::vector<PostgresStatement>& statements, Time until);
  std::vector<PostgresRows> exchange(const std::vector<const PostgresStatement*>& statements, Time until);
  void note(const PostgresRows& start);
  void wait(Time until);
  pg_result* next(Time until);
  [[noreturn]] void lose(const std::string& why);
  void check(pg_result* result);

  const std::string url_;
  const PostgresPatience patience_;
  const PostgresSession session_;
  pg_conn* connection_ = nullptr;
  Time since_;
  bool used_ = false;
  std::vector<std::pair<std::string, std::string>> prepared_;  ///< text and name
  bool wants_to_write_ = false;
  bool read_only_ = false;                    ///< of a pooled session, as its last transaction found
  std::optional<std::int64_t> server_start_;  ///< the same
};

}  // namespace bahnwerk::server
