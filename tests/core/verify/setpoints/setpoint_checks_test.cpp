// Rows of setpoints with one thing changed: the check that names it fails, and nothing else does.
#include "core/verify/setpoints/setpoint_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/setpoints/contour_setpoints.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "core/verify/verifier.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/motion/setpoints/slowed.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::machine;
using reference::Maker;
using test::slowed;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Columns of a plane contour.
enum { X, Y, VX, VY, AX, AY, S, V, MODE, BLOCK, WIDTH };

/// Passes rows on, each of them edited; and some other things that may be wrong.
struct Tampered final : SetpointSource {
  explicit Tampered(const SetpointSource& source) : source_(source), columns_(source.columns()) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return source_.count() + more - dropped; }
  double cycle_time() const override { return source_.cycle_time() * slower; }
  double duration() const override { return source_.duration(); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k, out += columns_.size()) {
      const std::size_t from = dropped && k >= dropped_row ? k + 1 : k;
      source_.read(std::min(from, source_.count() - 1), 1, out);
      if (edit) edit(k, out);
    }
  }
  std::function<void(std::size_t, double*)> edit;
  std::size_t more = 0, dropped = 0, dropped_row = 0;
  double slower = 1;

 private:
  const SetpointSource& source_;

 public:
  std::vector<Column> columns_;
};

struct SetpointChecks : testing::Test {
  Contour contour = Maker()
                        .block(300)
                        .line({50, 0})
                        .arc({60, 10}, {50, 10}, true)
                        .block(unlimited)
                        .bezier({{60, 30}, {80, 20}, {90, 40}})
                        .block(0.5)
                        .line({91, 42})
                        .done();
  Machine m = machine(2, 1800, 16000);
  std::shared_ptr<const PathMotion> motion;
  std::unique_ptr<ContourSetpoints> rows;
  std::size_t last = 0;

  void SetUp() override {
    contour.blocks[1].mode = Mode::position;
    Progress progress;
    const TimeLaw law = plan_acceleration_limited(contour, m, {}, progress).law;
    const Cycles cycles = whole_cycles(law.duration(), m.cycle_time);
    motion = slowed(contour, m, law, cycles);
    rows = std::make_unique<ContourSetpoints>(motion, contour, m, cycles.count);
    last = cycles.count;
  }
  std::vector<Check> checked(const SetpointSource& source) const {
    Progress progress;
    return setpoint_checks({motion->path(), m, motion->law(), source, &contour}, progress);
  }
  /// Exactly these checks fail.
  void expect_failed(const SetpointSource& source, const std::vector<std::string>& names) const {
    for (const Check& c : checked(source)) {
      const bool expected = std::find(names.begin(), names.end(), check_name(c)) != names.end();
      EXPECT_EQ(!c.passed, expected) << check_name(c) << ' ' << c.value << " against " << c.limit << " at " << c.at;
    }
  }
  /// Names of the checks that fail, each followed by a semicolon.
  std::string failed(const SetpointSource& source) const {
    std::string list;
    for (const Check& c : checked(source))
      if (!c.passed) list += check_name(c) + ";";
    return list;
  }
  std::string failed(const std::function<void(std::size_t, double*)>& edit) const {
    Tampered source(*rows);
    source.edit = edit;
    return failed(source);
  }
  void expect_failed(const std::function<void(std::size_t, double*)>& edit,
                     const std::vector<std::string>& names) const {
    Tampered source(*rows);
    source.edit = edit;
    expect_failed(source, names);
  }
  /// A row of the first line, the arc and the curve.
  std::vector<std::size_t> some() const {
    std::vector<double> all((last + 1) * WIDTH);
    rows->read(0, last + 1, all.data());
    std::vector<std::size_t> list;
    for (const double s : {30.0, 55.0, 80.0})
      for (std::size_t k = 0; k <= last; ++k)
        if (all[k * WIDTH + S] > s) {
          list.push_back(k);
          break;
        }
    return list;
  }
};

