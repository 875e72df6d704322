#include "api/text/base64.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace bahnwerk::api {
namespace {

constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int, 256> values = [] {
  std::array<int, 256> list{};
  list.fill(-1);
  for (std::size_t i = 0; i < alphabet.size(); ++i) list[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
  return list;
}();

}  // namespace

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? alphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t group = 0;
  std::size_t count = 0, padding = 0;
  for (const char c : text) {
    if (c == '\n' || c == '\r') continue;
    if (c == '=' && count % 4 >= 2 && padding < 2) {
      ++padding;
      continue;
    }
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0 || padding > 0) return std::nullopt;
    group = group << 6 | static_cast<std::uint32_t>(value);
    if (++count % 4 != 0) continue;
    for (int shift = 16; shift >= 0; shift -= 8) bytes += static_cast<char>(group >> shift & 255);
    group = 0;
  }
  const std::size_t rest = count % 4;
  if (rest == 1) return std::nullopt;
  if (rest >= 2) bytes += static_cast<char>(group << (rest == 2 ? 12 : 6) >> 16 & 255);
  if (rest == 3) bytes += static_cast<char>(group << 6 >> 8 & 255);
  return bytes;
}

}  // namespace bahnwerk::api
