#pragma once
/// Numbers with an exponent, as generators in C, Python or JavaScript print tiny ones: X1.42109e-14. RS274NGC has none,
/// and printers write words E behind others without a blank: X10E0.5.
#include <cstddef>
#include <string_view>

namespace bahnwerk::gcode {

/// The reading of an e or E behind a number.
enum class ExponentReading {
  word,      ///< a separate word E
  exponent,  ///< part of the number
  unclear,   ///< the text is ambiguous
};

/// Classifies e or E behind a number. `mantissa` are the digits and the point before it, `rest` the text from e or E to
/// the end of the line; `capital` says whether the letter of the word is a capital one; `size` becomes the length of
/// the exponent, e included.
///
/// It is a word E if its number has a point or no digit. It is an exponent if its e differs in case from the word's
/// letter (X…e…), or if sign, two digits and one digit before the mantissa's point show the output of a formatter.
/// Otherwise it is ambiguous. O(length of the number).
ExponentReading exponent_reading(std::string_view mantissa, std::string_view rest, bool capital, std::size_t& size);

/// Returns the length of an exponent (e-14, E+3, e5) at the beginning of `rest`, where only a number can be; 0 if there
/// is none.
std::size_t exponent_size(std::string_view rest);

}  // namespace bahnwerk::gcode
