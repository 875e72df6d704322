#include "core/verify/cam/law_verifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/progress.hpp"
#include "core/base/read_rows.hpp"
#include "core/verify/cam/law_polynomial.hpp"
#include "core/verify/cam/still_checks.hpp"
#include "core/verify/cam/textbook_laws.hpp"

namespace bahnwerk {
namespace {

using cam::MotionLawProblem;
using cam::Range;
using namespace verify;

constexpr double tolerance = 1e-9;      // part of a derivative's size
constexpr double most_rounding = 1e-4;  // part of a derivative's size that rounding of coefficients may take
constexpr std::size_t orders = 23;
constexpr std::size_t none = static_cast<std::size_t>(-1);

const char* derivative_name(int order) {
  static constexpr const char* names[] = {"position",     "velocity",     "acceleration", "jerk",
                                          "derivative 4", "derivative 5", "derivative 6", "derivative 7",
                                          "derivative 8", "derivative 9", "derivative 10"};
  return order < 11 ? names[order] : "higher derivatives";
}

/// The largest excess of one kind, in parts of its tolerance; what is written is in the derivative's unit.
struct Worst {
  double limit = 0, value = 0, at = 0, share = -1;
  void take(double excess, double allowed, double t) {
    const double now = allowed > 0 ? excess / allowed : excess > 0 ? HUGE_VAL : 0;
    if (now > share) share = now, value = excess, limit = allowed, at = t;
  }
  bool seen() const { return share >= 0; }
};

class Verifier {
 public:
  Verifier(const MotionLawProblem& problem, const LawToVerify& law, Progress progress)
      : problem_(problem), law_(law), progress_(progress) {
    out_.passed = true;
  }

  Verification run(const SetpointSource& table) {
    shape();
    if (!out_.passed) return std::move(out_);
    sizes();
    points();
    sections();
    peaks();
    means();
    check_textbook_laws(problem_, law_, out_);
    check_still_points(problem_, law_, out_);
    rows(table);
    if (law_.bound) add(CheckGroup::bound, "bound", "", law_.objective * (1 + 1e-9), *law_.bound, 0);
    return std::move(out_);
  }

 private:
  void add(CheckGroup group, std::string name, std::string unit, double limit, double value, double at) {
    out_.add({named(group, std::move(name), std::move(unit)), limit, value, at, value <= limit});
  }
  void add(CheckGroup group, const std::string& name, int order, const Worst& worst) {
    if (worst.seen()) add(group, name, unit(order), worst.limit, worst.value, worst.at);
  }
  std::string unit(int order) const {
    static constexpr const char* power[] = {"", "", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹", "¹⁰"};
    if (order == 0) return problem_.slave_unit;
    return problem_.slave_unit + "/s" + (order < 11 ? power[order] : "^r");
  }
  double duration(std::size_t piece) const { return law_.breaks[piece + 1] - law_.breaks[piece]; }
  std::vector<double> derived(std::size_t piece, int order) const {
    return derivative_coefficients(law_.bernstein[piece], duration(piece), order);
  }
  double size(int order) const { return size_[std::min(static_cast<std::size_t>(order), orders - 1)]; }
  double rounding(std::size_t piece, int order) const {
    const double whole = derivative_rounding(law_.bernstein[piece], duration(piece), order);
    return order == 0 ? whole : std::min(whole, most_rounding * size(order));
  }
  double allowed(std::size_t piece, int order) const { return tolerance * size(order) + rounding(piece, order); }
  /// The size of a derivative: the largest value of the whole law at some places, at least stroke by cycle^order. A
  /// short section does not enlarge it, unless the law is as large there.
  void sizes() {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const auto& piece : law_.bernstein) {
      const auto [low, high] = std::minmax_element(piece.begin(), piece.end());
      least = std::min(least, *low), most = std::max(most, *high);
    }
    double usual = std::max(most - least, 1e-6 * std::max(std::abs(most), std::abs(least)));
    for (std::size_t r = 0; r < orders; ++r, usual /= law_.cycle_duration) {
      size_[r] = usual;
      for (std::size_t i = 0; r > 0 && i < law_.bernstein.size(); ++i) {
        const auto c = derived(i, static_cast<int>(r));
        for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) size_[r] = std::max(size_[r], std::abs(bernstein_sum(c, x)));
      }
    }
  }
  std::size_t sections_count() const { return problem_.sections(); }
  double section_begin(std::size_t section) const {
    const double scale = law_.cycle_duration / problem_.length;
    return section < law_.at.size() ? law_.at[section] * scale : law_.at.front() * scale + law_.cycle_duration;
  }

