#include "api/verification.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "api/setpoints/setpoint_summary.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

TEST(BoundDocument, NamesWhatIsBounded) {
  EXPECT_EQ(bound({2, 0.5, "a"}).dump(), R"({"duration":2.0,"gap":0.5,"basis":"a"})");
  EXPECT_EQ(bound({12, 0.25, "b", BoundQuantity::count, BoundSense::upper, "1"}).dump(),
            R"({"count":12,"gap":0.25,"basis":"b"})");
  EXPECT_EQ(bound({4.5, 0, "c", BoundQuantity::objective, BoundSense::lower, "1"}).dump(),
            R"({"objective":4.5,"gap":0.0,"basis":"c"})");
}

struct Table final : SetpointSource {
  explicit Table(bool over_time) : over_time_(over_time) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return 5; }
  double cycle_time() const override { return 0.125; }
  double duration() const override { return 0.5; }
  Independent independent() const override {
    return over_time_ ? SetpointSource::independent() : Independent{"phi", "deg", 90};
  }
  void read(std::size_t, std::size_t, double*) const override {}

 private:
  bool over_time_;
  std::vector<Column> columns_{{"s", "mm"}};
};

TEST(SetpointSummary, TellsTheIndependentVariableWhereItIsNotTime) {
  EXPECT_EQ(setpoint_summary(Table(true)).dump(),
            R"({"count":5,"duration":0.5,"cycle_time":0.125,"columns":[{"name":"s","unit":"mm"}]})");
  EXPECT_EQ(setpoint_summary(Table(false)).dump(),
            R"({"count":5,"duration":0.5,"cycle_time":0.125,"independent":{"name":"phi","unit":"deg","step":90.0},)"
            R"("columns":[{"name":"s","unit":"mm"}]})");
}

}  // namespace
}  // namespace bahnwerk::api
