#pragma once
/// Classes of characters in a part program, independent of the locale.

namespace bahnwerk::gcode {

inline bool blank(char c) { return c == ' ' || c == '\t'; }
inline bool end_of_line(char c) { return c == '\n' || c == '\r'; }
inline bool part_of_number(char c) { return (c >= '0' && c <= '9') || c == '.'; }
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
inline char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

}  // namespace bahnwerk::gcode