  /// Angles in their ranges, sections that begin at them, pieces that cover the cycle.
  void shape() {
    Worst worst;
    const double slack = 1e-9 * problem_.length;
    bool fits = law_.at.size() == problem_.points.size() && law_.breaks.size() == law_.bernstein.size() + 1 &&
                law_.sections.size() == law_.bernstein.size() && !law_.bernstein.empty();
    for (std::size_t p = 0; fits && p < law_.at.size(); ++p) {
      const Range range = problem_.points[p].at;
      worst.take(std::max(range.min - law_.at[p], law_.at[p] - range.max), slack, section_begin(p));
      if (p > 0) fits = law_.at[p] > law_.at[p - 1];
    }
    first_piece_.assign(sections_count(), none);
    for (std::size_t i = 0; fits && i < law_.sections.size(); ++i) {
      const std::size_t s = law_.sections[i];
      fits = law_.breaks[i + 1] > law_.breaks[i] && s < sections_count() &&
             (i == 0 ? s == 0 : s == law_.sections[i - 1] || s == law_.sections[i - 1] + 1);
      if (fits && first_piece_[s] == none) first_piece_[s] = i;
    }
    fits = fits && law_.sections.back() + 1 == sections_count();
    const double second = slack * law_.cycle_duration / problem_.length;
    for (std::size_t s = 0; fits && s < sections_count(); ++s)
      worst.take(std::abs(law_.breaks[first_piece_[s]] - section_begin(s)) / second * slack, slack, section_begin(s));
    if (fits)
      worst.take(std::abs(law_.breaks.back() - section_begin(sections_count())) / second * slack, slack,
                 law_.breaks.back());
    if (!fits) worst.take(problem_.length, slack, 0);
    add(CheckGroup::limit, "angles", problem_.master_unit, worst.limit, worst.value, worst.at);
  }

  std::size_t piece_behind(std::size_t point) const { return point < sections_count() ? first_piece_[point] : none; }
  std::size_t piece_before(std::size_t point) const {
    if (point == 0) return problem_.periodic ? law_.bernstein.size() - 1 : none;
    return point < sections_count() ? first_piece_[point] - 1 : law_.bernstein.size() - 1;
  }

  /// What the end of the cycle is higher than its begin: the law comes to point 0 from there.
  double more_before(std::size_t point, int order) const {
    return point == 0 && order == 0 && problem_.periodic ? problem_.travel : 0;
  }

  void points() {
    std::vector<Worst> values(22), jumps(22);
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      progress_.report("verification", 0.9);
      const std::size_t before = piece_before(p), behind = piece_behind(p);
      const double t = section_begin(p);
      const auto& point = problem_.points[p];
      for (int r = 0; r < static_cast<int>(point.values.size()); ++r) {
        const Range range = point.values[static_cast<std::size_t>(r)];
        if (range.free()) continue;
        for (const std::size_t piece : {before, behind}) {
          if (piece == none) continue;
          const auto c = derived(piece, r);
          const double value = (piece == before ? c.back() : c.front()) - (piece == before ? more_before(p, r) : 0);
          values[static_cast<std::size_t>(r)].take(std::max({range.min - value, value - range.max, 0.0}),
                                                   allowed(piece, r), t);
        }
      }
      if (before == none || behind == none) continue;
      int highest = point.continuity;
      for (int r = 0; r < static_cast<int>(point.values.size()); ++r)
        if (!point.values[static_cast<std::size_t>(r)].free()) highest = std::max(highest, r);
      for (int r = 0; r <= highest; ++r)
        jumps[static_cast<std::size_t>(std::min(r, 21))].take(
            std::abs(derived(before, r).back() - more_before(p, r) - derived(behind, r).front()),
            allowed(before, r) + allowed(behind, r), t);
    }
    // Pieces inside a section join up to the order that makes J finite: acceleration, or velocity for laws whose
    // acceleration jumps.
    for (std::size_t i = 0; i + 1 < law_.bernstein.size(); ++i) {
      if (law_.sections[i] != law_.sections[i + 1]) continue;
      const cam::MotionPoint& point = problem_.points[law_.sections[i]];
      const int highest = point.law && acceleration_jumps(*point.law, point.fractions) ? 1 : 2;
      for (int r = 0; r <= highest; ++r)
        jumps[static_cast<std::size_t>(r)].take(std::abs(derived(i, r).back() - derived(i + 1, r).front()),
                                                allowed(i, r) + allowed(i + 1, r), law_.breaks[i + 1]);
    }
    for (int r = 0; r < 22; ++r)
      add(CheckGroup::limit, std::string("value ") + derivative_name(r), r, values[static_cast<std::size_t>(r)]);
    for (int r = 0; r < 22; ++r)
      add(CheckGroup::continuity, std::string("continuity ") + derivative_name(r), r,
          jumps[static_cast<std::size_t>(r)]);
  }

