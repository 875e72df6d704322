#include "core/winding/centre_borders.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/geometry/region/crossings.hpp"
#include "core/winding/margin.hpp"

namespace bahnwerk::winding {

CentreBorders centre_borders(const Region& usable_area, double radius, Progress progress) {
  CentreBorders found;
  if (usable_area.empty()) return found;
  const std::vector<Edge> edges = usable_area.parallels(radius);
  std::size_t asked = 0;
  const auto inside = [&](Point p) {
    if (++asked % 512 == 0) progress.report("borders", 0);
    return usable_area.distance(p) >= radius - fit_margin;
  };
  const auto corner = [&](Point p) {
    if (inside(p)) found.corners.push_back(p);
  };
  // An arc with the wire's own radius shrinks to its centre.
  for (const Edge& edge : usable_area.edges())
    if (!edge.straight() && edge.turn > 0 && std::abs(edge.radius - radius) <= fit_margin) corner(edge.centre);
  std::vector<std::vector<double>> cuts(edges.size(), {0, 1});
  for (const Edge& edge : edges) {
    corner(edge.from);  // edges that join all but smoothly may lose their crossing in rounding
    corner(edge.to);
  }
  const auto cut = [&](std::size_t i, std::size_t k, const Meeting& m) {
    corner(edges[i].at(m.first));
    cuts[i].push_back(m.first);
    cuts[k].push_back(m.second);
  };
  each_meeting(edges, cut,
               edges.size() < many_edges ? std::vector<Box>{} : usable_area.reached(edges, radius, progress));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    std::sort(cuts[i].begin(), cuts[i].end());
    for (std::size_t k = 1; k < cuts[i].size(); ++k) {
      const double from = cuts[i][k - 1], to = cuts[i][k];
      if ((to - from) * edges[i].length() > fit_margin && inside(edges[i].at((from + to) / 2)))
        found.pieces.push_back(edges[i].part(from, to));
    }
  }
  return found;
}

CentreBorders exact_fits(const CentreBorders& borders, const Region& centres, Progress progress) {
  std::size_t asked = 0;
  const auto bounds = [&](Point p) {
    if (++asked % 512 == 0) progress.report("borders", 0);
    return !centres.empty() && std::abs(centres.distance(p)) <= 2 * fit_margin;
  };
  CentreBorders left;
  for (const Edge& piece : borders.pieces)
    if (!bounds(piece.at(0.5))) left.pieces.push_back(piece);
  for (const Point corner : borders.corners) {
    const bool known = bounds(corner) || std::any_of(left.pieces.begin(), left.pieces.end(), [&](const Edge& piece) {
                         return distance(piece.at(piece.nearest(corner)), corner) <= 2 * fit_margin;
                       });
    if (!known) left.corners.push_back(corner);
  }
  return left;
}

}  // namespace bahnwerk::winding
