#include "core/winding/packing/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/progress.hpp"

namespace bahnwerk::winding {
namespace {

constexpr int steps = 600;  // largest number of steps of a minimisation
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr std::size_t elite = 4;  // starts from which hops continue

}  // namespace

PackingSearch::PackingSearch(const CentreArea& usable_area, double distance, std::uint64_t seed, Progress progress)
    : usable_area_(usable_area), energy_(usable_area, distance), random_(seed), progress_(progress) {
  if (usable_area.empty()) return;
  sides_ = winding::sides(usable_area.edges(), 1.5 * distance);
  // Candidate points, in cells one distance wide, for the holes between wires.
  std::vector<Point> points = usable_area.spread(distance / 4);
  const Box& box = usable_area.box();
  low_ = box.low;
  side_ = distance;
  columns_ = static_cast<std::size_t>((box.high.x - low_.x) / side_) + 1;
  rows_ = static_cast<std::size_t>((box.high.y - low_.y) / side_) + 1;
  const auto cell = [&](Point p) {
    const auto column = std::min(columns_ - 1, static_cast<std::size_t>(std::max(0.0, (p.x - low_.x) / side_)));
    const auto row = std::min(rows_ - 1, static_cast<std::size_t>(std::max(0.0, (p.y - low_.y) / side_)));
    return row * columns_ + column;
  };
  first_.assign(columns_ * rows_ + 1, 0);
  for (const Point& p : points) ++first_[cell(p)];
  std::uint32_t sum = 0;
  for (std::uint32_t& f : first_) sum = f += sum;
  pool_.resize(points.size());
  for (std::size_t i = points.size(); i-- > 0;) pool_[--first_[cell(points[i])]] = points[i];
}

std::vector<Point> PackingSearch::holes(std::span<const Point> wires, std::size_t most) {
  const double far = side_ * side_;
  clearance_.assign(pool_.size(), far);
  for (const Point& p : wires) {
    const auto column = static_cast<long>(std::floor((p.x - low_.x) / side_));
    const auto row = static_cast<long>(std::floor((p.y - low_.y) / side_));
    for (long r = std::max(0L, row - 1); r <= std::min(static_cast<long>(rows_) - 1, row + 1); ++r)
      for (long c = std::max(0L, column - 1); c <= std::min(static_cast<long>(columns_) - 1, column + 1); ++c) {
        const std::size_t cell = static_cast<std::size_t>(r) * columns_ + static_cast<std::size_t>(c);
        for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i)
          clearance_[i] = std::min(clearance_[i], square_distance(pool_[i], p));
      }
  }
  energy_.add_work(30 * wires.size() + 2 * most * pool_.size());
  std::vector<Point> found;
  while (found.size() < most) {
    const auto widest = std::max_element(clearance_.begin(), clearance_.end());
    if (widest == clearance_.end() || *widest <= 0) break;
    found.push_back(pool_[static_cast<std::size_t>(widest - clearance_.begin())]);
    for (std::size_t i = 0; i < pool_.size(); ++i)
      if (square_distance(pool_[i], found.back()) < 0.36 * far) clearance_[i] = 0;
  }
  return found;
}

void PackingSearch::adjust(std::vector<Point>& wires, std::size_t count) {
  while (wires.size() > count) {
    energy_.share(wires, share_);
    const auto worst = std::max_element(share_.begin(), share_.end());
    std::size_t which = static_cast<std::size_t>(worst - share_.begin());
    if (*worst == 0) which = random_.below(wires.size());
    wires.erase(wires.begin() + static_cast<std::ptrdiff_t>(which));
  }
  while (wires.size() < count) {
    const std::vector<Point> free = holes(wires, std::min<std::size_t>(count - wires.size(), 3));
    if (free.empty()) {
      wires.push_back(pool_[random_.below(pool_.size())]);
    } else {
      wires.insert(wires.end(), free.begin(), free.end());
    }
  }
}

PackingSearch::State PackingSearch::settled(std::vector<Point> wires, double goal) {
  progress_.report("potential");
  ++settled_;
  State state;
  const Rest rest = minimiser_.minimise(energy_, wires, goal, steps, progress_);
  state.wires = std::move(wires);
  state.energy = rest.energy;
  state.allowed = rest.allowed;
  return state;
}

std::vector<Point> PackingSearch::start(std::size_t count) {
  std::vector<Point> wires;
  const double full = energy_.distance();
  const bool few = count < 12;
  if (random_.chance(few ? 0.8 : 0.25)) {
    // Start from wires uniformly distributed in the usable area, which then grow [Herrmann Algorithm 4.3, lines 4 to
    // 17].
    for (std::size_t i = 0; i < count; ++i) {
      const Point jitter{random_.uniform(-0.125, 0.125) * full, random_.uniform(-0.125, 0.125) * full};
      const Point p = pool_[random_.below(pool_.size())] + jitter;
      wires.push_back(p + usable_area_.way_in(p));
    }
    for (const double grown : {0.5, 0.7, 0.85, 0.95}) {
      energy_.set_distance(grown * full);
      minimiser_.minimise(energy_, wires, endless, 30, progress_);
    }
    energy_.set_distance(full);
    return wires;
  }
  wires = random_rows(usable_area_, sides_, full, count, random_);
  adjust(wires, count);
  // Lattices are saddle points of the energy, so they are perturbed.
  for (Point& p : wires) p += Point{random_.uniform(-0.02, 0.02) * full, random_.uniform(-0.02, 0.02) * full};
  return wires;
}

