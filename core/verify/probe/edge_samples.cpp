#include "core/verify/probe/edge_samples.hpp"

#include <algorithm>

namespace bahnwerk {
namespace {

template <std::size_t D>
double distance(const std::array<double, D>& a, const std::array<double, D>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

}  // namespace

template <int D>
EdgeSamples<D>::EdgeSamples(const EdgeBoundProblem<D>& problem)
    : problem_(problem), rows_(difference_rows(problem.grid)), fixed_(count()), radius_(count()) {
  const double length = distance(problem.set[sample_at(0)].p, problem.set[sample_at(1)].p);
  for (std::size_t k = 0; k < count(); ++k) {
    // Where the set of a sample is nearly a point, the search takes the point as given or widens the set: the
    // certificate accounts for it.
    const SampleSet<D>& set = problem.set[k];
    fixed_[k] = set.p == set.q && set.radius < 1e-3 * length;
    radius_[k] = std::max(set.radius, 1e-4 * length);
  }
  for (std::size_t k = 0; k < count(); ++k) {
    tube_slack_.push_back(slacks_);
    if (!fixed_[k]) ++slacks_;
  }
  for (std::size_t r = 1; r <= 4; ++r)
    for (std::size_t k = 0; k < rows(r); ++k) {
      row_slack_[r - 1].push_back(slacks_);
      if (free_row(r, k)) slacks_ += r == 1 ? 1 : 2 * D;
    }
}

template <int D>
std::vector<std::array<double, D>> EdgeSamples<D>::start() const {
  std::vector<Point> x(count());
  const Point &a = problem_.set[sample_at(0)].p, &b = problem_.set[sample_at(1)].p;
  for (std::size_t k = 0; k < count(); ++k) {
    const double g = std::clamp(problem_.grid[k], 0.0, 1.0);
    const double s = g * g * g * g * (35 + g * (-84 + g * (70 - 20 * g)));
    for (int i = 0; i < D; ++i) x[k][i] = a[i] + s * (b[i] - a[i]);
    if (fixed_[k]) x[k] = problem_.set[k].p;
  }
  return x;
}

template <int D>
std::size_t EdgeSamples<D>::sample_at(double g) const {
  std::size_t k = 0;
  while (k + 1 < count() && problem_.grid[k] < g) ++k;
  return k;
}

template <int D>
std::array<double, D> EdgeSamples<D>::value(const std::vector<Point>& x, std::size_t r, std::size_t k,
                                            double power) const {
  Point q{};
  for (std::size_t i = 1; i <= r; ++i)
    for (int a = 0; a < D; ++a) q[a] += rows_[r - 1][k][i] * (x[k + i][a] - x[k][a]);
  for (int a = 0; a < D; ++a) q[a] *= power;
  return q;
}

template <int D>
bool EdgeSamples<D>::free_row(std::size_t r, std::size_t k) const {
  for (std::size_t i = 0; i <= r; ++i)
    if (!fixed_[k + i]) return true;
  return false;
}

template <int D>
std::array<double, D> EdgeSamples<D>::offset(std::size_t k, const Point& x, bool& cap, Point& u) const {
  const SampleSet<D>& s = problem_.set[k];
  double length = distance(s.p, s.q), along = 0;
  for (int a = 0; a < D; ++a) {
    u[a] = length > 0 ? (s.q[a] - s.p[a]) / length : 0;
    along += u[a] * (x[a] - s.p[a]);
  }
  cap = along <= 0 || along >= length;
  along = std::clamp(along, 0.0, length);
  Point d;
  for (int a = 0; a < D; ++a) d[a] = x[a] - s.p[a] - along * u[a];
  return d;
}

template <int D>
double EdgeSamples<D>::slowest(const std::vector<Point>& x) const {
  double h = 0;
  for (std::size_t r = 1; r <= 4; ++r)
    for (std::size_t k = 0; k < rows(r); ++k) {
      const Point q = value(x, r, k, 1);
      double ratio = 0;
      for (int a = 0; a < D; ++a)
        ratio = r == 1 ? std::hypot(ratio, q[a] / problem_.speed)
                       : std::max(ratio, std::abs(q[a]) / problem_.derivative[r - 2][a]);
      h = std::max(h, std::pow(ratio, 1.0 / static_cast<double>(r)));
    }
  return h;
}

template <int D>
bool EdgeSamples<D>::evaluate(const std::vector<Point>& x, double h, std::vector<double>& slack) const {
  slack.resize(slacks_);
  for (std::size_t k = 0; k < count(); ++k) {
    if (fixed_[k]) continue;
    bool cap;
    Point u;
    const Point d = offset(k, x[k], cap, u);
    double sum = 0;
    for (int a = 0; a < D; ++a) sum += d[a] * d[a];
    slack[tube_slack(k)] = 1 - sum / (radius_[k] * radius_[k]);
  }
  double power = 1;
  for (std::size_t r = 1; r <= 4; ++r) {
    power /= h;
    for (std::size_t k = 0; k < rows(r); ++k) {
      if (!free_row(r, k)) continue;
      const Point q = value(x, r, k, power);
      if (r == 1) {
        double sum = 0;
        for (int a = 0; a < D; ++a) sum += q[a] * q[a];
        slack[speed_slack(k)] = 1 - sum / (problem_.speed * problem_.speed);
        continue;
      }
      for (int a = 0; a < D; ++a) {
        const double ratio = q[a] / problem_.derivative[r - 2][a];
        double* s = &slack[axis_slack(r, k, a)];
        s[0] = 1 - ratio;
        s[1] = 1 + ratio;
      }
    }
  }
  return std::all_of(slack.begin(), slack.end(), [](double g) { return g > 0; });
}

template class EdgeSamples<1>;
template class EdgeSamples<2>;
template class EdgeSamples<3>;

}  // namespace bahnwerk
