#include "api/setpoints/setpoints.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "api/problem.hpp"
#include "tests/api/documents.hpp"
#include "tests/api/series.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

using namespace test;

constexpr SetpointFormat formats[] = {SetpointFormat::json, SetpointFormat::csv, SetpointFormat::ndjson,
                                      SetpointFormat::f64};

TEST(SetpointStream, EveryFormatHoldsTheSeries) {
  for (std::size_t rows : {1u, 2u, 2047u, 2048u, 2049u, 20'000u})
    for (auto format : formats) {
      Source source{rows};
      EXPECT_EQ(table(source, {}, format), expected(0, rows, 1)) << rows;
    }
}

/// Two rows of a machine with two axes and a tool that turns.
SetpointSeries needle_series() {
  SetpointSeries s;
  for (const char* name :
       {"q1", "q2", "vq1", "vq2", "aq1", "aq2", "x", "y", "phi", "s", "v", "brake", "vx", "vy", "vphi"})
    s.columns.push_back({name, "1"});
  s.count = 2;
  s.cycle_time = 0.002;
  s.read = [](std::size_t first, std::size_t n, std::vector<double>& out) {
    for (std::size_t i = 0; i < 15 * n; ++i) out.push_back(static_cast<double>(15 * first + i) / 4);
  };
  return s;
}
std::string laid_out(const SetpointQuery& query) {
  SetpointStream stream(needle_series(), query, SetpointFormat::csv);
  std::string text;
  while (stream.next(text)) {
  }
  return text;
}

TEST(SetpointStream, ControllersGetTheirColumnsAndSeparators) {
  SetpointQuery query;
  query.layout = CsvLayout::twincat;
  EXPECT_EQ(laid_out(query), "q1;q2;vq1;vq2;brake\r\n0;0.25;0.5;0.75;2.75\r\n3.75;4;4.25;4.5;6.5\r\n");
  query.layout = CsvLayout::twincat_poses;
  query.first = 1;
  EXPECT_EQ(laid_out(query), "x;y;phi;vx;vy;vphi;brake\r\n5.25;5.5;5.75;6.75;7;7.25;6.5\r\n");
  query.columns = {"s", "q2"};
  EXPECT_EQ(laid_out(query), "s;q2\r\n6;4\r\n");
  query.layout = CsvLayout::plain;
  EXPECT_EQ(laid_out(query), "s,q2\n6,4\n");
}

TEST(SetpointStream, PosesForAControllerAreOfTheMachinesBase) {
  SetpointSeries series = needle_series();
  series.pose_frame = PoseFrame{400, 10, 3, 90};
  const auto text = [&](SetpointQuery query, SetpointFormat format = SetpointFormat::csv) {
    query.first = 1;
    SetpointStream stream(series, query, format);
    std::string out;
    while (stream.next(out)) {
    }
    return out;
  };
  SetpointQuery query;
  query.layout = CsvLayout::twincat_poses;
  // Turned by 90°: x is 400 − y, y is 10 + x; the velocities turn with them.
  EXPECT_EQ(text(query), "x;y;phi;vx;vy;vphi;brake;base_frame\r\n394.5;15.25;95.75;-7;6.75;7.25;6.5;1\r\n");
  query.frame = SetpointFrame::part;
  EXPECT_EQ(text(query), "x;y;phi;vx;vy;vphi;brake;part_frame\r\n5.25;5.5;5.75;6.75;7;7.25;6.5;1\r\n");
  query.columns = {"q1", "x"};
  EXPECT_EQ(text(query), "q1;x\r\n3.75;5.25\r\n");
  SetpointQuery plain;
  plain.columns = {"y", "brake"};
  EXPECT_EQ(text(plain), "y,brake\n5.5,6.5\n") << "of the part where nobody asks";
  plain.frame = SetpointFrame::base;
  EXPECT_EQ(text(plain), "y,brake\n15.25,6.5\n");
  EXPECT_EQ(text(plain, SetpointFormat::ndjson), "{\"y\":15.25,\"brake\":6.5}\n");
  series.pose_frame.reset();
  EXPECT_THROW(text(plain), Problem) << "no machine's frame is known";
}

/// Two rows 1 ms apart, of a coarse and a fine axis.
SetpointSeries split_series() {
  SetpointSeries series;
  for (const char* name : {"x", "vx", "ax", "mode", "block", "xc", "xf", "vxc", "vxf", "axc", "axf"})
    series.columns.push_back({name, "mm"});
  series.count = 2;
  series.cycle_time = 0.001;
  series.read = [](std::size_t first, std::size_t rows, std::vector<double>& out) {
    out.clear();
    for (std::size_t i = first; i < first + rows; ++i)
      for (int c = 0; c < 11; ++c) out.push_back(static_cast<double>(100 * (i + 1)) + c);
  };
  return series;
}

TEST(SetpointStream, DriveGroupsHaveFilesOfTheirOwnEachWithItsDelay) {
  const auto text = [](const SetpointQuery& query) {
    SetpointStream stream(split_series(), query, SetpointFormat::csv);
    std::string all;
    while (stream.next(all)) {
    }
    return all;
  };
  SetpointQuery query;
  query.layout = CsvLayout::twincat;
  query.group = DriveGroup::coarse;
  EXPECT_EQ(text(query), "xc;vxc;mode;block\r\n105;107;103;104\r\n205;207;203;204\r\n");
  query.group = DriveGroup::fine;
  query.delay = 0.002;  // at rest where it begins
  EXPECT_EQ(text(query),
            "xf;vxf;mode;block\r\n106;0;103;104\r\n106;0;103;104\r\n106;108;103;104\r\n206;208;203;204\r\n");
  query.layout = CsvLayout::plain;
  query.first = 1;
  query.count = 2;
  EXPECT_EQ(text(query), "xf,vxf,axf,mode,block\n106,0,0,103,104\n106,108,110,103,104\n");
  query.delay = 0.0015;
  EXPECT_THROW(text(query), Problem);
  query.delay = 0;
  EXPECT_THROW(SetpointStream(needle_series(), query, SetpointFormat::csv), Problem);
}

TEST(SetpointStream, LayoutsBelongToCsvAndToWhatTheyHold) {
  SetpointQuery query;
  query.layout = CsvLayout::twincat;
  const auto refused = [&](SetpointSeries series, SetpointFormat format) {
    try {
      SetpointStream(std::move(series), query, format);
    } catch (const Problem& problem) {
      return test::pointers(problem).front();
    }
    return std::string();
  };
  for (const auto format : {SetpointFormat::json, SetpointFormat::ndjson, SetpointFormat::f64})
    EXPECT_EQ(refused(needle_series(), format), "/query/layout");
  Source source{3};  // its column has a velocity, but no acceleration
  EXPECT_EQ(refused(source.series(), SetpointFormat::csv), "/query/layout");
}

TEST(SetpointStream, SlicesEqualTheWhole) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    Source source{random() % 6000 + 1};
    SetpointQuery query;
    query.first = random() % (source.rows + 1);
    query.every = trial % 3 == 0 ? 1 + random() % 5000 : 1 + random() % 7;
    if (trial % 4) query.count = random() % 6000;
    const std::size_t end = std::min(source.rows, query.first + query.count.value_or(source.rows));
    ASSERT_EQ(table(source, query, formats[trial % 4]), expected(query.first, end, query.every));
  }
}

TEST(SetpointStream, ReadsInBoundedPieces) {
  for (auto format : formats) {
    Source source{50'000};
    answer(source, {}, format);
    EXPECT_LE(source.widest, 2048u);
    EXPECT_EQ(source.total, (format == SetpointFormat::json ? 3u : 1u) * 50'000u);
  }
  Source sparse{1'000'000};
  SetpointQuery query;
  query.every = 100'000;
  answer(sparse, query, SetpointFormat::csv);
  EXPECT_EQ(sparse.total, 10u) << "rows that are not asked for are not read when they are far apart";
}

TEST(SetpointStream, JsonSaysWhichRows) {
  Source source{100};
  SetpointQuery query;
  query.first = 10;
  query.count = 20;
  query.every = 6;
  query.columns = {"vx"};
  EXPECT_EQ(
      json::parse(answer(source, query, SetpointFormat::json)),
      (json{{"first", 10},
            {"every", 6},
            {"count", 4},
            {"cycle_time", 0.001},
            {"columns",
             {{{"name", "vx"}, {"unit", "mm/s"}, {"values", {cell(10, 1), cell(16, 1), cell(22, 1), cell(28, 1)}}}}}}));
}

TEST(SetpointStream, CsvHeaderFollowsRfc4180) {
  Source source{3};
  std::string header;
  from_csv(answer(source, {}, SetpointFormat::csv), &header);
  EXPECT_EQ(header, "x,vx,\"a,\"\"b\"\"\"");
}

TEST(SetpointStream, ColumnsComeInTheOrderAskedFor) {
  Source source{3};
  SetpointQuery query;
  query.columns = {"vx", "x"};
  SetpointStream stream(source.series(), query, SetpointFormat::csv);
  ASSERT_EQ(stream.columns().size(), 2u);
  EXPECT_EQ(stream.columns()[0].name, "vx");
  EXPECT_EQ(stream.columns()[1].name, "x");
  EXPECT_EQ(from_csv(answer(source, query, SetpointFormat::csv))[2], (std::vector<double>{cell(2, 1), cell(2, 0)}));
}

TEST(SetpointStream, AnEmptySliceIsAnEmptyAnswer) {
  for (auto format : formats)
    for (bool envelope : {false, true}) {
      Source source{5};
      SetpointQuery query;
      query.first = 5;
      if (envelope) query.points = 10;
      const auto text = answer(source, query, format);
      if (format == SetpointFormat::json)
        EXPECT_EQ(json::parse(text)["count"], 0);
      else if (format == SetpointFormat::csv)
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
      else
        EXPECT_EQ(text, "");
    }
}

/// A table over a master's angle: every format serves its rows, JSON tells what they are taken over.
TEST(SetpointStream, SeriesOverAnAngleAreServedInEveryFormat) {
  Source source{1000};
  SetpointSeries series = source.series();
  series.independent = {"phi", "deg", 0.36};
  const auto text = [&](SetpointQuery query, SetpointFormat format) {
    SetpointStream stream(series, std::move(query), format);
    std::string whole;
    while (stream.next(whole)) {
    }
    return whole;
  };
  EXPECT_EQ(from_csv(text({}, SetpointFormat::csv)), expected(0, 1000, 1));
  EXPECT_EQ(from_ndjson(text({}, SetpointFormat::ndjson)), expected(0, 1000, 1));
  EXPECT_EQ(from_f64(text({}, SetpointFormat::f64)), expected(0, 1000, 1));
  const json whole = json::parse(text({}, SetpointFormat::json));
  EXPECT_EQ(from_json(whole), expected(0, 1000, 1));
  EXPECT_EQ(whole["independent"], (json{{"name", "phi"}, {"unit", "deg"}, {"step", 0.36}}));
  SetpointQuery chart;
  chart.points = 10;
  EXPECT_EQ(json::parse(text(chart, SetpointFormat::json))["independent"]["step"], 0.36);
  SetpointQuery late;
  late.delay = 0.002;
  EXPECT_THROW(text(late, SetpointFormat::csv), Problem);
  EXPECT_FALSE(json::parse(answer(source, {}, SetpointFormat::json)).contains("independent")) << "it is time";
}

TEST(SetpointStream, RefusesUnknownColumnsAndRowsBeyondTheEnd) {
  const auto fault = [](const SetpointQuery& query) -> std::vector<std::string> {
    Source source{5};
    try {
      SetpointStream stream(source.series(), query, SetpointFormat::json);
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.type().slug, "schema-violation");
      return test::pointers(problem);
    }
    return {};
  };
  SetpointQuery beyond, unknown;
  beyond.first = 6;
  unknown.columns = {"x", "zz"};
  EXPECT_EQ(fault(beyond), std::vector<std::string>{"/query/first"});
  EXPECT_EQ(fault(unknown), std::vector<std::string>{"/query/columns"});
}

}  // namespace
}  // namespace bahnwerk::api
