#include "core/plan/winding/wire_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/read_rows.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using winding::Drawing;
using winding::Rate;

constexpr double radians = std::numbers::pi / 180;

ToolJet standing(const ToolPose& pose) {
  ToolJet tool;
  tool.position.value = pose.position;
  tool.phi.value = pose.phi, tool.psi.value = pose.psi;
  return tool;
}

struct Measured {
  double length = 0, bend = 0, brake = 0;
  std::size_t coil = 0;  ///< rows with another one have another wire
};

}  // namespace

WireRun::WireRun(std::shared_ptr<const PosePath> tool, std::vector<winding::Anchor> anchors, const winding::Pull& pull,
                 const winding::TensionModel& model)
    : tool_(std::move(tool)),
      anchors_(std::move(anchors)),
      model_(model),
      bend_radius_(winding::bend_radius(pull)),
      free_length_(pull.free_length) {
  model_.force = pull.force;
  const Path& path = tool_->tool;
  before_.assign(path.size(), 0);
  const auto length = [&](std::size_t i, double u) {
    return wire(i, standing(tool_->orientation->pose(path[i], i, u))).length.value();
  };
  for (std::size_t i = 1; i < path.size(); ++i)
    before_[i] = before_[i - 1] + length(i - 1, path[i - 1].curve().end()) - length(i, path[i].curve().begin());
}

winding::FreeWire WireRun::wire(std::size_t segment, const ToolJet& tool) const {
  const Jet& p = tool.position;
  const auto angle = [](const AngleJet& a) { return Rate::from(a.value, a.d1, a.d2); };
  const auto coordinate = [&](std::size_t k) { return Rate::from(p.value[k], p.d1[k], p.d2[k]); };
  return winding::free_wire({coordinate(0), coordinate(1), coordinate(2), angle(tool.phi), angle(tool.psi)},
                            anchors_[tool_->tool[segment].source()], bend_radius_, free_length_);
}

Drawing WireRun::drawing(std::size_t segment, double u, const LawState& law) const {
  const winding::FreeWire free = wire(segment, tool_->orientation->tool(tool_->tool[segment], segment, u));
  const double slope = free.length.derivative(1);
  return {slope * law.v, free.length.derivative(2) * law.v * law.v + slope * law.a, free.bend.value()};
}

double WireRun::tension(const PathMotion& motion, double from, double to) const {
  if (ideal()) return winding::compensating_brake(model_, {});
  const auto& pieces = motion.law().pieces();
  auto at = [&, piece = std::size_t{0}](double t) mutable {
    piece = motion.law().find(t, piece);
    const LawState law = motion.along(piece, t);
    const std::size_t segment = pieces[piece].segment;
    const Drawing drawn = drawing(segment, tool_->tool[segment].parameter(law.s), law);
    return std::tuple(tool_->tool[segment].source(), drawn, winding::compensating_brake(model_, drawn));
  };
  const auto [source, left, brake] = at(from);
  auto middle = std::get<Drawing>(at(0.5 * (from + to)));
  const auto [next_source, right, next_brake] = at(to);
  const bool other_coil = next_source != source && anchors_[next_source].free;
  if (other_coil || !(to > from))
    middle.acceleration = 0;
  else if (next_source == source)
    middle.acceleration = (right.speed - left.speed) / (to - from);
  return winding::tension(model_, 0.5 * (brake + next_brake), middle);
}

struct WireRows::State {
  using LawAt = std::pair<std::size_t, Drawing>;  ///< piece of the path, and the wire there

  State(const WireRun& wire, const SetpointSource& source, const PathMotion& sampled)
      : run(wire), motion(sampled), path(wire.tool_->tool), rows(source.count()), h(source.cycle_time()) {
    const auto& columns = source.columns();
    const char* const names[] = {"x", "y", "z", "phi", "psi", "s", "brake"};
    for (std::size_t i = 0; i < column.size(); ++i) {
      column[i] = column_index(columns, names[i]);
      if (column[i] == columns.size()) throw std::invalid_argument(std::string("setpoints have no column ") + names[i]);
    }
    figures.least = figures.constant_least = std::numeric_limits<double>::infinity();
  }

