#include "core/redundant/iterative/knot_choice.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

KnotChoice::KnotChoice(double duration, std::size_t places, std::size_t degree, std::size_t multiplicity,
                       std::size_t wide, double grading)
    : duration_(duration),
      places_(places),
      degree_(degree),
      multiplicity_(multiplicity),
      wide_(wide),
      grading_(grading),
      chosen_{0, places + 1} {}

std::size_t KnotChoice::interpolating(std::size_t samples, std::size_t degree, std::size_t multiplicity) {
  return samples + 1 > degree ? (samples + 1 - degree) / multiplicity : 0;
}

std::vector<double> KnotChoice::knots() const {
  std::vector<double> k(degree_ + 1, 0.0);
  k.reserve(2 * degree_ + 2 + multiplicity_ * chosen());
  for (std::size_t i = 1; i + 1 < chosen_.size(); ++i)
    k.insert(k.end(), multiplicity_, duration_ * static_cast<double>(chosen_[i]) / static_cast<double>(places_ + 1));
  k.insert(k.end(), degree_ + 1, duration_);
  return k;
}

std::size_t KnotChoice::place_at(double t) const {
  const double at = std::round(t / duration_ * static_cast<double>(places_ + 1));
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(places_ + 1)));
}

std::size_t KnotChoice::choice(double t) const {
  const std::size_t j = place_at(t), gaps = chosen_.size() - 1;
  const auto next = static_cast<std::size_t>(std::lower_bound(chosen_.begin(), chosen_.end(), j) - chosen_.begin());
  if (chosen_[next] != j) {
    const std::size_t here = next - 1;
    std::size_t best = here;
    if (gap(here) <= wide_) {  // neighbours behind one chosen knot each may be wider
      if (here > 0 && gap(here - 1) > gap(best)) best = here - 1;
      if (here + 1 < gaps && gap(here + 1) > gap(best)) best = here + 1;
    }
    return middle(grading_ > 0 ? graded(best) : best);
  }
  // The place is chosen already: take the wider of the nearest gaps on both sides that have places left.
  std::size_t left = next, right = next;
  while (left > 0 && gap(left - 1) == 0) --left;
  while (right < gaps && gap(right) == 0) ++right;
  const std::size_t on_left = left > 0 ? gap(left - 1) : 0, on_right = right < gaps ? gap(right) : 0;
  if (on_left == 0 && on_right == 0) return 0;
  return middle(on_left > on_right ? left - 1 : right);
}

std::size_t KnotChoice::graded(std::size_t i) const {
  const auto length = [&](std::size_t k) { return static_cast<double>(chosen_[k + 1] - chosen_[k]); };
  for (;;) {
    std::size_t longest = i;
    double most = grading_ * length(i);
    if (i > 0 && length(i - 1) > most) longest = i - 1, most = length(longest);
    if (i + 2 < chosen_.size() && length(i + 1) > most) longest = i + 1;
    if (longest == i) return i;
    i = longest;
  }
}

void KnotChoice::add(std::size_t place) {
  chosen_.insert(std::lower_bound(chosen_.begin(), chosen_.end(), place), place);
}

bool KnotChoice::insert(double t) {
  const std::size_t place = choice(t);
  if (place == 0) return false;
  add(place);
  return true;
}

bool KnotChoice::insert_in_widest() {
  std::size_t best = 0;
  for (std::size_t i = 1; i + 1 < chosen_.size(); ++i)
    if (gap(i) > gap(best)) best = i;
  if (gap(best) == 0) return false;
  add(middle(best));
  return true;
}

std::size_t KnotChoice::insert_apart(const std::vector<double>& times, std::size_t apart) {
  std::vector<std::size_t> added;
  for (const double t : times) {
    const std::size_t place = choice(t);
    if (place == 0) break;
    const auto rank = [&](std::size_t p) {  // among those chosen at the begin
      return std::lower_bound(chosen_.begin(), chosen_.end(), p) - chosen_.begin();
    };
    const auto here = rank(place);
    const auto next = std::lower_bound(added.begin(), added.end(), place);
    const auto reach = static_cast<std::ptrdiff_t>(apart);
    if (next != added.end() && rank(*next) - here < reach) continue;
    if (next != added.begin() && here - rank(*(next - 1)) < reach) continue;
    added.insert(next, place);
  }
  std::vector<std::size_t> both;
  both.reserve(chosen_.size() + added.size());
  std::merge(chosen_.begin(), chosen_.end(), added.begin(), added.end(), std::back_inserter(both));
  chosen_ = std::move(both);
  return added.size();
}

void KnotChoice::choose_nearest(const std::vector<double>& times) {
  for (const double t : times) chosen_.push_back(place_at(t));
  std::sort(chosen_.begin(), chosen_.end());
  chosen_.erase(std::unique(chosen_.begin(), chosen_.end()), chosen_.end());
}

void KnotChoice::choose_evenly(std::size_t count) {
  count = std::min(count, places_);
  chosen_.assign(1, 0);
  const double step = static_cast<double>(places_ + 1) / static_cast<double>(count + 1);
  for (std::size_t j = 1; j <= count; ++j)
    chosen_.push_back(static_cast<std::size_t>(std::floor(step * static_cast<double>(j) + 0.5)));
  chosen_.push_back(places_ + 1);
}

}  // namespace bahnwerk
