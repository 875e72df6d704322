#include "api/views/block_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "api/views/view_facts.hpp"

namespace bahnwerk::api {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Line 3 is driven twice, with line 4 in between; line 5 has no feed.
SegmentTable table() {
  SegmentTable table;
  table.program = true;
  table.segments = {{3, 0, true, true, 0, 2, 100, 100, 1},
                    {4, 0, true, false, 2, 1, 100, 100, 1},
                    {3, 0, true, false, 3, 4, 100, 100, 1},
                    {5, 1, false, true, 7, 3, 50, none, 2}};
  return table;
}

TEST(BlockList, LinesGatherTheirVisits) {
  const auto lines = list_blocks(table(), ListedBy::line, ListOrder::lost);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].number, 3U);
  EXPECT_EQ(lines[0].visits, 2U);
  EXPECT_EQ(lines[0].time, 6);
  EXPECT_EQ(lines[0].length, 200);
  EXPECT_EQ(lines[0].end, 7);
  EXPECT_EQ(lines[0].stops, 1U);
  EXPECT_EQ(lines[1].number, 5U);
  EXPECT_EQ(list_blocks(table(), ListedBy::segment, ListOrder::start).size(), 4U);
  const auto blocks = list_blocks(table(), ListedBy::block, ListOrder::time);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].time, 7);
  EXPECT_EQ(blocks[0].visits, 1U);
}

TEST(BlockList, PagesHaveTotalsOfTheWholeListAndTextsOfTheirLines) {
  BlockQuery query = parse_block_query({{"by", "line"}, {"sort", "time"}, {"first", "1"}, {"count", "1"}});
  BlockTexts texts{[](std::size_t line) { return "N" + std::to_string(line); }};
  std::vector<std::pair<double, double>> asked;
  texts.limit = [&](const auto& intervals) {
    asked = intervals;
    return MainLimit{"feed", 0.5};
  };
  auto page = blocks_document(table(), query, list_blocks(table(), query.by, query.sort), texts);
  EXPECT_EQ(page["total"], 3);
  EXPECT_EQ(page["time"], 10.0);
  EXPECT_EQ(page["lost"], (nlohmann::ordered_json{{"to_feed", 4.0}, {"to_axes", 1.0}}));
  ASSERT_EQ(page["blocks"].size(), 1U);
  EXPECT_EQ(page["blocks"][0]["line"], 5);
  EXPECT_EQ(page["blocks"][0]["text"], "N5");
  EXPECT_EQ(page["blocks"][0]["mode"], "position");
  EXPECT_TRUE(page["blocks"][0]["feed"].is_null());
  EXPECT_EQ(page["blocks"][0]["limit"], "feed");
  query.first = 0;
  blocks_document(table(), query, list_blocks(table(), query.by, query.sort), texts);
  EXPECT_EQ(asked, (std::vector<std::pair<double, double>>{{0, 2}, {3, 7}}));
  query.first = 99;
  EXPECT_TRUE(blocks_document(table(), query, list_blocks(table(), query.by, query.sort), texts)["blocks"].empty());
}

TEST(BlockList, FaultyQueriesAreRefusedAtTheirPlace) {
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
           {"by", "moon"}, {"sort", ""}, {"first", "-1"}, {"count", "0"}, {"count", "1001"}, {"count", "1e2"}}) {
    try {
      parse_block_query({{name, value}});
      ADD_FAILURE() << name << "=" << value << " is accepted";
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.errors().at(0).pointer, "/query/" + name);
    }
  }
  SegmentTable contour = table();
  contour.program = false;
  EXPECT_THROW(list_blocks(contour, ListedBy::line, ListOrder::start), Problem);
}

TEST(Segments, AreReadAsTheyWereStored) {
  auto facts = std::make_shared<ViewFacts>();
  auto all = std::make_shared<SegmentTable>();
  double start = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const double time = 0.001 * (1 + i % 7);
    all->segments.push_back({i / 2, i / 10, i % 3 == 0, i % 5 == 0, start, time, 0.5 * i, i % 4 ? 100.0 : none, time});
    start += time;
  }
  facts->segments = all;
  std::map<std::size_t, std::string> parts;
  const ViewSink sink = [&](const ViewPart& part) { parts[part.part] = part.bytes; };
  const auto view = segment_view({{}, 0, 0.001, facts}, sink);
  ASSERT_NE(view, nullptr);
  view->finish();
  EXPECT_EQ(parts.size(), 3U);
  const auto found = read_segments([&](std::string_view, std::size_t part) {
    const auto at = parts.find(part);
    return at == parts.end() ? std::nullopt : std::optional(at->second);
  });
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->program);
  ASSERT_EQ(found->segments.size(), all->segments.size());
  for (std::size_t i = 0; i < found->segments.size(); ++i) {
    const PlannedSegment &a = found->segments[i], &b = all->segments[i];
    ASSERT_EQ(std::tuple(a.source, a.block, a.cut, a.rests), std::tuple(b.source, b.block, b.cut, b.rests));
    ASSERT_NEAR(a.start, b.start, 1e-6);
    ASSERT_NEAR(a.time, b.time, 1e-9);
    ASSERT_FLOAT_EQ(static_cast<float>(a.length), static_cast<float>(b.length));
    ASSERT_EQ(std::isfinite(a.feed), std::isfinite(b.feed));
  }
  EXPECT_FALSE(read_segments([](std::string_view, std::size_t) { return std::optional<std::string>(); }));
}

}  // namespace
}  // namespace bahnwerk::api
