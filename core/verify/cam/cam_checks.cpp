#include "core/verify/cam/cam_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/progress.hpp"
#include "core/verify/cam/law_polynomial.hpp"
#include "core/verify/cam/law_verifier.hpp"
#include "core/verify/cam/polyline_distance.hpp"

namespace bahnwerk {
namespace {

using cam::CamGeometry;
using cam::CamType;
using cam::FollowerType;
using verify::bernstein_sum;

constexpr double pi = std::numbers::pi;

/// A piece of the law over the cam's angle, with bounds of its derivatives.
struct Piece {
  double begin = 0, width = 0;  // rad
  std::vector<double> c[4];
  double most[4]{};
  double at(double phi, int order) const {
    return bernstein_sum(c[order], std::clamp((phi - begin) / width, 0.0, 1.0));
  }
};

double largest(const std::vector<double>& c) {
  double most = 0;
  for (const double each : c) most = std::max(most, std::abs(each));
  return most;
}

class CamVerifier {
 public:
  CamVerifier(const LawToVerify& law, const CamToVerify& cam, Progress progress, Verification& out)
      : g_(cam.geometry), cam_(cam), progress_(progress), out_(out) {
    seconds_per_rad_ = law.cycle_duration / (2 * pi);
    const bool oscillates = g_.type == CamType::radial && g_.follower == FollowerType::oscillating;
    const double unit = oscillates ? pi / 180 : 1;
    double lowest = HUGE_VAL;
    for (std::vector<double> down : law.bernstein) {
      for (double& b : down) b = -b;
      lowest = std::min(lowest, -verify::enclosed_maximum(down, 1e-13 * largest(down)).value);
    }
    for (std::size_t i = 0; i < law.bernstein.size(); ++i) {
      Piece piece;
      piece.begin = law.breaks[i] / seconds_per_rad_;
      piece.width = (law.breaks[i + 1] - law.breaks[i]) / seconds_per_rad_;
      std::vector<double> b = law.bernstein[i];
      for (double& each : b) each = unit * (each - lowest);
      for (int r = 0; r < 4; ++r) {
        piece.c[r] = verify::derivative_coefficients(b, piece.width, r);
        piece.most[r] = largest(piece.c[r]);
      }
      pieces_.push_back(std::move(piece));
    }
    turn_ = g_.clockwise ? -1 : 1;
    roller_ = g_.follower == FollowerType::flat ? 0 : g_.roller_radius;
    pitch_ = cam.base_radius + (g_.type == CamType::radial ? roller_ : 0);
    height_ = std::sqrt(std::max(0.0, pitch_ * pitch_ - g_.offset * g_.offset));
    if (oscillates) {
      const double cosine =
          (g_.arm * g_.arm + g_.distance * g_.distance - pitch_ * pitch_) / (2 * g_.arm * g_.distance);
      swing_ = std::acos(std::clamp(cosine, -1.0, 1.0));
    }
  }

  void run() {
    Curve profile, other;
    if (!covers(cam_.profile) || (cam_.other_flank && !covers(*cam_.other_flank))) {
      add("cam curve", "mm", g_.tolerance, HUGE_VAL, 0);
      return;
    }
    profile = sampled(cam_.profile);
    if (cam_.other_flank) other = sampled(*cam_.other_flank);
    const double gap = std::max(closing(cam_.profile), cam_.other_flank ? closing(*cam_.other_flank) : 0);
    add("cam curve", "mm", 1e-9 * (pitch_ + 1), gap, 0);
    const bool flat = g_.follower == FollowerType::flat;
    flat ? flat_contact(profile) : roller_contact(profile, other);
    undercut();
    if (!flat) pressure_angle();
    differences();
  }

 private:
  /// Places along a curve, with the follower's at the same angles.
  struct Curve {
    std::vector<double> angle;  // rad
    std::vector<Point> curve, follower;
    double bow = 0;                  // largest distance of curve and follower together from their chords
    double worst = 0, worst_at = 0;  // largest |follower − curve| − roller radius, bow included
  };

  void add(std::string name, std::string unit, double limit, double value, double phi) {
    out_.add({named(CheckGroup::geometry, std::move(name), std::move(unit)), limit, value, phi * seconds_per_rad_,
              value <= limit});
  }

  const Piece& piece_at(double phi) const {
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && phi >= pieces_[i + 1].begin) ++i;
    return pieces_[i];
  }

