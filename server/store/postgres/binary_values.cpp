#include "server/store/postgres/binary_values.hpp"

#include <libpq-fe.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace bahnwerk::server {
namespace {

// Types of values (pg_type.dat of PostgreSQL; they never change).
constexpr unsigned bool_type = 16, bytes_type = 17, int8_type = 20, text_type = 25, float8_type = 701, time_type = 1184,
                   uuid_type = 2950, int8s_type = 1016, texts_type = 1009, float8s_type = 1022, uuids_type = 2951,
                   bytes_array_type = 1001, times_type = 1185;
/// ms from 1970 to 2000, with which the server's time begins, and the last time that it has.
constexpr std::int64_t server_epoch = 946'684'800'000, last_time = 9'224'318'015'999'999;
constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

template <class Number>
void put(std::string& out, Number value) {
  for (int shift = 8 * (static_cast<int>(sizeof value) - 1); shift >= 0; shift -= 8)
    out += static_cast<char>(static_cast<std::uint64_t>(value) >> shift);
}
std::string big_endian(std::int64_t value) {
  std::string out;
  put(out, value);
  return out;
}
std::int64_t number_of(std::string_view bytes) {
  std::uint64_t value = !bytes.empty() && (bytes[0] & 0x80) != 0 ? ~std::uint64_t{0} : 0;
  for (const char c : bytes) value = (value << 8) | static_cast<unsigned char>(c);
  return static_cast<std::int64_t>(value);
}

std::optional<std::string> uuid_bytes(std::string_view text) {
  if (text.size() != 36) return std::nullopt;
  std::string out;
  int high = -1;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (k == 8 || k == 13 || k == 18 || k == 23) {
      if (c != '-') return std::nullopt;
      continue;
    }
    const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    if (digit < 0) return std::nullopt;
    if (high < 0) {
      high = digit;
    } else {
      out += static_cast<char>(high * 16 + digit);
      high = -1;
    }
  }
  return out;
}

/// Returns the bytes of the character that begins the text; 0 where it is no UTF-8 [RFC 3629, 4].
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0) == 0x80; };
  const unsigned first = byte(0), second = byte(1);
  if (first == 0) return 0;
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4 || !follows(1)) return 0;
  if (first < 0xE0) return 2;
  if (!follows(2) || (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
  if (first < 0xF0) return 3;
  return follows(3) && !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F) ? 4 : 0;
}

std::string time_bytes(std::int64_t ms) {
  const std::int64_t last = last_time / 1000;
  return big_endian(ms == never ? never : std::clamp(ms, -server_epoch, last) * 1000 - server_epoch * 1000);
}

/// An array of one dimension in binary form: dimensions, whether it has NULLs, type, length, lowest index; elements.
template <class Add>
std::string array_of(unsigned type, std::size_t size, Add&& add) {
  std::string out;
  put(out, std::int32_t{size == 0 ? 0 : 1});
  put(out, std::int32_t{1});
  put(out, static_cast<std::int32_t>(type));
  if (size == 0) return out;
  put(out, static_cast<std::int32_t>(size));
  put(out, std::int32_t{1});
  for (std::size_t k = 0; k < size; ++k) {
    const auto element = add(k);
    put(out, element ? static_cast<std::int32_t>(element->size()) : std::int32_t{-1});
    if (element) out += *element;
  }
  return out;
}

}  // namespace

std::string storable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0)
      out += '?';
    else
      out.append(text.substr(0, length));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

