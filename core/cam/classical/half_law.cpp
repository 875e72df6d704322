#include "core/cam/classical/half_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/cam/bernstein.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t sine_degree = 21;  // (π/2)^19/19! < 5e-14 of the jerk is lost over half a period

struct Sine {
  double amplitude, omega, phase;  // amplitude · sin(omega z + phase)
};
/// c0 + c1 z + c2 z² + Σ sines up to `end`.
struct Zone {
  double end, c0, c1, c2;
  std::vector<Sine> sines;
};

/// Adds factor · (x − 1/2)^power, x ∈ [0, 1], to coefficients of degree n.
void add_power(double factor, std::size_t power, std::size_t n, double* sum) {
  BernsteinArray b{};
  for (std::size_t j = 0; j <= power; ++j)
    b[j] = ((power - j) % 2 == 0 ? 1 : -1) * std::ldexp(factor, -static_cast<int>(power));
  bernstein_raise(b.data(), power, n);
  for (std::size_t k = 0; k <= n; ++k) sum[k] += b[k];
}

std::vector<double> piece(const Zone& zone, double begin, double end) {
  const std::size_t n = zone.sines.empty() ? 2 : sine_degree;
  std::vector<double> b(n + 1, 0.0);
  const double middle = (begin + end) / 2, width = end - begin;
  add_power(zone.c0 + middle * (zone.c1 + middle * zone.c2), 0, n, b.data());
  add_power(width * (zone.c1 + 2 * zone.c2 * middle), 1, n, b.data());
  add_power(width * width * zone.c2, 2, n, b.data());
  for (const Sine& sine : zone.sines) {
    const double angle = sine.omega * middle + sine.phase, turn = sine.omega * width;
    const std::array derivatives{std::sin(angle), std::cos(angle), -std::sin(angle), -std::cos(angle)};
    double factor = sine.amplitude;
    for (std::size_t k = 0; k <= n; ++k) {
      add_power(factor * derivatives[k % 4], k, n, b.data());
      factor *= turn / static_cast<double>(k + 1);
    }
  }
  return b;
}

std::vector<HalfLawPiece> pieces(const std::vector<Zone>& zones) {
  std::vector<HalfLawPiece> out;
  double begin = 0;
  for (const Zone& zone : zones) {
    double turn = 0;
    for (const Sine& sine : zone.sines) turn = std::max(turn, sine.omega * (zone.end - begin));
    const int parts = std::max(1, static_cast<int>(std::ceil(turn / pi - 1e-9)));
    const double from = begin;
    for (int i = 0; i < parts; ++i) {
      const double end = i + 1 == parts ? zone.end : from + (zone.end - from) * (i + 1) / parts;
      out.push_back({begin, end, piece(zone, begin, end)});
      begin = end;
    }
  }
  return out;
}

std::vector<HalfLawPiece> polynomial(const std::vector<double>& whole) {
  BernsteinArray left{}, right{};
  bernstein_split(whole, 0.5, left.data(), right.data());
  return {{0, 0.5, {left.begin(), left.begin() + static_cast<std::ptrdiff_t>(whole.size())}}};
}

std::vector<HalfLawPiece> gutman(int harmonics) {
  std::vector<double> weight;
  double sum = 0;
  for (int i = 0; i < harmonics; ++i) {
    const double k = 2 * i + 1;
    weight.push_back((1 - k / (2 * harmonics + 2)) / (k * k)), sum += weight.back();
  }
  Zone zone{0.5, 0, 1, 0, {}};
  for (int i = 0; i < harmonics; ++i) {
    const double k = 2 * i + 1;
    zone.sines.push_back({-weight[static_cast<std::size_t>(i)] / sum / (2 * pi * k), 2 * pi * k, 0});
  }
  return pieces({zone});
}

/// Acceleration: a quarter sine up to 1/8, constant up to 3/8, a quarter cosine down to 0 at 1/2.
std::vector<HalfLawPiece> modified_trapezoid() {
  const double ca = 8 * pi / (2 + pi), w = 4 * pi;
  const double v1 = ca / w, s1 = ca / w / 8 - ca / (w * w);   // state at 1/8
  const double v2 = v1 + ca / 4, s2 = s1 + v1 / 4 + ca / 32;  // state at 3/8
  const Zone rise{0.125, 0, ca / w, 0, {{-ca / (w * w), w, 0}}};
  const Zone plateau{0.375, s1 - v1 / 8 + ca / 128, v1 - ca / 8, ca / 2, {}};
  // v = v2 + ca/w sin(w (z − 3/8)); s = s2 + v2 (z − 3/8) + ca/w² (1 − cos(w (z − 3/8)))
  const Zone fall{0.5, s2 - v2 * 0.375 + ca / (w * w), v2, 0, {{-ca / (w * w), w, pi / 2 - w * 0.375}}};
  return pieces({rise, plateau, fall});
}

