#include "server/runtime/uuid7.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

namespace bahnwerk::server {
namespace {

std::mt19937_64 seeded() {
  std::random_device device;
  std::array<std::uint32_t, 8> words{};
  std::generate(words.begin(), words.end(), std::ref(device));
  std::seed_seq seed(words.begin(), words.end());
  return std::mt19937_64(seed);
}

}  // namespace

Uuid7::Uuid7() : random_(seeded()) {}

std::string Uuid7::next(std::int64_t now_ms) {
  if (now_ms > last_ms_) {
    last_ms_ = now_ms;
    counter_ = static_cast<std::uint32_t>(random_() & 0x7ff);  // leaves at least 2048 steps within this millisecond
  } else if (++counter_ > 0xfff) {
    ++last_ms_;
    counter_ = 0;
  }
  const std::uint64_t tail = (random_() & 0x3fffffffffffffffULL) | 0x8000000000000000ULL;  // variant 10
  char text[37];
  std::snprintf(text, sizeof text, "%08llx-%04llx-7%03x-%04llx-%012llx",
                static_cast<unsigned long long>((last_ms_ >> 16) & 0xffffffff),
                static_cast<unsigned long long>(last_ms_ & 0xffff), counter_,
                static_cast<unsigned long long>(tail >> 48), static_cast<unsigned long long>(tail & 0xffffffffffffULL));
  return text;
}

void Uuid7::advance_past(std::string_view id) {
  if (id.size() != 36) return;
  const std::string digits = std::string(id.substr(0, 8)) + std::string(id.substr(9, 4));
  std::int64_t ms = 0;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), ms, 16);
  if (parsed.ec != std::errc() || ms < last_ms_) return;
  last_ms_ = ms;
  counter_ = 0xfff;  // the next identifier takes a later millisecond
}

std::string first_id(std::int64_t ms) {
  const auto time = static_cast<unsigned long long>(std::clamp<std::int64_t>(ms, 0, (std::int64_t{1} << 48) - 1));
  char text[37];
  std::snprintf(text, sizeof text, "%08llx-%04llx-7000-8000-000000000000", time >> 16, time & 0xffff);
  return text;
}

std::string random_id() {
  thread_local std::mt19937_64 random = seeded();
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(random()),
                static_cast<unsigned long long>(random()));
  return text;
}

}  // namespace bahnwerk::server
