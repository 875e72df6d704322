#include "core/motion/axes/orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/numeric/polynomial_discs.hpp"

namespace bahnwerk {
namespace {

constexpr double largest_jump = 1e-9;  // rad, at a joint
constexpr std::size_t most_terms = Rational::max_degree + 1;

/// Coefficients about t = at, in place: synthetic division.
std::size_t about(const Polynomial& p, double at, std::array<double, most_terms>& c) {
  const std::size_t n = std::min(p.size(), most_terms);
  std::copy_n(p.begin(), n, c.begin());
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = n - 1; k > i; --k) c[k - 1] += at * c[k];
  return n;
}

bool still(const Curve& angles, double u0, double u1) {
  constexpr int samples =
      2 * static_cast<int>(most_terms);  // number of samples, more than a polynomial of the degree has zeros
  for (int i = 0; i <= samples; ++i) {
    const Vec d1 = angles.at(u0 + (u1 - u0) * i / samples).d1;
    if (d1.x != 0 || d1.y != 0) return false;
  }
  return true;
}

}  // namespace

Orientation::Orientation(const Path& tool, std::vector<std::shared_ptr<const Curve>> angles)
    : angles_(std::move(angles)) {
  if (angles_.size() != tool.size()) throw std::invalid_argument("one curve of angles per segment of the path");
  Vec last;
  for (std::size_t i = 0; i < tool.size(); ++i) {
    const Curve &own = tool[i].curve(), &turn = *angles_[i];
    if (turn.kind() == CurveKind::arc || turn.begin() > own.begin() || turn.end() < own.end())
      throw std::invalid_argument("angles are lines or rational curves over the whole of their segment");
    const Vec first = turn.at(own.begin()).value;
    const double jump = i == 0 ? 0 : std::hypot(first.x - last.x, first.y - last.y);
    if (!(jump <= largest_jump))
      throw InvalidInput({{{"orientation", std::to_string(i)}, "the tool's angles jump between two segments"}});
    last = turn.at(own.end()).value;
    if ((own.speed(own.begin()) == 0 || own.speed(own.end()) == 0) && !still(turn, own.begin(), own.end()))
      throw InvalidInput({{{"orientation", std::to_string(i)}, "the tool turns where it does not move"}});
    Quotient q;
    if (turn.kind() == CurveKind::line) {
      const Jet line = turn.at(own.begin());
      q = {{0, line.d1.x}, {0, line.d1.y}, {1}, own.begin(), 1, line.value};
    } else {
      const auto& r = static_cast<const Rational&>(turn);
      q = {r.coordinate(0), r.coordinate(1), r.weight(), r.pivot(), r.reach(), r.origin()};
    }
    quotients_.push_back(std::move(q));
  }
}

// With σ = ds/du: u′ = 1/σ, u″ = −σ_u/σ³, u‴ = (3σ_u² − σσ_uu)/σ⁵.
ToolJet Orientation::tool(const Segment& segment, std::size_t index, double u) const {
  ToolJet tool;
  const Curve& curve = segment.curve();
  const Jet h = curve.at(u);
  tool.position = segment.at_parameter(u, h);
  const Jet a = angles_[index]->at(u);
  tool.phi.value = a.value.x, tool.psi.value = a.value.y;
  const auto zero = [](const Vec& v) { return v.x == 0 && v.y == 0; };
  if (zero(a.d1) && zero(a.d2) && zero(a.d3)) return tool;
  // The speed of lines and arcs is constant, without the rounding of a norm.
  const double speed = curve.kind() == CurveKind::rational ? norm(h.d1) : curve.speed(u);
  double u1 = 1 / speed, u2 = 0, u3 = 0;
  if (curve.kind() == CurveKind::rational) {  // s is linear in u on lines and arcs
    const double grows = dot(h.d1, h.d2) / speed, bends = (dot(h.d2, h.d2) + dot(h.d1, h.d3) - grows * grows) / speed,
                 cube = u1 * u1 * u1;
    u2 = -grows * cube;
    u3 = (3 * grows * grows - speed * bends) * cube * u1 * u1;
  }
  const auto along = [&](std::size_t k, AngleJet& angle) {
    angle.d1 = a.d1[k] * u1;
    angle.d2 = a.d2[k] * u1 * u1 + a.d1[k] * u2;
    angle.d3 = a.d3[k] * u1 * u1 * u1 + 3 * a.d2[k] * u1 * u2 + a.d1[k] * u3;
  };
  along(0, tool.phi), along(1, tool.psi);
  return tool;
}

ToolPose Orientation::pose(const Segment& segment, std::size_t index, double u) const {
  const Vec angles = angles_[index]->at(u).value;
  return {segment.curve().at(u).value, angles.x, angles.y};
}

// α − α(u) = (N − α(u) w)/w, whose numerator has no constant term about u.
double Orientation::turn_within(std::size_t index, double u, double radius) const {
  const Quotient& q = quotients_[index];
  const double t = (u - q.pivot) / q.reach, r = std::abs(radius / q.reach);
  std::array<double, most_terms> weight{}, n{};
  const std::size_t weights = about(q.weight, t, weight);
  double least = weight[0], power = 1;
  for (std::size_t k = 1; k < weights; ++k) least -= std::abs(weight[k]) * (power *= r);
  if (!(least > 0)) return std::numeric_limits<double>::infinity();
  double square = 0;
  for (const Polynomial* p : {&q.phi, &q.psi}) {
    n = {};
    const std::size_t terms = std::max(about(*p, t, n), weights);
    const double value = n[0] / weight[0];
    double sum = 0;
    power = 1;
    for (std::size_t k = 1; k < terms; ++k) sum += std::abs(n[k] - value * weight[k]) * (power *= r);
    square += sum * sum;
  }
  return std::sqrt(square) / least;
}

void Orientation::enclose(std::size_t index, double u, double radius, DiscJet& phi, DiscJet& psi) const {
  const Quotient& q = quotients_[index];
  const double t = (u - q.pivot) / q.reach, r = std::abs(radius / q.reach);
  const bool rational = q.weight.size() > 1;
  DiscJet weight;
  if (rational) weight = bahnwerk::enclose(q.weight, t, r);
  const auto both = bahnwerk::enclose(q.phi, q.psi, t, r);
  const auto angle = [&](const DiscJet& enclosed, const Polynomial& p, double origin, DiscJet& f) {
    f = enclosed;
    if (rational && !p.empty()) f = f / weight;
    double power = 1;
    for (std::size_t n = 1; n <= 3; ++n) f.c[n] = (power /= q.reach) * f.c[n];
    f.c[0] += origin;
  };
  angle(both[0], q.phi, q.origin.x, phi), angle(both[1], q.psi, q.origin.y, psi);
}

}  // namespace bahnwerk
