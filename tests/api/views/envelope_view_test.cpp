#include "api/views/envelope_view.hpp"

#include <gtest/gtest.h>

#include "api/setpoints/setpoint_rows.hpp"
#include "stored.hpp"

namespace bahnwerk::api {
namespace {

TEST(EnvelopeViewTest, EnvelopesOfAnyIntervalAreThoseOfItsRows) {
  std::mt19937_64 random(3);
  for (const std::size_t count : test::counts) {
    const test::Motion motion(count);
    for (int k = 0; k < 12; ++k) {
      const test::Zoom zoom(random, count);
      const auto bounds = bucket_bounds(zoom.first, zoom.rows, zoom.points, count);
      const SetpointSeries lines = envelope(motion.series(), zoom.first, zoom.rows, zoom.points, {1, 0, 4});
      ASSERT_EQ(lines.count, bounds.size() - 1);
      std::vector<double> table;
      if (lines.count > 0) lines.read(0, lines.count, table);
      for (std::size_t b = 0; b < lines.count; ++b) {
        ASSERT_EQ(table[7 * b], static_cast<double>(bounds[b]));
        for (std::size_t i = 0; i < 3; ++i) {
          LeastAndMost expected;
          for (std::size_t row = bounds[b]; row < bounds[b + 1]; ++row)
            expected.add(motion.at(row, std::array<std::size_t, 3>{1, 0, 4}[i]));
          ASSERT_EQ(table[7 * b + 1 + 2 * i], expected.least) << count << " rows, bucket " << b;
          ASSERT_EQ(table[7 * b + 2 + 2 * i], expected.most) << count << " rows, bucket " << b;
        }
      }
    }
  }
}

TEST(EnvelopeViewTest, ALongIntervalReadsFewRows) {
  const test::Motion motion(140'001);
  SetpointSeries series = motion.series();
  std::size_t rows_read = 0;
  series.read = [&, read = series.read](std::size_t first, std::size_t n, std::vector<double>& out) {
    rows_read += n;
    read(first, n, out);
  };
  const SetpointSeries lines = envelope(series, 777, 120'001, 300, {0, 1, 2, 3});
  std::vector<double> table;
  lines.read(0, lines.count, table);
  EXPECT_LT(rows_read, 128U);
}

TEST(EnvelopeViewTest, AShortSeriesHasNoParts) {
  const test::Motion motion(1024);
  for (const auto& [name, bytes] : motion.parts) EXPECT_NE(name.first.substr(0, 8), "envelope");
}

TEST(EnvelopeViewTest, AMissingPartIsReportedAndNoValue) {
  test::Motion motion(4097);
  motion.parts.erase({"envelope/64/x", 0});
  EnvelopeReader reader(test::reader(motion.parts), motion.count);
  const auto none = [](std::size_t, std::size_t) { return LeastAndMost{}; };
  EXPECT_THROW(reader.of("x", 0, 64, none), std::runtime_error);
}

}  // namespace
}  // namespace bahnwerk::api
