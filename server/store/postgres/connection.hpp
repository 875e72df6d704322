#pragma once
/// A connection to a PostgreSQL server, by libpq's asynchronous calls: each call ends at its deadline, whatever the
/// server does. After a deadline, or where the server has gone, the connection is broken and what the call did is
/// unknown.
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/store/values.hpp"

struct pg_conn;
struct pg_result;

namespace bahnwerk::server {

/// The server cannot be reached, or did not answer in time: whether the call was carried out is unknown.
struct StoreAway : StoreError {
  explicit StoreAway(const std::string& what) : StoreError(what, false, true) {}
};

/// Two transactions were in each other's way (SQLSTATE 40001, 40P01): the call had no effect and may be repeated.
struct StoreConflict : StoreError {
  explicit StoreConflict(const std::string& what) : StoreError(what, false, true) {}
};

/// Values of a statement's parameters in the binary form of the protocol, in order.
class PostgresParameters {
 public:
  PostgresParameters& operator<<(std::int64_t value);
  PostgresParameters& operator<<(double value);
  PostgresParameters& operator<<(bool value);
  /// Bytes that are no UTF-8, and U+0000, become question marks: the server has no place for them.
  PostgresParameters& operator<<(std::string_view text);
  PostgresParameters& operator<<(const std::string& text) { return *this << std::string_view(text); }
  PostgresParameters& operator<<(const char* text) { return *this << std::string_view(text); }
  PostgresParameters& operator<<(const std::optional<std::string>& text);
  PostgresParameters& operator<<(std::optional<std::int64_t> value);
  PostgresParameters& operator<<(std::optional<double> value);
  PostgresParameters& bytes(std::string_view bytes);  ///< not copied
  PostgresParameters& bytes(const std::string& value) { return bytes(std::string_view(value)); }
  PostgresParameters& bytes(const std::optional<std::string>& bytes);  ///< not copied
  PostgresParameters& uuid(std::string_view text);                     ///< NULL where the text is no UUID
  PostgresParameters& uuid(const std::string& text) { return uuid(std::string_view(text)); }
  PostgresParameters& uuid(const std::optional<std::string>& text);
  PostgresParameters& time(std::optional<std::int64_t> ms);  ///< ms since 1970 UTC; the largest: infinity
  PostgresParameters& uuids(const std::vector<std::string>& texts);
  PostgresParameters& integers(const std::vector<std::int64_t>& values);
  PostgresParameters& numbers(const std::vector<double>& values);
  PostgresParameters& texts(const std::optional<std::vector<std::string>>& texts);

 private:
  friend class PostgresConnection;
  struct Value {
    unsigned type = 0;
    std::optional<std::string> own = {};  ///< nullopt: NULL, or bytes that are not copied
    const char* shared = nullptr;
    std::size_t size = 0;
  };
  PostgresParameters& add(unsigned type, std::optional<std::string> bytes);
  std::vector<Value> values_;
};

/// Rows that a statement has returned.
class PostgresRows {
 public:
  PostgresRows() = default;
  explicit PostgresRows(pg_result* result);
  std::size_t size() const;
  bool empty() const { return size() == 0; }
  std::size_t changed() const;  ///< rows that the statement inserted, updated or deleted
  bool null(std::size_t row, int column) const;
  std::int64_t integer(std::size_t row, int column) const;  ///< also of smaller integers and booleans
  bool flag(std::size_t row, int column) const { return integer(row, column) != 0; }
  double number(std::size_t row, int column) const;
  std::string_view bytes(std::size_t row, int column) const;  ///< valid as long as this object
  std::string text(std::size_t row, int column) const { return std::string(bytes(row, column)); }
  std::string uuid(std::size_t row, int column) const;
  std::int64_t time(std::size_t row, int column) const;  ///< ms since 1970 UTC; infinity is the largest
  std::vector<std::string> texts(std::size_t row, int column) const;
  std::optional<std::string> optional_text(std::size_t row, int column) const;
  std::optional<std::int64_t> optional_integer(std::size_t row, int column) const;
  std::optional<double> optional_number(std::size_t row, int column) const;
  std::optional<std::int64_t> optional_time(std::size_t row, int column) const;

 private:
  std::shared_ptr<pg_result> result_;
};

struct PostgresStatement {
  std::string_view sql;  ///< the same statement has the same text, so that it is prepared once
  PostgresParameters parameters = {};
};

/// Longest times of calls: those of single rows, and those of pieces of setpoints and of many rows.
struct PostgresPatience {
  std::chrono::milliseconds brief{2'000}, lengthy{30'000};
};

class PostgresConnection {
 public:
  /// Connects. Throws StoreAway, or StoreError where the server refuses (password, database); no message has the
  /// password.
  explicit PostgresConnection(const std::string& url, PostgresPatience patience = {});
  ~PostgresConnection();
  PostgresConnection(const PostgresConnection&) = delete;
  PostgresConnection& operator=(const PostgresConnection&) = delete;

  /// Runs a prepared statement; outside of begin() and commit() it is a transaction.
  PostgresRows run(std::string_view sql, const PostgresParameters& parameters = {});
  PostgresRows run_lengthy(std::string_view sql, const PostgresParameters& parameters = {});
  /// Sends all statements at once (pipeline mode); outside of begin() and commit() they are one transaction.
  std::vector<PostgresRows> run_all(const std::vector<PostgresStatement>& statements);
  void script(const std::string& sql);  ///< several statements without parameters
  void begin() { script("BEGIN"); }
  void commit() { script("COMMIT"); }
  void rollback() noexcept;  ///< ends an open transaction, if any

  bool broken() const;  ///< whether a call has failed in a way after which the connection is of no use
  bool idle();          ///< whether it can take a call: unbroken, without a transaction, not closed by the server
  std::chrono::steady_clock::time_point since() const { return since_; }  ///< when it was made

 private:
  using Time = std::chrono::steady_clock::time_point;
  std::vector<PostgresRows> send(const std::vector<PostgresStatement>& statements, Time until);
  void wait(Time until);
  pg_result* next(Time until);
  [[noreturn]] void lose(const std::string& why);
  void check(pg_result* result);

  const PostgresPatience patience_;
  pg_conn* connection_ = nullptr;
  Time since_;
  std::vector<std::pair<std::string, std::string>> prepared_;  ///< text and name
};

}  // namespace bahnwerk::server
