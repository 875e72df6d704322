#include "server/http/gzip.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "api/problem.hpp"

namespace bahnwerk::server {
namespace {

std::string pack(const std::string& text) {
  z_stream z{};
  EXPECT_EQ(deflateInit2(&z, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&z, text.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  z.avail_in = static_cast<uInt>(text.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&z, Z_FINISH), Z_STREAM_END);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

std::string slug(const std::string& packed) {
  try {
    gunzip(packed, 1000);
  } catch (const api::Problem& problem) {
    return std::string(problem.type().slug);
  }
  return "";
}

TEST(Gunzip, GivesTheTextBack) {
  std::string noise(200'000, ' ');
  std::mt19937 random(1);
  for (char& c : noise) c = static_cast<char>(random());
  for (const std::string& text : {std::string(), std::string("{}"), std::string(65'536, 'a'), noise}) {
    EXPECT_EQ(gunzip(pack(text), text.size()), text);
    EXPECT_EQ(gunzip(pack(text) + pack("b"), text.size() + 1), text + "b") << "members one after the other";
  }
}

TEST(Gunzip, StopsAtTheLimit) {
  EXPECT_FALSE(gunzip(pack("abc"), 2));
  const std::string bomb = pack(std::string(100'000'000, ' '));
  EXPECT_LT(bomb.size(), 150'000U);
  EXPECT_FALSE(gunzip(bomb, 1'000'000));
  std::string chain;
  for (int i = 0; i < 100; ++i) chain += pack(std::string(100, 'a'));
  EXPECT_FALSE(gunzip(chain, 9'999));
  EXPECT_TRUE(gunzip(chain, 10'000));
}

TEST(Gunzip, RefusesWhatIsDamaged) {
  const std::string good = pack("a text that is long enough to be cut somewhere");
  EXPECT_EQ(slug(good), "");
  EXPECT_EQ(slug(""), "bad-request");
  EXPECT_EQ(slug("{\"kind\":1}"), "bad-request");
  EXPECT_EQ(slug(good + "x"), "bad-request");
  for (std::size_t cut = 0; cut < good.size(); ++cut) EXPECT_EQ(slug(good.substr(0, cut)), "bad-request") << cut;
  std::mt19937 random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bad = good;
    bad[random() % bad.size()] = static_cast<char>(random());
    EXPECT_NO_THROW(slug(bad));
  }
}

TEST(Gzip, GivesBackWhatItWasGivenInPieces) {
  std::mt19937 random(4);
  for (const std::size_t size : {0U, 1U, 100'000U, 3'000'000U}) {
    std::string text, packed;
    while (text.size() < size) text += static_cast<char>('a' + random() % 8);
    Gzip gzip;
    for (std::size_t at = 0; at < size;) {
      const std::size_t piece = std::min<std::size_t>(random() % 100'000, size - at);
      gzip.add(std::string_view(text).substr(at, piece), packed);
      at += piece;
    }
    gzip.finish(packed);
    EXPECT_EQ(gunzip(packed, size), text);
    EXPECT_LT(packed.size(), size / 2 + 100);
  }
}

}  // namespace
}  // namespace bahnwerk::server
