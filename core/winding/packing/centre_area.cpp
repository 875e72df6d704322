#include "core/winding/packing/centre_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/progress.hpp"
#include "core/winding/centre_borders.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double cells = 4096;
constexpr double on_line = 1e-10;  // mm, a point this near to a line lies on it

}  // namespace

CentreArea::CentreArea(const Region& usable_area, double radius, Progress progress)
    : region_(usable_area.inward(radius, progress)) {
  progress.report("potential", 0);
  const CentreBorders fits = exact_fits(centre_borders(usable_area, radius, progress), region_, progress);
  edges_.assign(region_.edges().begin(), region_.edges().end());
  edges_.insert(edges_.end(), fits.pieces.begin(), fits.pieces.end());
  for (const Point corner : fits.corners) edges_.push_back(line(corner, corner));
  if (edges_.empty()) return;
  const std::size_t n = edges_.size(), areas = region_.edges().size();
  box_ = areas > 0 ? region_.box() : extent(edges_.front(), 0);
  pieces_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Edge& edge = edges_[i];
    if (i >= areas) {
      const Box more = extent(edge, 0);
      box_.low = {std::min(box_.low.x, more.low.x), std::min(box_.low.y, more.low.y)};
      box_.high = {std::max(box_.high.x, more.high.x), std::max(box_.high.y, more.high.y)};
    }
    Piece& piece = pieces_[i];
    piece.thin = i >= areas;
    piece.from = edge.from;
    piece.to = edge.to;
    if (edge.straight()) {
      piece.length = edge.length();
      piece.along = piece.length > 0 ? (1 / piece.length) * (edge.to - edge.from) : Point{1, 0};
      continue;
    }
    piece.centre = edge.centre;
    piece.radius = edge.radius;
    piece.side = edge.turn > 0 ? 1 : -1;
    piece.over_half = std::abs(edge.turn) > 3.141592653589793;
    if (std::abs(edge.turn) >= 6.283185307179586 - 1e-12) piece.to = piece.from;
  }
  for (std::size_t i = 0; i < areas; ++i)
    pieces_[i].corner_from = region_.juts_at(i) ? -1 : region_.recedes_at(i) ? 1 : 0;
  for (std::size_t i = 0; i < areas; ++i) pieces_[region_.before(i)].corner_to = pieces_[i].corner_from;

  // The box has a margin, because wires are pushed out while they are squeezed.
  const Box& box = box_;
  const double margin = 0.5 * radius;
  const double width = box.high.x - box.low.x + 2 * margin, height = box.high.y - box.low.y + 2 * margin;
  low_ = {box.low.x - margin, box.low.y - margin};
  const double cell = std::max(std::sqrt(width * height / cells), std::max(width, height) / cells);
  per_cell_ = 1 / cell;
  columns_ = std::max(1, static_cast<int>(std::ceil(width / cell)));
  const int rows = std::max(1, static_cast<int>(std::ceil(height / cell)));
  last_column_ = columns_ - 1;
  last_row_ = rows - 1;
  first_.push_back(0);
  std::vector<std::uint32_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = static_cast<std::uint32_t>(i);
  const double reach = cell * std::sqrt(0.5) * (1 + 1e-9);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (n > 100 || column == 0) progress.report("potential", 0);
      const Point middle = low_ + Point{(column + 0.5) * cell, (row + 0.5) * cell};
      const Hit hit = nearest(middle, all);
      const double least = std::sqrt(hit.square);
      inside_.push_back(hit.inside && least > reach);
      if (!inside_.back())
        for (std::size_t i = 0; i < n; ++i)
          if (std::sqrt(nearest(middle, {&all[i], 1}).square) <= least + 2 * reach)
            among_.push_back(static_cast<std::uint32_t>(i));
      first_.push_back(static_cast<std::uint32_t>(among_.size()));
    }
  }
}

CentreArea::Hit CentreArea::nearest(Point p, std::span<const std::uint32_t> among) const {
  Hit best{std::numeric_limits<double>::max(), {}, false};
  for (const std::uint32_t i : among) {
    const Piece& piece = pieces_[i];
    Point at;
    int end = 0;  // 1: nearest to its begin, 2: to its end
    bool inside = false;
    if (piece.radius == 0) {
      const double f = dot(p - piece.from, piece.along);
      if (f <= 0) {
        at = piece.from;
        end = 1;
      } else if (f >= piece.length) {
        at = piece.to;
        end = 2;
      } else {
        at = piece.from + f * piece.along;
      }
      inside = cross(piece.along, p - piece.from) >= 0;
    } else {
      const Point d = p - piece.centre;
      const double after = piece.side * cross(piece.from - piece.centre, d);
      const double before = piece.side * cross(d, piece.to - piece.centre);
      const bool whole = piece.from == piece.to;
      const bool within = whole || (piece.over_half ? after >= 0 || before >= 0 : after >= 0 && before >= 0);
      const double away = norm(d);
      if (within && away > 0) {
        at = piece.centre + (piece.radius / away) * d;
      } else {
        end = square_distance(p, piece.from) <= square_distance(p, piece.to) ? 1 : 2;
        at = end == 1 ? piece.from : piece.to;
      }
      inside = piece.side * (piece.radius - away) >= 0;
    }
    const double square = square_distance(p, at);
    if (square >= best.square) continue;
    const int corner = end == 1 ? piece.corner_from : end == 2 ? piece.corner_to : 0;
    best = {square, at, piece.thin ? square <= on_line * on_line : corner != 0 ? corner < 0 : inside};
  }
  return best;
}

Point CentreArea::way_in(Point p, std::size_t cell) const {
  const Hit hit = nearest(p, {among_.data() + first_[cell], first_[cell + 1] - first_[cell]});
  return hit.inside ? Point{} : hit.at - p;
}

std::vector<Point> CentreArea::spread(double pitch) const {
  std::vector<Point> points;
  if (empty()) return points;
  const Box& box = box_;
  for (double y = box.low.y + pitch / 2; y < box.high.y; y += pitch)
    for (double x = box.low.x + pitch / 2; x < box.high.x; x += pitch)
      if (holds({x, y})) points.push_back({x, y});
  for (const Edge& edge : edges_) {
    const int parts = std::max(1, static_cast<int>(std::ceil(edge.length() / pitch)));
    for (int i = 0; i < parts; ++i) points.push_back(edge.at(static_cast<double>(i) / parts));
  }
  return points;
}

}  // namespace bahnwerk::winding
