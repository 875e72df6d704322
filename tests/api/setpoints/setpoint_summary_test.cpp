#include "api/setpoints/setpoint_summary.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::api {
namespace {

class Table final : public SetpointSource {
 public:
  explicit Table(Independent over) : over_(std::move(over)) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return 5; }
  double cycle_time() const override { return 0.25; }
  Independent independent() const override { return over_; }
  double duration() const override { return 1; }
  void read(std::size_t, std::size_t, double*) const override {}

 private:
  Independent over_;
  std::vector<Column> columns_{{"x", "mm"}, {"vx", "mm/s"}};
};

TEST(SetpointSummary, SeriesOverTimeHasItsCycleAndItsColumns) {
  EXPECT_EQ(
      setpoint_summary(Table({"time", "s", 0.25})).dump(),
      R"({"count":5,"duration":1.0,"cycle_time":0.25,"columns":[{"name":"x","unit":"mm"},{"name":"vx","unit":"mm/s"}]})");
}

TEST(SetpointSummary, SeriesOverAnythingElseSaysOverWhat) {
  const auto summary = setpoint_summary(Table({"master", "deg", 1.5}));
  EXPECT_EQ(summary["independent"].dump(), R"({"name":"master","unit":"deg","step":1.5})");
}

}  // namespace
}  // namespace bahnwerk::api
