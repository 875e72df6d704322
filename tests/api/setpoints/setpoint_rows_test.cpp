#include "api/setpoints/setpoint_rows.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/api/series.hpp"

namespace bahnwerk::api {
namespace {

using namespace test;
using nlohmann::json;

TEST(RowCursor, WalksAndRewinds) {
  Source source{5000};
  const auto series = source.series();
  RowCursor cursor(series, 7, 3, 1000);
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t k = 0; k < 1000; ++k) {
      const double* row = cursor.next();
      ASSERT_TRUE(row);
      ASSERT_EQ(row[1], cell(7 + 3 * k, 1));
    }
    EXPECT_EQ(cursor.next(), nullptr);
    cursor.rewind();
  }
}

TEST(Delayed, EveryDerivativeRestsWhereAxesWait) {
  SetpointSeries series;
  series.columns = {{"x", "mm"}, {"vx", "mm/s"}, {"ax", "mm/s²"}, {"jx", "mm/s³"}, {"sx", "mm/s⁴"}, {"s", "mm"}};
  series.count = 2, series.cycle_time = 0.001;
  series.read = [](std::size_t, std::size_t rows, std::vector<double>& out) { out.assign(6 * rows, 5.0); };
  std::vector<double> out;
  delayed(series, 3).read(2, 2, out);
  EXPECT_EQ(out, (std::vector<double>{5, 0, 0, 0, 0, 5, 5, 5, 5, 5, 5, 5}));
}

TEST(RowCursor, NoticesASeriesThatIsTooShort) {
  SetpointSeries series;
  series.columns = {{"x", "mm"}};
  series.count = 10;
  series.read = [](std::size_t, std::size_t, std::vector<double>& out) { out.assign(3, 0.0); };
  RowCursor cursor(series, 0, 1, 10);
  EXPECT_THROW(cursor.next(), std::runtime_error);
}

TEST(Envelope, HoldsTheExtremesOfEveryBucket) {
  for (std::size_t rows : {1u, 7u, 999u, 5000u})
    for (std::size_t points : {1u, 2u, 10u, 1000u, 20000u}) {
      Source source{rows};
      SetpointQuery query;
      query.first = rows / 3;
      query.points = points;
      const std::size_t spanned = rows - query.first, buckets = std::min(points, spanned);
      const auto document = json::parse(answer(source, query, SetpointFormat::json));
      EXPECT_EQ(source.total, spanned) << "the series is read once";
      ASSERT_EQ(document["points"], buckets);
      EXPECT_EQ(document["count"], spanned);
      const auto& index = document["index"];
      ASSERT_EQ(index.size(), buckets);
      EXPECT_EQ(index[0], query.first);
      for (std::size_t b = 0; b < buckets; ++b) {
        const std::size_t begin = index[b], end = b + 1 < buckets ? index[b + 1].get<std::size_t>() : rows;
        ASSERT_LT(begin, end);
        ASSERT_LE(end - begin, spanned / buckets + 1);
        for (std::size_t c = 0; c < 3; ++c) {
          double low = cell(begin, c), high = low;
          for (std::size_t r = begin; r < end; ++r) {
            low = std::min(low, cell(r, c));
            high = std::max(high, cell(r, c));
          }
          ASSERT_EQ(document["columns"][c]["min"][b], low);
          ASSERT_EQ(document["columns"][c]["max"][b], high);
        }
      }
    }
}

TEST(Envelope, IsTheSameInEveryFormat) {
  Source source{777};
  SetpointQuery query;
  query.points = 50;
  query.columns = {"vx"};
  const auto document = json::parse(answer(source, query, SetpointFormat::json));
  std::string header;
  const auto rows = from_csv(answer(source, query, SetpointFormat::csv), &header);
  EXPECT_EQ(header, "index,vx_min,vx_max");
  const auto bytes = from_f64(answer(source, query, SetpointFormat::f64));
  EXPECT_EQ(rows, bytes);
  ASSERT_EQ(rows.size(), 50u);
  for (std::size_t b = 0; b < 50; ++b)
    EXPECT_EQ(rows[b], (std::vector<double>{document["index"][b], document["columns"][0]["min"][b],
                                            document["columns"][0]["max"][b]}));
  EXPECT_EQ(SetpointStream(source.series(), query, SetpointFormat::f64).columns()[2].name, "vx_max");
}

}  // namespace
}  // namespace bahnwerk::api