  Point turned(double phi, Point p) const {
    const double c = std::cos(phi), s = turn_ * std::sin(phi);
    return {c * p.x + s * p.y, c * p.y - s * p.x};
  }
  /// The roller's centre as the cam sees it; under a flat follower the point (0, height of the face).
  Point follower(const Piece& piece, double phi) const {
    const double y = piece.at(phi, 0);
    if (g_.type == CamType::barrel) return {pitch_ * phi, y};
    if (g_.follower == FollowerType::oscillating) {
      const double angle = swing_ + y;
      return turned(phi, {g_.distance - g_.arm * std::cos(angle), g_.arm * std::sin(angle)});
    }
    if (g_.follower == FollowerType::flat) return turned(phi, {0, pitch_ + y});
    return turned(phi, {g_.offset, height_ + y});
  }
  /// A bound of the second derivative of follower() over a piece.
  double follower_bound(const Piece& p) const {
    if (g_.type == CamType::barrel) return p.most[2];
    if (g_.follower == FollowerType::oscillating)
      return g_.arm * (p.most[2] + p.most[1] * p.most[1] + 2 * p.most[1]) + g_.arm + g_.distance;
    return p.most[2] + 2 * p.most[1] + p.most[0] + pitch_;
  }

  static Point evaluate(const Point* b, double x) {
    Point p[6];
    std::copy(b, b + 6, p);
    for (int n = 5; n > 0; --n)
      for (int k = 0; k < n; ++k) p[k] = (1 - x) * p[k] + x * p[k + 1];
    return p[0];
  }

  bool covers(const CamCurveToVerify& curve) const {
    if (curve.angles.size() < 2 || curve.points.size() != 5 * (curve.angles.size() - 1) + 1) return false;
    for (std::size_t i = 0; i + 1 < curve.angles.size(); ++i)
      if (!(curve.angles[i + 1] > curve.angles[i])) return false;
    return std::abs(curve.angles.back() - curve.angles.front() - 360) < 1e-6 &&
           std::abs(curve.angles.front() * pi / 180 - pieces_.front().begin) < 1e-8;
  }
  double closing(const CamCurveToVerify& curve) const {
    const Point gap = curve.points.back() - curve.points.front();
    return g_.type == CamType::barrel ? std::hypot(gap.x - 2 * pi * pitch_, gap.y) : norm(gap);
  }

  Curve sampled(const CamCurveToVerify& curve) const {
    Curve out;
    for (std::size_t i = 0; i + 1 < curve.angles.size(); ++i) {
      if (i % 16 == 0) progress_.report("verification", 0.96);
      const Point* b = &curve.points[5 * i];
      const double from = curve.angles[i] * pi / 180, h = (curve.angles[i + 1] - curve.angles[i]) * pi / 180;
      const Piece& piece = piece_at(from + h / 2);
      double bend = 0;
      for (int k = 0; k < 4; ++k) bend = std::max(bend, norm(b[k] + b[k + 2] - 2 * b[k + 1]));
      bend = 20 * bend / (h * h) + follower_bound(piece);
      const double allowed = g_.tolerance / 20;
      const int cells = static_cast<int>(std::clamp(std::ceil(h * std::sqrt(bend / (8 * allowed))), 4.0, 2000.0));
      const double bow = bend * (h / cells) * (h / cells) / 8;
      out.bow = std::max(out.bow, bow);
      for (int k = 0; k <= cells; ++k) {
        const double x = static_cast<double>(k) / cells, phi = from + x * h;
        const Point q = evaluate(b, x), c = follower(piece, phi);
        const double away = distance(q, c) - roller_ + bow;
        if (away > out.worst) out.worst = away, out.worst_at = phi;
        if (k == 0 && i > 0) continue;
        out.angle.push_back(phi), out.curve.push_back(q), out.follower.push_back(c);
      }
    }
    return out;
  }

  void roller_contact(const Curve& profile, const Curve& other) {
    const Curve& worst = other.worst > profile.worst ? other : profile;
    add("cam contact", "mm", g_.tolerance, worst.worst, worst.worst_at);
    if (!(roller_ > 0)) return;
    double deepest = 0, at = 0;
    for (const Curve* curve : {&profile, &other}) {
      if (curve->curve.size() < 2) continue;
      const verify::NearestApproach found = verify::nearest_approach(curve->follower, curve->curve, roller_, progress_);
      const double depth = roller_ - found.distance + curve->bow;
      if (depth > deepest) deepest = depth, at = curve->angle[found.index];
    }
    add("cam penetration", "mm", g_.tolerance, deepest, at);
  }

