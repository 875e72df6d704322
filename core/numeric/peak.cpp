#include "core/numeric/peak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/numeric/sign_change.hpp"

namespace bahnwerk {
namespace {

double binomial(int n, int k) {
  double r = 1;
  for (int i = 1; i <= k; ++i) r = r * (n - k + i) / i;
  return r;
}

// T_j(2t − 1) as Bernstein coefficients of degree n ≥ j: b_i = (−1)^(j−i) C(2j,2i) / C(j,i), then raised in degree.
std::vector<double> chebyshev_in_bernstein(int j, int n) {
  std::vector<double> b(static_cast<std::size_t>(j) + 1);
  for (int i = 0; i <= j; ++i) b[i] = ((j - i) % 2 ? -1 : 1) * binomial(2 * j, 2 * i) / binomial(j, i);
  for (int d = j; d < n; ++d) {
    std::vector<double> up(static_cast<std::size_t>(d) + 2);
    for (int i = 0; i <= d + 1; ++i)
      up[i] = (i > 0 ? b[i - 1] * i / (d + 1) : 0) + (i <= d ? b[i] * (d + 1 - i) / (d + 1) : 0);
    b = std::move(up);
  }
  return b;
}

// ∫ T_j(2t − 1) dt from 0 to t.
double chebyshev_integral(int j, double t) {
  const double x = 2 * t - 1;
  auto antiderivative = [j](double y) {
    const double angle = std::acos(std::clamp(y, -1.0, 1.0));
    if (j == 0) return y;
    if (j == 1) return y * y / 2;
    return (std::cos((j + 1) * angle) / (j + 1) - std::cos((j - 1) * angle) / (j - 1)) / 2;
  };
  return (antiderivative(x) - antiderivative(-1)) / 2;
}

ChebyshevRule make_rule(int points, bool open) {
  ChebyshevRule rule;
  rule.points = points;
  const int n = points - 1;
  const double pi = std::numbers::pi;
  auto angle = [&](int i) { return open ? pi * (n - i + 0.5) / points : pi * (n - i) / n; };
  for (int i = 0; i < points; ++i) {
    const double half = std::sin((pi - angle(i)) / 2);  // (1 + cos)/2 without cancellation near 0
    rule.node[i] = half * half;
  }
  for (int k = 0; k < points; ++k)
    for (int i = 0; i < points; ++i) {
      double w = 2 * std::cos(k * angle(i)) / (open ? points : n);
      if (!open && (i == 0 || i == n)) w /= 2;
      if (k == 0 || (!open && k == n)) w /= 2;
      rule.chebyshev[k][i] = w;
    }
  for (int k = 0; k < points; ++k) {
    const std::vector<double> basis = chebyshev_in_bernstein(k, n);
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) {
        rule.bernstein[j][i] += basis[j] * rule.chebyshev[k][i];
        rule.integral[j][i] += chebyshev_integral(k, rule.node[j]) * rule.chebyshev[k][i];
      }
    for (int i = 0; i < points; ++i) rule.whole[i] += chebyshev_integral(k, 1) * rule.chebyshev[k][i];
  }
  for (int j = 0; j < points; ++j) {
    double sum = 0;
    for (int i = 0; i < points; ++i) sum += std::abs(rule.bernstein[j][i]);
    rule.rounding = std::max(rule.rounding, points * std::numeric_limits<double>::epsilon() / 2 * sum);
  }
  return rule;
}

double value_at(const double* c, int n, double t) {
  std::array<double, max_coefficients> b;
  std::copy(c, c + n, b.begin());
  for (int r = n - 1; r > 0; --r)
    for (int i = 0; i < r; ++i) b[i] += t * (b[i + 1] - b[i]);
  return b[0];
}

// The one root of the derivative (Bernstein differences d, m of them, of opposite sign at both ends). Boost's
// toms748_solve takes 1.2 to 1.4 times as long at these degrees.
double single_root(const double* d, int m) {
  SignChange root{0, d[0], 1, d[m - 1]};
  for (int i = 0; i < 60 && root.high - root.low > 1e-9; ++i) {
    double t = root.next();
    if (!root.holds(t)) t = root.middle();
    const double f = value_at(d, m, t);
    if (f == 0) return t;
    root.take(t, f);
  }
  return root.middle();
}

void locate(double* c, int n, double lo, double hi, int depth, PolynomialPeak& best) {
  auto offer = [&](double value, double at) {
    if (std::abs(value) > best.value) best = {std::abs(value), at};
  };
  offer(c[0], lo);
  offer(c[n - 1], hi);
  double bound = 0;
  for (int i = 0; i < n; ++i) bound = std::max(bound, std::abs(c[i]));
  if (bound <= best.value * (1 + 1e-13) || depth > 40) return;

  std::array<double, max_coefficients> d;
  int changes = 0;
  double sign = 0;
  for (int i = 0; i + 1 < n; ++i) {
    d[i] = c[i + 1] - c[i];
    if (d[i] == 0) continue;
    if (sign * d[i] < 0) ++changes;
    sign = d[i];
  }
  if (changes == 0) return;
  if (changes == 1 && d[0] != 0 && d[n - 2] != 0) {
    const double t = single_root(d.data(), n - 1);
    offer(value_at(c, n, t), lo + t * (hi - lo));
    return;
  }
  std::array<double, max_coefficients> left;
  for (int r = 0; r < n; ++r) {
    left[r] = c[0];
    for (int i = 0; i + 1 < n - r; ++i) c[i] = (c[i] + c[i + 1]) / 2;
  }
  // c now has the right half's coefficients.
  const double middle = lo + (hi - lo) / 2;
  locate(left.data(), n, lo, middle, depth + 1, best);
  locate(c, n, middle, hi, depth + 1, best);
}

}  // namespace

