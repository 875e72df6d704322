#include "core/probe/optimal/windows.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/windows.hpp"
#include "core/probe/optimal/cell_rows.hpp"
#include "core/probe/optimal/chain_problem.hpp"
#include "core/probe/optimal/refine.hpp"
#include "core/probe/optimal/start.hpp"

namespace bahnwerk {
namespace {

// The shortest of the times in which a derivative goes from 0 to its limit under the next one's, and the way in which
// the head can brake from its speed, over all axes.
struct Scales {
  double time = 1e300, braking = 0;
};
template <int D>
Scales scales(const ChainLimits<D>& limits) {
  Scales s;
  for (int k = 0; k < D; ++k) {
    const double a = limits.derivative[0][k], j = limits.derivative[1][k], q = limits.derivative[2][k],
                 v = limits.speed;
    s.time = std::min({s.time, j / q, std::sqrt(a / q), std::cbrt(v / q)});
    const double change = std::max({v / a, std::sqrt(v / j), std::cbrt(v / q)}) * 3;
    s.braking = std::max(s.braking, v * change / 2);
  }
  return s;
}

template <int D>
double edge_length(const ChainLimits<D>& limits, std::size_t e) {
  return capsule<D>(limits.points[e], limits.points[e + 1], 0).length;
}

// Points from `from` to `to`, as limits of their own.
template <int D>
ChainLimits<D> part_of(const ChainLimits<D>& limits, std::size_t from, std::size_t to) {
  ChainLimits<D> part = limits;
  const auto slice = [&](auto& v, const auto& all) {
    v.assign(all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + static_cast<std::ptrdiff_t>(to + 1));
  };
  slice(part.points, limits.points);
  slice(part.ball, limits.ball);
  if (!limits.along.empty()) {
    slice(part.along, limits.along);
    slice(part.curve, limits.curve);
  }
  if (!limits.tube.empty())
    part.tube.assign(limits.tube.begin() + static_cast<std::ptrdiff_t>(from),
                     limits.tube.begin() + static_cast<std::ptrdiff_t>(to));
  return part;
}
template <int D>
void renumber(CellChain<D>& chain, std::size_t from, std::size_t to) {
  for (auto& n : chain.node)
    if (n.point >= 0) n.point += static_cast<int>(to) - static_cast<int>(from);
  for (auto& c : chain.cell) c.edge += to - from;
}

// The point before which the head can stop twice, some tens of edges ahead at least.
template <int D>
std::size_t look_ahead(const ChainLimits<D>& limits, std::size_t from, double braking) {
  constexpr std::size_t least = 40, most = 400;
  const std::size_t edges = limits.points.size() - 1;
  std::size_t to = from;
  double length = 0;
  while (to < edges && to < from + most && (to < from + least || length < 2 * braking))
    length += edge_length(limits, to++);
  return to;
}

struct Effort {
  int levels;
  double final_gap;
  int iterations;  // largest number of a level; three times as many for the first one, whose start may be slow
};
// Few points may take long each; many get less.
Effort effort(std::size_t edges) {
  if (edges <= 40) return {6, 1e-4, 150};
  if (edges <= 150) return {4, 3e-4, 120};
  if (edges <= 500) return {2, 5e-4, 100};
  if (edges <= 2500) return {1, 2e-3, 80};
  return {0, 4e-3, 40};
}

}  // namespace

template <int D>
CellChain<D> plan_chain(const ChainLimits<D>& limits, std::size_t all_edges,
                        const std::function<void(double)>& report) {
  constexpr std::size_t whole = 3000, body = 800;  // edges: of a chain in one window, of a window that is kept
  const std::size_t edges = limits.points.size() - 1;
  const Effort work = effort(all_edges);
  const Scales scale = scales(limits);
  CellChain<D> done, window;
  ChainNode<D> begin;
  begin.state[0] = limits.points[0];
  begin.point = 0;
  begin.given = true;
  window.node.push_back(begin);
  std::size_t to = 0;  // the last point of the window before
  solve_windows(std::size_t{0}, edges, [&](std::size_t from, auto*) {
    std::size_t keep = edges, end = edges;
    if (edges - from > whole) {
      keep = look_ahead(limits, from + body, scale.braking);
      end = look_ahead(limits, keep, scale.braking);
      end = std::max(end, to);
      if (end == edges) keep = edges;
    }
    append_start(window, limits, to, end);
    to = end;
    window.node.back().given = true;
    const ChainLimits<D> part = part_of(limits, from, to);
    renumber(window, from, 0);
    for (int level = 0; level <= work.levels; ++level) {
      if (level > 0) {
        CellChain<D> finer = refined(window, part, level, (all_edges <= 4 ? 0.3 : 1.2) * scale.time);
        if (finer.cell.size() == window.cell.size() && level < work.levels) continue;
        window = std::move(finer);
      }
      double shortest = scale.time;
      for (const ChainCell& cell : window.cell) shortest = std::min(shortest, cell.duration);
      const double before = static_cast<double>(from), span = static_cast<double>(to - from);
      FeasibleOptions options;
      options.gap = level == work.levels ? work.final_gap : 1e-2;
      options.iterations = (level == 0 ? 3 : 1) * work.iterations;
      options.start_mu = level == 0 ? 0 : 0.02;
      options.tick = [&] { report((before + span * (level + 0.5) / (work.levels + 1)) / static_cast<double>(edges)); };
      shorten_chain(window, part, 1e-3 * shortest, options);
    }
    renumber(window, 0, from);
    window.node.back().given = false;
    std::size_t cut = 0;
    while (window.node[cut].point < static_cast<int>(keep)) ++cut;
    const auto nodes = static_cast<std::ptrdiff_t>(cut);
    done.node.insert(done.node.end(), window.node.begin(), window.node.begin() + nodes);
    done.cell.insert(done.cell.end(), window.cell.begin(), window.cell.begin() + nodes);
    window.node.erase(window.node.begin(), window.node.begin() + nodes);
    window.cell.erase(window.cell.begin(), window.cell.begin() + nodes);
    window.node.front().given = keep < edges;
    return keep;
  });
  done.node.push_back(window.node.back());
  return done;
}

template CellChain<1> plan_chain<1>(const ChainLimits<1>&, std::size_t, const std::function<void(double)>&);
template CellChain<2> plan_chain<2>(const ChainLimits<2>&, std::size_t, const std::function<void(double)>&);
template CellChain<3> plan_chain<3>(const ChainLimits<3>&, std::size_t, const std::function<void(double)>&);

}  // namespace bahnwerk
