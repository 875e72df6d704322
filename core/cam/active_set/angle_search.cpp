#include "core/cam/active_set/angle_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::cam {
namespace {

class AngleSearch {
 public:
  AngleSearch(const MotionLawProblem& problem, Progress progress) : problem_(problem), progress_(progress) {
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      at_.push_back(problem.points[i].at.min);
      if (!problem.points[i].at.fixed()) free_.push_back(i);
    }
  }

  Expected<LawSolution, NoLaw> run() {
    std::vector<Place> places = grid();
    if (places.empty()) return why_not_.value_or(NoLaw::angles);
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.objective < b.objective; });
    if (places.size() > starts) places.resize(starts);
    Place best = places.front();
    for (const Place& start : places)
      if (Place found = compass(start); found.objective < best.objective) best = std::move(found);
    Expected<LawSolution, NoLaw> solution = solve_active_set(problem_, angles(best.share), progress_);
    if (solution) solution->systems += systems_;
    return solution;
  }

 private:
  static constexpr std::size_t starts = 3, grid_places = 400, most_laws = 2000;
  struct Place {
    std::vector<double> share;  // 0 … 1 of each free range
    double objective = 0;
  };

  std::vector<double> angles(const std::vector<double>& share) const {
    std::vector<double> at = at_;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const Range range = problem_.points[free_[k]].at;
      at[free_[k]] = share[k] == 1 ? range.max : range.min + share[k] * (range.max - range.min);
    }
    return at;
  }

  /// Returns J at a place; infinite if there is no law.
  double objective(const std::vector<double>& share) {
    ++laws_;
    progress_.report("angles", std::min(0.95, static_cast<double>(laws_) / most_laws));
    const std::vector<double> at = angles(share);
    const double least = 1e-6 * problem_.length;
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      if (at[i + 1] - at[i] < least) return std::numeric_limits<double>::infinity();
    if (problem_.periodic && at.front() + problem_.length - at.back() < least)
      return std::numeric_limits<double>::infinity();
    ActiveSetOptions quick;
    quick.source_order_only = true;
    quick.distributions = 8;
    try {
      const Expected<LawSolution, NoLaw> found = solve_active_set(problem_, at, progress_, quick);
      if (found) {
        systems_ += found->systems;
        return found->value.objective;
      }
      if (!why_not_) why_not_ = found.reason();
    } catch (const InvalidInput&) {
      if (!retried_) first_ = std::current_exception(), retried_ = true;
    }
    return std::numeric_limits<double>::infinity();
  }

  std::vector<Place> grid() {
    const std::size_t n = free_.size();
    std::size_t per_angle =
        static_cast<std::size_t>(std::pow(static_cast<double>(grid_places), 1.0 / static_cast<double>(n)) + 1e-9);
    std::vector<Place> out;
    const auto try_place = [&](std::vector<double> share) {
      const double value = objective(share);
      if (std::isfinite(value)) out.push_back({std::move(share), value});
    };
    if (per_angle >= 3) {
      per_angle = std::min<std::size_t>(per_angle, 41);
      std::vector<std::size_t> index(n, 0);
      for (bool more = true; more;) {
        std::vector<double> share;
        for (const std::size_t i : index) share.push_back(static_cast<double>(i) / static_cast<double>(per_angle - 1));
        try_place(std::move(share));
        more = false;
        for (std::size_t k = 0; k < n && !more; ++k) {
          if (++index[k] < per_angle)
            more = true;
          else
            index[k] = 0;
        }
      }
    } else {
      Random random(problem_.seed);
      for (std::size_t i = 0; i < grid_places; ++i) {
        std::vector<double> share;
        for (std::size_t k = 0; k < n; ++k) share.push_back(i == 0 ? 0.5 : random.uniform());
        try_place(std::move(share));
      }
    }
    if (out.empty() && first_) std::rethrow_exception(first_);
    return out;
  }

  Place compass(Place place) {
    for (double step = 0.05; step > 1e-6 && laws_ < most_laws;) {
      bool better = false;
      for (std::size_t k = 0; k < place.share.size() && laws_ < most_laws; ++k)
        for (const double sign : {1.0, -1.0}) {
          std::vector<double> share = place.share;
          share[k] = std::clamp(share[k] + sign * step, 0.0, 1.0);
          if (share[k] == place.share[k]) continue;
          const double value = objective(share);
          if (value < place.objective) {
            place = {std::move(share), value};
            better = true;
            break;
          }
        }
      if (!better) step /= 2;
    }
    return place;
  }

  const MotionLawProblem& problem_;
  Progress progress_;
  std::vector<double> at_;
  std::vector<std::size_t> free_;
  std::size_t laws_ = 0, systems_ = 0;
  std::optional<NoLaw> why_not_;
  std::exception_ptr first_;
  bool retried_ = false;
};

}  // namespace

Expected<LawSolution, NoLaw> plan_active_set(const MotionLawProblem& problem, Progress progress) {
  if (problem.has_free_angles()) return AngleSearch(problem, progress).run();
  std::vector<double> at;
  for (const MotionPoint& point : problem.points) at.push_back(point.at.min);
  return solve_active_set(problem, at, progress);
}

}  // namespace bahnwerk::cam
