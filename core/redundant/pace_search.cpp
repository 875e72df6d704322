#include "core/redundant/pace_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/redundant/following.hpp"

namespace bahnwerk {
namespace {

// Room that is left in all boxes, in the chain's units: the solution of the chain needs some.
constexpr std::array<double, 3> rooms{3e-4, 3e-5, 0};
constexpr int levels = 4;        // of acceleration and of braking, from both axes' to the coarse one's
constexpr double finest = 1.1;   // quotient of accelerations at which the search ends
constexpr double worth = 1e-3;   // of a duration, below which a pace counts as no quicker
constexpr double closed = 5e-4;  // bisection of a duration
constexpr int max_sweeps = 3;
constexpr double enough = 2e-4;   // of the stretch's duration, gained by a sweep
constexpr std::size_t reach = 4;  // sections between the two of an exchange, at most
constexpr double shift = 1.04;    // of the duration of a move, in an exchange

/// Duration of a straight move of length L that accelerates and brakes with 1/a + 1/b = s and cruises at w.
double duration_of(double length, double s, double w) { return 0.5 * w * s + length / w; }
double duration_of(const StraightMove& move, const Pace& pace) {
  const double s = 1 / pace.rise + 1 / pace.fall;
  return duration_of(move.length, s, std::min({pace.feed, move.fastest.feed, std::sqrt(2 * move.length / s)}));
}
/// The cruising speed for a duration; the highest where that is below the least, √(2 s L).
double cruise_of(double length, double s, double duration) {
  const double least = std::sqrt(2 * s * length), t = std::max(duration, least);
  return (t - std::sqrt((t - least) * (t + least))) / s;
}

}  // namespace

PaceSearch::PaceSearch(HeadPlan<2>& plan, const CoarseFineMachine& machine, const HeadCellOptions& cells,
                       ProgressScope& scope, std::size_t first, std::size_t last)
    : plan_(plan), machine_(machine), cell_options_(cells), scope_(scope), first_(first), last_(last) {}

PaceSearch::Timed PaceSearch::timed(std::size_t first, std::size_t last) {
  scope_.report();
  Timed t{first, last, 0, {}};
  const auto head = plan_.motion(first, last);
  const bool all = last == head->path().size();
  const HeadCells cells = head_cells(*head, 0, head->pieces() - (all ? 0 : 1), cell_options_, scope_);
  t.duration = cells.times.back();
  for (std::size_t k = 0; k < machine_.axes.size(); ++k) {
    Chain<2> chain = following<2>(cells, k, machine_.axes[k]);
    chain.begins_at_rest = first == 0;
    chain.ends_at_rest = all;
    for (auto& boxes : chain.states)
      for (Range& r : boxes) {
        const double by = std::min(room_, 0.25 * std::max(r.width(), 0.0));
        r.lowest += by, r.highest -= by;
      }
    t.chains.push_back(std::move(chain));
  }
  return t;
}

void PaceSearch::carry_forward(std::size_t from) {
  for (std::size_t i = from; i < sections_.size(); ++i)
    for (std::size_t k = 0; k < machine_.axes.size(); ++k) {
      const Chain<2>& chain = sections_[i].chains[k];
      FollowableStates states = forward_[i][k];
      if (i > 0) states.limit(chain.states.front());
      forward_[i + 1][k] = followed_forward(std::move(states), chain, 0, chain.cells());
    }
}

void PaceSearch::carry_backward(std::size_t from) {
  for (std::size_t i = from; i-- > 0;)
    for (std::size_t k = 0; k < machine_.axes.size(); ++k) {
      const Chain<2>& chain = sections_[i].chains[k];
      FollowableStates states = backward_[i + 1][k];
      if (i + 1 < sections_.size()) states.limit(chain.states.back());
      backward_[i][k] = followed_backward(std::move(states), chain, 0, chain.cells());
    }
}

bool PaceSearch::possible(std::size_t section, const Timed& timed) const {
  for (std::size_t k = 0; k < machine_.axes.size(); ++k) {
    const Chain<2>& chain = timed.chains[k];
    const std::size_t n = chain.cells(), middle = n / 2;
    FollowableStates from = forward_[section][k], to = backward_[section + 1][k];
    if (section > 0) from.limit(chain.states.front());
    if (section + 1 < sections_.size()) to.limit(chain.states.back());
    from = followed_forward(std::move(from), chain, 0, middle);
    if (from.empty()) return false;
    to = followed_backward(std::move(to), chain, middle, n);
    if (!from.meets(to)) return false;
  }
  return true;
}

bool PaceSearch::set_room(double room) {
  room_ = room;
  sections_.clear();
  for (std::size_t i = first_; i < last_;) {
    const std::size_t end = plan_.section_end(i);
    sections_.push_back(timed(i, end));
    i = end;
  }
  const std::size_t n = sections_.size(), axes = machine_.axes.size();
  forward_.assign(n + 1, std::vector<FollowableStates>(axes));
  backward_ = forward_;
  for (std::size_t k = 0; k < axes; ++k) {
    const Chain<2>&head = sections_.front().chains[k], &tail = sections_.back().chains[k];
    forward_[0][k] = FollowableStates::at_node(head.states.front(), head.begins_at_rest);
    backward_[n][k] = FollowableStates::at_node(tail.states.back(), tail.ends_at_rest);
  }
  carry_forward(0);
  carry_backward(n);
  return possible(n / 2, sections_[n / 2]);
}

Paces::Straight* PaceSearch::straight(std::size_t section) {
  const auto at = plan_.paces().straight.find(sections_[section].first);
  return at == plan_.paces().straight.end() ? nullptr : &at->second;
}

PaceSearch::Speeds PaceSearch::speeds(std::size_t section) {
  Speeds s;
  if (const Paces::Straight* move = straight(section)) s.pace = move->pace, s.slowed = move->slowed;
  const auto& feeds = plan_.paces().feeds;
  s.feeds.assign(feeds.begin() + static_cast<std::ptrdiff_t>(sections_[section].first),
                 feeds.begin() + static_cast<std::ptrdiff_t>(sections_[section].last));
  return s;
}

void PaceSearch::restore(std::size_t section, const Speeds& speeds) {
  if (Paces::Straight* move = straight(section)) move->pace = speeds.pace, move->slowed = speeds.slowed;
  std::copy(speeds.feeds.begin(), speeds.feeds.end(),
            plan_.paces().feeds.begin() + static_cast<std::ptrdiff_t>(sections_[section].first));
}

bool PaceSearch::slowed(std::size_t section) {
  if (const Paces::Straight* move = straight(section)) return move->slowed;
  for (std::size_t i = sections_[section].first; i < sections_[section].last; ++i)
    if (plan_.paces().feeds[i] < plan_.feed(i)) return true;
  return false;
}

bool PaceSearch::quickest_move(std::size_t section, double limit) {
  Paces::Straight& move = *straight(section);
  const StraightMove& m = move.move;
  const Speeds before = speeds(section);
  const double wait = std::max(sections_[section].duration - duration_of(m, before.pace), 0.0);  // a dwell
  Speeds best = before;
  Timed best_timed;
  bool found = false;
  const auto tried = [&](double rise, double fall, double duration) {
    const double s = 1 / rise + 1 / fall;
    move.pace = {std::min(cruise_of(m.length, s, duration - wait), m.fastest.feed), rise, fall};
    move.slowed = true;
    Timed now = timed(sections_[section].first, sections_[section].last);
    if (!(now.duration < limit) || !possible(section, now)) return false;
    limit = now.duration;
    best = speeds(section);
    best_timed = std::move(now);
    return found = true;
  };
  const auto searched = [&](double rise, double fall) {
    rise = std::min(rise, m.fastest.rise), fall = std::min(fall, m.fastest.fall);
    double least = wait + duration_of(m, {m.fastest.feed, rise, fall});
    if (!(least < limit * (1 - worth))) return;
    if (!tried(rise, fall, limit * (1 - worth))) return;
    while (limit - least > closed * limit) {
      const double middle = 0.5 * (least + limit);
      if (!tried(rise, fall, middle)) least = middle;
    }
  };
  if (before.slowed && tried(m.fastest.rise, m.fastest.fall, 0)) {
    sections_[section] = std::move(best_timed);
    return true;
  }
  if (before.slowed) searched(before.pace.rise, before.pace.fall);
  const double rises = m.fastest.rise / m.slowest.rise, falls = m.fastest.fall / m.slowest.fall;
  for (int i = 0; i < levels; ++i)
    for (int j = 0; j < levels; ++j)
      searched(m.fastest.rise * std::pow(rises, -i / (levels - 1.0)),
               m.fastest.fall * std::pow(falls, -j / (levels - 1.0)));
  for (double q = std::sqrt(std::pow(std::max(rises, falls), 1 / (levels - 1.0))); found && q > finest;
       q = std::sqrt(q)) {
    const Pace centre = best.pace;
    for (const double r : {1.0, q, 1 / q})
      for (const double f : {1.0, q, 1 / q})
        if (r != 1 || f != 1) searched(centre.rise * r, centre.fall * f);
  }
  restore(section, best);
  if (found) sections_[section] = std::move(best_timed);
  return found;
}

bool PaceSearch::quicker_cut(std::size_t section) {
  const Timed& old = sections_[section];
  const std::size_t first = old.first, last = old.last;
  std::vector<double>& feeds = plan_.paces().feeds;
  const Speeds before = speeds(section);
  double low = 0, high = 0;
  for (std::size_t i = first; i < last; ++i) {
    if (!(feeds[i] < unlimited)) return false;
    low = std::max(low, feeds[i]);
  }
  high = std::max(low, plan_.peak(first, last));
  Speeds best = before;
  Timed best_timed;
  bool found = false;
  const auto tried = [&](double cap) {
    for (std::size_t i = first; i < last; ++i)
      feeds[i] = std::max(before.feeds[i - first], std::min(plan_.feed(i), cap));
    Timed now = timed(first, last);
    if (!possible(section, now)) return false;
    if (!(now.duration < sections_[section].duration)) return false;
    best = speeds(section);
    best_timed = std::move(now);
    return found = true;
  };
  if (!tried(unlimited))
    for (int i = 0; i < 5; ++i) {
      const double middle = std::sqrt(low * high);
      (tried(middle) ? low : high) = middle;
    }
  restore(section, best);
  if (found) sections_[section] = std::move(best_timed);
  return found;
}

bool PaceSearch::sweep() {
  bool found = false;
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    if (slowed(i)) {
      const bool quicker = straight(i) ? quickest_move(i, sections_[i].duration) : quicker_cut(i);
      found = found || quicker;
    }
    for (std::size_t k = 0; k < machine_.axes.size(); ++k) {
      const Chain<2>& chain = sections_[i].chains[k];
      FollowableStates states = forward_[i][k];
      if (i > 0) states.limit(chain.states.front());
      forward_[i + 1][k] = followed_forward(std::move(states), chain, 0, chain.cells());
    }
  }
  if (found) carry_backward(sections_.size());
  return found;
}

