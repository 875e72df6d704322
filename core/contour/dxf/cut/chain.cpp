#include "core/contour/dxf/cut/chain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/base/progress_scope.hpp"
#include "core/contour/dxf/cut/point_grid.hpp"

namespace bahnwerk {
namespace {

constexpr std::uint32_t none = UINT32_MAX;
constexpr std::size_t max_partners = 8;

/// End 2i is where strand i begins, 2i + 1 where it ends.
Vec place(const std::vector<Strand>& strands, std::size_t end) {
  const Strand& s = strands[end / 2];
  return end % 2 == 0 ? s.from : s.to;
}
/// Returns the unit tangent at an end, pointing out of the strand.
Vec outward(const std::vector<Strand>& strands, std::size_t end) {
  const Strand& s = strands[end / 2];
  return end % 2 == 0 ? -s.from_direction : s.to_direction;
}

struct Pair {
  std::uint32_t cost, a, b;
};

/// Coincident ends come first, by their turn in µrad, then gaps by their width.
std::uint32_t cost(const std::vector<Strand>& strands, std::size_t a, std::size_t b, double distance,
                   double tolerance) {
  constexpr double gap = 4e6, resolution = 1e6;
  const double shorter = std::min(strands[a / 2].length, strands[b / 2].length);
  // Strands shorter than the tolerance have the ends of the next but one near, too: those are gaps.
  const bool coincident = distance <= std::min(0.1 * tolerance, 0.5 * shorter) || distance == 0;
  return static_cast<std::uint32_t>(
      coincident ? std::round(resolution * angle_between(outward(strands, a), -outward(strands, b)))
                 : gap + std::round(resolution * distance / tolerance));
}

std::vector<Pair> pairs(const std::vector<Strand>& strands, const std::vector<bool>& closed, double tolerance,
                        ProgressScope& progress) {
  PointGrid grid(tolerance, 2 * strands.size());
  std::vector<std::uint32_t> ends;
  std::vector<Pair> list;
  for (std::size_t i = 0; i < strands.size(); ++i) {
    progress.work(4);
    if (closed[i]) continue;
    for (std::size_t end = 2 * i; end < 2 * i + 2; ++end) {
      const Vec p = place(strands, end);
      std::size_t found = 0;
      grid.near(p, [&](std::size_t k, double distance) {
        if (distance > tolerance || ends[k] / 2 == i) return true;
        list.push_back({cost(strands, ends[k], end, distance, tolerance), ends[k], static_cast<std::uint32_t>(end)});
        return ++found < max_partners;
      });
    }
    for (std::size_t end = 2 * i; end < 2 * i + 2; ++end) {
      grid.add(place(strands, end));
      ends.push_back(static_cast<std::uint32_t>(end));
    }
  }
  return list;
}

}  // namespace

std::vector<StrandChain> chains(const std::vector<Strand>& strands, double tolerance, Progress progress) {
  const std::size_t n = strands.size();
  std::vector<bool> closed(n);
  for (std::size_t i = 0; i < n; ++i)
    closed[i] = norm(strands[i].to - strands[i].from) <= std::min(tolerance, 0.1 * strands[i].length);

  ProgressScope reading(progress.part(0, 0), "reading");
  auto list = pairs(strands, closed, tolerance, reading);
  std::sort(list.begin(), list.end(), [&](const Pair& p, const Pair& q) {
    reading.work();
    return std::tie(p.cost, p.a, p.b) < std::tie(q.cost, q.a, q.b);
  });
  std::vector<std::uint32_t> partner(2 * n, none);
  for (const Pair& p : list) {
    if (partner[p.a] != none || partner[p.b] != none) continue;
    partner[p.a] = p.b;
    partner[p.b] = p.a;
  }

  std::vector<StrandChain> result;
  std::vector<bool> used(n);
  for (std::size_t first = 0; first < n; ++first) {
    reading.work();
    if (used[first]) continue;
    StrandChain chain;
    // The walk goes back to where the chain begins, or round to `first` again.
    std::size_t begin = 2 * first;  // the end by which a strand is entered
    while (partner[begin] != none) {
      begin = partner[begin] ^ 1U;
      if (begin == 2 * first) break;
    }
    chain.closed = closed[first] || partner[begin] != none;
    for (std::size_t end = begin;;) {
      chain.links.push_back({end / 2, end % 2 == 1});
      used[end / 2] = true;
      const std::uint32_t next = partner[end ^ 1U];
      if (next == none || next == begin) break;
      end = next;
    }
    result.push_back(std::move(chain));
  }
  return result;
}

}  // namespace bahnwerk
