#pragma once
/// Numbers in messages: rounded, but never so far that a comparison seems to be false.
#include <cstdio>
#include <string>

namespace bahnwerk {

/// Returns `value` with `digits` significant digits.
inline std::string number_text(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// Returns `value` with `digits` significant digits, or with as many more as distinguish it from `other`, the number
/// with which a message compares it.
inline std::string number_text(double value, double other, int digits) {
  while (value != other && digits < 17 && number_text(value, digits) == number_text(other, digits)) ++digits;
  return number_text(value, digits);
}

}  // namespace bahnwerk
