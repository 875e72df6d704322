#include "core/contour/gcode/words/number_exponent.hpp"

namespace bahnwerk::gcode {
namespace {

bool digit(std::string_view text, std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; }

}  // namespace

std::size_t exponent_size(std::string_view rest) {
  if (rest.empty() || (rest[0] != 'e' && rest[0] != 'E')) return 0;
  std::size_t at = 1;
  if (at < rest.size() && (rest[at] == '+' || rest[at] == '-')) ++at;
  if (!digit(rest, at)) return 0;
  while (digit(rest, at)) ++at;
  return at < rest.size() && rest[at] == '.' ? 0 : at;
}

ExponentReading exponent_reading(std::string_view mantissa, std::string_view rest, bool capital, std::size_t& size) {
  size = exponent_size(rest);
  if (size == 0) return ExponentReading::word;
  if (capital != (rest[0] == 'E')) return ExponentReading::exponent;
  const bool sign = !digit(rest, 1);
  if (!sign || size < 4) return ExponentReading::unclear;  // a formatter writes a sign and two digits at least
  const std::size_t point = mantissa.find('.');
  const bool formatted = point == 1 && mantissa.size() > 3;                    // 1.42E-14; Fortran: 0.142E-13
  const bool padded = rest[2] == '0' && (point == 1 || mantissa.size() == 1);  // 2.5E-07, 1E-05
  return formatted || padded ? ExponentReading::exponent : ExponentReading::unclear;
}

}  // namespace bahnwerk::gcode
