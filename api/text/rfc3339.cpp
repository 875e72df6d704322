#include "api/text/rfc3339.hpp"

#include <chrono>
#include <cstdio>

namespace bahnwerk::api {
namespace {

/// Reads exactly `digits` digits from the front.
bool take_number(std::string_view& text, std::size_t digits, int& value) {
  if (text.size() < digits) return false;
  value = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return false;
    value = 10 * value + (text[i] - '0');
  }
  text.remove_prefix(digits);
  return true;
}

bool take_char(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == any_of.npos) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::string rfc3339(std::int64_t ms) {
  using namespace std::chrono;
  const sys_time<milliseconds> time{milliseconds(ms)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()), static_cast<int>(clock.subseconds().count()));
  return text;
}

std::optional<std::int64_t> parse_rfc3339(std::string_view text) {
  using namespace std::chrono;
  int y, mo, d, h, mi, s;
  if (!take_number(text, 4, y) || !take_char(text, "-") || !take_number(text, 2, mo) || !take_char(text, "-") ||
      !take_number(text, 2, d) || !take_char(text, "Tt ") || !take_number(text, 2, h) || !take_char(text, ":") ||
      !take_number(text, 2, mi) || !take_char(text, ":") || !take_number(text, 2, s))
    return std::nullopt;
  int ms = 0;
  if (take_char(text, ".")) {
    int digit, weight = 100;
    if (!take_number(text, 1, digit)) return std::nullopt;
    do {
      ms += weight * digit;
      weight /= 10;  // digits below a millisecond are cut off
    } while (take_number(text, 1, digit));
  }
  int offset = 0;
  if (!take_char(text, "Zz")) {
    const bool west = !text.empty() && text.front() == '-';
    int oh, om;
    if (!take_char(text, "+-") || !take_number(text, 2, oh) || !take_char(text, ":") || !take_number(text, 2, om) ||
        oh > 23 || om > 59)
      return std::nullopt;
    offset = (west ? -1 : 1) * (60 * oh + om);
  }
  const year_month_day date(year(y), month(static_cast<unsigned>(mo)), day(static_cast<unsigned>(d)));
  if (!text.empty() || !date.ok() || h > 23 || mi > 59 || s > 60) return std::nullopt;  // 60: a leap second
  const auto time = sys_days(date) + hours(h) + minutes(mi) + seconds(s) + milliseconds(ms) - minutes(offset);
  return milliseconds(time.time_since_epoch()).count();
}

}  // namespace bahnwerk::api