  /// For a fixed point q of the profile, q · d(φ) − height(φ) bends by at most |q| + |y″|.
  void flat_contact(const Curve& profile) {
    double far = 0, most_second = 0, reach = 0, away = 0, away_at = 0, deepest = 0, at = 0;
    for (const Piece& piece : pieces_) most_second = std::max(most_second, piece.most[2]);
    for (const Point& q : profile.curve) reach = std::max(reach, norm(q));
    for (std::size_t i = 0; i < profile.angle.size(); ++i) {
      if (i % 64 == 0) progress_.report("verification", 0.97);
      const double height = norm(profile.follower[i]);
      const Point up = (1 / height) * profile.follower[i];
      const double h = i > 0 ? profile.angle[i] - profile.angle[i - 1] : 0;
      const double bow = profile.bow + (reach + most_second) * h * h / 8 +
                         (i > 0 ? distance(profile.curve[i], profile.curve[i - 1]) * h / 4 : 0);
      double most = -HUGE_VAL;
      for (const Point& q : profile.curve) most = std::max(most, dot(q, up));
      far = most - height + bow;
      if (far > deepest) deepest = far, at = profile.angle[i];
      const double gap = height - dot(profile.curve[i], up) + bow;
      if (gap > away) away = gap, away_at = profile.angle[i];
    }
    add("cam contact", "mm", g_.tolerance, away, away_at);
    add("cam penetration", "mm", g_.tolerance, deepest, at);
  }

  /// Control vectors of the profile's derivative, in eighths of spans, against the direction in which the follower
  /// passes over the cam: where all go forward, the profile does.
  void undercut() {
    double least = HUGE_VAL, at = 0;
    const auto look = [&](const CamCurveToVerify& curve) {
      for (std::size_t i = 0; i + 1 < curve.angles.size(); ++i) {
        const double from = curve.angles[i] * pi / 180, h = (curve.angles[i + 1] - curve.angles[i]) * pi / 180 / 8;
        const Piece& piece = piece_at(from + 4 * h);
        std::vector<Point> rest(&curve.points[5 * i], &curve.points[5 * i] + 6);
        for (int part = 0; part < 8; ++part) {
          const double x = 1.0 / (8 - part);
          std::vector<Point> now{rest[0]}, row = rest;
          for (std::size_t n = 5; n > 0; --n) {
            for (std::size_t k = 0; k < n; ++k) row[k] = (1 - x) * row[k] + x * row[k + 1];
            now.push_back(row[0]);
          }
          rest = row;
          const double phi = from + part * h;
          const Point way = g_.follower == FollowerType::flat ? turned(phi + h / 2, {turn_, 0})
                                                              : unit(follower(piece, phi + h) - follower(piece, phi));
          for (std::size_t k = 0; k < 5; ++k) {
            const double advance = 5 * dot(now[k + 1] - now[k], way) / h;
            if (advance < least) least = advance, at = phi;
          }
        }
      }
    };
    look(cam_.profile);
    if (cam_.other_flank) look(*cam_.other_flank);
    add("cam undercut", "mm/rad", 0, -least, at);
  }

  struct Slope {
    double along, across;
  };
  Slope slope(const Piece& p, double phi) const {
    const double y = p.at(phi, 0), first = p.at(phi, 1);
    if (g_.type == CamType::barrel) return {first, pitch_};
    if (g_.follower == FollowerType::translating) return {first - turn_ * g_.offset, height_ + y};
    const double angle = swing_ + y;
    return {g_.arm * (turn_ + first) - turn_ * g_.distance * std::cos(angle), g_.distance * std::sin(angle)};
  }
  /// ±along − t · across ≤ 0 at every angle, t the tangent of what is reported: second derivatives are bounded.
  void pressure_angle() {
    const double tangent = std::tan(cam_.pressure_angle);
    double most = 0, at = 0;
    for (const Piece& p : pieces_) {
      const double bend = g_.type == CamType::barrel ? p.most[3]
                          : g_.follower == FollowerType::translating
                              ? p.most[3] + tangent * p.most[2]
                              : g_.arm * p.most[3] + g_.distance * (1 + tangent) * (p.most[1] * p.most[1] + p.most[2]);
      const double fine = std::ceil(p.width * std::sqrt(bend / (8 * 1e-7 * pitch_)));
      const int cells = static_cast<int>(std::clamp(fine, 8.0, 200000.0));
      const double h = p.width / cells, bow = bend * h * h / 8;
      double before = -HUGE_VAL;
      for (int k = 0; k <= cells; ++k) {
        if (k % 1024 == 0) progress_.report("verification", 0.98);
        const double phi = p.begin + k * h;
        const Slope s = slope(p, phi);
        const double excess = std::max(s.along, -s.along) - tangent * s.across;
        const double angle = cam_.pressure_angle + std::max(0.0, std::max(excess, before) + bow) / (s.across - bow);
        if (!(s.across > bow)) most = pi / 2, at = phi;
        if (angle > most) most = angle, at = phi;
        before = excess;
      }
    }
    const double limit = g_.pressure_angle ? *g_.pressure_angle : cam_.pressure_angle;
    constexpr double degree = 180 / pi;
    add("cam pressure angle", "deg", degree * limit + 1e-5, degree * most, at);
  }

