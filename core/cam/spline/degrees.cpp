#include "core/cam/spline/degrees.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

namespace bahnwerk::cam {
namespace {

constexpr int unreachable = std::numeric_limits<int>::max() / 2;

/// Distributions along a chain of points whose first and last shares are chosen among what they allow. Point i's
/// section is the one behind it.
class Chain {
 public:
  Chain(std::vector<PointShare> points, const std::vector<bool>& sections)
      : points_(std::move(points)), sections_(sections) {}

  /// Returns the least largest degree; `unreachable` if a section would have no condition.
  int least_maximum() { return run(unreachable - 1, true); }
  /// Returns the least sum of squares with degrees up to `cap`; keeps the solutions for list().
  int least_squares(int cap) { return run(cap, false); }
  /// Returns the least unevenness of a distribution of that sum, Σ (before − behind)² over the shares of all points,
  /// and stores its degrees: lopsided shares all along a law let its derivatives grow from section to section.
  int most_even(std::vector<int>& degrees) const {
    const std::size_t n = points_.size();
    std::vector<std::vector<int>> uneven(n);
    const auto own = [&](std::size_t i, int choice) {
      const int more = 2 * before(i, choice) - points_[i].total;
      return more * more;
    };
    const auto best_next = [&](std::size_t i, int choice) {
      std::pair<int, int> best{unreachable, 0};
      for (int next = 0; next < choices(i + 1); ++next) {
        const int here = cost(i, choice, next, false), rest = costs_[i + 1][static_cast<std::size_t>(next)];
        if (here == unreachable || rest == unreachable || here + rest != costs_[i][static_cast<std::size_t>(choice)])
          continue;
        best = std::min(best, {uneven[i + 1][static_cast<std::size_t>(next)], next});
      }
      return best;
    };
    for (std::size_t i = n; i-- > 0;)
      for (int choice = 0; choice < choices(i); ++choice) {
        const int rest = i + 1 == n ? 0 : best_next(i, choice).first;
        uneven[i].push_back(rest == unreachable ? unreachable : rest + own(i, choice));
      }
    std::pair<int, int> first{unreachable, 0};
    for (int choice = 0; choice < choices(0); ++choice)
      if (costs_[0][static_cast<std::size_t>(choice)] == best_)
        first = std::min(first, {uneven[0][static_cast<std::size_t>(choice)], choice});
    degrees.assign(sections_.size(), -1);
    for (std::size_t i = 0, choice = static_cast<std::size_t>(first.second); i + 1 < n; ++i) {
      const int next = best_next(i, static_cast<int>(choice)).second;
      if (sections_[i]) degrees[i] = degree(i, static_cast<int>(choice), next);
      choice = static_cast<std::size_t>(next);
    }
    return first.first;
  }
  /// Adds the distributions of that sum, up to `at_most` in `out`; false when there are more. `variety` 0: the earliest
  /// sections get the most first; else each point begins with a choice of its own.
  bool list(std::set<std::vector<int>>& out, std::size_t at_most, std::size_t variety) {
    variety_ = variety;
    std::vector<int> degrees(sections_.size(), -1);
    return follow(0, -1, best_, degrees, out, at_most);
  }
  /// Adds the distributions whose sum of squares is `sum`, up to `at_most` in `out`, and looks at some thousand
  /// choices.
  void list_sum(int sum, std::set<std::vector<int>>& out, std::size_t at_most, std::size_t variety) {
    constexpr std::size_t enough = 20000;
    variety_ = variety, choices_left_ = enough;
    exact_ = false;
    std::vector<int> degrees(sections_.size(), -1);
    follow(0, -1, sum, degrees, out, at_most);
    exact_ = true;
  }

 private:
  int choices(std::size_t i) const { return points_[i].before_max - points_[i].before_min + 1; }
  int before(std::size_t i, int choice) const { return points_[i].before_max - choice; }
  int degree(std::size_t section, int choice, int next) const {
    return points_[section].total - before(section, choice) + before(section + 1, next) - 1;
  }

  /// Computes costs_[i][choice], the least cost of sections i, i + 1, …
  int run(int cap, bool maximum) {
    cap_ = cap;
    costs_.assign(points_.size(), {});
    for (std::size_t i = points_.size(); i-- > 0;) {
      costs_[i].assign(static_cast<std::size_t>(choices(i)), i + 1 == points_.size() ? 0 : unreachable);
      if (i + 1 == points_.size()) continue;
      for (int choice = 0; choice < choices(i); ++choice)
        for (int next = 0; next < choices(i + 1); ++next) {
          const int rest = costs_[i + 1][static_cast<std::size_t>(next)], own = cost(i, choice, next, maximum);
          if (rest == unreachable || own == unreachable) continue;
          int& least = costs_[i][static_cast<std::size_t>(choice)];
          least = std::min(least, maximum ? std::max(rest, own) : rest + own);
        }
    }
    best_ = *std::min_element(costs_[0].begin(), costs_[0].end());
    return best_;
  }
  int cost(std::size_t section, int choice, int next, bool maximum) const {
    if (!sections_[section]) return 0;
    const int d = degree(section, choice, next);
    if (d < 0 || d > cap_) return unreachable;
    return maximum ? d : d * d;
  }
  bool follow(std::size_t i, int choice, int left, std::vector<int>& degrees, std::set<std::vector<int>>& out,
              std::size_t at_most) {
    if (!exact_ && choices_left_-- == 0) return choices_left_ = 0, false;
    if (i + 1 == points_.size() && choice >= 0) {
      if (left != 0) return true;
      if (out.size() >= at_most) return out.count(degrees) > 0;
      out.insert(degrees);
      return true;
    }
    if (choice < 0) {
      for (int first = 0; first < choices(0); ++first)
        if (reaches(costs_[0][static_cast<std::size_t>(first)], left) && !follow(0, first, left, degrees, out, at_most))
          return false;
      return true;
    }
    const int count = choices(i + 1);
    for (int k = 0; k < count; ++k) {
      const int next = (k + first_choice(i)) % count;
      const int own = cost(i, choice, next, false), rest = costs_[i + 1][static_cast<std::size_t>(next)];
      if (own == unreachable || rest == unreachable || !reaches(own + rest, left)) continue;
      degrees[i] = sections_[i] ? degree(i, choice, next) : -1;
      if (!follow(i + 1, next, left - own, degrees, out, at_most)) return false;
    }
    return true;
  }

