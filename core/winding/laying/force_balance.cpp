#include "core/winding/laying/force_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/progress.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double tolerance = 1e-6;  // tolerance in units of the forces on the wires

}  // namespace

void ForceBalance::add_wire(Point force) {
  forces_.push_back(force);
  touching_.push_back(0);
}

void ForceBalance::add_contact(std::size_t wire, std::size_t other, Point normal) {
  const auto add = [&](Point direction) {
    pushes_.push_back({wire, other, unit(direction)});
    amount_.push_back(0);
    ++touching_[wire];
    if (other != wall) ++touching_[other];
  };
  if (friction_ > 0) {
    add(normal + friction_ * left_of(normal));
    add(normal - friction_ * left_of(normal));
  } else {
    add(normal);
  }
}

void ForceBalance::spread(const std::vector<double>& pushes, std::vector<Point>& forces) const {
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    const Push& push = pushes_[i];
    const Point force = pushes[i] * push.direction;
    forces[push.wire] += force;
    if (push.other != wall) forces[push.other] -= force;
  }
}

void ForceBalance::gather(const std::vector<Point>& forces, std::vector<double>& pushes) const {
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    const Push& push = pushes_[i];
    const Point relative = push.other == wall ? forces[push.wire] : forces[push.wire] - forces[push.other];
    pushes[i] = dot(relative, push.direction);
  }
}

/// Improves the start: what is unbalanced on a wire is passed on to the earlier wires and walls that it touches, the
/// latest wire first, by the two pushes with the least sum that balance it. In a pile that grew by a wire which the
/// others carry, nothing is then left. Pushes are expected in the order of their wires; others are left out.
void ForceBalance::pass_on() {
  std::size_t end = pushes_.size();
  for (std::size_t wire = left_.size(); wire-- > 0;) {
    std::size_t begin = end;
    while (begin > 0 && pushes_[begin - 1].wire == wire) --begin;
    const Point load = -left_[wire];
    double least = std::numeric_limits<double>::infinity();
    std::array<std::pair<std::size_t, double>, 2> chosen{};
    if (norm(load) > tolerance / 8)
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = i + 1; k < end; ++k) {
          const Point a = pushes_[i].direction, b = pushes_[k].direction;
          const double span = cross(a, b);
          if (std::abs(span) < 1e-3) continue;
          const double along_a = cross(load, b) / span, along_b = cross(a, load) / span;
          if (along_a < 0 || along_b < 0 || along_a + along_b >= least) continue;
          least = along_a + along_b;
          chosen = {std::pair{i, along_a}, {k, along_b}};
        }
    end = begin;
    if (!std::isfinite(least)) continue;
    for (const auto& [i, amount] : chosen) {
      amount_[i] += amount;
      if (pushes_[i].other != wall) left_[pushes_[i].other] -= amount * pushes_[i].direction;
    }
  }
}

void ForceBalance::balance() {
  left_ = forces_;
  spread(amount_, left_);
  gather(left_, gradient_);
}

ForceBalance::Result ForceBalance::measure() const {
  Result result;
  for (std::size_t i = 0; i < left_.size(); ++i)
    if (const double size = norm(left_[i]); size > result.residual) {
      result.residual = size;
      result.fastest = i;
    }
  result.balanced = result.residual <= tolerance;
  for (const double g : gradient_) result.closing = std::max(result.closing, -g);
  if (result.residual > 0) result.closing /= result.residual;
  return result;
}

bool ForceBalance::choose_step(double fixed, double residual, Step& step) {
  double reduced = 0, joining = 0, steepest = 0;
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    const double g = gradient_[i];
    if (amount_[i] > 0) {
      reduced += g * std::min(g, amount_[i] / fixed);
      steepest = std::max(steepest, std::abs(g));
    } else if (g < 0) {
      joining += g * g;
      steepest = std::max(steepest, -g);
    }
  }
  if (steepest <= 1e-7 * residual) return false;
  const Step last = step;
  step = joining > reduced ? Step::joining : Step::loaded;
  if (step == Step::joining) {
    for (std::size_t i = 0; i < pushes_.size(); ++i) step_[i] = amount_[i] > 0 ? 0 : std::max(0.0, -gradient_[i]);
  } else if (last != Step::loaded) {
    for (std::size_t i = 0; i < pushes_.size(); ++i) step_[i] = amount_[i] > 0 ? -gradient_[i] : 0;
  }
  return true;
}

ForceBalance::Result ForceBalance::solve(Progress progress) {
  // Dostál, Schöberl: Minimizing quadratic functions over non-negative cone with the rate of convergence and finite
  // termination (2005). Conjugate gradients over the loaded contacts; unloaded ones join when their part of the
  // gradient outweighs; where a step would make a contact pull it ends, and a gradient step of fixed length changes the
  // set.
  const std::size_t n = pushes_.size();
  gradient_.resize(n);
  step_.assign(n, 0);
  image_.resize(n);
  change_.resize(forces_.size());
  balance();
  pass_on();
  balance();
  // The step is at most 2/‖AᵀA‖: each push acts on two wires, each wire has at most `most` pushes.
  const double fixed =
      1.0 / static_cast<double>(std::max<std::size_t>(1, *std::max_element(touching_.begin(), touching_.end())));
  Step step = Step::first;
  const std::size_t limit = 2000 + 30 * n;
  Result result = measure();
  for (std::size_t round = 1; !result.balanced && round < limit; ++round, result = measure()) {
    if (round % 256 == 0) progress.report("balancing forces", 0);
    if (!choose_step(fixed, result.residual, step)) break;
    std::fill(change_.begin(), change_.end(), Point{});
    spread(step_, change_);
    double slope = 0, curvature = 0, usable_area = std::numeric_limits<double>::infinity();
    for (const Point d : change_) curvature += dot(d, d);
    for (std::size_t i = 0; i < n; ++i) {
      slope -= gradient_[i] * step_[i];
      if (step_[i] < 0) usable_area = std::min(usable_area, -amount_[i] / step_[i]);
    }
    const double length = curvature > 0 ? slope / curvature : usable_area;
    if (!std::isfinite(std::min(length, usable_area))) break;
    if (length <= usable_area) {
      for (std::size_t i = 0; i < n; ++i) amount_[i] += length * step_[i];
      for (std::size_t i = 0; i < left_.size(); ++i) left_[i] += length * change_[i];
      if (round % 64 == 0) balance();  // sums of steps drift away from what they stand for
      gather(left_, gradient_);
      if (step == Step::loaded) conjugate(curvature);
    } else {
      for (std::size_t i = 0; i < n; ++i) amount_[i] = std::max(0.0, amount_[i] + usable_area * step_[i]);
      balance();
      for (std::size_t i = 0; i < n; ++i)
        if (amount_[i] > 0) amount_[i] = std::max(0.0, amount_[i] - fixed * gradient_[i]);
      balance();
      step = Step::first;
    }
  }
  return result;
}

void ForceBalance::conjugate(double curvature) {
  gather(change_, image_);
  double along = 0;
  for (std::size_t i = 0; i < pushes_.size(); ++i)
    if (amount_[i] > 0) along += gradient_[i] * image_[i];
  const double beta = along / curvature;
  for (std::size_t i = 0; i < pushes_.size(); ++i) step_[i] = amount_[i] > 0 ? -gradient_[i] + beta * step_[i] : 0;
}

}  // namespace bahnwerk::winding
