#include "core/plan/winding/path_clearance.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>

#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

constexpr double tolerance = 0.001;  // mm

winding::PartObstacles obstacles(const winding::StatorPart& part, const WindingRequest& request, winding::Coil coil) {
  return winding::part_obstacles(part, winding::checked_slot(part), request.tool, {coil});
}
winding::PartObstacles obstacles(const winding::RotorPart& part, const WindingRequest&, winding::Coil) {
  return winding::part_obstacles(part, winding::checked_slot(part));
}

}  // namespace

winding::PartObstacles coil_obstacles(const WindingRequest& request, std::size_t coil) {
  return std::visit([&](const auto& part) { return obstacles(part, request, request.coils[coil]); }, request.part);
}

PathClearance path_clearance(const WindingRequest& request, const std::vector<winding::FixedPiece>& support,
                             const winding::NeedlePath& path, Progress progress) {
  PathClearance nearest;
  nearest.least.minimum = unlimited;
  const std::vector<BezierPiece> curves = path.curves();
  const auto& pieces = path.pieces;
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::size_t coil = coil_of(pieces[begin], support);
    std::size_t end = begin;
    while (end < pieces.size() && coil_of(pieces[end], support) == coil) ++end;
    const winding::PartObstacles all = coil_obstacles(request, coil);
    const auto done = [&](std::size_t piece) {
      return static_cast<double>(piece) / static_cast<double>(pieces.size());
    };
    const Progress clearing = progress.part(done(begin), done(end)).named("clearance");
    winding::Clearance least = winding::clearance(std::span(curves).subspan(begin, end - begin), request.needle,
                                                  all.list(), tolerance, clearing);
    least.move += begin;
    if (least.minimum < nearest.least.minimum)
      nearest.least = least, nearest.nearest = all.list().empty() ? "" : all.name(least.obstacle);
    begin = end;
  }
  return nearest;
}

namespace {

constexpr double curve_tolerance = 0.01, curve_enough = 20;  // mm
constexpr int most_halvings = 3;                             // halvings of a piece

/// Collects the curve: intervals in the order of the path, where pieces are many `together` of them as one.
class CurveBuilder {
 public:
  CurveBuilder(const Path& tool, std::size_t together) : tool_(tool), together_(together) {
    curve_.tolerance = curve_tolerance, curve_.enough = curve_enough;
    curve_.bounds.push_back(0);
  }
  /// Adds the interval that ends at parameter `end` of a piece.
  void add(std::size_t piece, double end, const winding::Clearance& found, const std::string& name) {
    if (open_ == 0 || found.minimum < least_) least_ = found.minimum, nearest_ = number_of(name);
    end_ = length_at(piece, end);
    if (++open_ == together_) close();
  }
  ClearanceCurve take() {
    if (open_ > 0) close();
    return std::move(curve_);
  }

 private:
  void close() {
    curve_.bounds.push_back(end_);
    curve_.least.push_back(least_);
    curve_.nearest.push_back(nearest_);
    open_ = 0;
  }
  std::size_t number_of(const std::string& name) {
    const auto known = std::find(curve_.names.begin(), curve_.names.end(), name);
    const auto number = static_cast<std::size_t>(known - curve_.names.begin());
    if (known == curve_.names.end()) curve_.names.push_back(name);
    return number;
  }
  /// Returns the length at a parameter of a piece; pieces come in their order.
  double length_at(std::size_t piece, double v) {
    while (segment_ + 1 < tool_.size() && (tool_[segment_].source() < piece || tool_[segment_].curve().end() < v) &&
           tool_[segment_ + 1].source() <= piece)
      ++segment_;
    return tool_[segment_].arc_length(std::min(v, tool_[segment_].curve().end()));
  }

  const Path& tool_;
  ClearanceCurve curve_;
  std::size_t together_, open_ = 0, nearest_ = 0, segment_ = 0;
  double least_ = 0, end_ = 0;
};

}  // namespace

ClearanceCurve clearance_curve(const WindingRequest& request, const std::vector<winding::FixedPiece>& support,
                               const winding::NeedlePath& path, const Path& tool, Progress progress) {
  const auto& pieces = path.pieces;
  int halvings = 0;
  while (halvings < most_halvings && (pieces.size() << (halvings + 1)) <= most_clearance_intervals) ++halvings;
  CurveBuilder builder(tool, (pieces.size() + most_clearance_intervals - 1) / most_clearance_intervals);
  std::size_t coil = request.coils.size();
  winding::PartObstacles all;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (const std::size_t next = coil_of(pieces[i], support); next != coil)
      coil = next, all = coil_obstacles(request, coil);
    const auto done = [&](std::size_t piece) {
      return static_cast<double>(piece) / static_cast<double>(pieces.size());
    };
    const Progress clearing = progress.part(done(i), done(i + 1)).named("clearance");
    const std::vector<winding::Clearance> found = winding::clearance_in_intervals(
        pieces[i].curve, halvings, request.needle, all.list(), {curve_enough, curve_tolerance}, clearing);
    for (std::size_t k = 0; k < found.size(); ++k)
      builder.add(i, static_cast<double>(k + 1) / static_cast<double>(found.size()), found[k],
                  all.name(found[k].obstacle));
  }
  return builder.take();
}

}  // namespace bahnwerk