TEST_F(SetpointChecks, ServedRowsPass) {
  ASSERT_GT(last, 4000u);
  expect_failed(*rows, {});
  EXPECT_EQ(checked(*rows).size(), 11u);
}

TEST_F(SetpointChecks, OneValueOfOneRow) {
  for (const std::size_t k : some()) {
    SCOPED_TRACE(k);
    const auto shift = [k](int column, double by) {
      return [=](std::size_t row, double* out) {
        if (row == k) out[column] += by;
      };
    };
    for (const int column : {X, Y}) {
      expect_failed(shift(column, 1e-11), {"setpoints position"});
      expect_failed(shift(column, -1e-11), {"setpoints position"});
    }
    for (const int column : {VX, VY}) expect_failed(shift(column, 1e-10), {"setpoints velocity"});
    for (const int column : {AX, AY}) expect_failed(shift(column, 1e-7), {"setpoints acceleration"});
    EXPECT_EQ(failed(shift(S, 1e-9)).substr(0, 15), "setpoints path;");
    EXPECT_EQ(failed(shift(V, 1e-9)).substr(0, 35), "setpoints speed;setpoints velocity;");
    expect_failed(shift(MODE, 1), {"setpoints mode and block"});
    expect_failed(shift(BLOCK, 1), {"setpoints mode and block"});
    for (int column = 0; column < WIDTH; ++column) {
      Tampered source(*rows);
      source.edit = shift(column, std::numeric_limits<double>::quiet_NaN());
      const auto checks = checked(source);
      EXPECT_TRUE(std::any_of(checks.begin(), checks.end(), [](const Check& c) { return !c.passed; })) << column;
    }
  }
}

/// Just above what rounding explains, and just below.
TEST_F(SetpointChecks, TolerancesAreThoseOfRounding) {
  const std::size_t k = some()[0];  // on a line at constant speed
  const double t = static_cast<double>(k) * m.cycle_time;
  const auto shifted = [&](int column, double by) {
    Tampered source(*rows);
    source.edit = [=](std::size_t row, double* out) {
      if (row == k) out[column] += by;
    };
    return checked(source);
  };
  const auto find = [](const std::vector<Check>& list, const std::string& name) {
    return *std::find_if(list.begin(), list.end(), [&](const Check& c) { return check_name(c) == name; });
  };
  const double place = 32 * eps * (30 + 50), quick = 32 * eps * 300;
  EXPECT_TRUE(find(shifted(X, 0.9 * place), "setpoints position").passed);
  EXPECT_FALSE(find(shifted(X, 1.2 * place), "setpoints position").passed);
  EXPECT_NEAR(find(shifted(X, 1.2 * place), "setpoints position").at, t, 1e-12);
  EXPECT_TRUE(find(shifted(VX, 0.9 * quick), "setpoints velocity").passed);
  EXPECT_FALSE(find(shifted(VX, 1.2 * quick), "setpoints velocity").passed);
  EXPECT_FALSE(find(shifted(V, 1.2 * quick), "setpoints speed").passed);
}

TEST_F(SetpointChecks, ARowTooFewTooManyOrTwice) {
  const std::size_t k = some()[1];
  Tampered dropped(*rows);
  dropped.dropped = 1, dropped.dropped_row = k;
  EXPECT_NE(failed(dropped).find("setpoints count;setpoints time;setpoints path"), std::string::npos)
      << failed(dropped);
  Tampered more(*rows);
  more.more = 1;
  EXPECT_NE(failed(more).find("setpoints count;setpoints time;"), std::string::npos) << failed(more);
  Tampered slower(*rows);
  slower.slower = 1 + 1e-12;
  EXPECT_EQ(failed(slower), "setpoints time;");
  std::vector<double> before(WIDTH);
  rows->read(k - 1, 1, before.data());
  expect_failed(
      [&](std::size_t row, double* out) {
        if (row == k) std::copy(before.begin(), before.end(), out);
      },
      {"setpoints path"});
  rows->read(k - 2, 1, before.data());
  expect_failed(
      [&](std::size_t row, double* out) {
        if (row == k) std::copy(before.begin(), before.end(), out);
      },
      {"setpoints path", "setpoints forward"});
}

