#include "core/contour/blend/smooth_system.hpp"

#include <algorithm>

namespace bahnwerk::blending {

namespace {

/// Runs `work` in registers of four numbers where the processor has them: in half the time, with equal results to the
/// last bit, since every operation is unchanged. Only code inlined into `work` benefits.
#if defined(__x86_64__)
template <class Work>
[[gnu::target("avx2")]] void work_wide(Work& work) {
  work();
}
template <class Work>
void work_in_lanes(Work&& work) {
  static const bool wide = __builtin_cpu_supports("avx2");
  wide ? work_wide(work) : work();
}
#else
template <class Work>
void work_in_lanes(Work&& work) {
  work();
}
#endif

}  // namespace

template <std::size_t Dim>
TubeSystem<Dim>::TubeSystem(const TubeProblem& problem, ProgressScope& progress)
    : p_(problem),
      progress_(progress),
      points_(problem.breaks.size() + spline_degree - 1),
      knots_(clamped_knots(problem.breaks)),
      energy_(points_),
      energies_(points_ * Dim),
      system_(points_ * Dim),
      c_((points_ + spline_degree) * Dim, 0.0) {
  assemble_energy();
  prepare_sites();
  fix_ends();
}

template <std::size_t Dim>
std::vector<Vec> TubeSystem<Dim>::points() const {
  std::vector<Vec> all;
  for (std::size_t i = 0; i < points_; ++i) all.push_back(point(i));
  return all;
}

template <std::size_t Dim>
void TubeSystem<Dim>::assemble_energy() {
  // |f'''|² is a polynomial of degree 4 in an interval: three Gauss points integrate it exactly.
  static const double node[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double radius = HUGE_VAL;
  for (const TubeSite& s : p_.sites) radius = std::min(radius, s.radius);
  for (std::size_t k = 0; k + 1 < p_.breaks.size(); ++k) {
    progress_.work();
    const double h = p_.breaks[k + 1] - p_.breaks[k];
    const double H = p_.scale[k], w = H * H * H * H * H / (radius * radius);
    std::array<double, 3> places;
    for (std::size_t g = 0; g < 3; ++g) places[g] = p_.breaks[k] + node[g] * h;
    const auto rows = third_basis_at(knots_, k, places);
    for (std::size_t g = 0; g < 3; ++g) {
      const auto& row = rows[g];
      const double part = w * weight[g] * h;
      for (std::size_t j = 0; j < spline_order; ++j) {
        double* const column = energy_.column(k + j);
        const double share = part * row[j];
        for (std::size_t i = j; i < spline_order; ++i) column[i - j] += share * row[i];
      }
    }
  }
  for (std::size_t j = 0; j < points_; ++j)
    for (std::size_t i = 0; i < spline_order; ++i)
      for (std::size_t d = 0; d < Dim; ++d) energies_.column(j * Dim + d)[i * Dim] = energy_.column(j)[i];
}

template <std::size_t Dim>
void TubeSystem<Dim>::prepare_sites() {
  const std::size_t m = p_.sites.size();
  rows_.resize(m);
  residual_.resize(m);
  std::size_t span = 0;
  for (std::size_t i = 0; i < m; ++i) {
    const double t = p_.sites[i].t;
    while (span + 2 < p_.breaks.size() && t >= p_.breaks[span + 1]) ++span;
    rows_[i].first = span;
    rows_[i].value = value_basis_at(knots_, span, t)[0];
    const double before = i > 0 ? p_.sites[i - 1].t : p_.breaks.front();
    const double after = i + 1 < m ? p_.sites[i + 1].t : p_.breaks.back();
    rows_[i].gain = 0.5 * (after - before) / p_.scale[span];
  }
}

template <std::size_t Dim>
void TubeSystem<Dim>::fix_ends() {
  const std::size_t last = points_ - 1, spans = p_.breaks.size() - 1;
  const auto part = [](const Jet& j, std::size_t k) { return k == 0 ? j.value : k == 1 ? j.d1 : k == 2 ? j.d2 : j.d3; };
  fixed_begin_ = p_.begin.clamped ? 4 : 1;
  fixed_end_ = p_.end.clamped ? 4 : 1;
  const BasisRow first = basis_at(knots_, 0, p_.breaks.front());
  for (std::size_t k = 0; k < fixed_begin_; ++k) {
    Vec rest = part(p_.begin.jet, k);
    for (std::size_t i = 0; i < k; ++i) rest += -first[k][i] * point(i);
    place(k, rest / first[k][k]);
  }
  const BasisRow final = basis_at(knots_, spans - 1, p_.breaks.back());
  for (std::size_t k = 0; k < fixed_end_; ++k) {
    Vec rest = part(p_.end.jet, k);
    for (std::size_t i = 0; i < k; ++i) rest += -final[k][spline_degree - i] * point(last - i);
    place(last - k, rest / final[k][spline_degree - k]);
  }
}

template <std::size_t Dim>
void TubeSystem<Dim>::look_at_sites() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    residual_[i] = value(rows_[i], c_);
    for (std::size_t d = 0; d < Dim; ++d) residual_[i][d] -= p_.sites[i].p[d];
  }
}

