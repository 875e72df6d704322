#pragma once
/// Numbers with an exponent, as generators in C, Python or JavaScript print tiny ones: X1.42109e-14. RS274NGC has none,
/// and printers write words E behind others without a blank: X10E0.5.
#include <cstddef>
#include <string_view>

namespace bahnwerk::gcode {

enum class ExponentReading {
  word,      ///< a word E of its own
  exponent,  ///< part of the number
  unclear,   ///< either
};

/// What e or E behind a number is. `mantissa`: the digits and the point before it. `rest`: from e or E on, to the end
/// of the line. `capital`: whether the letter of the word is a capital one. `size`: length of the exponent, e included.
///
/// An E word when its number has a point or no digit. An exponent where its e is not written as the word's letter is
/// (X…e…), or where sign, two digits and one digit before the mantissa's point tell the output of a formatter.
/// Otherwise unclear. O(length of the number).
ExponentReading exponent_reading(std::string_view mantissa, std::string_view rest, bool capital, std::size_t& size);

/// Length of an exponent (e-14, E+3, e5) at the begin of `rest`, where nothing but a number can stand; 0: there is
/// none.
std::size_t exponent_size(std::string_view rest);

}  // namespace bahnwerk::gcode