PostgresParameters& PostgresParameters::add(unsigned type, std::optional<std::string> bytes) {
  values_.push_back({.type = type, .own = std::move(bytes)});
  return *this;
}
PostgresParameters& PostgresParameters::operator<<(std::int64_t value) { return add(int8_type, big_endian(value)); }
PostgresParameters& PostgresParameters::operator<<(double value) {
  return add(float8_type, big_endian(std::bit_cast<std::int64_t>(value)));
}
PostgresParameters& PostgresParameters::operator<<(bool value) {
  return add(bool_type, std::string(1, value ? '\1' : '\0'));
}
PostgresParameters& PostgresParameters::operator<<(std::string_view text) { return add(text_type, storable(text)); }
PostgresParameters& PostgresParameters::operator<<(const std::optional<std::string>& text) {
  return add(text_type, text ? std::optional(storable(*text)) : std::nullopt);
}
PostgresParameters& PostgresParameters::operator<<(std::optional<std::int64_t> value) {
  return add(int8_type, value ? std::optional(big_endian(*value)) : std::nullopt);
}
PostgresParameters& PostgresParameters::operator<<(std::optional<double> value) {
  return value ? *this << *value : add(float8_type, std::nullopt);
}
PostgresParameters& PostgresParameters::bytes(std::string_view bytes) {
  values_.push_back({.type = bytes_type, .shared = bytes.data() ? bytes.data() : "", .size = bytes.size()});
  return *this;
}
PostgresParameters& PostgresParameters::bytes(const std::optional<std::string>& value) {
  return value ? bytes(std::string_view(*value)) : add(bytes_type, std::nullopt);
}
PostgresParameters& PostgresParameters::uuid(std::string_view text) { return add(uuid_type, uuid_bytes(text)); }
PostgresParameters& PostgresParameters::uuid(const std::optional<std::string>& text) {
  return add(uuid_type, text ? uuid_bytes(*text) : std::nullopt);
}
PostgresParameters& PostgresParameters::time(std::optional<std::int64_t> ms) {
  return add(time_type, ms ? std::optional(time_bytes(*ms)) : std::nullopt);
}
PostgresParameters& PostgresParameters::uuids(const std::vector<std::string>& texts) {
  return add(uuids_type, array_of(uuid_type, texts.size(), [&](std::size_t k) { return uuid_bytes(texts[k]); }));
}
PostgresParameters& PostgresParameters::integers(const std::vector<std::int64_t>& values) {
  return add(int8s_type,
             array_of(int8_type, values.size(), [&](std::size_t k) { return std::optional(big_endian(values[k])); }));
}
PostgresParameters& PostgresParameters::numbers(const std::vector<double>& values) {
  return add(float8s_type, array_of(float8_type, values.size(), [&](std::size_t k) {
               return std::optional(big_endian(std::bit_cast<std::int64_t>(values[k])));
             }));
}
PostgresParameters& PostgresParameters::texts(const std::optional<std::vector<std::string>>& texts) {
  if (!texts) return add(texts_type, std::nullopt);
  return add(texts_type,
             array_of(text_type, texts->size(), [&](std::size_t k) { return std::optional(storable((*texts)[k])); }));
}
PostgresParameters& PostgresParameters::texts(const std::vector<std::optional<std::string>>& texts) {
  return add(texts_type, array_of(text_type, texts.size(), [&](std::size_t k) {
               return texts[k] ? std::optional(storable(*texts[k])) : std::nullopt;
             }));
}
PostgresParameters& PostgresParameters::numbers(const std::vector<std::optional<double>>& values) {
  return add(float8s_type, array_of(float8_type, values.size(), [&](std::size_t k) {
               return values[k] ? std::optional(big_endian(std::bit_cast<std::int64_t>(*values[k]))) : std::nullopt;
             }));
}
PostgresParameters& PostgresParameters::times(const std::vector<std::optional<std::int64_t>>& ms) {
  return add(times_type, array_of(time_type, ms.size(), [&](std::size_t k) {
               return ms[k] ? std::optional(time_bytes(*ms[k])) : std::nullopt;
             }));
}
PostgresParameters& PostgresParameters::bytes(const std::vector<std::optional<std::string_view>>& bytes) {
  return add(bytes_array_type, array_of(bytes_type, bytes.size(), [&](std::size_t k) { return bytes[k]; }));
}

PostgresRows::PostgresRows(pg_result* result) : result_(result, PQclear) {}
std::size_t PostgresRows::size() const { return result_ ? static_cast<std::size_t>(PQntuples(result_.get())) : 0; }
std::size_t PostgresRows::changed() const {
  const std::string count = result_ ? PQcmdTuples(result_.get()) : "";
  return count.empty() ? 0 : static_cast<std::size_t>(std::stoull(count));
}
bool PostgresRows::null(std::size_t row, int column) const {
  return PQgetisnull(result_.get(), static_cast<int>(row), column) != 0;
}
std::string_view PostgresRows::bytes(std::size_t row, int column) const {
  const int at = static_cast<int>(row);
  return {PQgetvalue(result_.get(), at, column), static_cast<std::size_t>(PQgetlength(result_.get(), at, column))};
}
std::int64_t PostgresRows::integer(std::size_t row, int column) const { return number_of(bytes(row, column)); }
double PostgresRows::number(std::size_t row, int column) const {
  return std::bit_cast<double>(number_of(bytes(row, column)));
}
std::string PostgresRows::uuid(std::size_t row, int column) const {
  static constexpr char digits[] = "0123456789abcdef";
  std::string out;
  for (const char c : bytes(row, column)) {
    if (out.size() == 8 || out.size() == 13 || out.size() == 18 || out.size() == 23) out += '-';
    out += digits[static_cast<unsigned char>(c) >> 4];
    out += digits[static_cast<unsigned char>(c) & 15];
  }
  return out;
}
std::int64_t PostgresRows::time(std::size_t row, int column) const {
  const std::int64_t value = integer(row, column);
  if (value == never) return never;
  const std::int64_t us = value + server_epoch * 1000;
  return us >= 0 ? us / 1000 : -((-us + 999) / 1000);
}
std::vector<std::string> PostgresRows::texts(std::size_t row, int column) const {
  std::string_view rest = bytes(row, column);
  std::vector<std::string> out;
  const auto take = [&rest](std::size_t size) {
    const std::string_view part = rest.substr(0, size);
    rest.remove_prefix(std::min(size, rest.size()));
    return part;
  };
  if (number_of(take(4)) != 1) return out;
  take(8);
  const auto size = static_cast<std::size_t>(number_of(take(4)));
  take(4);
  for (std::size_t k = 0; k < size; ++k) out.emplace_back(take(static_cast<std::size_t>(number_of(take(4)))));
  return out;
}
std::optional<std::string> PostgresRows::optional_text(std::size_t row, int column) const {
  return null(row, column) ? std::nullopt : std::optional(text(row, column));
}
std::optional<std::int64_t> PostgresRows::optional_integer(std::size_t row, int column) const {
  return null(row, column) ? std::nullopt : std::optional(integer(row, column));
}
std::optional<double> PostgresRows::optional_number(std::size_t row, int column) const {
  return null(row, column) ? std::nullopt : std::optional(number(row, column));
}
std::optional<std::int64_t> PostgresRows::optional_time(std::size_t row, int column) const {
  return null(row, column) ? std::nullopt : std::optional(time(row, column));
}

}  // namespace bahnwerk::server
