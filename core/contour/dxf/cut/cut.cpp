#include "core/contour/dxf/cut/cut.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/base/progress_scope.hpp"
#include "core/contour/dxf/cut/chain.hpp"
#include "core/contour/dxf/cut/chain_order.hpp"
namespace bahnwerk {
namespace {

/// An arc whose ends lie close together would turn as a whole when one of them is moved: halves do not.
void append(Cut& cut, Drawn curve, std::size_t line) {
  if (const auto* arc = std::get_if<DrawnArc>(&curve);
      arc != nullptr && std::abs(arc->sweep) > 1.5 * std::numbers::pi &&
      norm(last_point(curve) - first_point(curve)) > 1e-9 * norm(arc->a)) {
    DrawnArc half = *arc;
    half.sweep /= 2;
    cut.curves.emplace_back(half);
    cut.lines.push_back(line);
    half.start += half.sweep;
    curve = half;
  }
  cut.curves.push_back(std::move(curve));
  cut.lines.push_back(line);
}

/// Returns the possible starts of a closed cut: its corners, or any place between curves if it has none.
std::vector<std::size_t> starts(const Cut& cut, ProgressScope& progress) {
  constexpr double corner = 1e-3;  // rad
  std::vector<std::size_t> list;
  const std::size_t n = cut.curves.size();
  for (std::size_t i = 0; i < n; ++i) {
    progress.work();
    if (angle_between(last_direction(cut.curves[(i + n - 1) % n]), first_direction(cut.curves[i])) > corner)
      list.push_back(i);
  }
  if (list.empty())
    for (std::size_t i = 0; i < n; ++i) list.push_back(i);
  return list;
}

void turn_round(Cut& cut) {
  std::reverse(cut.curves.begin(), cut.curves.end());
  std::reverse(cut.lines.begin(), cut.lines.end());
  for (Drawn& curve : cut.curves) curve = reversed(std::move(curve));
}

}  // namespace

std::vector<Cut> cuts(std::vector<DxfStrand> strands, double tolerance, Progress progress) {
  std::vector<Strand> ends;
  ends.reserve(strands.size());
  ProgressScope reading(progress.part(0, 0), "reading");
  for (const DxfStrand& s : strands) {
    double length = 0;
    for (const Drawn& curve : s.curves) length += extent(curve);
    ends.push_back({first_point(s.curves.front()), last_point(s.curves.back()), first_direction(s.curves.front()),
                    last_direction(s.curves.back()), length});
    reading.work(1 + s.curves.size());
  }
  std::vector<Cut> result;
  for (const StrandChain& chain : chains(ends, tolerance, progress)) {
    Cut cut;
    cut.closed = chain.closed;
    std::size_t count = 0;
    for (const ChainLink& link : chain.links) count += strands[link.strand].curves.size();
    cut.curves.reserve(count);
    cut.lines.reserve(count);
    for (const ChainLink& link : chain.links) {
      DxfStrand& s = strands[link.strand];
      if (link.reversed) std::reverse(s.curves.begin(), s.curves.end());
      for (Drawn& curve : s.curves) {
        reading.work();
        append(cut, link.reversed ? reversed(std::move(curve)) : std::move(curve), s.line);
      }
      s.curves = {};
    }
    reading.work();
    result.push_back(std::move(cut));
  }
  return result;
}

std::vector<Cut> nearest(std::vector<Cut> cuts, Progress progress) {
  ProgressScope reading(progress.part(0, 0), "reading");
  std::vector<ChainEntries> entries;
  std::vector<std::vector<std::size_t>> where(cuts.size());
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    reading.work();
    ChainEntries e{{}, cuts[c].closed};
    if (e.closed) {
      where[c] = starts(cuts[c], reading);
      // The first block starts as drawn.
      if (c == 0) where[c] = {0};
      for (const std::size_t i : where[c]) e.at.push_back(first_point(cuts[c].curves[i]));
    } else {
      e.at = {first_point(cuts[c].curves.front()), last_point(cuts[c].curves.back())};
    }
    entries.push_back(std::move(e));
  }
  std::vector<Cut> result;
  result.reserve(cuts.size());
  for (const ChainVisit& visit : nearest_order(entries, progress)) {
    Cut& cut = cuts[visit.chain];
    if (!cut.closed) {
      if (visit.entry == 1) turn_round(cut);
    } else if (const auto first = static_cast<std::ptrdiff_t>(where[visit.chain][visit.entry]); first != 0) {
      std::rotate(cut.curves.begin(), cut.curves.begin() + first, cut.curves.end());
      std::rotate(cut.lines.begin(), cut.lines.begin() + first, cut.lines.end());
    }
    result.push_back(std::move(cut));
  }
  return result;
}

}  // namespace bahnwerk
