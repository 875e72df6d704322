#include "core/cam/table/controller_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cam/bernstein.hpp"

namespace bahnwerk::cam {
namespace {

/// State of the law at t, order by order, unit/s^r, behind or before t.
std::array<double, 4> state(const CamLaw& law, double t, bool before) {
  const double slack = 1e-12 * law.duration();
  std::size_t piece = 0;
  while (piece + 1 < law.pieces() && law.breaks()[piece + 1] <= (before ? t - slack : t + slack)) ++piece;
  const double x = std::clamp((t - law.breaks()[piece]) / law.piece_duration(piece), 0.0, 1.0);
  std::array<double, 4> out{};
  for (int r = 0; r < 4; ++r) out[static_cast<std::size_t>(r)] = law.in_piece(piece, x, r);
  return out;
}

/// Returns the Bernstein coefficients of the curve that a controller drives between two states.
std::vector<double> driven(Between between, double duration, const std::array<double, 4>& from,
                           const std::array<double, 4>& to) {
  const int k = between == Between::straight ? 1 : between == Between::quintic ? 3 : 4, n = 2 * k - 1;
  std::vector<double> b(static_cast<std::size_t>(n + 1));
  for (int i = 0; i < k; ++i) {
    double forward = 0, backward = 0, binomial = 1, scale = 1;
    for (int r = 0; r <= i; ++r) {
      forward += binomial * scale * from[static_cast<std::size_t>(r)];
      backward += (r % 2 == 0 ? binomial : -binomial) * scale * to[static_cast<std::size_t>(r)];
      binomial *= static_cast<double>(i - r) / static_cast<double>(r + 1);
      scale *= duration / static_cast<double>(n - r);
    }
    b[static_cast<std::size_t>(i)] = forward, b[static_cast<std::size_t>(n - i)] = backward;
  }
  return b;
}

/// The part of a polynomial between two of its parameters, over [0, 1].
std::vector<double> part(const std::vector<double>& b, double from, double to) {
  BernsteinArray left{}, right{}, rest{};
  bernstein_split(b, to, left.data(), rest.data());
  bernstein_split({left.data(), b.size()}, to > 0 ? from / to : 0, rest.data(), right.data());
  return {right.begin(), right.begin() + static_cast<std::ptrdiff_t>(b.size())};
}

/// Takes the difference of law and table between t0 and t1 into the errors.
void take_difference(const CamLaw& law, double t0, double t1, const std::vector<double>& table,
                     std::array<double, 4>& error) {
  const auto behind = std::upper_bound(law.breaks().begin() + 1, law.breaks().end() - 1, t0);
  for (auto i = static_cast<std::size_t>(behind - law.breaks().begin()) - 1; i < law.pieces(); ++i) {
    if (law.breaks()[i] >= t1) break;
    const double begin = std::max(t0, law.breaks()[i]), end = std::min(t1, law.breaks()[i + 1]);
    if (!(end - begin > 1e-12 * law.duration())) continue;
    const double own = law.breaks()[i], length = law.piece_duration(i);
    auto a = part(law.piece(i).bernstein, (begin - own) / length, std::min(1.0, (end - own) / length));
    auto b = part(table, (begin - t0) / (t1 - t0), std::min(1.0, (end - t0) / (t1 - t0)));
    BernsteinArray p{}, q{};
    std::copy(a.begin(), a.end(), p.begin());
    std::copy(b.begin(), b.end(), q.begin());
    const std::size_t n = std::max(a.size(), b.size());
    bernstein_raise(p.data(), a.size() - 1, n - 1);
    bernstein_raise(q.data(), b.size() - 1, n - 1);
    for (std::size_t k = 0; k < n; ++k) p[k] -= q[k];
    std::size_t size = n;
    for (double& largest : error) {
      BernsteinExtremes found{-largest, largest};
      take_extremes({p.data(), size}, found);
      largest = std::max(found.high, -found.low);
      size = bernstein_derivative({p.data(), size}, p.data());
      for (std::size_t k = 0; k < size; ++k) p[k] /= end - begin;
    }
  }
}

/// The table in the making: its points by their times, and the curves between them.
class Table {
 public:
  Table(const CamLaw& law, const TableCycle& cycle, bool own_ends) : law_(law), cycle_(cycle), own_ends_(own_ends) {}

  /// A curve of the table, and how far it is from the law.
  struct Curve {
    double begin = 0, end = 0;
    Between between = Between::straight;
    bool step = false;  ///< carries a jump of the law
    std::array<double, 4> error{};
  };

