#include "core/probe/optimal/start.hpp"

#include <algorithm>
#include <cmath>

#include "core/probe/optimal/cell_rows.hpp"
#include "core/probe/optimal/chain_speed.hpp"
#include "core/probe/optimal/refine.hpp"

namespace bahnwerk {
namespace {

// The speed at distance d from a rest, relative to that far away: it grows as d^(3/4), as under a constant snap.
struct Ramp {
  double length;  // mm
  double speed(double d) const {
    const double u = d / length;
    return std::pow(u / (1 + u), 0.75);
  }
  double slope(double d) const {
    const double u = std::max(d / length, 1e-9);
    return 0.75 * std::pow(u / (1 + u), -0.25) / ((1 + u) * (1 + u)) / length;
  }
};

template <int D>
class Passage {
 public:
  Passage(const ChainLimits<D>& limits, std::size_t from, std::size_t to)
      : limits_(limits), from_(from), n_(to - from) {
    rest_.assign(n_ + 1, 0);
    rest_.front() = rest_.back() = 1;
    at_.assign(n_ + 1, 0.0);
    for (std::size_t i = 0; i < n_; ++i) at_[i + 1] = at_[i] + length(i);
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

  // Returns the chain through points i … end, at rest at both.
  CellChain<D> curve(std::size_t i, std::size_t end) const {
    CellChain<D> chain;
    const auto distance = [&](double s) { return std::min(s - at_[i], at_[end] - s); };
    for (std::size_t p = i; p <= end; ++p) {
      ChainNode<D> node;
      node.state[0] = point(p);
      node.point = static_cast<int>(from_ + p);
      if (p > i && p < end) {
        const double a = length(p - 1), b = length(p), d = distance(at_[p]);
        const double sign = at_[p] - at_[i] <= at_[end] - at_[p] ? 1 : -1;
        const double w = ramp_.speed(d), slope = sign * ramp_.slope(d), step = 1e-4 * d;
        const double change =
            sign * (ramp_.speed(d + step) * ramp_.slope(d + step) - ramp_.speed(d - step) * ramp_.slope(d - step)) /
            (2 * step);
        for (int k = 0; k < D; ++k) {
          const double in = (point(p)[k] - point(p - 1)[k]) / a, out = (point(p + 1)[k] - point(p)[k]) / b;
          const double tangent = (in * b + out * a) / (a + b), bend = 2 * (out - in) / (a + b);
          node.state[1][k] = w * tangent;
          node.state[2][k] = w * slope * tangent + w * w * bend;
          node.state[3][k] = w * change * sign * tangent + 3 * w * w * slope * bend;
        }
      }
      chain.node.push_back(node);
      if (p == end) break;
      const double l = length(p);
      double time = 0;
      if (p == i || p + 1 == end) {
        time = 4 * l / ramp_.speed(l);
      } else {
        const double s0 = distance(at_[p]), s1 = distance(at_[p + 1]), middle = distance((at_[p] + at_[p + 1]) / 2);
        time = l / 6 * (1 / ramp_.speed(s0) + 4 / ramp_.speed(middle) + 1 / ramp_.speed(s1));
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
    CellValues<D> v;
    for (std::size_t c = 0; c < chain.cell.size(); ++c) {
      const Capsule<D> set = capsule<D>(point(i + c), point(i + c + 1), room * limits_.radius(from_ + i + c));
      evaluate_cell(chain.node[c], chain.node[c + 1], chain.cell[c].duration, v);
      bool left = false;
      for (std::size_t r = 0; r < CellBasis::first[1]; ++r) {
        bool cap;
        const std::array<double, D> d = offset(set, v.q[r], cap);
        double sum = 0;
        for (int k = 0; k < D; ++k) sum += d[k] * d[k];
        left |= !(sum < set.radius2);
      }
      if (!left) continue;
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
