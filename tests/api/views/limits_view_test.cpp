#include "api/views/limits_view.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "stored.hpp"

namespace bahnwerk::api {
namespace {

/// The limit of a row of test::Motion, from the definition.
std::uint8_t expected(const test::Motion& m, std::size_t k) {
  double most = 0;
  std::uint8_t number = 0;
  const auto offer = [&](double share, std::size_t declared) {
    if (share > most) most = share, number = static_cast<std::uint8_t>(row_states + declared);
  };
  const std::size_t begin = m.facts.limits.size() == 4 ? 1 : 0;  // a short series may have no block with a feed
  if (begin == 1) {
    const bool limited = m.facts.limits[0].key.empty() || static_cast<std::size_t>(m.at(k, 4)) % 2 == 0;
    if (limited) offer(m.at(k, 3) / 90, 0);
  }
  offer(std::abs(m.at(k, 1)) / 100, begin);
  offer(std::abs(m.at(k, 2)) / 4000, begin + 1);
  if (m.count > 1) {
    const std::size_t i = std::min(k, m.count - 2);
    offer(std::abs(m.at(i + 1, 2) - m.at(i, 2)) / 0.001 / 7e6, begin + 2);
  }
  if (most >= limit_reached) return number;
  if (m.at(k, 3) != 0) return ahead;
  return k + 1 < m.count && m.at(k + 1, 3) == 0 ? dwell : stop;
}

TEST(LimitsViewTest, CountsOfAnyIntervalAreThoseOfItsRows) {
  std::mt19937_64 random(4);
  for (const std::size_t count : test::counts) {
    const test::Motion motion(count);
    LimitsReader reader(test::reader(motion.parts), count);
    ASSERT_EQ(reader.numbers(), row_states + motion.facts.limits.size());
    for (int k = 0; k < 20; ++k) {
      const test::Zoom zoom(random, count);
      LimitsReader::Counts counts(reader.numbers(), 0);
      for (std::size_t row = zoom.first; row < zoom.first + zoom.rows; ++row) ++counts[expected(motion, row)];
      ASSERT_EQ(reader.count(zoom.first, zoom.first + zoom.rows), counts) << count << " rows";
    }
  }
}

TEST(LimitsViewTest, ChangesOfFeedsBeginAtTheIntervalAndAreThoseOfItsBlocks) {
  std::mt19937_64 random(5);
  const test::Motion motion(140'001);
  LimitsReader reader(test::reader(motion.parts), motion.count);
  const auto feed = [&](std::size_t row) {
    return static_cast<std::size_t>(motion.at(row, 4)) % 2 == 0 ? 90 : unlimited;
  };
  for (int k = 0; k < 20; ++k) {
    const std::size_t from = random() % motion.count, to = from + 1 + random() % (motion.count - from);
    const auto changes = reader.changes(0, from, to, motion.count);
    ASSERT_FALSE(changes.empty());
    ASSERT_EQ(changes.front().first, from);
    std::size_t next = 0;
    for (std::size_t row = from; row < to; ++row) {
      if (next < changes.size() && changes[next].first == row) ++next;
      ASSERT_EQ(changes[next - 1].permitted.highest, feed(row)) << row;
    }
    ASSERT_EQ(next, changes.size());
  }
  EXPECT_EQ(reader.changes(0, 0, motion.count, 3).size(), 3U);
}

TEST(LimitsViewTest, TheColumnsUseAndLimitFollowFromTheRowsAndTheStoredList) {
  for (const std::size_t count : test::counts) {
    const test::Motion motion(count);
    SetpointQuery query;
    query.columns = {"limit", "use"};
    SetpointStream stream(motion.series(), query, SetpointFormat::f32);
    std::string bytes;
    while (stream.next(bytes)) {
    }
    ASSERT_EQ(bytes.size(), 8 * count);
    for (std::size_t k = 0; k < count; ++k) {
      float limit = 0;
      std::memcpy(&limit, bytes.data() + 8 * k, 4);
      ASSERT_EQ(limit, expected(motion, k)) << k << " of " << count;
    }
  }
}

TEST(LimitsViewTest, AnIntervalAnswersTheMostFrequentLimitAndTheLargestShare) {
  std::mt19937_64 random(6);
  for (const std::size_t count : {std::size_t{65}, std::size_t{140'001}}) {
    const test::Motion motion(count);
    SetpointQuery rows;
    rows.columns = {"use"};
    SetpointStream all(motion.series(), rows, SetpointFormat::f64);
    std::string use;
    while (all.next(use)) {
    }
    for (int k = 0; k < 8; ++k) {
      const test::Zoom zoom(random, count);
      SetpointQuery query;
      query.first = zoom.first, query.count = zoom.rows, query.points = zoom.points;
      query.columns = {"use", "limit"};
      SetpointStream stream(motion.series(), query, SetpointFormat::f64);
      std::string bytes;
      while (stream.next(bytes)) {
      }
      const auto bounds = bucket_bounds(zoom.first, zoom.rows, zoom.points, count);
      ASSERT_EQ(bytes.size(), 40 * (bounds.size() - 1));
      for (std::size_t b = 0; b + 1 < bounds.size(); ++b) {
        double line[5];
        std::memcpy(line, bytes.data() + 40 * b, 40);
        LimitsReader::Counts counts(row_states + motion.facts.limits.size(), 0);
        double most = 0;
        for (std::size_t row = bounds[b]; row < bounds[b + 1]; ++row) {
          ++counts[expected(motion, row)];
          double value = 0;
          std::memcpy(&value, use.data() + 8 * row, 8);
          most = std::max(most, value);
        }
        ASSERT_EQ(line[2], most);
        ASSERT_EQ(line[3], static_cast<double>(most_frequent(counts)));
        ASSERT_EQ(line[4], line[3]);
      }
    }
  }
}

TEST(LimitsViewTest, AMissingViewIsReported) {
  const test::Parts none;
  EXPECT_THROW(LimitsReader(test::reader(none), 10), std::runtime_error);
}

}  // namespace
}  // namespace bahnwerk::api
