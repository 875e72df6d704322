#pragma once
/// Structured log: one JSON object per line on stderr, {"time","level","event",…fields}.
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace bahnwerk::server::log {

/// A field's value: a truth value, a number or a text.
class Value {
 public:
  Value(bool value) : value_(value) {}
  Value(std::floating_point auto value) : value_(static_cast<double>(value)) {}
  Value(std::signed_integral auto value) : value_(static_cast<std::int64_t>(value)) {}
  Value(std::unsigned_integral auto value) : value_(static_cast<std::uint64_t>(value)) {}
  Value(std::string value) : value_(std::move(value)) {}
  Value(std::string_view value) : value_(std::string(value)) {}
  Value(const char* value) : value_(std::string(value)) {}
  const auto& variant() const { return value_; }

 private:
  std::variant<bool, double, std::int64_t, std::uint64_t, std::string> value_;
};
struct Field {
  std::string_view name;
  Value value;
};
using Fields = std::vector<Field>;

enum class Level { debug, info, warn, error };
void set_level(Level level);
void write(Level level, std::string_view event, const Fields& fields = {});

/// Writes a line that no level suppresses: who changed what.
void audit(const Fields& fields);

inline void info(std::string_view event, const Fields& fields = {}) { write(Level::info, event, fields); }
inline void warn(std::string_view event, const Fields& fields = {}) { write(Level::warn, event, fields); }
inline void error(std::string_view event, const Fields& fields = {}) { write(Level::error, event, fields); }

}  // namespace bahnwerk::server::log