  /// Curvature by differences of the follower's places, and what follows from it.
  void differences() {
    double radius = HUGE_VAL, radius_at = 0, square = 0, square_at = 0, weakest = HUGE_VAL, weakest_at = 0;
    for (const Piece& p : pieces_) {
      progress_.report("verification", 0.99);
      const double h = std::min(1e-4, p.width / 8);
      const int cells = static_cast<int>(std::clamp(p.width / 2e-3, 4.0, 4000.0));
      for (int k = 0; k <= cells; ++k) {
        const double phi = p.begin + h + (p.width - 2 * h) * k / cells;
        for (const double side : {1.0, -1.0}) {
          if (side < 0 && g_.type != CamType::barrel) continue;
          const double here = curvature_radius(p, phi, h, side);
          if (here < radius) radius = here, radius_at = phi;
          if (!g_.contact) continue;
          const double pressed = force(p, phi), rho = roller_ > 0 ? roller_ * here / (roller_ + here) : here;
          const Slope s = g_.follower == FollowerType::flat ? Slope{0, 1} : slope(p, phi);
          const double normal = pressed * std::hypot(s.along, s.across) / s.across;
          const double now = normal / rho;
          if (now > square) square = now, square_at = phi;
          if (pressed < weakest) weakest = pressed, weakest_at = phi;
        }
      }
    }
    if (cam_.profile_radius && radius < HUGE_VAL)
      add("cam profile radius", "mm", radius + 1e-4 * std::abs(radius) + 1e-6 * pitch_, *cam_.profile_radius,
          radius_at);
    if (!g_.contact) return;
    const auto& c = *g_.contact;
    const double stiffness = 1 / ((1 - c.cam.poisson * c.cam.poisson) / c.cam.modulus +
                                  (1 - c.follower.poisson * c.follower.poisson) / c.follower.modulus);
    const double stress = std::sqrt(square * stiffness / (pi * c.width));
    if (cam_.stress) {
      add("cam stress", "N/mm²", *cam_.stress * (1 + 1e-4), stress, square_at);
      if (c.stress) add("cam stress limit", "N/mm²", *c.stress * (1 + 1e-9), std::max(stress, *cam_.stress), square_at);
    }
    add("cam force", "N", 0, -std::min(weakest, cam_.least_force.value_or(weakest)), weakest_at);
  }
  /// Radius of curvature of the profile where it is convex; infinite where it is not.
  double curvature_radius(const Piece& p, double phi, double h, double side) const {
    if (g_.follower == FollowerType::flat) return pitch_ + p.at(phi, 0) + p.at(phi, 2);
    const Point a = follower(p, phi - h), b = follower(p, phi), c = follower(p, phi + h);
    // The circle through three places: 4 · area / product of the sides.
    const double area = cross(b - a, c - a) / 2, sides = distance(a, b) * distance(b, c) * distance(a, c);
    const double curvature = (g_.type == CamType::barrel ? side : -turn_) * 4 * area / sides;
    return curvature > 1e-9 / pitch_ ? 1 / curvature - roller_ : HUGE_VAL;
  }
  double force(const Piece& p, double phi) const {
    const auto& c = *g_.contact;
    const double length = g_.type == CamType::radial && g_.follower == FollowerType::oscillating ? g_.arm : 1;
    const double acceleration = length * p.at(phi, 2) / (seconds_per_rad_ * seconds_per_rad_);  // mm/s²
    return c.force + c.spring * length * p.at(phi, 0) + c.mass * acceleration / 1000;
  }

  const CamGeometry& g_;
  const CamToVerify& cam_;
  Progress progress_;
  Verification& out_;
  std::vector<Piece> pieces_;
  double seconds_per_rad_ = 0, turn_ = 1, roller_ = 0, pitch_ = 0, height_ = 0, swing_ = 0;
};

}  // namespace

void verify_cam(const LawToVerify& law, const CamToVerify& cam, Progress progress, Verification& out) {
  CamVerifier(law, cam, progress, out).run();
}

}  // namespace bahnwerk
