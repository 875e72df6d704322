#include "core/cam_profile/cam_figures.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/base/progress.hpp"

namespace bahnwerk::cam {
namespace {

using T = LawSeries<Disc>;

class Figures {
 public:
  Figures(const CamGeometry& geometry, const FollowerLaw& law, double base_radius, Progress progress)
      : g_(geometry),
        law_(law),
        seat_(pitch_seat<Disc>(geometry, Disc(pitch_radius(geometry, base_radius)))),
        progress_(progress) {
    out_.base_radius = base_radius;
  }

  CamFigures run() {
    if (g_.has_roller()) {
      pressure_angles();
      curvatures();
    } else {
      flat();
    }
    if (g_.contact) contact();
    return out_;
  }

 private:
  template <class F>
  CertifiedMaximum most(F&& function, double accuracy = 1e-12) const {
    return certified_maximum(law_, std::forward<F>(function), accuracy, progress_);
  }
  static CamExtreme extreme(const CertifiedMaximum& m, double sign = 1) { return {sign * m.value, m.at}; }

  void pressure_angles() {
    const auto tangent = [&](double sign) {
      return [this, sign](const T& y) {
        const PitchPoint<Disc> p = pitch_point(seat_, y);
        return sign * (p.along / p.across);
      };
    };
    const CertifiedMaximum rise = most(tangent(1)), back = most(tangent(-1));
    out_.pressure_angle = {std::atan(rise.value), rise.at};
    out_.pressure_angle_back = {-std::atan(back.value), back.at};
  }

  void curvatures() {
    const auto curvature = [&](double sign) {
      return [this, sign](const T& y) { return sign * pitch_curvature(seat_, pitch_point(seat_, y)); };
    };
    const CertifiedMaximum convex = most(curvature(1)), concave = most(curvature(-1));
    out_.pitch_curvature = extreme(convex), out_.pitch_curvature_back = extreme(concave, -1);
    const double r = g_.roller_radius;
    const double flank = g_.type == CamType::barrel ? std::max(convex.upper, concave.upper) : convex.upper;
    out_.undercut_bound = r * flank - 1;
    // A groove's flanks are convex on either side where the pitch curve turns.
    const CamExtreme tightest = g_.type == CamType::barrel && concave.value > convex.value
                                    ? CamExtreme{concave.value, concave.at}
                                    : CamExtreme{convex.value, convex.at};
    if (tightest.value > 1e-12) out_.profile_radius = {1 / tightest.value - r, tightest.at};
    if (concave.value > 1e-12) out_.concave_radius = {1 / concave.value + r, concave.at};
  }

  void flat() {
    const CertifiedMaximum least = most([&](const T& y) { return -flat_profile_radius(seat_, y); });
    out_.profile_radius = extreme(least, -1);
    out_.undercut_bound = least.upper;
    const CertifiedMaximum right = most([](const T&y) { return derived(y); }),
                           left = most([](const T&y) { return -derived(y); });
    out_.face_width = right.value + left.value;
  }

  /// Returns the force along the follower's motion, N. mm/s² · kg = 1e-3 N.
  T force(const T& y) const {
    const CamContact& c = *g_.contact;
    const double length = g_.type == CamType::radial && g_.follower == FollowerType::oscillating ? g_.arm : 1;
    const double rate = law_.angular_velocity();
    return T(c.force) + (c.spring * length) * y + (1e-3 * c.mass * length * rate * rate) * derived(derived(y));
  }

  /// Hertz for a line: p² = F E* /(π b) · (curvature of both), 1/E* = Σ (1 − ν²)/E. Roller on profile: 1/r + κ/(1 − κr)
  /// = 1/(r(1 − κr)).
  void contact() {
    const CamContact& c = *g_.contact;
    CamContactFigures figures;
    const CertifiedMaximum high = most([&](const T&y) { return force(y); }, 1e-9),
                           low = most([&](const T&y) { return -force(y); }, 1e-9);
    figures.most_force = extreme(high), figures.least_force = extreme(low, -1);
    const auto compliance = [](const ElasticMaterial& m) { return (1 - m.poisson * m.poisson) / m.modulus; };
    const double factor = 1 / (std::numbers::pi * c.width * (compliance(c.cam) + compliance(c.follower)));
    if (out_.undercut_bound < 0) {
      const auto square = [&](double sign) {
        return [this, sign, factor](const T& y) {
          if (!g_.has_roller()) return factor * (force(y) / flat_profile_radius(seat_, y));
          const PitchPoint<Disc> p = pitch_point(seat_, y);
          const T tangent = p.along / p.across, normal = force(y) * sqrt(T(1) + tangent * tangent);
          const T gap = T(1) - (sign * g_.roller_radius) * pitch_curvature(seat_, p);
          return (factor / g_.roller_radius) * (normal / gap);
        };
      };
      CertifiedMaximum worst = most(square(1), 1e-9);
      if (g_.type == CamType::barrel)
        if (const CertifiedMaximum other = most(square(-1), 1e-9); other.value > worst.value) worst = other;
      figures.stress = {std::sqrt(std::max(0.0, worst.value)), worst.at};
    }
    out_.contact = figures;
  }

  const CamGeometry& g_;
  const FollowerLaw& law_;
  PitchSeat<Disc> seat_;
  Progress progress_;
  CamFigures out_;
};

}  // namespace

CamPlace cam_place(const CamGeometry& g, const FollowerLaw& law, double base_radius, std::size_t piece, double x) {
  const PitchSeat<double> seat = pitch_seat<double>(g, pitch_radius(g, base_radius));
  const LawSeries<double> y = law.at(piece, x);
  CamPlace out{law.begin(piece) + x * law.width(piece), 0, 0};
  if (!g.has_roller()) {
    out.curvature = 1 / flat_profile_radius(seat, y).value();
    return out;
  }
  const PitchPoint<double> p = pitch_point(seat, y);
  out.pressure_angle = std::atan(p.along.value() / p.across.value());
  const double curvature = pitch_curvature(seat, p).value();
  out.curvature = g.type == CamType::barrel ? curvature : curvature / (1 - g.roller_radius * curvature);
  return out;
}

CamFigures cam_figures(const CamGeometry& geometry, const FollowerLaw& law, double base_radius, Progress progress) {
  return Figures(geometry, law, base_radius, progress).run();
}

}  // namespace bahnwerk::cam