const ChebyshevRule& lobatto_rule(int points) {
  static const std::array<ChebyshevRule, 3> rules{make_rule(5, false), make_rule(9, false), make_rule(13, false)};
  return rules[static_cast<std::size_t>(points / 4 - 1)];
}

const ChebyshevRule& open_rule() {
  static const ChebyshevRule rule = make_rule(9, true);
  return rule;
}

PolynomialPeak polynomial_peak(double* coefficients, int n, double floor) {
  PolynomialPeak best{floor, -1};
  locate(coefficients, n, 0, 1, 0, best);
  return best;
}

double interpolation_error(int points, double reach) {
  if (!(reach > 1)) return std::numeric_limits<double>::infinity();
  // The ellipse reaches (ρ + 1/ρ)/2 from its middle.
  const double rho = reach + std::sqrt(reach * reach - 1), square = rho * rho;
  double power = 1;
  for (int n = points - 1; n > 1; n -= 2) power *= square;
  if (points % 2 == 0) power *= rho;
  return 4 / (power * (rho - 1));
}

PeakSweep::PeakSweep(std::vector<double> scales, double resolution, double rounding)
    : peaks_(scales.size()),
      scales_(std::move(scales)),
      resolution_(resolution),
      rounding_(rounding),
      values_(peaks_.size() * static_cast<std::size_t>(ChebyshevRule::max_points)),
      missing_(peaks_.size()),
      room_(peaks_.size()) {}

void PeakSweep::raise(std::size_t channel, double value, double at, std::size_t tag) {
  Peak& peak = peaks_[channel];
  if (!std::isfinite(value)) {
    if (peak.finite) peak = {value, at, tag, false};
    return;
  }
  if (peak.finite && std::abs(value) > peak.value) peak = {std::abs(value), at, tag, true};
}

// Coefficients that no longer decay below this are rounding, which matters next to the peak only.
constexpr double noise_like = 1e-6;
// More points than usual span longer intervals and lie on the flanks of a peak, where errors of their places count
// most. They show that an interval stays below the peak by more than this part of it; a higher one is only taken from
// them where that part is below the resolution.
constexpr int usual_points = 9;
constexpr double off_flanks = 1e-9;

