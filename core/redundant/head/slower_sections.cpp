#include "core/redundant/head/slower_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/redundant/head/following.hpp"

namespace bahnwerk {
namespace {

constexpr double feed_step = 0.97, acceleration_step = feed_step * feed_step;
constexpr int most_steps = 10;           // most steps per round, because the gain is known locally only
constexpr double untrusted_factor = 30;  // relaxation_factor from which on the estimate is not trusted
// Share of the estimated gain of a lower acceleration that is credited: such a change shifts the whole section, and
// where the coarse axis can start before the head a lower feed turns out to be better.
constexpr double trust = 0.2;
constexpr double trust_below = 0.1;  // additional factor for limits below those of the coarse axes alone
constexpr double patient = 1.3;
constexpr double least_share = 0.02;  // least share of a step
constexpr double all_slower = 0.8;
constexpr double worth =
    0.5;  // least gain per unit of time relative to the first step; smaller gains wait for the next round

/// A cell of a section, with times in the chain's units.
struct Lengthened {
  double speed = 0;               // mm/s, speed of the head along its path
  double behind = 0, before = 0;  // mm, distance from the section's begin and to its end
  double duration = 0;            // duration of the cell
  double gain = 0;                // relative gain per unit of time by which the cell is lengthened
};

struct Section {
  std::size_t first = 0, last = 0;  // segments
  double peak = 0;                  // mm/s
  SectionLimits::Straight* straight = nullptr;
  std::vector<Lengthened> cells;
  std::array<double, 3> steps{};  // relative steps of feed, rise, fall
  bool floor = false;             // whether limits of straight moves end at those of the coarse axes alone

