#pragma once
/// Numbers that represent all complex numbers within a radius of a real one. A formula written once then encloses its
/// values for all of them [Petković, Petković, "Complex Interval Arithmetic and Its Applications", 1998, chapter 1].
///
/// A real interval is the diameter of a disc, so these numbers enclose functions over intervals and, where they are
/// analytic, over discs in the complex plane. Rounding of the centres is included; rounding of the radii, 1e-15 of
/// them, is not. If a disc may reach a singularity, the radius is infinite or NaN. As coefficients of a Taylor
/// (core/numeric/taylor.hpp) they enclose derivatives. Cost: 2 to 4 multiplications each.
#include <cmath>
#include <limits>

#include "core/numeric/sine_cosine.hpp"

namespace bahnwerk {

/// The set of all complex numbers within `radius` of `centre`.
struct Disc {
  double centre = 0, radius = 0;

  Disc() = default;
  Disc(double number) : centre(number) {}  // NOLINT: numbers are used in formulas like discs
  Disc(double c, double r) : centre(c), radius(r) {}

  double low() const { return centre - radius; }
  double high() const { return centre + radius; }
  double most() const { return std::abs(centre) + radius; }  ///< largest magnitude
  bool known() const { return std::isfinite(radius); }
  bool zero() const { return centre == 0 && radius == 0; }

  friend Disc operator-(const Disc& a) { return {-a.centre, a.radius}; }
  friend Disc operator+(const Disc& a, const Disc& b) { return rounded(a.centre + b.centre, a.radius + b.radius); }
  friend Disc operator-(const Disc& a, const Disc& b) { return rounded(a.centre - b.centre, a.radius + b.radius); }
  friend Disc operator*(const Disc& a, const Disc& b) {
    return rounded(a.centre * b.centre, std::abs(a.centre) * b.radius + a.radius * (std::abs(b.centre) + b.radius));
  }
  friend Disc operator*(double a, const Disc& b) { return rounded(a * b.centre, std::abs(a) * b.radius); }
  friend Disc operator/(const Disc& a, const Disc& b) {
    const double least = std::abs(b.centre) - b.radius, q = a.centre / b.centre;
    return least > 0 ? rounded(q, (a.radius + std::abs(q) * b.radius) / least) : unknown(q);
  }
  Disc& operator+=(const Disc& b) { return *this = *this + b; }
  Disc& operator-=(const Disc& b) { return *this = *this - b; }
  Disc& operator/=(double b) { return *this = rounded(centre / b, radius / std::abs(b)); }

  /// Returns the root, from |√(c + δ) − √c| = |δ|/|√(c + δ) + √c|, and Re √(c + δ) ≥ √(c − r).
  friend Disc sqrt(const Disc& a) {
    const double root = std::sqrt(a.centre), least = a.centre - a.radius;
    return least > 0 ? rounded(root, a.radius / (root + std::sqrt(least))) : unknown(root);
  }
  /// Returns the sine, from sin(c + δ) − sin c = cos c sin δ − sin c (1 − cos δ), |sin δ| ≤ sinh r, |1 − cos δ| ≤ cosh
  /// r − 1.
  friend SineCosine<Disc> sine_cosine(const Disc& a) {
    const auto [s, c] = bahnwerk::sine_cosine(a.centre);
    const double first = grown_sine(a.radius), second = grown_cosine(a.radius);
    return {rounded(s, std::abs(c) * first + std::abs(s) * second),
            rounded(c, std::abs(s) * first + std::abs(c) * second)};
  }
  friend Disc sin(const Disc& a) { return sine_cosine(a).sine; }
  friend Disc cos(const Disc& a) { return sine_cosine(a).cosine; }
  /// Returns the angle of the direction (x, y): (log(x + iy) − log(x − iy))/2i, and |log(1 + z)| ≤ −log(1 − |z|).
  friend Disc direction_angle(const Disc& y, const Disc& x) {
    const double angle = bahnwerk::direction_angle(y.centre, x.centre),
                 part = (x.radius + y.radius) / std::sqrt(x.centre * x.centre + y.centre * y.centre);
    return part < 1 ? rounded(angle, -std::log1p(-part)) : unknown(angle);
  }
  /// Returns the arc cosine, from |acos′ z| = 1/|√(1 − z²)|.
  friend Disc acos(const Disc& a) {
    const double angle = std::acos(a.centre), most = a.most();
    return most < 1 ? rounded(angle, a.radius / std::sqrt(1 - most * most)) : unknown(angle);
  }

 private:
  static constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();

  static Disc rounded(double centre, double radius) { return {centre, radius + rounding * std::abs(centre)}; }
  static Disc unknown(double centre) { return {centre, std::numeric_limits<double>::infinity()}; }
  /// Return upper bounds of sinh r and of cosh r − 1.
  static double grown_sine(double r) { return r <= 1 ? r * (1 + 0.18 * r * r) : std::sinh(r); }
  static double grown_cosine(double r) { return r <= 1 ? 0.55 * r * r : std::cosh(r) - 1; }
};

}  // namespace bahnwerk
