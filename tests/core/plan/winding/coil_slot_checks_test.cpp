#include "core/verify/setpoints/coil_slot_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/plan/winding/coil_passes.hpp"
#include "tests/core/plan/winding/winding_plans.hpp"

namespace bahnwerk {
namespace {

std::string failed(CoilSlotInput input) {
  Progress progress;
  std::string names;
  for (const Check& check : coil_slot_checks(std::move(input), progress))
    if (!check.passed) names += (names.empty() ? "" : ", ") + check_name(check);
  return names;
}

/// Rows of another source, turned about the part's axis, or shifted along it.
class Moved final : public SetpointSource {
 public:
  Moved(const SetpointSource& source, double turn, double shift, double last = 1)
      : source_(source), turn_(turn), shift_(shift), last_(last) {}
  const std::vector<Column>& columns() const override { return source_.columns(); }
  std::size_t count() const override { return static_cast<std::size_t>(last_ * static_cast<double>(source_.count())); }
  double cycle_time() const override { return source_.cycle_time(); }
  double duration() const override { return source_.duration(); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    source_.read(first, rows, out);
    const std::size_t width = columns().size(), x = column("x"), y = column("y"), z = column("z"), phi = column("phi");
    const double c = std::cos(turn_), s = std::sin(turn_);
    for (double* row = out; row != out + rows * width; row += width) {
      const double old = row[x];
      row[x] = c * old - s * row[y], row[y] = s * old + c * row[y];
      row[z] += shift_, row[phi] += turn_ * 180 / std::numbers::pi;
    }
  }

