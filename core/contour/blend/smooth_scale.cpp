#include "core/contour/blend/smooth_scale.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::blending {

namespace {

constexpr double growth = 1.4, slope = 0.4;
constexpr double node_step = 0.25;  // distance of nodes, as a part of H
constexpr std::size_t fewest = 8;   // intervals

/// Tells whether the contour between two places, mm, stays within the tolerance, mm, of its chord. `near` is an element
/// near them.
bool flat(const ElementRun& stretch, double low, double high, double tolerance, std::size_t near) {
  const Vec p = point_of(stretch, low, near);
  std::size_t last = near;
  const Vec way = point_of(stretch, high, last) - p;
  const double square = dot(way, way);
  constexpr int samples = 8;
  for (int i = 1; i < samples; ++i) {
    const Vec d = point_of(stretch, low + (high - low) * i / samples, near) - p;
    const Vec off = square > 0 ? d - std::clamp(dot(d, way) / square, 0.0, 1.0) * way : d;
    if (!(norm(off) <= tolerance)) return false;
  }
  return true;
}

}  // namespace

Vec point_of(const ElementRun& stretch, double t, std::size_t& at) {
  const Element& e = stretch.elements[at = stretch.near(t, at)];
  const double along = std::clamp(t - e.begin, 0.0, e.length);
  return e.straight ? e.from + along * e.tangent : e.at(along).value;
}

TubeScale::TubeScale(const ElementRun& stretch, double a, double b, double tolerance, ProgressScope& progress) {
  const double most = 0.5 * (b - a), least = std::min(tolerance, most);
  min_ = least / 16;
  double h = most;
  std::size_t near = 0;
  const auto flat_around = [&](double t, double length) {
    return flat(stretch, std::max(a, t - 0.5 * length), std::min(b, t + 0.5 * length), tolerance, near);
  };
  for (double t = a;; t = std::min(b, t + node_step * h)) {
    near = stretch.near(t, near);
    while (h > least && !flat_around(t, h)) h /= growth;
    while (h < most && flat_around(t, h * growth)) h *= growth;
    h = std::clamp(h, least, most);
    t_.push_back(t);
    h_.push_back(h);
    if (t >= b) break;
    progress.work();
  }
  grade();
}

double TubeScale::at(double t) const {
  auto node = static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin());
  return at(t, node);
}

double TubeScale::at(double t, std::size_t& node) const {
  std::size_t& i = node;  // the first node behind t
  while (i < t_.size() && t_[i] <= t) ++i;
  while (i > 0 && t < t_[i - 1]) --i;
  if (i == 0) return h_.front();
  if (i == t_.size()) return h_.back();
  const double x = (t - t_[i - 1]) / (t_[i] - t_[i - 1]);
  return h_[i - 1] + x * (h_[i] - h_[i - 1]);
}

bool TubeScale::refine(const std::vector<double>& places) {
  std::size_t next = 0;  // nodes before it are done
  bool changed = false;
  for (const double t : places) {
    const auto after = static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin());
    for (std::size_t i = std::max(next, after > 0 ? after - 1 : 0); i < std::min(after + 1, t_.size()); ++i) {
      const double halved = std::max(min_, 0.5 * h_[i]);
      changed = changed || halved < h_[i];
      h_[i] = halved;
      next = i + 1;
    }
  }
  grade();
  return changed;
}

TubeScale TubeScale::part(double a, double b) const {
  TubeScale part;
  part.min_ = min_;
  part.t_.push_back(a);
  part.h_.push_back(at(a));
  for (auto i = static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), a) - t_.begin());
       i < t_.size() && t_[i] < b; ++i) {
    part.t_.push_back(t_[i]);
    part.h_.push_back(h_[i]);
  }
  part.t_.push_back(b);
  part.h_.push_back(at(b));
  return part;
}

double TubeScale::ahead(double t, double breaks) const {
  double left = t, h = at(t);
  for (auto i = static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()); i < t_.size(); ++i) {
    const double step = (t_[i] - left) * (1 / h + 1 / h_[i]);
    if (step >= breaks) return left + (t_[i] - left) * (breaks / step);
    breaks -= step;
    left = t_[i];
    h = h_[i];
  }
  return t_.back();
}

void TubeScale::grade() {
  for (std::size_t i = 1; i < t_.size(); ++i) h_[i] = std::min(h_[i], h_[i - 1] + slope * (t_[i] - t_[i - 1]));
  for (std::size_t i = t_.size() - 1; i-- > 0;) h_[i] = std::min(h_[i], h_[i + 1] + slope * (t_[i + 1] - t_[i]));
}

std::vector<double> TubeScale::breaks() const {
  // Divides into equal steps of ∫ 2/H dt.
  std::vector<double> sum(t_.size(), 0.0);
  for (std::size_t i = 1; i < t_.size(); ++i) sum[i] = sum[i - 1] + (t_[i] - t_[i - 1]) * (1 / h_[i - 1] + 1 / h_[i]);
  const std::size_t intervals = std::max(fewest, static_cast<std::size_t>(std::ceil(sum.back())));
  std::vector<double> list{t_.front()};
  for (std::size_t k = 1, i = 1; k < intervals; ++k) {
    const double wanted = sum.back() * static_cast<double>(k) / static_cast<double>(intervals);
    while (sum[i] < wanted) ++i;
    const double x = (wanted - sum[i - 1]) / (sum[i] - sum[i - 1]);
    list.push_back(t_[i - 1] + x * (t_[i] - t_[i - 1]));
  }
  list.push_back(t_.back());
  return list;
}

}  // namespace bahnwerk::blending
