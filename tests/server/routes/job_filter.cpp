#include "server/routes/job_filter.hpp"

#include <gtest/gtest.h>

#include "api/problem.hpp"

namespace bahnwerk::server {
namespace {

TEST(JobFilter, ReadsWhatAnAddressSays) {
  const JobFilter filter = parse_filter({{"state", "failed"},
                                         {"kind", "contour"},
                                         {"reference", "WO-1"},
                                         {"tag", "a"},
                                         {"text", "br"},
                                         {"sort", "oldest"},
                                         {"created_after", "1970-01-01T00:00:01Z"},
                                         {"before", "1970-01-01T00:00:02Z"},
                                         {"limit", "7"},
                                         {"cursor", "01900000-0000-7000-8000-000000000000"}});
  EXPECT_EQ(filter.state, api::JobState::failed);
  EXPECT_EQ(filter.kind, "contour");
  EXPECT_EQ(filter.reference, "WO-1");
  EXPECT_EQ(filter.tag, "a");
  EXPECT_EQ(filter.text, "br");
  EXPECT_TRUE(filter.oldest_first);
  EXPECT_EQ(filter.created_after, 1000);
  EXPECT_EQ(filter.created_before, 2000);
  EXPECT_EQ(filter.limit, 7U);
  EXPECT_EQ(filter.before, "01900000-0000-7000-8000-000000000000");
}

TEST(JobFilter, RefusesWhatItDoesNotUnderstandAndNamesTheParameter) {
  const Pairs faults{{"state", "lost"}, {"sort", "name"}, {"created_after", "monday"}, {"limit", "0"},
                     {"limit", "201"},  {"limit", "1x"},  {"cursor", "next"},          {"text", ""}};
  for (const auto& fault : faults) {
    try {
      parse_filter({fault});
      ADD_FAILURE() << fault.first;
    } catch (const api::Problem& problem) {
      EXPECT_EQ(problem.type().slug, "schema-violation");
      EXPECT_EQ(problem.errors().at(0).pointer, "/query/" + fault.first);
    }
  }
}

}  // namespace
}  // namespace bahnwerk::server
