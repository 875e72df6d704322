#include "core/probe/optimal/start.hpp"

#include <algorithm>
#include <cmath>

#include "core/probe/optimal/cell_rows.hpp"
#include "core/probe/optimal/chain_speed.hpp"
#include "core/probe/optimal/refine.hpp"

namespace bahnwerk {
namespace {

// The speed at `s` between rests that are `whole` apart, relative to that far away from both: it grows as the distance
// from a rest to the power 3/4, as under a constant snap.
struct Ramp {
  double length;  // mm
  double speed(double s, double whole) const {
    const double u = distance(s, whole);
    return std::pow(u / (1 + u), 0.75);
  }
  // The slope of the speed over s.
  double slope(double s, double whole) const {
    const double u = std::max(distance(s, whole), 1e-9);
    return 0.75 * std::pow(u / (1 + u), -0.25) / ((1 + u) * (1 + u)) * (1 - 2 * s / whole) / length;
  }

 private:
  // From both rests, smoothly, in lengths of the ramp.
  double distance(double s, double whole) const { return s * (whole - s) / (whole * length); }
};

// Returns whether the Bézier points of cell c are inside the capsule.
template <int D>
bool in_capsule(const CellChain<D>& chain, std::size_t c, const Capsule<D>& set) {
  CellValues<D> v;
  evaluate_cell(chain.node[c], chain.node[c + 1], chain.cell[c].duration, v);
  for (std::size_t r = 0; r < CellBasis::first[1]; ++r) {
    bool cap;
    const std::array<double, D> d = offset(set, v.q[r], cap);
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += d[k] * d[k];
    if (!(sum < set.radius2)) return false;
  }
  return true;
}

template <int D>
class Passage {
 public:
  Passage(const ChainLimits<D>& limits, std::size_t from, std::size_t to)
      : limits_(limits), from_(from), n_(to - from) {
    rest_.assign(n_ + 1, 0);
    rest_.front() = rest_.back() = 1;
    at_.assign(n_ + 1, 0.0);
    for (std::size_t i = 0; i < n_; ++i) at_[i + 1] = at_[i] + way(i);
    for (int k = 0; k < D; ++k) {
      const double v = limits.speed;
      ramp_.length =
          std::max(ramp_.length, 1.5 * v *
                                     std::max({v / limits.derivative[0][k], std::sqrt(v / limits.derivative[1][k]),
                                               std::cbrt(v / limits.derivative[2][k])}));
    }
  }

  void append(CellChain<D>& chain) {
    // Curves that leave the tube make rests, which change the curves next to them.
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < n_;) {
        std::size_t end = i + 1;
        while (!rest_[end]) ++end;
        if (end > i + 1) changed |= !section(i, end);
        i = end;
      }
    }
    for (std::size_t i = 0; i < n_;) {
      std::size_t end = i + 1;
      while (!rest_[end]) ++end;
      if (end == i + 1) {
        append_stopping_edge(chain, limits_, from_ + i);
      } else {
        CellChain<D> part = curve(i, end);
        slow_down(part, slowing_factor(part, limits_, 0.1));
        chain.node.insert(chain.node.end(), part.node.begin() + 1, part.node.end());
        chain.cell.insert(chain.cell.end(), part.cell.begin(), part.cell.end());
      }
      i = end;
    }
  }

 private:
  const std::array<double, D>& point(std::size_t i) const { return limits_.points[from_ + i]; }
  double length(std::size_t i) const { return capsule<D>(point(i), point(i + 1), 0).length; }
  bool on_curve(std::size_t i) const {
    return !limits_.curve.empty() && limits_.curve[from_ + i][0] != std::array<double, D>{};
  }
  // Returns the distance along the curve from point i to the next one, or along the edge where the curve's is not about
  // that.
  double way(std::size_t i) const {
    const double edge = length(i);
    if (limits_.along.empty()) return edge;
    const double step = limits_.along[from_ + i + 1] - limits_.along[from_ + i];
    return step > edge / 2 && step < 2 * edge ? step : edge;
  }

  // Returns the chain through points i … end, at rest at both.
  CellChain<D> curve(std::size_t i, std::size_t end) const {
    CellChain<D> chain;
    const double whole = at_[end] - at_[i];
    const auto speed = [&](std::size_t p, double beyond) { return ramp_.speed(at_[p] - at_[i] + beyond, whole); };
    for (std::size_t p = i; p <= end; ++p) {
      ChainNode<D> node;
      node.state[0] = point(p);
      node.point = static_cast<int>(from_ + p);
      if (p > i && p < end) {
        const double a = length(p - 1), b = length(p), d = at_[p] - at_[i], step = 1e-4 * std::min(d, whole - d);
        const double w = ramp_.speed(d, whole), slope = ramp_.slope(d, whole);
        const double change = (ramp_.speed(d + step, whole) * ramp_.slope(d + step, whole) -
                               ramp_.speed(d - step, whole) * ramp_.slope(d - step, whole)) /
                              (2 * step);
        for (int k = 0; k < D; ++k) {
          const double in = (point(p)[k] - point(p - 1)[k]) / a, out = (point(p + 1)[k] - point(p)[k]) / b;
          double tangent = (in * b + out * a) / (a + b), bend = 2 * (out - in) / (a + b), third = 0;
          if (on_curve(p)) {
            const auto& curve = limits_.curve[from_ + p];
            tangent = curve[0][k], bend = curve[1][k], third = curve[2][k];
          }
          node.state[1][k] = w * tangent;
          node.state[2][k] = w * slope * tangent + w * w * bend;
          node.state[3][k] = w * change * tangent + 3 * w * w * slope * bend + w * w * w * third;
        }
      }
      chain.node.push_back(node);
      if (p == end) break;
      const double l = way(p);
      double time = 0;
      if (p == i || p + 1 == end) {
        time = 4 * l / (p == i ? speed(p + 1, 0) : speed(p, 0));
      } else {
        time = l / 6 * (1 / speed(p, 0) + 4 / speed(p, l / 2) + 1 / speed(p + 1, 0));
      }
      chain.cell.push_back({time, from_ + p, 0});
    }
    return chain;
  }

  // False: made rests where the curve leaves the tube.
  bool section(std::size_t i, std::size_t end) {
    constexpr double room = 0.9;
    const CellChain<D> chain = curve(i, end);
    bool inside = true;
    for (std::size_t c = 0; c < chain.cell.size(); ++c) {
      const Capsule<D> set = capsule<D>(point(i + c), point(i + c + 1), room * limits_.radius(from_ + i + c));
      if (in_capsule(chain, c, set)) continue;
      inside = false;
      rest_[i + c] = rest_[i + c + 1] = 1;
    }
    return inside;
  }

  const ChainLimits<D>& limits_;
  std::size_t from_, n_;
  std::vector<char> rest_;
  std::vector<double> at_;
  Ramp ramp_{0};
};

}  // namespace

template <int D>
void append_start(CellChain<D>& chain, const ChainLimits<D>& limits, std::size_t from, std::size_t to) {
  if (limits.tolerance > 0) {
    Passage<D>(limits, from, to).append(chain);
    return;
  }
  for (std::size_t e = from; e < to; ++e) append_stopping_edge(chain, limits, e);
}

template void append_start<1>(CellChain<1>&, const ChainLimits<1>&, std::size_t, std::size_t);
template void append_start<2>(CellChain<2>&, const ChainLimits<2>&, std::size_t, std::size_t);
template void append_start<3>(CellChain<3>&, const ChainLimits<3>&, std::size_t, std::size_t);

}  // namespace bahnwerk