std::vector<Point> PackingSearch::hop(const State& from) {
  std::vector<Point> wires = from.wires;
  const std::size_t n = wires.size();
  const double full = energy_.distance(), kind = random_.uniform();
  if (kind < 0.4) {
    energy_.share(wires, share_);
    std::size_t which = random_.below(n);
    // Move a wire with a large overlap, one without contact force, or any wire.
    const double whom = random_.uniform();
    if (whom < 0.6) {
      for (int i = 0; i < 5; ++i)
        if (const std::size_t other = random_.below(n); share_[other] > share_[which]) which = other;
    } else if (whom < 0.8) {
      for (int i = 0; i < 5; ++i)
        if (const std::size_t other = random_.below(n); share_[other] < share_[which]) which = other;
    }
    std::vector<Point> free = holes(wires, 6);
    std::size_t rank = 0;
    while (rank + 1 < free.size() && random_.chance(0.5)) ++rank;
    if (!free.empty()) wires[which] = free[rank];
  } else if (kind < 0.9) {
    const Point middle = wires[random_.below(n)];
    const double reach = random_.uniform(1.2, 3.2) * full, far = random_.uniform(0.15, 0.6) * full;
    for (Point& p : wires)
      if (square_distance(p, middle) < reach * reach)
        p += Point{random_.uniform(-far, far), random_.uniform(-far, far)};
  } else {
    const double far = random_.uniform(0.05, 0.4) * full;
    for (Point& p : wires) p += Point{random_.uniform(-far, far), random_.uniform(-far, far)};
  }
  return wires;
}

std::optional<std::vector<Point>> PackingSearch::find(std::size_t count, std::span<const std::vector<Point>> likely,
                                                      std::uint64_t work, std::size_t tries) {
  if (count == 0) return std::vector<Point>{};
  if (pool_.empty()) return std::nullopt;
  const std::uint64_t end = energy_.work() + work;
  const std::size_t last = settled_ + tries;
  const auto goes_on = [&] {
    const double spent = 1 - static_cast<double>(end - std::min(end, energy_.work())) / static_cast<double>(work);
    const double tried = 1 - static_cast<double>(last - std::min(last, settled_)) / static_cast<double>(tries);
    progress_.reach(reach_ * std::max(spent, tried));
    return energy_.work() < end && settled_ < last;
  };
  std::vector<State> states;
  const auto keep = [&](State state) {
    states.push_back(std::move(state));
    std::stable_sort(states.begin(), states.end(), [](const State& a, const State& b) { return a.energy < b.energy; });
    if (states.size() > elite) states.pop_back();
  };
  for (const std::vector<Point>& hint : likely) {
    std::vector<Point> wires = hint;
    adjust(wires, count);
    State state = settled(std::move(wires), endless);
    if (state.allowed) return state.wires;
    keep(std::move(state));
  }
  // A third of the work is spent on starts, the rest on hops, in rounds, so that a bad first round can be corrected.
  std::uint64_t round = std::max<std::uint64_t>(work / 12, 1);
  while (goes_on()) {
    const std::uint64_t begin = energy_.work();
    std::size_t tried = 0;
    while ((energy_.work() < begin + round / 3 || tried < elite) && goes_on()) {
      State state = settled(start(count), states.size() < elite ? endless : states.back().energy);
      if (state.allowed) return state.wires;
      keep(std::move(state));
      ++tried;
    }
    while (energy_.work() < begin + round && !states.empty() && goes_on())
      for (State& state : states) {
        State next = settled(hop(state), state.energy);
        if (next.allowed) return next.wires;
        if (next.energy < state.energy) {
          next.idle = 0;
          state = std::move(next);
        } else {
          ++state.idle;
        }
      }
    // Layouts without an improvement for long are replaced by new starts.
    std::erase_if(states, [&](const State& s) { return s.idle > 30 + 2 * count; });
  }
  return std::nullopt;
}

void PackingSearch::fill(std::vector<Point>& wires) {
  if (pool_.empty()) return;
  for (;;) {
    bool added = false;
    for (const Point& p : holes(wires, 4)) {
      bool free = true;
      for (const Point& other : wires) free = free && distance(p, other) >= energy_.distance();
      if (free && usable_area_.holds(p)) {
        wires.push_back(p);
        added = true;
      }
    }
    if (!added) return;
  }
}

}  // namespace bahnwerk::winding
