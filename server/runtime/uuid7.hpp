#pragma once
/// UUID version 7 [RFC 9562, 5.7], strictly increasing within one generator: their text order is the order of creation.
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

namespace bahnwerk::server {

class Uuid7 {
 public:
  Uuid7();
  /// Returns the next identifier, greater than all earlier ones even when the clock stands still or steps back (then
  /// the time part runs ahead of `now_ms` as far as needed, RFC 9562 6.2 method 1 with a 12-bit counter). Not
  /// thread-safe.
  std::string next(std::int64_t now_ms);
  /// Makes all further identifiers greater than `id` (one of a previous process).
  void advance_past(std::string_view id);

 private:
  std::mt19937_64 random_;
  std::int64_t last_ms_ = 0;
  std::uint32_t counter_ = 0;
};

/// Returns the least identifier of that millisecond (0 to 2^48 − 1; times beyond are the nearest one).
std::string first_id(std::int64_t ms);

/// Returns a random identifier without order, for request ids.
std::string random_id();

}  // namespace bahnwerk::server