  struct Effect {
    double gain = 0, time = 0;
  };
  Pace pace(const std::array<double, 3>& n) const {
    Pace p{peak * std::pow(feed_step, n[0]), unlimited, unlimited};
    if (!straight) return p;
    p.rise = straight->pace.rise * std::pow(acceleration_step, n[1]);
    p.fall = straight->pace.fall * std::pow(acceleration_step, n[2]);
    if (floor) {
      const Pace& coarse = straight->move.slowest;
      p = {std::max(p.feed, std::min(peak, coarse.feed)), std::max(p.rise, coarse.rise), std::max(p.fall, coarse.fall)};
    }
    return p;
  }
  /// Returns the share of a limit's estimated gain that is credited.
  double trusted(std::size_t kind, const Pace& p) const {
    if (!straight) return 1;
    const Pace& coarse = straight->move.slowest;
    const bool low = kind == 0 ? p.feed < coarse.feed : (kind == 1 ? p.rise < coarse.rise : p.fall < coarse.fall);
    return (kind == 0 ? 1 : trust) * (low ? trust_below : 1);
  }
  /// Returns, for other limits, how much longer each cell takes.
  Effect effect(const Pace& p) const {
    Effect e;
    for (const Lengthened& c : cells) {
      double speed = std::min(c.speed, p.feed);
      if (straight) speed = std::min({speed, std::sqrt(2 * p.rise * c.behind), std::sqrt(2 * p.fall * c.before)});
      if (!(speed < c.speed)) continue;
      const double by = c.speed / speed - 1;
      e.gain += by * c.gain;
      e.time += by * c.duration;
    }
    return e;
  }
  /// Lowers the limits to those of a pace.
  void lower(const Pace& p, SectionLimits& section_limits) const {
    if (!straight) {
      for (std::size_t i = first; i < last; ++i) section_limits.feeds[i] = std::min(section_limits.feeds[i], p.feed);
      return;
    }
    Pace& now = straight->pace;
    if (p.feed < peak) now.feed = std::min(now.feed, p.feed);
    now.rise = std::min(now.rise, p.rise);
    now.fall = std::min(now.fall, p.fall);
    straight->slowed = true;
  }
};

/// Returns the sections of the law that hold the cells [first, last).
std::vector<Section> sections_of(const TimeLaw& law, const HeadCells& head, std::size_t first, std::size_t last,
                                 SectionLimits& section_limits) {
  std::vector<Section> sections;
  const auto& pieces = law.pieces();
  const auto rests_before = [&](std::size_t i) { return i == 0 || pieces[i].v == 0; };
  for (std::size_t c = first; c < last;) {
    std::size_t begin = head.pieces[c], end = head.pieces[c] + 1;
    while (!rests_before(begin)) --begin;
    while (end < pieces.size() && !rests_before(end)) ++end;
    Section s;
    s.first = pieces[begin].segment;
    s.last = pieces[end - 1].segment + 1;
    if (const auto at = section_limits.straight.find(s.first); at != section_limits.straight.end())
      s.straight = &at->second;
    for (; c < last && head.pieces[c] < end; ++c) {
      const double t = 0.5 * (head.times[c] + head.times[c + 1]);
      const LawPiece& piece = pieces[law.find(t, head.pieces[c])];
      const LawState x = piece.at(t - piece.t0);
      s.cells.push_back({x.v, std::max(x.s - pieces[begin].s, 0.0), std::max(pieces[end - 1].s_end - x.s, 0.0), 0, 0});
    }
    sections.push_back(std::move(s));
  }
  return sections;
}

}  // namespace

template <std::size_t order>
void lower_section_limits(const TimeLaw& law, const HeadCells& head, const InfeasibleInterval<order>& interval,
                          double relaxation_factor, SectionLimits& section_limits) {
  const std::size_t axis = interval.axis;
  const CoarseFineAxis& limits = interval.limits;
  const Cluster<order>& cluster = interval.cluster;
  const ChainUnits units = chain_units(limits);
  const std::size_t first = cluster.certificate.first, last = cluster.certificate.last;
  std::vector<Section> sections = sections_of(law, head, first, last, section_limits);
  for (Section& s : sections) s.floor = relaxation_factor < patient;
  std::size_t c = first;
  for (Section& s : sections)
    for (Lengthened& cell : s.cells) {
      cell.duration = (head.times[c + 1] - head.times[c]) / units.time;
      cell.gain = cell.duration * cluster.gain[c - first];
      // The multiplier belongs to a velocity box given by the fine axis' limit, which moves with the head.
      const double z = cluster.certificate.multipliers[c - first][1], v = head.nodes[axis][c].v;
      const bool fine = z > 0 ? v + limits.fine.velocity < limits.coarse.velocity
                              : v - limits.fine.velocity > -limits.coarse.velocity;
      if (fine) cell.gain -= z * v / units.velocity();
      s.peak = std::max(s.peak, cell.speed);
      ++c;
    }

  double need = relaxation_factor * cluster.need, first_ratio = 0;
  while (need > 0) {
    Section* best = nullptr;
    std::size_t best_kind = 0;
    double best_ratio = 0, best_gain = 0;
    for (Section& s : sections) {
      if (s.peak == 0) continue;
      const auto now = s.effect(s.pace(s.steps));
      for (std::size_t kind = 0; kind < (s.straight ? 3u : 1u); ++kind) {
        if (s.steps[kind] == most_steps) continue;
        auto steps = s.steps;
        ++steps[kind];
        const Pace pace = s.pace(steps);
        const auto next = s.effect(pace);
        const double gain = next.gain - now.gain, time = next.time - now.time;
        const double ratio = gain / time * s.trusted(kind, pace);
        if (time > 0 && ratio > best_ratio) {
          best = &s;
          best_kind = kind;
          best_ratio = ratio;
          best_gain = gain;
        }
      }
    }
    if (!best || best_ratio < worth * first_ratio) break;
    first_ratio = std::max(first_ratio, best_ratio);
    const double share = std::clamp(need / best_gain, least_share, 1.0);
    auto steps = best->steps;
    steps[best_kind] += share;
    best->lower(best->pace(steps), section_limits);
    ++best->steps[best_kind];
    need -= best_gain;
  }
  if (need == relaxation_factor * cluster.need || relaxation_factor > untrusted_factor)
    for (const Section& s : sections) {
      if (s.peak == 0) continue;
      const double n = std::log(all_slower) / std::log(feed_step);
      s.lower(s.pace({n, n, n}), section_limits);
    }
}

template void lower_section_limits(const TimeLaw&, const HeadCells&, const InfeasibleInterval<2>&, double,
                                   SectionLimits&);
template void lower_section_limits(const TimeLaw&, const HeadCells&, const InfeasibleInterval<3>&, double,
                                   SectionLimits&);

}  // namespace bahnwerk
