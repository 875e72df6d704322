#include "core/verify/cam/load_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/progress.hpp"
#include "core/verify/cam/law_polynomial.hpp"
#include "core/verify/cam/law_verifier.hpp"

namespace bahnwerk {
namespace {

using namespace verify;

constexpr double pi = std::numbers::pi;

/// Returns the coefficients of the same polynomial, one degree higher.
std::vector<double> raised(const std::vector<double>& c) {
  const std::size_t n = c.size();
  std::vector<double> out(n + 1);
  for (std::size_t k = 0; k <= n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n);
    out[k] = (k > 0 ? share * c[k - 1] : 0) + (k < n ? (1 - share) * c[k] : 0);
  }
  return out;
}

/// The part of a polynomial over [from, to], by blossoms.
std::vector<double> part_of(const std::vector<double>& c, double from, double to) {
  const std::size_t n = c.size() - 1;
  std::vector<double> out;
  for (std::size_t k = 0; k <= n; ++k) {
    std::vector<double> row = c;
    for (std::size_t step = 0; step < n; ++step) {
      const double x = step < k ? to : from;
      for (std::size_t i = 0; i + step < n; ++i) row[i] = (1 - x) * row[i] + x * row[i + 1];
    }
    out.push_back(row[0]);
  }
  return out;
}

class LoadVerifier {
 public:
  LoadVerifier(const LawToVerify& law, const LoadToVerify& load, Progress progress, Verification& out)
      : law_(law), load_(load), progress_(progress), out_(out) {
    for (std::size_t i = 0; i < law.bernstein.size(); ++i)
      for (const double v : derivative_coefficients(law.bernstein[i], duration(i), 1))
        still_ = std::max(still_, 1e-9 * std::abs(v));
    const cam::DriveLoad& given = load.load;
    // A turn of the motor lets a linear slave travel `ratio`: work is equal on both sides.
    if (given.ratio > 0) share_ = given.rotary ? 1 / given.ratio : given.ratio / 1000 / (2 * pi);
    friction_ = share_ * given.friction;
    if (given.rotary) motor_ = given.motor_inertia * (given.ratio > 0 ? given.ratio : 1) * pi / 180;
    if (!given.rotary && given.ratio > 0) motor_ = given.motor_inertia * 2 * pi / given.ratio;
  }

  void run() {
    for (std::size_t i = 0; i < law_.bernstein.size(); ++i) {
      progress_.report("verification", 0.99);
      const auto effort = combined(i);
      const auto velocity = derivative_coefficients(law_.bernstein[i], duration(i), 1);
      for (int k = 0; k < parts; ++k) {
        const double from = static_cast<double>(k) / parts, to = static_cast<double>(k + 1) / parts;
        look(i, part_of(effort, from, to), part_of(velocity, from, to), from, to);
      }
    }
    const std::string what = load_.load.turns() ? "torque" : "force", unit = load_.load.turns() ? "N m" : "N";
    const double limit = std::min(load_.limits.peak, load_.peak);
    add("drive " + what, unit, limit * (1 + 1e-6) + 1e-12, peak_, at_);
    add("drive rms " + what, unit, std::min(load_.limits.rms, load_.rms * (1 + 1e-3)) * (1 + 1e-6) + 1e-12, rms(), 0);
  }

 private:
  static constexpr int parts = 64;
  double duration(std::size_t i) const { return law_.breaks[i + 1] - law_.breaks[i]; }
  void add(std::string name, std::string unit, double limit, double value, double at) {
    out_.add({named(CheckGroup::limit, std::move(name), std::move(unit)), limit, value, at, value <= limit});
  }
  /// The force or torque of the drive without friction.
  std::vector<double> combined(std::size_t i) const {
    const auto& s = law_.bernstein[i];
    auto v = derivative_coefficients(s, duration(i), 1), a = derivative_coefficients(s, duration(i), 2);
    while (v.size() < s.size()) v = raised(v);
    while (a.size() < s.size()) a = raised(a);
    const cam::DriveLoad& given = load_.load;
    const double inertia = given.inertia * (given.rotary ? pi / 180 : 1e-3);
    std::vector<double> out;
    for (std::size_t k = 0; k < s.size(); ++k) {
      const double slave =
          inertia * a[k] + given.damping * v[k] + given.spring * (s[k] - given.spring_zero) + given.force;
      out.push_back(share_ * slave + motor_ * a[k]);
    }
    return out;
  }
  /// A part in which the slave turns back or comes to rest is halved, so that friction counts with the sign that it
  /// has.
  void look(std::size_t i, const std::vector<double>& effort, const std::vector<double>& v, double from, double to) {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    const bool up = *high > still_, down = *low < -still_;
    const bool moves = *low > still_ || *high < -still_, rests = !up && !down;
    if (!moves && !rests && to - from > 1e-10) {
      const double middle = (from + to) / 2;
      look(i, part_of(effort, 0, 0.5), part_of(v, 0, 0.5), from, middle);
      look(i, part_of(effort, 0.5, 1), part_of(v, 0.5, 1), middle, to);
      return;
    }
    // Where the slave moves in the whole part, friction that only helps lowers the peak.
    take(effort, 1, up ? friction_ : moves ? -friction_ : 0, i, from, to);
    take(effort, -1, down ? friction_ : moves ? -friction_ : 0, i, from, to);
  }
  void take(std::vector<double> c, double sign, double friction, std::size_t i, double from, double to) {
    for (double& each : c) each = sign * each + friction;
    if (*std::max_element(c.begin(), c.end()) <= peak_) return;
    const EnclosedMaximum found = enclosed_maximum(c, 1e-8 * peak_);
    if (found.value > peak_) peak_ = found.value, at_ = law_.breaks[i] + (from + (to - from) * found.at) * duration(i);
  }
  double rms() const {
    double sum = 0, whole = 0;
    for (std::size_t i = 0; i < law_.bernstein.size(); ++i) {
      const auto effort = combined(i);
      const auto velocity = derivative_coefficients(law_.bernstein[i], duration(i), 1);
      constexpr int cells = 512;
      for (int k = 0; k <= 2 * cells; ++k) {
        // Friction of a cell's end counts inside the cell.
        const double x = std::clamp(k / (2.0 * cells), 1e-9, 1 - 1e-9), v = bernstein_sum(velocity, x);
        const double f = bernstein_sum(effort, x) + friction_ * (v > still_ ? 1 : v < -still_ ? -1 : 0);
        const double weight = k == 0 || k == 2 * cells ? 1 : k % 2 == 1 ? 4 : 2;
        sum += weight * f * f * duration(i) / (6 * cells);
      }
      whole += duration(i);
    }
    return std::sqrt(sum / whole);
  }

  const LawToVerify& law_;
  const LoadToVerify& load_;
  Progress progress_;
  Verification& out_;
  double still_ = 0, share_ = 1, friction_ = 0, motor_ = 0;
  double peak_ = 0, at_ = 0;
};

}  // namespace

void verify_load(const LawToVerify& law, const LoadToVerify& load, Progress progress, Verification& out) {
  LoadVerifier(law, load, progress, out).run();
}

}  // namespace bahnwerk
