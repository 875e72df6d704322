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
      unpack_rows(Compressor().rows(values.data(), rows, columns), columns, back);
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
  const std::string packed = Compressor().rows(values.data(), rows, columns);
  EXPECT_LT(packed.size(), values.size() * 8 / 2);
  unpack_rows(packed, columns, back);
  expect_same_bits(values, back);
}

// What a compressor makes does not depend on what it made before.
TEST(Compressor, PacksOneAfterTheOther) {
  std::vector<double> values(4096 * 10), back;
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = std::sin(1e-4 * static_cast<double>(k));
  Compressor one;
  for (const std::size_t size : {std::size_t{0}, std::size_t{17}, 3 * text_piece, std::size_t{900}}) {
    const std::string text(size, 'x'), packed = one.rows(values.data(), 4096, 10);
    EXPECT_EQ(packed, Compressor().rows(values.data(), 4096, 10));
    unpack_rows(packed, 10, back);
    expect_same_bits(values, back);
    EXPECT_EQ(one.text(text), pack_text(text));
    EXPECT_EQ(unpack_text(pack_text(text)), text);
  }
}

TEST(UnpackRows, RefusesDamage) {
  std::vector<double> values(300, 1.5), back;
  const std::string packed = Compressor().rows(values.data(), 100, 3);
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

std::string numbers(std::size_t bytes) {
  std::string text;
  for (std::size_t k = 0; text.size() < bytes; ++k) text += std::to_string(k * k) + ",";
  text.resize(bytes);
  return text;
}

TEST(PackText, LongTextsHaveFramesThatCanBeUnpackedAlone) {
  for (const std::size_t size : {text_piece - 1, text_piece, text_piece + 1, 2 * text_piece, 10 * text_piece + 17}) {
    const std::string text = numbers(size), packed = pack_text(text);
    EXPECT_EQ(unpack_text(packed), text);
    const std::size_t bytes = text_index_size(std::string_view(packed).substr(0, text_index_head));
    EXPECT_EQ(bytes > 0, size > text_piece);
    if (bytes == 0) continue;
    const TextIndex index = text_index(std::string_view(packed).substr(0, bytes));
    EXPECT_EQ(index.size, size);
    std::string pieces;
    for (const auto& [offset, length] : index.frames) {
      const std::string piece = unpack_text(std::string_view(packed).substr(offset, length));
      EXPECT_LE(piece.size(), text_piece);
      pieces += piece;
    }
    EXPECT_EQ(pieces, text);
  }
}

TEST(PackText, DamagedIndicesAreRefused) {
  std::mt19937 random(3);
  const std::string packed = pack_text(numbers(3 * text_piece));
  for (std::size_t cut = 0; cut < 40; ++cut) EXPECT_THROW(unpack_text(packed.substr(0, cut)), std::runtime_error);
  for (int i = 0; i < 300; ++i) {
    std::string bad = packed;
    bad[random() % 28] = static_cast<char>(random());
    try {
      unpack_text(bad);
    } catch (const std::runtime_error&) {
    } catch (const std::bad_alloc&) {
    }
  }
}

TEST(PackRows, TakesNoMoreMemoryThanItsResult) {
  const std::vector<double> rest(4096 * 12, 10.0);
  const std::string packed = Compressor().rows(rest.data(), 4096, 12);
  EXPECT_LT(packed.size(), 1000U);
  EXPECT_LT(packed.capacity(), 2000U);
}

}  // namespace
}  // namespace bahnwerk::server
