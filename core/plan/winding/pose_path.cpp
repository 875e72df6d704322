#include "core/plan/winding/pose_path.hpp"

#include <cstddef>
#include <utility>

#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {
namespace {

struct Curves {
  std::shared_ptr<const Curve> place, angles;
};

Curves curves(const BezierPiece& piece) {
  std::vector<Vec> places, angles;
  std::vector<double> weights;
  bool even = true;
  for (const HomogeneousPoint& homogeneous : piece.points()) {
    const SplinePoint p = projected(homogeneous);
    places.push_back({p[0], p[1], p[2]});
    angles.push_back({p[3], p[4], 0});
    weights.push_back(homogeneous[spline_dimension]);
    even = even && weights.back() == weights.front();
  }
  if (even && piece.degree() == 1)
    return {std::make_shared<Line>(places[0], places[1]), std::make_shared<Line>(angles[0], angles[1])};
  if (even) weights.clear();
  return {std::make_shared<Rational>(Rational::bezier(places, weights)),
          std::make_shared<Rational>(Rational::bezier(angles, weights))};
}

}  // namespace

PosePath pose_path(const std::vector<BezierPiece>& pieces) {
  PosePath path;
  std::vector<std::shared_ptr<const Curve>> angles;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Curves both = curves(pieces[i]);
    path.tool.append(both.place, i);
    while (angles.size() < path.tool.size()) angles.push_back(both.angles);
  }
  path.orientation = std::make_shared<const Orientation>(path.tool, std::move(angles));
  return path;
}

}  // namespace bahnwerk
