#pragma once
/// Values that go to a PostgreSQL server and come back, in the binary form of its protocol.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct pg_result;

namespace bahnwerk::server {

/// Returns a text as the server can keep it: bytes that are no UTF-8, and U+0000, become question marks.
std::string storable(std::string_view text);

/// Values of a statement's parameters in the binary form of the protocol, in order.
class PostgresParameters {
 public:
  PostgresParameters& operator<<(std::int64_t value);
  PostgresParameters& operator<<(double value);
  PostgresParameters& operator<<(bool value);
  PostgresParameters& operator<<(std::string_view text);  ///< as storable() has it, as are all texts
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
  // Columns of rows, whose values may be missing.
  PostgresParameters& texts(const std::vector<std::optional<std::string>>& texts);
  PostgresParameters& numbers(const std::vector<std::optional<double>>& values);
  PostgresParameters& times(const std::vector<std::optional<std::int64_t>>& ms);
  PostgresParameters& bytes(const std::vector<std::optional<std::string_view>>& bytes);  ///< copied

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

}  // namespace bahnwerk::server
