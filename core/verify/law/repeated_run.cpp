#include "core/verify/law/repeated_run.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/geometry/curve/arc.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double tolerance = 1e-12, place_tolerance = 1e-11;
constexpr std::size_t min_pieces = 16;

bool close(double a, double b) { return std::abs(a - b) <= tolerance * std::abs(b); }

bool same_arc(const Segment& a, const Segment& b) {
  const auto &p = static_cast<const Arc&>(a.curve()), &q = static_cast<const Arc&>(b.curve());
  return norm(p.e1() - q.e1()) <= tolerance && norm(p.e2() - q.e2()) <= tolerance && close(p.radius(), q.radius()) &&
         close(p.sweep(), q.sweep()) && close(p.rise(), q.rise());
}

}  // namespace

std::size_t RepeatedRuns::skip(std::size_t first) {
  const auto& pieces = in_.law.pieces();
  const std::size_t segment = pieces[first].segment;
  if (!in_.path.cartesian() || segment >= in_.path.size() || in_.path[segment].curve().kind() != CurveKind::arc)
    return first;
  Run run{first, first};
  while (run.last < pieces.size() && pieces[run.last].segment == segment) ++run.last;
  if (run.last - run.first < min_pieces) return first;
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  const std::uint64_t shape = rough_shape(in_.path.tool(), segment, segment + 1) ^ (run.last - run.first) ^
                              std::rotl(bits(pieces[first].duration), 17) ^
                              std::rotl(bits(pieces[(first + run.last) / 2].duration), 41);
  for (const std::size_t i : index_.of(shape))
    if (same(runs_[i], run)) return run.last;
  index_.add(shape, runs_.size());
  runs_.push_back(run);
  return first;
}

bool RepeatedRuns::same(const Run& a, const Run& b) const {
  const auto& pieces = in_.law.pieces();
  const Segment &s = in_.path[pieces[a.first].segment], &t = in_.path[pieces[b.first].segment];
  if (a.last - a.first != b.last - b.first || !same_arc(s, t)) return false;
  const double off = place_tolerance * static_cast<const Arc&>(t.curve()).radius();
  const auto near = [&](double x, double y) { return std::abs((x - s.s0()) - (y - t.s0())) <= off; };
  for (std::size_t i = 0; i < b.last - b.first; ++i) {
    const LawPiece &p = pieces[a.first + i], &q = pieces[b.first + i];
    if (!(near(p.s, q.s) && near(p.s_end, q.s_end) && close(p.duration, q.duration) && close(p.v, q.v) &&
          close(p.a, q.a) && close(p.j, q.j) && close(p.snap, q.snap)))
      return false;
  }
  return true;
}

}  // namespace bahnwerk::verify