template <std::size_t Dim>
std::pair<double, std::size_t> TubeSystem<Dim>::fullest() {
  look_at_sites();
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double fill = std::sqrt(product(residual_[i], residual_[i])) / p_.sites[i].radius;
    if (!(fill <= worst)) worst = std::isnan(fill) ? HUGE_VAL : fill, at = i;
  }
  return {worst, at};
}

template <std::size_t Dim>
void TubeSystem<Dim>::times_energy(const std::vector<double>& x, std::vector<double>& product) const {
  product.assign((points_ + spline_degree) * Dim, 0.0);
  for (std::size_t j = 0; j < points_; ++j) {
    const double* const e = energy_.column(j);
    const double* const from = &x[j * Dim];
    double* const to = &product[j * Dim];
    Coordinates sum{};
    for (std::size_t i = 0; i < spline_order; ++i)
      for (std::size_t d = 0; d < Dim; ++d) sum[d] += e[i] * from[i * Dim + d];
    for (std::size_t i = 1; i < spline_order; ++i)
      for (std::size_t d = 0; d < Dim; ++d) to[i * Dim + d] += e[i] * from[d];
    for (std::size_t d = 0; d < Dim; ++d) to[d] += sum[d];
  }
}

template <std::size_t Dim>
void TubeSystem<Dim>::start() {
  system_ = energies_;
  times_energy(c_, pull_);
  right_.resize(points_ * Dim);
  energy_before_ = 0;
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = -pull_[i], energy_before_ += 0.5 * c_[i] * pull_[i];
}

template <std::size_t Dim>
void TubeSystem<Dim>::add_sites(const std::vector<SiteTerm>& terms) {
  work_in_lanes([&]() __attribute__((always_inline)) {
    for (std::size_t i = 0; i < rows_.size(); ++i) add_site(i, terms[i]);
  });
}

template <std::size_t Dim>
void TubeSystem<Dim>::keep_ends() {
  constexpr std::size_t width = spline_order * Dim - 1;
  const std::size_t n = points_ * Dim, first = fixed_begin_ * Dim, last = n - fixed_end_ * Dim;
  const auto keep = [&](std::size_t j) {
    std::fill_n(system_.column(j), width + 1, 0.0);
    *system_.column(j) = 1;
    right_[j] = 0;
  };
  for (std::size_t j = 0; j < first; ++j) keep(j);
  for (std::size_t j = last > width ? last - width : 0; j < last; ++j)
    std::fill(system_.column(j) + (last - j), system_.column(j) + width + 1, 0.0);
  for (std::size_t j = last; j < n; ++j) keep(j);
}

template <std::size_t Dim>
void TubeSystem<Dim>::solve(double damping) {
  progress_.report();  // windows are too short for the steps that others count
  for (std::size_t j = 0; damping > 0 && j < points_ * Dim; ++j) *system_.column(j) *= 1 + damping;
  keep_ends();
  work_in_lanes([&]() __attribute__((always_inline)) {
    system_.factor([&] { progress_.work(); });
    system_.solve(right_);
  });
}

template <std::size_t Dim>
void TubeSystem<Dim>::move(double share) {
  for (std::size_t i = 0; i < right_.size(); ++i) c_[i] += share * right_[i];
}

template <std::size_t Dim>
void TubeSystem<Dim>::energy_along(double& quadratic, double& linear) {
  for (std::size_t i = 0; i < right_.size(); ++i) linear += right_[i] * pull_[i];
  right_.resize((points_ + spline_degree) * Dim, 0.0);
  times_energy(right_, pull_);
  right_.resize(points_ * Dim);
  for (std::size_t i = 0; i < right_.size(); ++i) quadratic += right_[i] * pull_[i];
}

template class TubeSystem<2>;
template class TubeSystem<3>;

}  // namespace bahnwerk::blending