bool PaceSearch::exchange(std::size_t section, const Speeds& before, std::size_t move) {
  const Timed old = sections_[section];
  sections_[section] = timed(old.first, old.last);
  const std::size_t low = std::min(section, move), high = std::max(section, move);
  const auto carry = [&] {
    carry_forward(low);
    carry_backward(high + 1);
  };
  carry();
  const double gained = old.duration - sections_[section].duration, limit = sections_[move].duration + gained;
  if (limit > 0 && quickest_move(move, limit * (1 - worth))) {
    carry();
    return true;
  }
  restore(section, before);
  sections_[section] = old;
  carry();
  return false;
}

bool PaceSearch::exchanges() {
  bool found = false;
  const std::size_t n = sections_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i > reach ? i - reach : 0; j < std::min(n, i + reach + 1); ++j) {
      if (j == i || !straight(j) || !slowed(i)) continue;
      const Speeds before = speeds(i);
      if (Paces::Straight* move = straight(i)) {
        if (!slowed(j)) continue;
        const StraightMove& m = move->move;
        for (const double by : {shift, 1 / shift}) {
          const double s = 1 / move->pace.rise + 1 / move->pace.fall, duration = duration_of(m, move->pace) * by;
          if (duration * duration < 2 * s * m.length) continue;
          move->pace.feed = std::min(cruise_of(m.length, s, duration), m.fastest.feed);
          if (exchange(i, before, j)) {
            found = true;
            break;
          }
        }
      } else {
        for (std::size_t k = sections_[i].first; k < sections_[i].last; ++k) plan_.paces().feeds[k] = plan_.feed(k);
        found = exchange(i, before, j) || found;
      }
    }
  }
  return found;
}

double PaceSearch::total() const {
  double sum = 0;
  for (const Timed& t : sections_) sum += t.duration;
  return sum;
}

bool PaceSearch::run() {
  if (std::none_of(rooms.begin(), rooms.end(), [&](double room) { return set_room(room); })) return false;
  for (int i = 0; i < max_sweeps; ++i) {
    const double before = total();
    const bool swept = sweep();
    if (!exchanges() && !swept) break;
    if (total() > before * (1 - enough)) break;
  }
  return true;
}

}  // namespace bahnwerk
