#include "core/winding/needle/solid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bahnwerk::winding {
namespace {

constexpr double coarsest = 0.6;  // rad, of an arc that becomes one chord

/// Returns into how many chords an arc of `turn` rad is divided: the height of a chord over 2 α is r (1 − cos α).
int chords(double radius, double turn, double tolerance) {
  const double half = std::acos(std::max(-1.0, 1 - tolerance / radius));
  return std::max(1, static_cast<int>(std::ceil(std::abs(turn) / std::min(2 * half, coarsest))));
}

}  // namespace

void append_chords(const Edge& edge, double tolerance, std::vector<Point>& line) {
  const int pieces = edge.straight() ? 1 : chords(edge.radius, edge.turn, tolerance);
  for (int i = 1; i <= pieces; ++i) line.push_back(edge.at(static_cast<double>(i) / pieces));
}

std::vector<Edge> open_edges(const Region& region, Point axis) {
  const auto edges = region.edges();
  std::size_t circle = 0;
  double longest = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!edges[i].straight() && distance(edges[i].centre, axis) < 1e-9 && std::abs(edges[i].turn) > longest)
      longest = std::abs(edges[i].turn), circle = i;
  std::vector<Edge> open;
  for (std::size_t i = 1; i < edges.size(); ++i) open.push_back(edges[(circle + i) % edges.size()]);
  return open;
}

std::vector<Point> closed_round(const std::vector<Point>& line, int count, double pitch, double tolerance) {
  std::vector<Point> round;
  const double radius = norm(line.back()), round_angle = 2 * std::numbers::pi,
               end = std::atan2(line.back().y, line.back().x),
               way = std::atan2(line.front().y, line.front().x) + pitch - end,
               sweep = way - round_angle * std::floor(way / round_angle);
  const int pieces = chords(radius, sweep, tolerance);
  for (int n = 0; n < count; ++n) {
    const double turn = n * pitch, cosine = std::cos(turn), sine = std::sin(turn);
    for (const Point p : line) round.push_back({cosine * p.x - sine * p.y, sine * p.x + cosine * p.y});
    for (int i = 1; i < pieces; ++i) {
      const double angle = turn + end + sweep * i / pieces;
      round.push_back(radius * Point{std::cos(angle), std::sin(angle)});
    }
  }
  return round;
}

}  // namespace bahnwerk::winding
