#include "api/setpoints/limits_answer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "tests/api/views/stored.hpp"

namespace bahnwerk::api {
namespace {

nlohmann::ordered_json answer(const test::Motion& motion, const IntervalQuery& query) {
  LimitsReader reader(test::reader(motion.parts), motion.count);
  return limits_answer(reader, motion.count, 0.001, query);
}

TEST(LimitsAnswerTest, TimesSumToTheDurationAndSharesToOneAtAnyZoom) {
  std::mt19937_64 random(7);
  for (const std::size_t count : test::counts) {
    const test::Motion motion(count);
    for (int k = 0; k < 10; ++k) {
      const test::Zoom zoom(random, count);
      const auto out = answer(motion, {zoom.first, zoom.rows, zoom.points});
      const bool ends = zoom.first + zoom.rows == count && zoom.rows > 0;
      const double duration = 0.001 * static_cast<double>(zoom.rows - (ends ? 1 : 0));
      EXPECT_NEAR(out["duration"].get<double>(), duration, 1e-9);
      double time = 0, share = 0;
      for (const auto& limit : out["limits"])
        time += limit["time"].get<double>(), share += limit["share"].get<double>();
      EXPECT_NEAR(time, duration, 1e-9);
      EXPECT_NEAR(share, zoom.rows > 0 ? 1 : 0, 1e-12);
      const auto& shares = out["points"]["shares"];
      ASSERT_EQ(shares.size(), out["limits"].size());
      for (std::size_t b = 0; b < out["points"]["index"].size(); ++b) {
        double sum = 0;
        for (const auto& limit : shares) sum += limit[b].get<double>();
        ASSERT_NEAR(sum, 1, 1e-12) << count << " rows, interval " << b;
      }
    }
  }
}

TEST(LimitsAnswerTest, AFeedThatChangesIsGivenByIntervals) {
  const test::Motion motion(4097);
  const auto out = answer(motion, {100, 2000});
  const auto& feed = out["limits"][row_states];
  EXPECT_EQ(feed["name"], "feed");
  EXPECT_TRUE(feed["value"].is_null());
  EXPECT_EQ(feed["intervals"][0]["first"], 100);
  std::size_t rows = 0;
  for (const auto& interval : feed["intervals"]) rows += interval["count"].get<std::size_t>();
  EXPECT_EQ(rows, 2000U);
  EXPECT_EQ(feed["more"], false);
  EXPECT_EQ(out["limits"][row_states + 2]["name"], "acceleration x");
  EXPECT_EQ(out["limits"][row_states + 2]["column"], "ax");
  EXPECT_EQ(out["limits"][row_states + 2]["value"], 4000);
}

TEST(LimitsAnswerTest, AQueryHasFirstCountAndPointsAlone) {
  const IntervalQuery query = parse_interval_query({{"first", "5"}, {"count", "7"}, {"points", "3"}});
  EXPECT_EQ(query.first, 5U);
  EXPECT_EQ(query.count, 7U);
  EXPECT_EQ(query.points, 3U);
  EXPECT_THROW(parse_interval_query({{"every", "2"}}), Problem);
  EXPECT_THROW(parse_interval_query({{"points", "0"}}), Problem);
  const test::Motion motion(65);
  EXPECT_THROW(answer(motion, {66}), Problem);
}

}  // namespace
}  // namespace bahnwerk::api
