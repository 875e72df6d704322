#include "core/verify/redundant/stroke_chains.hpp"

#include <algorithm>
#include <array>

#include "core/base/progress_scope.hpp"

namespace bahnwerk {
namespace {

using verify::Passage;
using verify::StrokeAxis;
using verify::StrokeSections;

constexpr std::size_t most_sections = 5;  // largest number of sections of a chain
constexpr double worth = 1.5e-3;          // share of all bounds; a smaller gap is left
// Shares of a chain's bounds, and of the gap of the whole path, below which a possible gain is ignored.
constexpr double worth_of_chain = 2e-4, worth_of_gap = 0.02;
constexpr double most_gain = 0.5;  // largest gain that is sought, relative to a chain's bounds
constexpr double enough = 0.7;     // share of what a chain could gain at which no other one is asked
constexpr std::size_t cells = 32;  // steps in which a chain's gain is sought
constexpr double longest = 50;     // units of time, of a part
constexpr double rounding = 1e-9;  // relative rounding of a bound

/// The two parts of a chain and the states possible at the rest between them.
class PartedChain {
 public:
  /// `step`, s: width of a cell.
  PartedChain(const StrokeSections& sections, std::size_t first, std::size_t middle, std::size_t last, double step,
              ProgressScope& scope)
      : step_(step), scope_(scope) {
    const StrokeSections::Surroundings around = sections.around(first, last);
    if (!around.known()) return;
    parts_[0] = {sections.bound(first, middle), sections.passage(first, middle)};
    parts_[1] = {sections.bound(middle, last), sections.passage(middle, last).reversed()};
    for (std::size_t k = 0; k < sections.axes(); ++k) {
      if (!sections.split(k)) continue;
      const StrokeAxis axis = sections.axis(k, first);
      if (std::max(parts_[0].bound, parts_[1].bound) > longest * axis.unit()) continue;
      axes_.push_back({axis, {around.begin(axis), around.end(axis)}, {}});
    }
  }

  /// Returns the lower bound, s, of the additional time of both parts.
  double gain() {
    for (std::size_t sum = 0; sum < cells; ++sum)
      for (std::size_t i = 0; i <= sum; ++i)
        if (possible(i, sum - i)) return static_cast<double>(sum) * step_;
    return cells * step_;
  }

 private:
  struct Part {
    double bound = 0;
    Passage passage;  ///< passage of the second one in time that runs backwards
  };
  struct Axis {
    StrokeAxis axis;
    std::array<ReachableStates, 2> ends;                    ///< the chain's
    std::array<std::vector<ReachableStates>, 2> between{};  ///< at the rest between the parts, per cell
  };

  bool possible(std::size_t first, std::size_t second) {
    const auto impossible = [&](Axis& axis) {
      ReachableStates common = states(axis, 0, first);
      scope_.work(200);
      common.limit(states(axis, 1, second));
      return common.empty();
    };
    const auto by = std::find_if(axes_.begin(), axes_.end(), impossible);
    if (by == axes_.end()) return true;
    std::iter_swap(axes_.begin(), by);  // it will be the reason for the next one, too
    return false;
  }

  const ReachableStates& states(Axis& axis, std::size_t part, std::size_t cell) {
    std::vector<ReachableStates>& known = axis.between[part];
    while (known.size() <= cell) {
      scope_.work(2000);
      const double least = parts_[part].bound + static_cast<double>(known.size()) * step_, most = least + step_;
      ReachableStates s = axis.axis.pass(axis.ends[part], parts_[part].passage, most);
      s.scale_velocity(most / least * (1 + rounding));
      known.push_back(part == 0 ? s : s.reversed());
    }
    return known[cell];
  }

  double step_;
  ProgressScope& scope_;
  std::array<Part, 2> parts_;
  std::vector<Axis> axes_;
};

}  // namespace

double gain_of_chains(const StrokeBoundTask& task, const std::vector<SectionBound>& sections,
                      const std::vector<double>& planned, Progress progress) {
  ProgressScope scope(progress, "bound");
  const StrokeSections looked(task, sections);
  const std::size_t n = sections.size();
  double all = 0;
  for (std::size_t i = 0; i < n; ++i) all += planned[i] - sections[i].duration;
  if (!(all > worth * looked.bound(0, n))) return 0;
  std::vector<char> far(n), waits(n);
  for (std::size_t i = 0; i < n; ++i) far[i] = looked.far(i), waits[i] = looked.waits(i);
  std::vector<double> most(n + 1);  // largest gain of the first i sections
  for (std::size_t last = 1; last <= n; ++last) {
    scope.done(static_cast<double>(last) / static_cast<double>(n));
    scope.work(10);
    most[last] = most[last - 1];
    bool any_far = far[last - 1] != 0;
    double more = planned[last - 1] - sections[last - 1].duration;
    for (std::size_t first = last - 1; first > 0 && last - first < most_sections && waits[first] == 0;) {
      --first;
      any_far = any_far || far[first] != 0;
      more += planned[first] - sections[first].duration;
      const double bound = looked.bound(first, last);
      const double known = most[last] - most[first], worth_it = std::max(worth_of_chain * bound, worth_of_gap * all);
      if (!any_far || !(more > worth_it) || known > enough * more) continue;
      const double step = std::min(more, most_gain * bound) / cells;
      double gain = 0;
      for (std::size_t middle = first + 1; middle < last && gain <= enough * more; ++middle)
        gain = std::max(gain, PartedChain(looked, first, middle, last, step, scope).gain());
      most[last] = std::max(most[last], most[first] + gain - rounding * bound);
    }
  }
  return most[n] * (1 - rounding);
}

}  // namespace bahnwerk