  /// The enclosed maximum of ±s^(order) over a piece.
  EnclosedMaximum most(std::size_t piece, int order, double sign) const {
    auto c = derived(piece, order);
    for (double& each : c) each *= sign;
    EnclosedMaximum found = enclosed_maximum(c, allowed(piece, order) / 4);
    found.at = law_.breaks[piece] + found.at * duration(piece);
    return found;
  }

  void sections() {
    Worst worst[cam::limited_orders];
    for (std::size_t i = 0; i < law_.bernstein.size(); ++i)
      for (int r = 0; r < cam::limited_orders; ++r) {
        const Range limit = problem_.points[law_.sections[i]].section[static_cast<std::size_t>(r)];
        if (limit.free()) continue;
        const auto high = most(i, r, 1), low = most(i, r, -1);
        worst[r].take(std::max(high.value - limit.max, 0.0), 2 * allowed(i, r), high.at);
        worst[r].take(std::max(limit.min + low.value, 0.0), 2 * allowed(i, r), low.at);
      }
    for (int r = 0; r < cam::limited_orders; ++r)
      add(CheckGroup::limit, std::string("section limit ") + derivative_name(r), r, worst[r]);
  }

  void peaks() {
    double objective = 0, slack = 0, factor = 1;
    if (problem_.objective.normalised) factor = 1 / problem_.points_stroke();
    const double drive[] = {HUGE_VAL, problem_.drive ? problem_.drive->velocity : HUGE_VAL,
                            problem_.drive ? problem_.drive->acceleration : HUGE_VAL,
                            problem_.drive ? problem_.drive->jerk : HUGE_VAL};
    for (int r = 1; r < cam::limited_orders; ++r) {
      const auto order = static_cast<std::size_t>(r);
      double peak = 0, at = 0, off = 0;
      // Peaks that count in J, and what they may be off: that of all sections without a weight of their own, and that
      // of each of the others.
      std::vector<std::array<double, 2>> counted(sections_count() + 1);
      for (std::size_t i = 0; i < law_.bernstein.size(); ++i) {
        const std::size_t s = law_.sections[i];
        auto& own = counted[problem_.points[s].weight ? s : sections_count()];
        for (const double sign : {1.0, -1.0}) {
          const auto found = most(i, r, sign);
          if (found.value > own[0]) own = {found.value, allowed(i, r)};
          if (found.value > peak) peak = found.value, at = found.at, off = allowed(i, r);
        }
      }
      add(CheckGroup::limit, std::string("peak ") + derivative_name(r), unit(r),
          law_.peaks[order] * (1 + 1e-9) + 2 * off, peak, at);
      if (std::isfinite(drive[r]))
        add(CheckGroup::limit, std::string("drive ") + derivative_name(r), unit(r), drive[r] * (1 + 1e-9), peak, at);
      if (problem_.objective.normalised) factor *= law_.cycle_duration;
      for (std::size_t s = 0; s < counted.size(); ++s) {
        const double own = s < sections_count() ? problem_.points[s].weight.value_or(0) : 1;
        objective += problem_.objective.weight[order] * factor * own * counted[s][0];
        slack += problem_.objective.weight[order] * factor * own * 2 * counted[s][1];
      }
    }
    if (!(problem_.objective.zero_crossing_penalty > 0))
      add(CheckGroup::bound, "objective", "", law_.objective * (1 + 1e-9) + slack, objective, 0);
  }

  /// The reported RMS values of acceleration and jerk.
  void means() {
    for (int r = 2; r < cam::limited_orders && !law_.rms.empty(); ++r) {
      double sum = 0, off = 0;
      for (std::size_t i = 0; i < law_.bernstein.size(); ++i) {
        sum += duration(i) * mean_square(derived(i, r));
        off = std::max(off, allowed(i, r));
      }
      const double rms = std::sqrt(sum / (law_.breaks.back() - law_.breaks.front()));
      add(CheckGroup::limit, std::string("rms ") + derivative_name(r), unit(r), off,
          std::abs(rms - law_.rms[static_cast<std::size_t>(r)]), 0);
    }
  }