  /// Returns the curve from one time to another.
  Curve curve(double begin, double end, Between between, bool step = false) const {
    Curve out{begin, end, between, step, {}};
    take_difference(law_, begin, end, driven(between, end - begin, state(law_, begin, false), state_at_end(end)),
                    out.error);
    return out;
  }

  ControllerTable finish(const std::vector<Curve>& curves) const {
    ControllerTable out;
    for (const Curve& curve : curves) {
      out.points.push_back(point(curve.begin, state(law_, curve.begin, false), curve.between));
      out.ends.push_back(point(curve.end, state_at_end(curve.end), curve.between));
      for (std::size_t r = 0; r < out.error.size(); ++r) out.error[r] = std::max(out.error[r], curve.error[r]);
      if (curve.step) ++out.steps, out.longest_step = std::max(out.longest_step, (curve.end - curve.begin) / rate());
    }
    out.points.push_back(out.ends.back());
    clean_zeros(out);
    return out;
  }

 private:
  double rate() const { return cycle_.duration / cycle_.length; }  // s per master's unit
  double law_end() const { return law_.breaks().back(); }
  /// A controller that knows one state per point takes the one behind it.
  std::array<double, 4> state_at_end(double t) const { return state(law_, t, own_ends_ || t >= law_end()); }
  TablePoint point(double t, const std::array<double, 4>& now, Between next) const {
    const double unit = rate();
    return {cycle_.begin + (t >= law_end() ? cycle_.length : t / unit),
            now[0],
            now[1] * unit,
            now[2] * unit * unit,
            now[3] * unit * unit * unit,
            next};
  }
  /// Writes 0 for what is rounding beside the largest value of its order.
  void clean_zeros(ControllerTable& table) const {
    int order = 0;
    for (double TablePoint::*column :
         {&TablePoint::position, &TablePoint::velocity, &TablePoint::acceleration, &TablePoint::jerk}) {
      const double little = 1e-13 * law_.peak(order).value * std::pow(rate(), order);
      for (auto* list : {&table.points, &table.ends})
        for (TablePoint& p : *list)
          if (std::abs(p.*column) <= little) p.*column = 0;
      ++order;
    }
  }

  const CamLaw& law_;
  const TableCycle& cycle_;
  const bool own_ends_;
};

/// Returns whether s^(order) jumps at the break at which a piece begins, beside the derivative's peak.
bool jumps(const CamLaw& law, std::size_t piece, int order, double peak) {
  return std::abs(law.in_piece(piece - 1, 1, order) - law.in_piece(piece, 0, order)) > 1e-7 * peak;
}

/// Makes tables whose points lie where the law needs them.
class BreaksTable {
 public:
  BreaksTable(const CamLaw& law, const TableCycle& cycle, std::size_t max_points, bool septic, bool own_ends)
      : law_(law), table_(law, cycle, own_ends), max_points_(max_points), septic_(septic), own_ends_(own_ends) {
    const auto range = law.extremes(0);
    position_room_ = 1e-6 * (range.highest.value - range.lowest.value);
    peaks_ = {0, law.peak(1).value, law.peak(2).value, law.peak(3).value};
    jerk_room_ = 0.01 * std::max(peaks_[3], 1e-3 * peaks_[2] / law.duration());
  }