/// The half law of acceleration 1 is scaled to 1/2 in the middle.
std::vector<HalfLawPiece> sine_straight(const SineStraight& f) {
  const double b = f.b / pi, d = f.d / pi, q = (f.b + f.c) / 2, e = (1 - f.b - f.c - f.d) / 2;
  const double s1 = b * f.b / 2 - b * b, v1 = b;                       // state at b/2
  const double s2 = s1 + (v1 + f.c / 4) * f.c / 2, v2 = v1 + f.c / 2;  // state at q
  const double s3 = s2 + v2 * f.d / 2 + d * d, v3 = v2 + d;            // state at q + d/2
  if (!(v3 > 0)) return pieces({{0.5, 0, 1, 0, {}}});
  const double ca = 0.5 / (s3 + v3 * e);
  std::vector<Zone> zones;
  if (f.b > 0) zones.push_back({f.b / 2, 0, ca * b, 0, {{-ca * b * b, 1 / b, 0}}});
  if (f.c > 0) {
    const double from = f.b / 2;
    zones.push_back({q, ca * (s1 - v1 * from + from * from / 2), ca * (v1 - from), ca / 2, {}});
  }
  // −cos x = −sin(x + π/2).
  if (f.d > 0)
    zones.push_back({q + f.d / 2, ca * (s2 - v2 * q + d * d), ca * v2, 0, {{-ca * d * d, 1 / d, pi / 2 - q / d}}});
  if (e > 1e-9) zones.push_back({0.5, 0.5 - 0.5 * ca * v3, ca * v3, 0, {}});
  zones.back().end = 0.5;
  return pieces(zones);
}

/// Takes rounding out of f(1).
std::vector<HalfLawPiece> ending_at_one(std::vector<HalfLawPiece> law) {
  law.back().bernstein.back() = 1;
  return law;
}

std::vector<HalfLawPiece> harmonic_combination(double lambda) {
  const double mu = 1 - lambda, v = 1 / (lambda / 2 + 2 * mu / pi);
  return ending_at_one(
      pieces({{lambda, 0, v / 2, 0, {{-v * lambda / (2 * pi), pi / lambda, 0}}},
              {1, v * lambda / 2, 0, 0, {{2 * v * mu / pi, pi / (2 * mu), -pi * lambda / (2 * mu)}}}}));
}

/// Returns 1 − f(1 − z).
std::vector<HalfLawPiece> reversed(std::vector<HalfLawPiece> law) {
  std::reverse(law.begin(), law.end());
  for (HalfLawPiece& piece : law) {
    piece = {1 - piece.end, 1 - piece.begin, {piece.bernstein.rbegin(), piece.bernstein.rend()}};
    for (double& b : piece.bernstein) b = 1 - b;
  }
  return law;
}

std::vector<HalfLawPiece> modified_sine() {
  const double c = 1 / (4 + pi);
  return pieces(
      {{0.125, 0, pi * c, 0, {{-c / 4, 4 * pi, 0}}}, {0.5, 2 * c, pi * c, 0, {{-2.25 * c, 4 * pi / 3, pi / 3}}}});
}

}  // namespace

std::vector<HalfLawPiece> half_law(ClassicalLaw law, const SineStraight& fractions) {
  switch (law) {
    case ClassicalLaw::polynomial_345:
      return polynomial({0, 0, 0, 1, 1, 1});
    case ClassicalLaw::polynomial_4567:
      return polynomial({0, 0, 0, 0, 1, 1, 1, 1});
    case ClassicalLaw::modified_sine:
      return modified_sine();
    case ClassicalLaw::modified_trapezoid:
      return modified_trapezoid();
    case ClassicalLaw::inclined_sine:
    case ClassicalLaw::gutman_1:
      return gutman(1);
    case ClassicalLaw::simple_harmonic:
      return pieces({{0.5, 0.5, 0, 0, {{-0.5, pi, pi / 2}}}});
    case ClassicalLaw::quadratic:
      return pieces({{0.5, 0, 0, 2, {}}});
    case ClassicalLaw::gutman_2:
      return gutman(2);
    case ClassicalLaw::gutman_3:
      return gutman(3);
    case ClassicalLaw::sine_straight_combination:
      return sine_straight(fractions);
    case ClassicalLaw::double_harmonic_from_dwell:
    case ClassicalLaw::double_harmonic_to_dwell:
    case ClassicalLaw::harmonic_combination_from_dwell:
    case ClassicalLaw::harmonic_combination_to_dwell:
    case ClassicalLaw::polynomial_3456_from_dwell:
    case ClassicalLaw::polynomial_3456_to_dwell:
    case ClassicalLaw::straight:
      break;
  }
  throw std::logic_error("a law without halves");
}

std::vector<HalfLawPiece> whole_law(ClassicalLaw law, std::optional<double> inflection) {
  switch (law) {
    case ClassicalLaw::double_harmonic_from_dwell:
      return ending_at_one(pieces({{1, 0.375, 0, 0, {{-0.5, pi, pi / 2}, {0.125, 2 * pi, pi / 2}}}}));
    case ClassicalLaw::double_harmonic_to_dwell:
      return reversed(whole_law(ClassicalLaw::double_harmonic_from_dwell));
    case ClassicalLaw::harmonic_combination_from_dwell:
      return harmonic_combination(inflection.value_or(2 - std::numbers::sqrt2));
    case ClassicalLaw::harmonic_combination_to_dwell:
      return reversed(harmonic_combination(inflection ? 1 - *inflection : 2 - std::numbers::sqrt2));
    case ClassicalLaw::polynomial_3456_from_dwell:
      return {{0, 1, {0, 0, 0, 0.4, 0.8, 1, 1}}};
    case ClassicalLaw::polynomial_3456_to_dwell:
      return reversed(whole_law(ClassicalLaw::polynomial_3456_from_dwell));
    default:
      return {};
  }
}

bool has_inflection(ClassicalLaw law) {
  return law == ClassicalLaw::harmonic_combination_from_dwell || law == ClassicalLaw::harmonic_combination_to_dwell ||
         (law != ClassicalLaw::straight && whole_law(law).empty());
}

double middle_velocity(const std::vector<HalfLawPiece>& half) {
  const HalfLawPiece& last = half.back();
  BernsteinArray d;
  const std::size_t size = bernstein_derivative(last.bernstein, d.data());
  return d[size - 1] / (last.end - last.begin);
}

}  // namespace bahnwerk::cam
