#include "core/contour/dxf/read/binary.hpp"

#include <bit>
#include <charconv>
#include <cstdint>

#include "core/base/progress_scope.hpp"
#include "core/contour/dxf/read/tags.hpp"

namespace bahnwerk {
namespace {

constexpr std::string_view sentinel("AutoCAD Binary DXF\r\n\x1A\0", 22);

enum class Value { text, real, int16, int32, int64, byte, chunk };

/// Returns the type of a value by its group code (DXF reference, "Group code value types").
Value value_of(int code) {
  const auto within = [&](int first, int last) { return code >= first && code <= last; };
  if (within(10, 59) || within(110, 149) || within(210, 239) || within(460, 469) || within(1010, 1059))
    return Value::real;
  if (within(60, 79) || within(170, 179) || within(270, 289) || within(370, 389) || within(400, 409) ||
      within(1060, 1070))
    return Value::int16;
  if (within(90, 99) || within(420, 429) || within(440, 459) || code == 1071) return Value::int32;
  if (within(160, 169)) return Value::int64;
  if (within(290, 299)) return Value::byte;
  if (within(310, 319) || code == 1004) return Value::chunk;
  return Value::text;
}

class BinaryReading {
 public:
  BinaryReading(std::string_view bytes, Progress progress) : bytes_(bytes), progress_(progress.part(0, 0), "reading") {}

  std::string ascii() {
    at_ = sentinel.size();
    const auto first = at_ + 1 < bytes_.size() ? number(2) : 0xFFFF;
    at_ = sentinel.size();
    // "0 SECTION", or a comment: 0 and S are the first two bytes of a file with short codes.
    short_ = (first & 0xFF) == 0 && first != 0;
    if (!short_ && first != 0 && first != 999) refuse("this is a binary DXF file that does not begin with a section");
    text_.reserve(2 * bytes_.size());
    bool ended = false;
    while (!ended && at_ < bytes_.size()) {
      progress_.work();
      const int code = group_code();
      put(code);
      if (const Value kind = value_of(code); kind == Value::text)
        ended = string() && code == 0;
      else
        value(kind);
      text_ += '\n';
      lines_ += 2;
    }
    return std::move(text_);
  }

 private:
  [[noreturn]] void refuse(const char* what) { refuse_dxf(lines_ + 1, what); }

  std::uint64_t number(std::size_t size) {
    if (bytes_.size() - at_ < size) refuse("this is a binary DXF file that is cut off");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[at_ + i])) << (8 * i);
    at_ += size;
    return value;
  }

  int group_code() {
    if (!short_) return static_cast<int>(number(2));
    constexpr int escape = 255;  // a code of two bytes follows: extended data
    const int code = static_cast<int>(number(1));
    return code == escape ? static_cast<int>(number(2)) : code;
  }

  template <class T>
  void write(T value) {
    char digits[40];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    text_.append(digits, end);
  }
  void put(int code) {
    write(code);
    text_ += '\n';
  }

  void value(Value kind) {
    switch (kind) {
      case Value::real:
        return write(std::bit_cast<double>(number(8)));
      case Value::int16:
        return write(static_cast<std::int16_t>(number(2)));
      case Value::int32:
        return write(static_cast<std::int32_t>(number(4)));
      case Value::int64:
        return write(static_cast<std::int64_t>(number(8)));
      case Value::byte:
        return write(static_cast<int>(number(1)));
      default: {
        const auto size = static_cast<std::size_t>(number(1));
        if (bytes_.size() - at_ < size) refuse("this is a binary DXF file that is cut off");
        at_ += size;
      }
    }
  }

  /// Reads up to the next zero; returns whether the text is EOF.
  bool string() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string_view::npos) refuse("this is a binary DXF file that is cut off");
    const std::string_view value = bytes_.substr(at_, end - at_);
    for (const char c : value) text_ += c == '\n' || c == '\r' ? ' ' : c;
    at_ = end + 1;
    return value == "EOF";
  }

  std::string_view bytes_;
  ProgressScope progress_;
  std::string text_;
  std::size_t at_ = 0, lines_ = 0;
  bool short_ = false;
};

}  // namespace

bool dxf_is_binary(std::string_view bytes) { return bytes.substr(0, sentinel.size()) == sentinel; }

std::string dxf_ascii(std::string_view bytes, Progress progress) { return BinaryReading(bytes, progress).ascii(); }

}  // namespace bahnwerk
