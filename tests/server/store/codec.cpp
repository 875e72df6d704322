#include "server/store/codec.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace bahnwerk::server {
namespace {

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << i;
}

TEST(PackRows, IsLosslessForAnyBits) {
  std::mt19937_64 random(1);
  for (const std::size_t columns : {1U, 3U, 11U}) {
    for (const std::size_t rows : {1U, 2U, 3U, 100U, 4096U}) {
      std::vector<double> values(rows * columns), back;
      for (double& value : values) value = std::bit_cast<double>(random());
      values.front() = -0.0;
      values.back() = std::numeric_limits<double>::quiet_NaN();
      unpack_rows(pack_rows(values.data(), rows, columns), columns, back);
      expect_same_bits(values, back);
    }
  }
}

TEST(PackRows, MakesSmoothSeriesSmall) {
  constexpr std::size_t rows = 4096, columns = 3;
  std::vector<double> values, back;
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = 0.001 * static_cast<double>(k);
    values.insert(values.end(), {100 * std::sin(t), 100 * std::cos(t), 4.0});
  }
  const std::string packed = pack_rows(values.data(), rows, columns);
  EXPECT_LT(packed.size(), values.size() * 8 / 2);
  unpack_rows(packed, columns, back);
  expect_same_bits(values, back);
}

TEST(UnpackRows, RefusesDamage) {
  std::vector<double> values(300, 1.5), back;
  const std::string packed = pack_rows(values.data(), 100, 3);
  EXPECT_THROW(unpack_rows(packed, 4, back), std::runtime_error);
  EXPECT_THROW(unpack_rows("", 3, back), std::runtime_error);
  EXPECT_THROW(unpack_rows(packed.substr(0, packed.size() - 1), 3, back), std::runtime_error);
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {  // any flipped byte is either noticed or harmless, never a crash
    std::string bad = packed;
    bad[random() % bad.size()] = static_cast<char>(random());
    try {
      unpack_rows(bad, 3, back);
      EXPECT_EQ(back.size(), 300U);
    } catch (const std::runtime_error&) {
    }
  }
}

TEST(PackText, ComesBack) {
  for (const std::string& text :
       {std::string(), std::string("{}"), std::string(100'000, 'x'), std::string("\0\xff", 2)})
    EXPECT_EQ(unpack_text(pack_text(text)), text);
  EXPECT_THROW(unpack_text("nonsense"), std::runtime_error);
}

}  // namespace
}  // namespace bahnwerk::server
