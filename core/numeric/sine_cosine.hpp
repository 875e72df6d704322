#pragma once
/// Sine and cosine of one angle at once, and the angle of a direction, for numbers of any type: one of a pair takes
/// nearly as long as both.
///
/// The versions for doubles are accurate to 2 units in the last place. They are own code because results must not
/// depend on the machine: the C library chooses among versions with and without fused multiply-add by the processor,
/// and its sine, cosine and angle differ between them in the last bit (seen with glibc 2.36 and
/// GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2); these give the same bits everywhere. Kinematics call them a million
/// times per path, and the C library also takes 1.3 times (sine, cosine) and 2.4 times (angle) as long. Sine and
/// cosine: reduction by parts of π/2 [Cody, Waite, "Software Manual for the Elementary Functions", 1980, chapter 8],
/// polynomials as in FreeBSD's k_sin.c and k_cos.c. Angle: the rational function of Cephes' atan.c.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace bahnwerk {

/// Sine and cosine of an angle.
template <class T>
struct SineCosine {
  T sine, cosine;
};

/// Returns c₀ + c₁ z + c₂ z² + …
template <std::size_t n>
constexpr double horner(double z, const double (&c)[n]) {
  double sum = c[n - 1];
  for (std::size_t k = n - 1; k-- > 0;) sum = sum * z + c[k];
  return sum;
}

/// Angles from 1e5 rad on use the C library.
inline SineCosine<double> sine_cosine(double angle) {
  constexpr double farthest = 1e5;
  if (!(std::abs(angle) < farthest)) return {std::sin(angle), std::cos(angle)};
  // π/2 is split into three parts: a number of quarters times the first one is exact.
  constexpr double first = 1.57079632673412561417, second = 6.07710050630396597660e-11,
                   third = 2.02226624879595063154e-21;
  constexpr double to_whole = 6755399441055744.0;  // 1.5 · 2^52: a sum with it has the nearest integer in its last bits
  const double shifted = angle * (2 / std::numbers::pi) + to_whole, quarters = shifted - to_whole;
  const auto quadrant = std::bit_cast<std::uint64_t>(shifted);
  const double near = angle - quarters * first, part = quarters * second, x = near - part,
               rest = (near - x) - part - quarters * third;  // the angle left is x + rest
  const double z = x * x, half = 0.5 * z, high = 1 - half, cube = z * x;
  const double odd = horner(z, {8.33333333332248946124e-03, -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                                -2.50507602534068634195e-08, 1.58969099521155010221e-10});
  const double even =
      z * horner(z, {4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05,
                     -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11});
  const double s = x - ((z * (0.5 * rest - cube * odd) - rest) + cube * 1.66666666666666324348e-01),
               c = high + (((1 - high) - half) + (z * even - x * rest));
  const bool across = (quadrant & 1) != 0;
  const double sine = across ? c : s, cosine = across ? s : c;
  return {(quadrant & 2) != 0 ? -sine : sine, ((quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

/// Returns the angle of the direction (x, y), from −π to π; NaN where both are 0.
inline double direction_angle(double y, double x) {
  constexpr double pi = std::numbers::pi, tan_of_eighth = 0.41421356237309504880;  // tan(π/8)
  const double across = std::abs(x), up = std::abs(y);
  const bool steep = up > across;
  const double longer = steep ? up : across, shorter = steep ? across : up;
  const bool turned = shorter > tan_of_eighth * longer;  // whether the angle is reduced by π/4
  const double t = turned ? (shorter - longer) / (shorter + longer) : shorter / longer, z = t * t;
  const double above = horner(z, {-6.485021904942025371773e1, -1.228866684490136173410e2, -7.500855792314704667340e1,
                                  -1.615753718733365076637e1, -8.750608600031904122785e-1}),
               below = horner(z, {1.945506571482613964425e2, 4.853903996359136964868e2, 4.328810604912902668951e2,
                                  1.650270098316988542046e2, 2.485846490142306297962e1, 1.0});
  double angle = (turned ? pi / 4 : 0) + (t + t * (z * above / below));
  if (steep) angle = pi / 2 - angle;
  if (x < 0) angle = pi - angle;
  return std::copysign(angle, y);
}

}  // namespace bahnwerk
