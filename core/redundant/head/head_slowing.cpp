#include "core/redundant/head/head_slowing.hpp"

#include <algorithm>
#include <cmath>

#include "core/redundant/chain/chain_windows.hpp"
#include "core/redundant/chain/clusters.hpp"
#include "core/redundant/head/following.hpp"
#include "core/redundant/head/section_timing_search.hpp"

namespace bahnwerk {
namespace {

constexpr double first_raise = 1.06, least_raise = 1.006, finer = 1.0 / 3;  // factors of a speed
// A loose gap suffices to see how much time is needed; the penalty makes its effect on the excess 1e-4 of the gap.
constexpr double rough_gap = 1e-2, unclear = 1e-5, fine_gap = 1e-5;
constexpr std::size_t most_work = 8000000;  // cells times Newton steps after which a range is given up: about 5 s
constexpr double hopeless = 10;             // largest factor of a range's first duration
constexpr int patience = 30;                // Newton steps after which a raised speed counts as infeasible

/// Factor on the first-order estimate of the required slowing, which is a fifth too low. Applied to late rounds it
/// saves rounds; applied to early ones it would lose time.
double relaxation_factor_of(std::size_t round) {
  return round <= 2 ? 1.0 : 1.25 * std::pow(1.25, std::max(0.0, static_cast<double>(round) - 8));
}

}  // namespace

template <std::size_t order>
Expected<typename HeadSlowing<order>::Problem, NoPlan> HeadSlowing<order>::problem(const SegmentRange& range) {
  Problem p;
  p.head = plan_.motion(range.first, range.last);
  const bool all = range.last == p.head->path().size();
  p.cells = head_cells(*p.head, 0, p.head->pieces() - (all ? 0 : 1), options_.cells, scope_);
  for (std::size_t k = 0; k < machine_.axes.size(); ++k) {
    if (!(machine_.axes[k].stroke > 0)) continue;
    std::optional<Chain<order>> chain = following<order>(p.cells, k, machine_.axes[k]);
    if (!chain) return NoPlan::head_exceeds_limits;
    p.axes.push_back(k);
    p.chains.push_back(*std::move(chain));
    p.chains.back().begins_at_rest = range.first == 0;
    p.chains.back().ends_at_rest = all;
  }
  if (work_ > most_work || all_work_.spent()) return NoPlan::effort;
  return p;
}

template <std::size_t order>
Expected<bool, NoPlan> HeadSlowing<order>::slow_once(const SegmentRange& range, std::size_t round,
                                                     HeadSlowingCounts& counts) {
  const Expected<Problem, NoPlan> found_problem = problem(range);
  if (!found_problem) return found_problem.reason();
  const Problem& p = *found_problem;
  ChainOptions rough;
  rough.gap = rough_gap;
  rough.any = true;
  rough.tick = [this] { scope_.report(); };
  bool slower = false;
  for (std::size_t k = 0; k < p.chains.size(); ++k) {
    ChainSolution<order> solution = solve_raising_penalty(p.chains[k], rough);
    worked(static_cast<std::size_t>(solution.iterations), p.cells.size());
    if (solution.excess > 0 && solution.excess < unclear) {
      ChainOptions fine = rough;
      fine.gap = fine_gap;
      solution = solve_raising_penalty(p.chains[k], fine);
    }
    if (solution.excess <= 0) continue;
    const std::vector<Cluster<order>> found = clusters(p.chains[k], solution, 0.0);
    if (found.empty()) return NoPlan::cannot_follow;  // the coarse axes do not come to rest
    for (const Cluster<order>& c : found) {
      counts.certified += round == 1 && c.certificate.value > 0;
      lower_section_limits<order>(p.head->law(), p.cells, {p.axes[k], machine_.axes[p.axes[k]], c},
                                  relaxation_factor_of(round), plan_.section_limits());
      slower = true;
    }
  }
  return slower;
}

template <std::size_t order>
bool HeadSlowing<order>::followed(const SegmentRange& range) {
  const Expected<Problem, NoPlan> p = problem(range);
  if (!p) return false;
  ChainOptions rough;
  rough.gap = rough_gap;
  rough.any = true;
  rough.max_iterations = patience;
  rough.tick = [this] { scope_.report(); };
  return std::all_of(p->chains.begin(), p->chains.end(), [&](const Chain<order>& chain) {
    const ChainSolution<order> solution = solve(chain, rough);
    worked(static_cast<std::size_t>(solution.iterations), p->cells.size());
    return solution.excess <= 0;
  });
}

/// Returns the sections of a range that influence the section that begins with `segment`.
template <std::size_t order>
SegmentRange HeadSlowing<order>::neighbourhood(const SegmentRange& range, std::size_t segment) {
  const auto head = plan_.motion(range.first, range.last);
  const auto& pieces = head->law().pieces();
  const auto at = [&](std::size_t s) {
    return std::lower_bound(pieces.begin(), pieces.end(), s,
                            [](const LawPiece& p, std::size_t k) { return p.segment < k; });
  };
  const auto segment_at = [&](double t) {
    return std::min(pieces[head->law().find(std::clamp(t, 0.0, head->duration()))].segment, range.last - 1);
  };
  const auto end = at(segment + 1);
  const double begins = at(segment)->t0, ends = end == pieces.end() ? head->duration() : end->t0;
  return {std::max(range.first, plan_.section_begin(segment_at(begins - options_.around))),
          std::min(range.last, plan_.section_end(segment_at(ends + options_.around)))};
}

template <std::size_t order>
void HeadSlowing<order>::raise(const SegmentRange& range) {
  auto& straight = plan_.section_limits().straight;
  for (double by = first_raise; by > least_raise; by = std::pow(by, finer))
    for (auto s = straight.lower_bound(range.first); s != straight.end() && s->first < range.last; ++s) {
      if (work_ > most_work / 2 || all_work_.done > 0.5 * all_work_.most) return;  // it is followed as it is
      if (!s->second.slowed) continue;
      const SegmentRange around = neighbourhood(range, s->first);
      const auto raised = [&](double Pace::*limit, double factor) {
        for (;;) {
          const double before = s->second.pace.*limit, most = s->second.move.fastest.*limit;
          if (!(before < most)) return;
          s->second.pace.*limit = std::min(before * factor, most);
          if (work_ <= most_work / 2 && !all_work_.spent() && followed(around)) continue;
          s->second.pace.*limit = before;
          return;
        }
      };
      raised(&Pace::rise, by * by);
      raised(&Pace::fall, by * by);
      raised(&Pace::feed, by);
    }
}

template <std::size_t order>
Expected<bool, NoPlan> HeadSlowing<order>::run(const SegmentRange& range, HeadSlowingCounts& counts) {
  bool raised = false;
  work_ = 0;
  const double longest = hopeless * plan_.motion(range.first, range.last)->duration();
  for (std::size_t round = 1; round <= static_cast<std::size_t>(options_.max_rounds); ++round) {
    counts.rounds = std::max(counts.rounds, round);
    const Expected<bool, NoPlan> slower = slow_once(range, round, counts);
    if (!slower) return slower.reason();
    if (*slower) {
      if (plan_.motion(range.first, range.last)->duration() > longest) break;
      continue;
    }
    if (raised || round == 1) return round > 1;
    bool searched = false;
    if constexpr (order == 2)
      searched = SectionTimingSearch(plan_, machine_, options_.cells, scope_, range.first, range.last).run();
    if (!searched) raise(range);
    raised = true;
  }
  return NoPlan::cannot_follow;
}

template class HeadSlowing<2>;
template class HeadSlowing<3>;

}  // namespace bahnwerk