 private:
  std::size_t column(const char* name) const {
    std::size_t i = 0;
    while (columns()[i].name != name) ++i;
    return i;
  }
  const SetpointSource& source_;
  double turn_, shift_, last_;
};

/// A plan with quick rows of few cycles, which are looked at between, too.
WindingRequest quick(WindingRequest request) {
  request.feed = PlanningMethod::critical_points, request.cycle_time = 0.004;
  return request;
}
CoilSlotInput with(CoilSlotInput input, const SetpointSource& rows) {
  return {input.path, rows, input.low, input.high, input.edge, input.outside, input.needle_length, input.passes};
}

TEST(CoilSlotChecks, CoilsInTheirSlotsPass) {
  for (const bool stator : {true, false})
    for (const bool backwards : {false, true}) {
      WindingRequest r = quick(stator ? stator_request(2) : rotor_request(2));
      if (backwards) r.coils = {reversed(r.coils.front())};
      r.coils = winding::repeated(r.coils.front(), stator ? 48 : 6, stator ? 12 : 2, 2, true);
      const WindingPlan p = planned(r);
      EXPECT_EQ(failed(coil_passes(r, p, *p.motion.setpoints)), "") << stator << backwards;
    }
}

// A link from the last turn of a coil may dip into the slot above which it begins.
TEST(CoilSlotChecks, ADipIntoASlotOfTheCoilPasses) {
  WindingRequest r = quick(rotor_request(1));
  r.model.change_radius = r.model.change_height = 0;
  r.coils = winding::repeated(r.coils.front(), 6, 2, 3, false);
  const WindingPlan p = planned(r);
  EXPECT_EQ(failed(coil_passes(r, p, *p.motion.setpoints)), "");
}

TEST(CoilSlotChecks, AnotherSlotOfTheDocumentFails) {
  for (const bool stator : {true, false}) {
    const WindingRequest r = quick(stator ? stator_request(1) : rotor_request(1));
    const WindingPlan p = planned(r);
    for (const int aside : {-1, 1}) {
      WindingRequest other = r;
      other.coils.front().first += aside;
      EXPECT_NE(failed(coil_passes(other, p, *p.motion.setpoints)), "") << stator << aside;
    }
    WindingRequest other = r;
    other.coils = {reversed(r.coils.front())};
    EXPECT_NE(failed(coil_passes(other, p, *p.motion.setpoints)).find("passes of coil slots"), std::string::npos)
        << "down and up are exchanged";
  }
}

TEST(CoilSlotChecks, ANeedleInTheNeighbouringSlotFails) {
  for (const bool stator : {true, false}) {
    const WindingRequest r = quick(stator ? stator_request(1) : rotor_request(1));
    const WindingPlan p = planned(r);
    const CoilSlotInput right = coil_passes(r, p, *p.motion.setpoints);
    const double pitch = 2 * right.passes.front().slot.half;
    for (const double turn : {-pitch, -0.7 * pitch, 0.7 * pitch, pitch})
      // Beside a rotor's pole the neighbouring slot may be the coil's other one.
      if (stator) {
        EXPECT_EQ(failed(with(right, Moved(*p.motion.setpoints, turn, 0))), "needle outside coil slots") << turn;
      } else {
        EXPECT_NE(failed(with(right, Moved(*p.motion.setpoints, turn, 0))), "") << turn;
      }
  }
}

TEST(CoilSlotChecks, WiresOutsideTheirPlacesFail) {
  for (const bool stator : {true, false}) {
    const WindingRequest r = quick(stator ? stator_request(1) : rotor_request(1));
    const WindingPlan p = planned(r);
    const CoilSlotInput right = coil_passes(r, p, *p.motion.setpoints);
    CoilSlotInput shallow = right;
    Vec& place = shallow.passes[1].wire_out;
    const double factor = (stator ? 0.999 : 1.001) * right.edge / std::hypot(place.x, place.y);
    place.x *= factor, place.y *= factor;
    EXPECT_EQ(failed(shallow), "wire outside coil slots") << stator;
    if (stator) continue;
    // At the neighbouring pole, in the same slot.
    CoilSlotInput across = right;
    for (Vec* wire : {&across.passes[0].wire_in, &across.passes[0].wire_out}) {
      const double turn = 2 * (across.passes[0].slot.middle - std::atan2(wire->y, wire->x)), x = wire->x;
      wire->x = std::cos(turn) * x - std::sin(turn) * wire->y, wire->y = std::sin(turn) * x + std::cos(turn) * wire->y;
    }
    EXPECT_EQ(failed(across), "wire outside coil slots");
  }
}

TEST(CoilSlotChecks, EveryPassIsNeeded) {
  const WindingRequest r = quick(stator_request(2));
  const WindingPlan p = planned(r);
  const CoilSlotInput right = coil_passes(r, p, *p.motion.setpoints);
  ASSERT_EQ(right.passes.size(), 4u);
  EXPECT_EQ(failed(with(right, Moved(*p.motion.setpoints, 0, 0, 0.5))), "passes of coil slots");
  EXPECT_EQ(failed(with(right, Moved(*p.motion.setpoints, 0, 1000))), "passes of coil slots");
  CoilSlotInput fewer = right;
  fewer.passes.resize(2);
  EXPECT_EQ(failed(fewer), "passes of coil slots");
}

TEST(CoilSlotChecks, RowsWithoutNumbersOrColumnsFail) {
  const WindingRequest r = quick(stator_request(1));
  const WindingPlan p = planned(r);
  const CoilSlotInput right = coil_passes(r, p, *p.motion.setpoints);
  EXPECT_NE(failed(with(right, Moved(*p.motion.setpoints, 0, std::nan("")))).find("needle outside coil slots"),
            std::string::npos);
  struct Bare final : SetpointSource {
    std::vector<Column> none{{"x", "mm"}};
    const std::vector<Column>& columns() const override { return none; }
    std::size_t count() const override { return 1; }
    double cycle_time() const override { return 1; }
    double duration() const override { return 0; }
    void read(std::size_t, std::size_t, double* out) const override { *out = 0; }
  } bare;
  EXPECT_EQ(failed(with(right, bare)), "passes of coil slots");
}

}  // namespace
}  // namespace bahnwerk