  ControllerTable make() {
    lay_curves();
    const auto worse = [&](std::size_t a, std::size_t b) { return excess(curves_[a]) < excess(curves_[b]); };
    std::vector<std::size_t> heap(curves_.size());
    for (std::size_t i = 0; i < heap.size(); ++i) heap[i] = i;
    std::make_heap(heap.begin(), heap.end(), worse);
    while (!heap.empty() && curves_.size() + 1 < max_points_) {
      std::pop_heap(heap.begin(), heap.end(), worse);
      const std::size_t worst = heap.back();
      heap.pop_back();
      if (!(excess(curves_[worst]) > 1)) break;
      const double middle = division(curves_[worst]);
      if (!(middle > 0)) continue;
      const double end = curves_[worst].end;
      curves_[worst] = curve(curves_[worst].begin, middle);
      curves_.push_back(curve(middle, end));
      for (const std::size_t part : {worst, curves_.size() - 1}) {
        heap.push_back(part);
        std::push_heap(heap.begin(), heap.end(), worse);
      }
    }
    std::sort(curves_.begin(), curves_.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    return table_.finish(curves_);
  }

 private:
  using Curve = Table::Curve;
  static constexpr double step_part = 1e-3;          // part of its piece that a step takes
  static constexpr double smallest_part = 1 / 64.0;  // part of its piece that a curve takes at least

  /// Begins with curves between the breaks of the law, or where these are too many between its jumps.
  void lay_curves() {
    std::vector<bool> jump(law_.pieces() + 1, false);
    std::size_t count = 0;
    for (std::size_t i = 1; i < law_.pieces(); ++i)
      if ((jump[i] = jumps(law_, i, 1, peaks_[1]) || jumps(law_, i, 2, peaks_[2]))) ++count;
    const std::size_t steps = own_ends_ ? 0 : count;
    const bool all = law_.pieces() + 1 + steps <= max_points_;
    const bool with_steps = !own_ends_ && 2 * count + 2 <= max_points_;
    double begin = law_.breaks().front();
    for (std::size_t i = 1; i <= law_.pieces(); ++i) {
      const bool last = i == law_.pieces();
      if (!last && !all && !(jump[i] && (own_ends_ ? count + 2 <= max_points_ : with_steps))) continue;
      double end = law_.breaks()[i];
      if (!last && jump[i] && with_steps) {
        const double before = end - step_part * law_.piece_duration(i - 1);
        curves_.push_back(curve(begin, before));
        curves_.push_back(table_.curve(before, end, Between::quintic, true));
      } else {
        curves_.push_back(curve(begin, end));
      }
      begin = end;
    }
  }

  Curve curve(double begin, double end) const { return table_.curve(begin, end, between(begin, end)); }

  /// A polynomial of degree 7 takes the jerk at its ends: a jump of the jerk has no place there.
  Between between(double begin, double end) const {
    if (!septic_) return Between::quintic;
    const std::size_t piece = piece_at(begin);
    const bool whole = end >= law_.breaks()[piece + 1];
    if (end > law_.breaks()[piece + 1] || law_.piece(piece).degree() <= 5 ||
        (whole && piece + 1 < law_.pieces() && jumps(law_, piece + 1, 3, peaks_[3])))
      return Between::quintic;
    return Between::septic;
  }

  std::size_t piece_at(double t) const {
    const auto behind = std::upper_bound(law_.breaks().begin() + 1, law_.breaks().end() - 1, t);
    return static_cast<std::size_t>(behind - law_.breaks().begin()) - 1;
  }

  double excess(const Curve& curve) const {
    if (curve.step) return 0;
    return std::max(curve.error[0] / std::max(position_room_, 1e-300), curve.error[3] / std::max(jerk_room_, 1e-300));
  }

  /// Returns where a curve is divided: at the break of the law nearest to its middle, or there; 0: it is short enough.
  double division(const Curve& curve) const {
    const double middle = (curve.begin + curve.end) / 2, slack = 1e-9 * (curve.end - curve.begin);
    double best = 0;
    for (std::size_t i = piece_at(curve.begin) + 1; i < law_.pieces() && law_.breaks()[i] < curve.end - slack; ++i)
      if (law_.breaks()[i] > curve.begin + slack &&
          (best == 0 || std::abs(law_.breaks()[i] - middle) < std::abs(best - middle)))
        best = law_.breaks()[i];
    if (best != 0) return best;
    const double piece = law_.piece_duration(piece_at(middle));
    return middle - curve.begin < smallest_part * piece * (1 - 1e-9) ? 0 : middle;
  }

  const CamLaw& law_;
  Table table_;
  const std::size_t max_points_;
  const bool septic_, own_ends_;
  double position_room_ = 0, jerk_room_ = 0;
  std::array<double, 4> peaks_{};
  std::vector<Curve> curves_;
};

}  // namespace

ControllerTable even_table(const CamLaw& law, const TableCycle& cycle, std::size_t steps, Between between) {
  const Table table(law, cycle, false);
  std::vector<Table::Curve> curves;
  const auto time = [&](std::size_t k) {
    return k == steps ? law.breaks().back() : law.duration() * static_cast<double>(k) / static_cast<double>(steps);
  };
  for (std::size_t k = 0; k < steps; ++k) curves.push_back(table.curve(time(k), time(k + 1), between));
  return table.finish(curves);
}

ControllerTable breaks_table(const CamLaw& law, const TableCycle& cycle, std::size_t max_points, bool septic,
                             bool own_ends) {
  return BreaksTable(law, cycle, max_points, septic, own_ends).make();
}

}  // namespace bahnwerk::cam