  /// Returns whether sections whose least cost is `least` may have the cost that is left.
  bool reaches(int least, int left) const { return exact_ ? least == left : least <= left; }
  int first_choice(std::size_t i) const {
    if (variety_ == 0) return 0;
    const std::uint64_t mixed = (i + 1) * 0x9e3779b97f4a7c15ULL ^ variety_ * 0xbf58476d1ce4e5b9ULL;
    return static_cast<int>((mixed * 0x94d049bb133111ebULL) >> 56);
  }

  std::size_t variety_ = 0, choices_left_ = 0;
  bool exact_ = true;  // the cost is the least one
  std::vector<PointShare> points_;
  const std::vector<bool>& sections_;
  std::vector<std::vector<int>> costs_;
  int cap_ = 0, best_ = unreachable;
};

}  // namespace

namespace {

/// Returns the path of points, or one per share of the first point around a cycle.
std::vector<Chain> make_chains(const std::vector<PointShare>& shares, const std::vector<bool>& sections) {
  std::vector<Chain> chains;
  if (sections.size() != shares.size()) {
    chains.emplace_back(shares, sections);
    return chains;
  }
  for (int before = shares[0].before_max; before >= shares[0].before_min; --before) {
    std::vector<PointShare> points = shares;
    points.front().before_min = points.front().before_max = before;
    points.push_back(points.front());
    chains.emplace_back(std::move(points), sections);
  }
  return chains;
}

}  // namespace

DegreeDistributions balance_degrees(const std::vector<PointShare>& shares, const std::vector<bool>& sections,
                                    int max_degree, std::size_t at_most) {
  DegreeDistributions out;
  std::vector<Chain> chains = make_chains(shares, sections);
  int least = unreachable;
  for (Chain& chain : chains) least = std::min(least, chain.least_maximum());
  out.least_maximum = least;
  if (least == unreachable || least > max_degree) return out;
  int squares = unreachable;
  std::vector<int> costs;
  for (Chain& chain : chains) costs.push_back(chain.least_squares(least)), squares = std::min(squares, costs.back());
  std::set<std::vector<int>> found;
  const auto list = [&](std::size_t limit, std::size_t variety) {
    bool complete = true;
    for (std::size_t i = 0; i < chains.size(); ++i)
      if (costs[i] == squares && !chains[i].list(found, limit, variety)) complete = false;
    return complete;
  };
  out.complete = list(at_most, 0);
  if (out.complete) {
    out.degrees.assign(found.rbegin(), found.rend());
    return out;
  }
  // One after the other they differ at the end of the law alone: the most even one and some of each kind instead.
  std::pair<int, std::vector<int>> even{unreachable, {}};
  for (std::size_t i = 0; i < chains.size(); ++i) {
    if (costs[i] != squares) continue;
    std::vector<int> degrees;
    const int uneven = chains[i].most_even(degrees);
    if (uneven < even.first) even = {uneven, std::move(degrees)};
  }
  found = {even.second};
  if (at_most > 1) {
    constexpr std::size_t varieties = 16;
    for (std::size_t v = 1; v <= varieties; ++v) list(std::max<std::size_t>(2, at_most * v / varieties), v);
    found.erase(even.second);
  }
  out.degrees = {even.second};
  if (at_most > 1) out.degrees.insert(out.degrees.end(), found.rbegin(), found.rend());
  return out;
}

std::vector<std::vector<int>> next_degrees(const std::vector<PointShare>& shares, const std::vector<bool>& sections,
                                           int max_degree, std::size_t at_most) {
  std::vector<std::vector<int>> out;
  std::vector<Chain> chains = make_chains(shares, sections);
  int least = unreachable, squares = unreachable;
  for (Chain& chain : chains) least = std::min(least, chain.least_maximum());
  if (least == unreachable || least >= max_degree) return out;
  for (Chain& chain : chains) squares = std::min(squares, chain.least_squares(least));
  const double most = 1.02 * static_cast<double>(squares);
  for (Chain& chain : chains) squares = std::min(squares, chain.least_squares(least + 1));
  constexpr std::size_t varieties = 4;
  // The sum of degrees is given, so the sums of squares are even numbers apart.
  for (int sum = squares; sum <= most && out.size() < at_most; sum += 2) {
    std::set<std::vector<int>> found;
    const std::size_t left = at_most - out.size();
    for (std::size_t v = 0; v < varieties; ++v)
      for (Chain& chain : chains) chain.list_sum(sum, found, std::max<std::size_t>(1, left * (v + 1) / varieties), v);
    for (auto it = found.rbegin(); it != found.rend() && out.size() < at_most; ++it)
      if (sum > squares || *std::max_element(it->begin(), it->end()) > least) out.push_back(*it);
  }
  return out;
}

}  // namespace bahnwerk::cam
