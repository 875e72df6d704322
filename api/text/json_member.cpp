#include "api/text/json_member.hpp"

#include <algorithm>
#include <utility>

namespace bahnwerk::api {
namespace {

void append_utf8(unsigned code, std::string& out) {
  const auto byte = [&out](unsigned value) { out += static_cast<char>(static_cast<unsigned char>(value)); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    byte(0xE0 | code >> 12);
    byte(0x80 | (code >> 6 & 0x3F));
  } else {
    byte(0xF0 | code >> 18);
    byte(0x80 | (code >> 12 & 0x3F));
    byte(0x80 | (code >> 6 & 0x3F));
  }
  byte(0x80 | (code & 0x3F));
}

unsigned hexadecimal(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  return static_cast<unsigned>((c | 0x20) - 'a' + 10);
}

}  // namespace

JsonMember::JsonMember(std::vector<std::string> path) : path_(std::move(path)) {}

void JsonMember::take(std::string_view piece, std::string& out) {
  for (std::size_t at = 0; at < piece.size() && !ended_;) {
    if (inside_ != Inside::nothing) {
      at = take_string(piece, at, inside_ == Inside::member ? out : key_);
      continue;
    }
    const char c = piece[at++];
    if (c != '"') {
      structural(c);
      continue;
    }
    key_.clear();
    if (key_next_) {
      inside_ = Inside::key;
    } else if (here_ && matched_ + 1 == path_.size()) {
      inside_ = Inside::member;
      found_ = true;
    } else {
      inside_ = Inside::other_string;
    }
    key_next_ = here_ = false;
  }
}

void JsonMember::structural(char c) {
  const bool innermost = depth_ == matched_ + 1;  // the innermost open value is the object at the path so far
  switch (c) {
    case '{':
      if (here_ && matched_ + 1 < path_.size()) {
        ++matched_;
        key_next_ = true;
      } else {
        key_next_ = depth_ == 0;
      }
      here_ = false;
      ++depth_;
      break;
    case '[':
      here_ = false;
      ++depth_;
      break;
    case '}':
    case ']':
      if (innermost && matched_ > 0) --matched_;
      key_next_ = false;
      --depth_;
      break;
    case ',':
      key_next_ = innermost;
      here_ = false;
      break;
    default:  // a colon, blanks, and the characters of numbers and words
      break;
  }
}

/// Takes a string from `at` on, to its end or that of the piece; returns the place behind it.
std::size_t JsonMember::take_string(std::string_view piece, std::size_t at, std::string& out) {
  while (at < piece.size()) {
    if (escape_ >= 0) {
      escaped(piece[at++], out);
      continue;
    }
    const std::size_t end = std::min(piece.find_first_of("\"\\", at), piece.size());
    if (inside_ != Inside::other_string) out.append(piece, at, end - at);
    at = end;
    if (at == piece.size()) break;
    if (piece[at++] == '\\') {
      escape_ = 0;
      continue;
    }
    end_string();
    break;
  }
  return at;
}

void JsonMember::escaped(char c, std::string& out) {
  if (escape_ > 0) {
    unit_ = unit_ << 4 | hexadecimal(c);
    if (--escape_ > 0) return;
    escape_ = -1;
    return code_unit(unit_, out);
  }
  if (c == 'u') {
    escape_ = 4;
    unit_ = 0;
    return;
  }
  escape_ = -1;
  constexpr std::string_view names = "bfnrt", values = "\b\f\n\r\t";
  const std::size_t named = names.find(c);
  out += named == std::string_view::npos ? c : values[named];
}

/// Takes a UTF-16 code unit; a character beyond U+FFFF comes as two of them.
void JsonMember::code_unit(unsigned unit, std::string& out) {
  if (unit >= 0xD800 && unit < 0xDC00) {
    high_ = unit;
    return;
  }
  if (unit >= 0xDC00 && unit < 0xE000) unit = 0x10000 + ((high_ - 0xD800) << 10) + (unit - 0xDC00);
  append_utf8(unit, out);
}

void JsonMember::end_string() {
  if (inside_ == Inside::member) ended_ = true;
  if (inside_ == Inside::key) here_ = key_ == path_[matched_];
  inside_ = Inside::nothing;
}

}  // namespace bahnwerk::api