TEST_F(SetpointChecks, TheLastRowIsAtRestAtTheEnd) {
  const auto shift = [this](int column, double by) {
    return [=, this](std::size_t row, double* out) {
      if (row == last) out[column] += by;
    };
  };
  for (const int column : {X, Y, S}) expect_failed(shift(column, 1e-13), {"setpoints end"});
  for (const int column : {VX, VY, V, AX, AY}) expect_failed(shift(column, 1e-300), {"setpoints end at rest"});
  expect_failed(shift(BLOCK, -1), {"setpoints mode and block"});
}

TEST_F(SetpointChecks, AColumnThatIsMissing) {
  Tampered source(*rows);
  source.columns_[BLOCK].name = "blocks";
  const auto checks = checked(source);
  EXPECT_EQ(check_name(checks[0]), "setpoints count");
  EXPECT_FALSE(checks[0].passed);
  EXPECT_EQ(checks[0].value, 1);
}

TEST_F(SetpointChecks, StopsWhenAskedAndReportsOften) {
  struct Watching final : ProgressSink {
    void report(std::string_view, double fraction, std::string_view) override {
      EXPECT_GE(fraction, 0.5);
      EXPECT_LE(fraction, 0.75);
      if (++calls == stop) throw Stopped(StopReason::cancelled);
    }
    int calls = 0, stop = 1000;
  };
  Watching watching;
  setpoint_checks({motion->path(), m, motion->law(), *rows, &contour}, Progress(watching).part(0.5, 0.75));
  EXPECT_GE(watching.calls, static_cast<int>(last / 8192) + 2);
  Watching stopping;
  stopping.stop = 2;
  EXPECT_THROW(setpoint_checks({motion->path(), m, motion->law(), *rows, &contour}, Progress(stopping).part(0.5, 0.75)),
               Stopped);
}

TEST_F(SetpointChecks, RestIsAMotion) {
  // 0.25 s of rest between two lines, and at the end.
  const Contour corner = Maker().block(400).line({40, 0}).block(200).line({40, 30}).done();
  TimeLaw law = reference::law_through(corner.path, {{0, 0}, {20, 400}, {40, 0}});
  law.append({0, 0.25, 40, 40, 0, 0, 0, 1});
  const TimeLaw second = reference::law_through(corner.path, {{40, 0}, {55, 200}, {70, 0}});
  for (const LawPiece& p : second.pieces()) law.append(p);
  law.append({0, 0.125, 70, 70, 0, 0, 0, 1});
  const Cycles cycles = whole_cycles(law.duration(), m.cycle_time);
  const auto dwelling = slowed(corner, m, law, cycles);
  const ContourSetpoints source(dwelling, corner, m, cycles.count);
  Progress progress;
  for (const Check& c : setpoint_checks({dwelling->path(), m, dwelling->law(), source, &corner}, progress))
    EXPECT_TRUE(c.passed) << check_name(c) << ' ' << c.value << " against " << c.limit << " at " << c.at;
  const Verification v = verify_motion({corner, m, dwelling->law(), 1e-3}, progress);
  for (const Check& c : v.checks)
    EXPECT_TRUE(c.passed) << check_name(c) << ' ' << c.value << " against " << c.limit << " at " << c.at;
}

TEST(BoundCheck, FailsAPlanThatIsTooShort) {
  const Bound bound{2, 0, ""};
  EXPECT_EQ(check_name(bound_check(bound, 2.5)), "bound");
  EXPECT_TRUE(bound_check(bound, 2.5).passed);
  EXPECT_TRUE(bound_check(bound, 2).passed);
  EXPECT_TRUE(bound_check(bound, 2 * (1 - 5e-10)).passed);
  EXPECT_FALSE(bound_check(bound, 2 * (1 - 2e-9)).passed);
  EXPECT_FALSE(bound_check(bound, 0).passed);
  EXPECT_FALSE(bound_check(bound, std::numeric_limits<double>::quiet_NaN()).passed);
}

}  // namespace
}  // namespace bahnwerk