  Measured measure(const double* row) {
    segment = path.find(row[column[5]], segment);
    for (; entered < segment; ++entered)
      if (path[entered + 1].source() != path[entered].source() && run.anchors_[path[entered + 1].source()].free) ++coil;
    const ToolPose pose{
        {row[column[0]], row[column[1]], row[column[2]]}, radians * row[column[3]], radians * row[column[4]]};
    const winding::FreeWire free = run.wire(segment, standing(pose));
    return {run.before_[segment] + free.length.value(), free.bend.value(), row[column[6]], coil};
  }

  void evaluate(const Measured& row, const Drawing& drawing, double t) {
    const double now = tension(run.model_, row.brake, drawing),
                 constant = tension(run.model_, run.model_.force, drawing);
    if (!(now <= figures.peak)) figures.peak = now, figures.peak_at = t;
    if (!(now >= figures.least)) figures.least = now, figures.least_at = t;
    figures.constant_peak = std::max(figures.constant_peak, constant);
    figures.constant_least = std::min(figures.constant_least, constant);
    figures.speed = std::max(figures.speed, drawing.speed);
    figures.taken_back = std::max(figures.taken_back, -drawing.speed);
    figures.acceleration = std::max(figures.acceleration, std::abs(drawing.acceleration));
  }

  LawAt law_at(double t) {
    piece = motion.law().find(t, piece);
    const std::size_t at = motion.law().pieces()[piece].segment;
    const LawState law = motion.along(piece, t);
    return {path[at].source(), run.drawing(at, path[at].parameter(law.s), law)};
  }

  // Measures the wire in the middle of the cycle that ends with row k, by the law, with the cycle's mean acceleration:
  // where the wire begins to lie on its bend circle the acceleration itself has a pole that lasts microseconds. Where
  // the wire gets another anchor its speed steps, which only differences of rows see.
  void within(std::size_t k, const Measured& before, const Measured& after) {
    const double t = (static_cast<double>(k) - 0.5) * h;
    if (!left || row_of_left + 1 != k) left = law_at(static_cast<double>(k - 1) * h);
    LawAt middle = law_at(t);
    const LawAt right = law_at(static_cast<double>(k) * h);
    if (left->first == right.first) middle.second.acceleration = (right.second.speed - left->second.speed) / h;
    left = right, row_of_left = k;
    evaluate({0, middle.second.bend, 0.5 * (before.brake + after.brake), after.coil}, middle.second, t);
  }

  void take(std::size_t k, const double* row) {
    std::rotate(last.begin(), last.begin() + 1, last.end());
    last[2] = measure(row);
    if (k == 0 || k + 1 == rows) evaluate(last[2], {0, 0, last[2].bend}, static_cast<double>(k) * h);
    if (k > 0 && last[1].coil == last[2].coil) within(k, last[1], last[2]);
    if (k < 2 || last[0].coil != last[2].coil) return;
    const auto& [a, b, c] = last;
    evaluate(b, {(c.length - a.length) / (2 * h), (c.length - 2 * b.length + a.length) / (h * h), b.bend},
             static_cast<double>(k - 1) * h);
  }

  const WireRun& run;
  const PathMotion& motion;
  const Path& path;
  std::size_t rows;
  double h;  ///< s, a cycle
  std::array<std::size_t, 7> column{};
  std::size_t segment = 0, entered = 0, coil = 0, piece = 0;
  std::optional<LawAt> left;  ///< the wire at row `row_of_left`, as far as it is known
  std::size_t row_of_left = 0;
  std::array<Measured, 3> last{};
  WireFigures figures;
};

WireRows::WireRows(const WireRun& wire, const SetpointSource& setpoints, const PathMotion& motion, double permitted)
    : state_(std::make_unique<State>(wire, setpoints, motion)), permitted_(permitted) {}
WireRows::~WireRows() = default;
void WireRows::row(std::size_t k, const double* row) { state_->take(k, row); }
std::vector<Check> WireRows::checks() { return wire_checks(state_->figures, permitted_); }
const WireFigures& WireRows::figures() const { return state_->figures; }

std::vector<Check> wire_checks(const WireFigures& figures, double permitted) {
  std::vector<Check> checks;
  if (std::isfinite(permitted))
    checks.push_back(verify::make_check({{"wire pull"}, 0, "N"}, permitted, {figures.peak, figures.peak_at}));
  checks.push_back(
      verify::make_check({{"wire slack"}, 0, "N"}, 0, figures.least, figures.least_at, figures.least >= 0));
  return checks;
}

}  // namespace bahnwerk