bool PeakSweep::absorb(const ChebyshevRule& rule, double begin, double end, std::size_t tag, bool resolved,
                       Patience patience) {
  evaluations_ += static_cast<std::size_t>(rule.points);
  const int n = rule.points;
  bool done = true;
  for (std::size_t channel = 0; channel < peaks_.size(); ++channel) {
    const double* f = values_.data() + channel * static_cast<std::size_t>(n);
    double largest = 0, sum = 0;
    int where = 0;
    for (int i = 0; i < n; ++i) {
      sum += f[i];
      if (std::abs(f[i]) > largest) largest = std::abs(f[i]), where = i;
    }
    if (!std::isfinite(sum)) {
      for (int i = 0; i < n; ++i) raise(channel, f[i], begin + rule.node[i] * (end - begin), tag);
      raise(channel, sum, begin, tag);
      continue;
    }
    raise(channel, f[where], begin + rule.node[where] * (end - begin), tag);
    Peak& peak = peaks_[channel];
    if (!peak.finite) continue;
    room_[channel] = peak.value - largest;

    // |p| ≤ Λ max|f(x_i)| with Lebesgue constants below 2.6 for up to 13 Chebyshev points.
    const double proven = missing_[channel] + (rounding_ + rule.rounding) * largest,
                 doubt = proven + (n > usual_points ? off_flanks * largest : 0);
    if (resolved && 2.6 * largest + doubt <= peak.value) continue;

    std::array<double, ChebyshevRule::max_points> b{};
    double bound = 0;
    for (int j = 0; j < n; ++j) {
      double x = 0;
      for (int i = 0; i < n; ++i) x += rule.bernstein[j][i] * f[i];
      b[j] = x;
      bound = std::max(bound, std::abs(x));
    }
    const double magnitude = std::max(scales_[channel], largest);
    if (std::isfinite(proven) || (!std::isnan(proven) && patience != Patience::none)) {
      if (resolved && bound + doubt <= peak.value * (1 + 1e-12)) continue;
      if (resolved) {  // the polynomial may stay below the peak where its coefficients do not
        const PolynomialPeak p = polynomial_peak(b.data(), n, std::max(0.0, peak.value - doubt));
        if (p.at < 0 && doubt <= peak.value) continue;
        if (doubt <= resolution_ * magnitude) {
          if (p.value + proven > peak.value) peak = {p.value + proven, begin + p.at * (end - begin), tag, true};
          continue;
        }
      }
      if (patience == Patience::none || (patience == Patience::some && proven <= resolution_ * magnitude)) {
        raise(channel, bound + proven, begin + (end - begin) / 2, tag);
        continue;
      }
      done = false;
      continue;
    }
    ++estimated_;
    // The last four coefficients give the rate of decay, and the rate the truncation error.
    std::array<double, 4> c{};
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < n; ++i) c[k] += rule.chebyshev[n - 4 + k][i] * f[i];
    const double earlier = std::max(std::abs(c[0]), std::abs(c[1])), tail = std::max(std::abs(c[2]), std::abs(c[3]));
    const double missing = tail <= resolution_ / 8 * magnitude ? tail * 8
                           : tail <= earlier / 8               ? tail * tail / earlier * 8 / 7
                           : tail <= noise_like * magnitude    ? tail * 64
                                                               : std::numeric_limits<double>::infinity();

    if (resolved && bound + 4 * missing <= peak.value * (1 + 1e-12)) continue;
    if (resolved && missing <= resolution_ * magnitude) {
      const PolynomialPeak p = polynomial_peak(b.data(), n, peak.value);
      if (p.at >= 0) peak = {p.value, begin + p.at * (end - begin), tag, true};
      continue;
    }
    const bool noise = patience == Patience::some && tail <= 5 * resolution_ * magnitude;
    if (noise || patience == Patience::none) {
      raise(channel, bound + 8 * tail, begin + (end - begin) / 2, tag);
      continue;
    }
    done = false;
  }
  return done;
}

}  // namespace bahnwerk
