// Binary DXF: the same drawing as in ASCII, with group codes of one byte and of two.
#include "core/contour/dxf/read/binary.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <numbers>

#include "core/base/progress.hpp"
#include "tests/core/contour/dxf_text.hpp"

namespace bahnwerk {
namespace {

using namespace test;

class Bytes {
 public:
  explicit Bytes(bool short_codes) : short_(short_codes) {}
  Bytes& text(int code, const std::string& value) {
    group(code);
    out_ += value + '\0';
    return *this;
  }
  Bytes& real(int code, double value) { return group(code).integer(std::bit_cast<std::uint64_t>(value), 8); }
  Bytes& small(int code, int value) { return group(code).integer(static_cast<std::uint64_t>(value), 2); }
  Bytes& word(int code, int value) { return group(code).integer(static_cast<std::uint64_t>(value), 4); }
  Bytes& byte(int code, int value) { return group(code).integer(static_cast<std::uint64_t>(value), 1); }
  Bytes& chunk(int code, const std::string& data) {
    group(code).integer(data.size(), 1);
    out_ += data;
    return *this;
  }
  const std::string& all() const { return out_; }

 private:
  Bytes& group(int code) {
    if (short_ && code >= 255) out_ += '\xFF';
    return integer(static_cast<std::uint64_t>(code), short_ && code < 255 ? 1 : 2);
  }
  Bytes& integer(std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) out_ += static_cast<char>(value >> (8 * i) & 255);
    return *this;
  }
  bool short_;
  std::string out_{"AutoCAD Binary DXF\r\n\x1A\0", 22};
};

/// A line, an arc of 90°, a circle on a layer that is off, extended data.
std::string part(bool short_codes) {
  Bytes b(short_codes);
  b.text(0, "SECTION").text(2, "HEADER").text(9, "$INSUNITS").small(70, 5).text(0, "ENDSEC");
  b.text(0, "SECTION").text(2, "TABLES").text(0, "TABLE").text(2, "LAYER").small(70, 1);
  b.text(0, "LAYER").text(2, "aside").small(70, 0).small(62, -7).text(0, "ENDTAB").text(0, "ENDSEC");
  b.text(0, "SECTION").text(2, "ENTITIES");
  b.text(0, "LINE").text(8, "0").real(10, 0.1).real(20, 0).real(11, 2.5).real(21, 0);
  if (!short_codes) b.word(420, -3).byte(290, 1).chunk(310, std::string("\0\n\xFF", 3));
  b.text(1001, "ACAD").small(1070, 7).real(1040, 2.0);
  b.text(0, "ARC").text(8, "0").real(10, 2.5).real(20, 1).real(40, 1).real(50, -90).real(51, 0);
  b.text(0, "CIRCLE").text(8, "aside").real(10, 0).real(20, 0).real(40, 9);
  b.text(0, "ENDSEC").text(0, "EOF");
  return b.all();
}

TEST(DxfBinary, IsReadAsItsAsciiForm) {
  for (const bool short_codes : {false, true}) {
    const Contour c = read_dxf(part(short_codes));  // in cm
    EXPECT_NEAR(cut_length(c), 24 + 5 * std::numbers::pi, 1e-12);
    EXPECT_EQ(begin_of(c).x, 1);
    EXPECT_EQ(cut_count(c), 1u);
    EXPECT_TRUE(noted(c, "on a layer switched off, \"aside\""));
  }
}

TEST(DxfBinary, NumbersKeepTheirBits) {
  Progress silent;
  const double value = 0.1 + 0.2;
  const std::string text = dxf_ascii(Bytes(false).text(0, "SECTION").real(40, value).all(), silent);
  EXPECT_EQ(text, "0\nSECTION\n40\n0.30000000000000004\n");
  EXPECT_EQ(dxf_ascii(Bytes(true).text(0, "SECTION").small(62, -1).text(1, "a\nb").all(), silent),
            "0\nSECTION\n62\n-1\n1\na b\n");
}

TEST(DxfBinary, TruncatedFilesAreRefused) {
  for (const bool short_codes : {false, true}) {
    const std::string whole = part(short_codes);
    for (std::size_t size = 22; size + 8 < whole.size(); ++size) {
      const auto list = faults(whole.substr(0, size));
      ASSERT_EQ(list.size(), 1u) << size;
      EXPECT_EQ(list[0].rfind("/contour/dxf line ", 0), 0u) << list[0];
    }
  }
  EXPECT_NE(faults("AutoCAD Binary DXF\r\n\x1Aggg").at(0).find("bytes were changed"), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk
