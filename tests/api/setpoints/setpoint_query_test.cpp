#include <gtest/gtest.h>

#include "api/problem.hpp"
#include "api/setpoints/setpoints.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;
using Pointers = std::vector<std::string>;

Pointers faults(const Pairs& query) {
  try {
    parse_setpoint_query(query);
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.type().slug, "schema-violation");
    return test::pointers(problem);
  }
  return {};
}

TEST(SetpointQuery, ReadsEveryParameter) {
  const auto query = parse_setpoint_query({{"first", "10"}, {"count", "20"}, {"every", "3"}, {"columns", "x,vy"}});
  EXPECT_EQ(query.first, 10u);
  EXPECT_EQ(query.count, 20u);
  EXPECT_EQ(query.every, 3u);
  EXPECT_EQ(query.columns, (Pointers{"x", "vy"}));
  EXPECT_EQ(parse_setpoint_query({{"points", "500"}}).points, 500u);
  EXPECT_EQ(parse_setpoint_query({{"format", "ndjson"}}).format, SetpointFormat::ndjson);
  EXPECT_EQ(parse_setpoint_query({{"layout", "twincat"}}).layout, CsvLayout::twincat);
  EXPECT_EQ(parse_setpoint_query({{"layout", "twincat_poses"}}).layout, CsvLayout::twincat_poses);
  EXPECT_EQ(parse_setpoint_query({{"layout", "codesys_xyva"}}).file_layout, "codesys_xyva");
  EXPECT_EQ(parse_setpoint_query({{"layout", "csv"}}).format, SetpointFormat::csv);
  EXPECT_FALSE(parse_setpoint_query({}).frame);
  EXPECT_EQ(parse_setpoint_query({{"frame", "part"}}).frame, SetpointFrame::part);
  EXPECT_EQ(parse_setpoint_query({{"frame", "base"}}).frame, SetpointFrame::base);
  EXPECT_EQ(parse_setpoint_query({{"layout", "plain"}, {"points", "9"}}).layout, CsvLayout::plain);
  EXPECT_EQ(parse_setpoint_query({{"group", "fine"}}).group, DriveGroup::fine);
  EXPECT_EQ(parse_setpoint_query({{"delay", "0.004"}}).delay, 0.004);
}

TEST(SetpointQuery, DefaultsToEverything) {
  const auto query = parse_setpoint_query({});
  EXPECT_EQ(query.first, 0u);
  EXPECT_EQ(query.every, 1u);
  EXPECT_FALSE(query.count || query.points);
  EXPECT_TRUE(query.columns.empty());
}

TEST(SetpointQuery, RefusesWhatIsNoNaturalNumber) {
  for (const char* text : {"", "-1", "+1", "1.5", "1e3", "x", " 1", "0x10", "99999999999999999999999"})
    for (const char* name : {"first", "count", "every", "points"})
      EXPECT_EQ(faults({{name, text}}), Pointers{std::string("/query/") + name}) << text;
  EXPECT_EQ(faults({{"every", "0"}}), Pointers{"/query/every"});
  EXPECT_EQ(faults({{"points", "0"}}), Pointers{"/query/points"});
  EXPECT_EQ(faults({{"points", "20001"}}), Pointers{"/query/points"});
}

TEST(SetpointQuery, RefusesContradictionsAndStrangers) {
  EXPECT_EQ(faults({{"points", "10"}, {"every", "2"}}), Pointers{"/query/points"});
  for (const char* format : {"", "CSV", "xml"})
    EXPECT_EQ(faults({{"format", format}}), Pointers{"/query/format"}) << format;
  EXPECT_EQ(faults({{"layout", "twincat"}, {"points", "10"}}), Pointers{"/query/layout"});
  EXPECT_EQ(faults({{"layout", "twincat_nc"}, {"first", "3"}}), Pointers{"/query/layout"});
  EXPECT_EQ(faults({{"layout", "csv"}, {"format", "json"}}), Pointers{"/query/format"});
  for (const char* layout : {"", "TwinCAT", "siemens"})
    EXPECT_EQ(faults({{"layout", layout}}), Pointers{"/query/layout"}) << layout;
  for (const char* group : {"", "Coarse", "xc"})
    EXPECT_EQ(faults({{"group", group}}), Pointers{"/query/group"}) << group;
  for (const char* delay : {"", "-0.001", "4 ms", "nan", "61"})
    EXPECT_EQ(faults({{"delay", delay}}), Pointers{"/query/delay"}) << delay;
  EXPECT_EQ(faults({{"offset", "10"}}), Pointers{"/query/offset"});
  EXPECT_EQ(faults({{"a/b", ""}}), Pointers{"/query/a~1b"});
  EXPECT_EQ(faults({{"first", "1"}, {"first", "1"}}), Pointers{"/query/first"});
  for (const char* columns : {"", "x,", ",x", "x,,y", "x,x"})
    EXPECT_EQ(faults({{"columns", columns}}), Pointers{"/query/columns"}) << columns;
  EXPECT_EQ(faults({{"first", "-"}, {"count", "-"}}), (Pointers{"/query/first", "/query/count"}));
}

}  // namespace
}  // namespace bahnwerk::api