  /// Rows against the law, evaluated by the binomial sum, and against the limits of their section.
  void rows(const SetpointSource& table) {
    Worst columns[5], limits[cam::limited_orders];
    const double n = static_cast<double>(table.count() - 1);
    const double first =
        problem_.periodic && problem_.points.front().at.min >= 0 && problem_.points.back().at.max <= problem_.length
            ? 0
            : problem_.points.front().at.min;
    std::size_t piece = 0;
    for_each_row(
        table,
        [&](std::size_t k, const double* given) {
          const double share = static_cast<double>(k) / n;
          columns[0].take(std::abs(given[0] - (first + problem_.length * share)),
                          1e-12 * (std::abs(first) + problem_.length), share * law_.cycle_duration);
          double t = first * law_.cycle_duration / problem_.length + share * law_.cycle_duration;
          const double same = moment(t);
          double moved = 0;
          while (problem_.periodic && t < law_.breaks.front() - same)
            t += law_.cycle_duration, moved -= problem_.travel;
          while (problem_.periodic && t >= law_.breaks.back() - same)
            t -= law_.cycle_duration, moved += problem_.travel;
          const double row[] = {given[0], given[1] - moved, given[2], given[3], given[4]};
          while (piece > 0 && t < law_.breaks[piece]) --piece;
          while (piece + 1 < law_.bernstein.size() && t >= law_.breaks[piece + 1]) ++piece;
          // A row at a break may show either side.
          double distance[4], off[4];
          compare(piece, t, row, distance, off);
          const auto other = [&](std::size_t neighbour, double at, double more = 0) {
            double there[4], off_there[4];
            const double same_place[] = {row[0], row[1] + more, row[2], row[3], row[4]};
            compare(neighbour, at, same_place, there, off_there);
            for (int r = 0; r < 4; ++r)
              if (there[r] / off_there[r] < distance[r] / off[r]) distance[r] = there[r], off[r] = off_there[r];
          };
          const bool at_begin = t - law_.breaks[piece] < same, at_end = law_.breaks[piece + 1] - t < same;
          if (at_begin && piece > 0) other(piece - 1, law_.breaks[piece]);
          if (at_begin && piece == 0 && problem_.periodic)
            other(law_.bernstein.size() - 1, law_.breaks.back(), problem_.travel);
          if (at_end && piece + 1 < law_.bernstein.size()) other(piece + 1, law_.breaks[piece + 1]);
          for (int r = 0; r < 4; ++r) columns[1 + r].take(distance[r], off[r], t);
          for (int r = 0; r < cam::limited_orders && !at_begin && !at_end; ++r) {
            const Range limit = problem_.points[law_.sections[piece]].section[static_cast<std::size_t>(r)];
            if (!limit.free())
              limits[r].take(std::max({row[1 + r] - limit.max, limit.min - row[1 + r], 0.0}),
                             2 * allowed(piece, r) + off[r], t);
          }
        },
        [&](std::size_t, std::size_t) { progress_.report("verification", 0.95); });
    static constexpr const char* names[] = {"table phi", "table s", "table v", "table a", "table j"};
    for (int c = 0; c < 5; ++c)
      add(CheckGroup::setpoints, names[c], c == 0 ? problem_.master_unit : unit(c - 1), columns[c].limit,
          columns[c].value, columns[c].at);
    for (int r = 0; r < cam::limited_orders; ++r)
      add(CheckGroup::setpoints, std::string("table section limit ") + derivative_name(r), r, limits[r]);
  }

  /// What rounding of times may be, s.
  double moment(double t) const { return 64 * 2.3e-16 * (std::abs(t) + law_.cycle_duration); }

  /// Distances of a row from a piece at t, and what time's rounding and the coefficients' may make of them.
  void compare(std::size_t piece, double t, const double* row, double* distance, double* off) const {
    const double x = std::clamp((t - law_.breaks[piece]) / duration(piece), 0.0, 1.0);
    for (int r = 0; r < 4; ++r) {
      distance[r] = std::abs(row[1 + r] - bernstein_sum(derived(piece, r), x));
      off[r] = 1e-12 * size(r) + rounding(piece, r) + size(r + 1) * moment(t) + 1e-300;
    }
  }

  const MotionLawProblem& problem_;
  const LawToVerify& law_;
  Progress progress_;
  Verification out_;
  std::vector<std::size_t> first_piece_;
  double size_[orders] = {};
};

}  // namespace

Verification verify_motion_law(const MotionLawProblem& problem, const LawToVerify& law, const SetpointSource& table,
                               Progress progress) {
  return Verifier(problem, law, progress).run(table);
}

}  // namespace bahnwerk
