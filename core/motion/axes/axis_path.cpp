#include "core/motion/axes/axis_path.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/errors.hpp"

namespace bahnwerk {

void AxisPath::write_at(std::size_t segment, double s, double* out) const {
  const AxisJet q = at(segment, s);
  for (const AxisArray* row : {&q.value, &q.d1, &q.d2, &q.d3})
    for (std::size_t k = 0; k < axes_; ++k) *out++ = (*row)[k];
}

void AxisPath::write_row(PathBatch& batch, std::size_t i, const AxisJet& q) const {
  for (std::size_t k = 0; k < axes_; ++k)
    batch.d1[k].set(i, q.d1[k]), batch.d2[k].set(i, q.d2[k]), batch.d3[k].set(i, q.d3[k]);
}

MapBounds AxisPath::every_axis_moves() const {
  MapBounds bounds;
  for (std::size_t k = 0; k < axes_; ++k) bounds.order[0][k] = 1;
  return bounds;
}

CartesianAxisPath::CartesianAxisPath(std::shared_ptr<const Path> tool, std::size_t axes, double height)
    : AxisPath(std::move(tool), std::min<std::size_t>(axes, 3), true), height_(height) {}

AxisJet CartesianAxisPath::axes_at(const PathPoint& p) const {
  AxisJet q;
  for (std::size_t k = 0; k < axes(); ++k)
    q.value[k] = p.value[k], q.d1[k] = p.d1[k], q.d2[k] = p.d2[k], q.d3[k] = p.d3[k];
  if (axes() == 3) q.value[2] += height_;
  return q;
}

namespace {
template <std::size_t n>
void write(const PathPoint& p, double* out) {
  for (std::size_t k = 0; k < n; ++k)
    out[k] = p.value[k], out[n + k] = p.d1[k], out[2 * n + k] = p.d2[k], out[3 * n + k] = p.d3[k];
}
}  // namespace

void CartesianAxisPath::write_at(std::size_t segment, double s, double* out) const {
  const PathPoint p = tool()[segment].at(s);
  if (axes() == 1) return write<1>(p, out);
  if (axes() == 2) return write<2>(p, out);
  write<3>(p, out);
  out[2] += height_;
}

MapBounds CartesianAxisPath::map_bounds(std::size_t, double, double) const {
  MapBounds bounds;
  for (std::size_t k = 0; k < axes(); ++k) bounds.order[0][k] = 1;
  return bounds;
}

KinematicAxisPath::KinematicAxisPath(std::shared_ptr<const Path> tool, std::shared_ptr<const Kinematics> kinematics,
                                     std::shared_ptr<const Orientation> orientation)
    : AxisPath(std::move(tool), kinematics->axes().size(), false),
      shared_kinematics_(std::move(kinematics)),
      kinematics_(*shared_kinematics_),
      orientation_(std::move(orientation)),
      discs_(this->tool(), orientation_),
      turns_(*this) {}

AxisJet KinematicAxisPath::raw_at_parameter(std::size_t segment, double u) const {
  const Segment& here = tool()[segment];
  try {
    return kinematics_.inverse(tool_jet(segment, u));
  } catch (const UnreachablePose& e) {
    throw UnreachablePose(e.what(), here.arc_length(u), e.pose);  // the place on the path is known here only
  }
}

AxisJet KinematicAxisPath::at_parameter(std::size_t segment, double u) const {
  AxisJet q = raw_at_parameter(segment, u);
  turns_.add(segment, u, q.value);
  return q;
}

ToolPose KinematicAxisPath::pose(std::size_t segment, double u) const {
  if (orientation_) return orientation_->pose(tool()[segment], segment, u);
  return {tool()[segment].curve().at(u).value};
}

ToolJet KinematicAxisPath::tool_jet(std::size_t segment, double u) const {
  if (orientation_) return orientation_->tool(tool()[segment], segment, u);
  return {tool()[segment].at_parameter(u), {}, {}};
}

double KinematicAxisPath::pose_turn(std::size_t segment, double u, double radius) const {
  const double lever = kinematics_.lever();
  return orientation_ && lever > 0 ? lever * orientation_->turn_within(segment, u, radius) : 0;
}

bool KinematicAxisPath::enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const {
  ToolDiscs tool;
  return discs_.enclose(this->tool()[segment], segment, u, radius, tool) && kinematics_.enclose(tool, axes);
}

void KinematicAxisPath::at_parameters(std::size_t segment, PathBatch& batch) const {
  batch.close();
  batch.planar = false;
  tool()[segment].travelled(batch);
  AxisJet q;
  for (std::size_t i = 0; i < batch.count; ++i)
    write_row(batch, i, q = raw_at_parameter(segment, batch.u[i]));  // positions are not needed
  if (batch.count % 2 == 1) write_row(batch, batch.count, q);
}

AxisArray largest_rates(const AxisPath& path, ProgressScope* progress) {
  constexpr double rounding = 1e-12,
                   surely = 1e-3;  // largest relative rate that is rounding; smallest rate that is not, unit/mm
  constexpr std::array inner{0.1178, 0.3451, 0.6373,
                             0.8682};  // places inside a panel, as an axis may rest at both ends
  AxisArray most{}, between{}, possible{};
  const auto all = [&](const auto& look) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const std::vector<double> panels = path[i].panel_parameters();
      look(i, panels.front(), most);
      for (std::size_t p = 1; p < panels.size(); ++p) {
        for (const double x : inner) look(i, panels[p - 1] + x * (panels[p] - panels[p - 1]), between);
        look(i, panels[p], most);
      }
    }
  };
  all([&](std::size_t i, double u, AxisArray& rates) {
    if (progress) progress->work(16);
    const AxisJet q = path.at_parameter(i, u);
    for (std::size_t k = 0; k < path.axes(); ++k) rates[k] = std::max(rates[k], std::abs(q.d1[k]));
  });
  // An axis may be slow at both ends of a panel and quick inside, as those that follow a straight tool path smoothly.
  constexpr double usual = 1.1;
  for (std::size_t k = 0; k < path.axes(); ++k)
    if (between[k] > usual * most[k] && most[k] > surely) most[k] = between[k];
  // No map lets an axis move so much that this would be rounding.
  const auto moves = [&](double rate) { return rate > surely; };
  if (std::all_of(most.begin(), most.begin() + static_cast<std::ptrdiff_t>(path.axes()), moves)) return most;
  all([&](std::size_t i, double u, AxisArray&) {
    if (progress) progress->work(16);
    const MapBounds map = path.map_bounds(i, u, 0);
    for (std::size_t k = 0; k < path.axes(); ++k) possible[k] = std::max(possible[k], map.order[0][k]);
  });
  for (std::size_t k = 0; k < path.axes(); ++k) {
    if (most[k] <= rounding * possible[k]) most[k] = between[k];
    if (most[k] <= rounding * possible[k]) most[k] = 0;
  }
  return most;
}

}  // namespace bahnwerk
