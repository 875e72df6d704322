#include "core/redundant/head/section_timing_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/redundant/head/following.hpp"

namespace bahnwerk {
namespace {

// Margin left in all boxes, in the chain's units, because the solution of the chain needs some.
constexpr std::array<double, 3> rooms{3e-4, 3e-5, 0};
constexpr int levels = 4;           // levels of acceleration and of braking, from both axes' limits to the coarse one's
constexpr double finest = 1.1;      // quotient of accelerations at which the search ends
constexpr double worth = 1e-3;      // least relative gain of duration that counts
constexpr double closed = 5e-4;     // relative accuracy of the bisection of a duration
constexpr int cut_steps = 6;        // steps of the bisection of a feed
constexpr double cut_least = 0.3;   // least feed to try, relative to the peak speed
constexpr double share_step = 0.8;  // factor of accelerations of sections that are no straight moves
constexpr double least_share = 0.1, finest_share = 0.98;
constexpr std::size_t most_segments =
    12;  // largest number of segments of a section whose feeds are searched separately
constexpr int max_sweeps = 20;
constexpr double enough = 2e-5;   // relative gain below which no further sweep follows
constexpr std::size_t reach = 4;  // most sections between the two of an exchange
// Relative changes of a move's duration, and of its acceleration or braking, in an exchange.
constexpr std::array<double, 9> shifts{1.01, 1.04, 1.12, 1.3, 1 / 1.01, 1 / 1.04, 1 / 1.1, 1 / 1.2, 1 / 1.5};
constexpr std::array<double, 3> ends{0.9, 0.7, 0.4};

}  // namespace

SectionTimingSearch::SectionTimingSearch(HeadPlan<2>& plan, const CoarseFineMachine& machine,
                                         const HeadCellOptions& cells, ProgressScope& scope, std::size_t first,
                                         std::size_t last)
    : plan_(plan), machine_(machine), cell_options_(cells), scope_(scope), first_(first), last_(last) {
  for (std::size_t k = 0; k < machine.axes.size(); ++k)
    if (machine.axes[k].stroke > 0) split_.push_back(k);
}

SectionTimingSearch::Timed SectionTimingSearch::timed(std::size_t first, std::size_t last) {
  scope_.report();
  Timed t{first, last, 0, {}};
  const auto head = plan_.motion(first, last);
  const bool all = last == head->path().size();
  const HeadCells cells = head_cells(*head, 0, head->pieces() - (all ? 0 : 1), cell_options_, scope_);
  t.duration = cells.times.back();
  for (const std::size_t k : split_) {
    std::optional<Chain<2>> followed = following<2>(cells, k, machine_.axes[k]);
    if (!followed) {
      t.chains.clear();
      return t;
    }
    Chain<2>& chain = *followed;
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

void SectionTimingSearch::carry_forward(std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i)
    for (std::size_t k = 0; k < split_.size(); ++k) {
      const Chain<2>& chain = sections_[i].chains[k];
      ControllableSet states = forward_[i][k];
      if (i > 0) states.limit(chain.states.front());
      forward_[i + 1][k] = followed_forward(std::move(states), chain, 0, chain.cells());
    }
}

void SectionTimingSearch::carry_backward(std::size_t from, std::size_t to) {
  for (std::size_t i = to; i-- > from;)
    for (std::size_t k = 0; k < split_.size(); ++k) {
      const Chain<2>& chain = sections_[i].chains[k];
      ControllableSet states = backward_[i + 1][k];
      if (i + 1 < sections_.size()) states.limit(chain.states.back());
      backward_[i][k] = followed_backward(std::move(states), chain, 0, chain.cells());
    }
}

bool SectionTimingSearch::possible(std::size_t section, const Timed& timed) const {
  if (timed.chains.empty()) return false;
  for (std::size_t k = 0; k < split_.size(); ++k) {
    const Chain<2>& chain = timed.chains[k];
    const std::size_t n = chain.cells(), middle = n / 2;
    ControllableSet from = forward_[section][k], to = backward_[section + 1][k];
    if (section > 0) from.limit(chain.states.front());
    if (section + 1 < sections_.size()) to.limit(chain.states.back());
    from = followed_forward(std::move(from), chain, 0, middle);
    if (from.empty()) return false;
    to = followed_backward(std::move(to), chain, middle, n);
    if (!from.meets(to)) return false;
  }
  return true;
}

bool SectionTimingSearch::set_room(double room) {
  room_ = room;
  sections_.clear();
  for (std::size_t i = first_; i < last_;) {
    const std::size_t end = plan_.section_end(i);
    sections_.push_back(timed(i, end));
    if (sections_.back().chains.empty()) return false;
    i = end;
  }
  const std::size_t n = sections_.size(), axes = split_.size();
  forward_.assign(n + 1, std::vector<ControllableSet>(axes));
  backward_ = forward_;
  for (std::size_t k = 0; k < axes; ++k) {
    const Chain<2>&head = sections_.front().chains[k], &tail = sections_.back().chains[k];
    forward_[0][k] = ControllableSet::at_node(head.states.front(), head.begins_at_rest);
    backward_[n][k] = ControllableSet::at_node(tail.states.back(), tail.ends_at_rest);
  }
  carry_forward(0, n);
  carry_backward(0, n);
  return possible(n / 2, sections_[n / 2]);
}

SectionLimits::Straight* SectionTimingSearch::straight(std::size_t section) {
  const auto at = plan_.section_limits().straight.find(sections_[section].first);
  return at == plan_.section_limits().straight.end() ? nullptr : &at->second;
}

SectionTimingSearch::Speeds SectionTimingSearch::speeds(std::size_t section) {
  Speeds s;
  if (const SectionLimits::Straight* move = straight(section)) s.pace = move->pace, s.slowed = move->slowed;
  const auto& feeds = plan_.section_limits().feeds;
  if (const auto at = plan_.section_limits().acceleration_share.find(sections_[section].first);
      at != plan_.section_limits().acceleration_share.end())
    s.share = at->second;
  s.feeds.assign(feeds.begin() + static_cast<std::ptrdiff_t>(sections_[section].first),
                 feeds.begin() + static_cast<std::ptrdiff_t>(sections_[section].last));
  return s;
}

void SectionTimingSearch::restore(std::size_t section, const Speeds& speeds) {
  if (SectionLimits::Straight* move = straight(section)) move->pace = speeds.pace, move->slowed = speeds.slowed;
  std::copy(speeds.feeds.begin(), speeds.feeds.end(),
            plan_.section_limits().feeds.begin() + static_cast<std::ptrdiff_t>(sections_[section].first));
  if (speeds.share < 1)
    plan_.section_limits().acceleration_share[sections_[section].first] = speeds.share;
  else
    plan_.section_limits().acceleration_share.erase(sections_[section].first);
}

bool SectionTimingSearch::slowed(std::size_t section) {
  if (const SectionLimits::Straight* move = straight(section)) return move->slowed;
  for (std::size_t i = sections_[section].first; i < sections_[section].last; ++i)
    if (plan_.section_limits().feeds[i] < plan_.feed(i)) return true;
  return plan_.section_limits().acceleration_share.count(sections_[section].first) > 0;
}

bool SectionTimingSearch::quickest_move(std::size_t section, double limit) {
  SectionLimits::Straight& move = *straight(section);
  const StraightMove& m = move.move;
  const Speeds before = speeds(section);
  const double wait = std::max(sections_[section].duration - duration_of(m, before.pace), 0.0);  // a dwell
  Speeds best = before;
  Timed best_timed;
  bool found = false;
  const auto tried = [&](double rise, double fall, double duration) {
    move.pace = lasting(m, {0, rise, fall}, duration - wait);
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
  const auto graded = [&](int i, int j) {
    searched(m.fastest.rise * std::pow(rises, -i / (levels - 1.0)),
             m.fastest.fall * std::pow(falls, -j / (levels - 1.0)));
  };
  for (int i = 0; i < levels; ++i)
    for (int j = 0; j < levels; ++j) graded(i, j);
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

bool SectionTimingSearch::quicker_cut(std::size_t section) {
  const Timed& old = sections_[section];
  const std::size_t first = old.first, last = old.last;
  const Speeds before = speeds(section);
  double lowest = 0;
  for (const double feed : before.feeds) {
    if (!(feed < unlimited) && before.share == 1) return false;
    lowest = std::max(lowest, feed);
  }
  const double highest = plan_.peak(first, last);
  lowest = std::min(lowest, highest);
  Speeds best = before;
  Timed best_timed;
  double duration = old.duration;
  bool found = false;
  enum class Outcome { slower, impossible, better };
  const auto tried = [&](const Speeds& now) {
    restore(section, now);
    Timed t = timed(first, last);
    if (!(t.duration < duration)) return Outcome::slower;
    if (!possible(section, t)) return Outcome::impossible;
    duration = t.duration;
    best = now;
    best_timed = std::move(t);
    found = true;
    return Outcome::better;
  };
  const auto capped = [&](double cap, double share) {
    Speeds now{{}, false, before.feeds, share};
    for (std::size_t i = first; i < last; ++i)
      now.feeds[i - first] =
          std::max(share == before.share ? before.feeds[i - first] : 0.0, std::min(plan_.feed(i), cap));
    return tried(now);
  };
  // Search the highest feed for the whole section with these accelerations.
  const auto searched = [&](double share) {
    if (capped(unlimited, share) != Outcome::impossible) return;
    double low = share == before.share ? lowest : cut_least * highest, high = highest;
    for (int i = 0; i < cut_steps; ++i) {
      const double middle = std::sqrt(low * high);
      (capped(middle, share) == Outcome::impossible ? high : low) = middle;
    }
  };
  searched(before.share);
  double step = share_step;
  for (double share = 1; share > least_share; share *= step)
    if (share != before.share) searched(share);
  for (step = std::sqrt(step); found && step < finest_share; step = std::sqrt(step))
    for (const double share : {best.share * step, best.share / step})
      if (share <= 1) searched(share);
  // Search the feed of each segment.
  if (last - first > 1 && last - first <= most_segments)
    for (std::size_t i = 0; i < last - first; ++i) {
      if (!(best.feeds[i] < plan_.feed(first + i))) continue;
      Speeds now = best;
      now.feeds[i] = plan_.feed(first + i);
      if (tried(now) != Outcome::impossible) continue;
      double low = best.feeds[i], high = std::min(highest, plan_.feed(first + i));
      for (int k = 0; k < cut_steps && low < high; ++k) {
        now = best;
        now.feeds[i] = std::sqrt(low * high);
        (tried(now) == Outcome::impossible ? high : low) = now.feeds[i];
      }
    }
  restore(section, best);
  if (found) sections_[section] = std::move(best_timed);
  return found;
}

bool SectionTimingSearch::sweep() {
  bool found = false;
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    if (slowed(i)) {
      const bool quicker = straight(i) ? quickest_move(i, sections_[i].duration) : quicker_cut(i);
      found = found || quicker;
    }
    for (std::size_t k = 0; k < split_.size(); ++k) {
      const Chain<2>& chain = sections_[i].chains[k];
      ControllableSet states = forward_[i][k];
      if (i > 0) states.limit(chain.states.front());
      forward_[i + 1][k] = followed_forward(std::move(states), chain, 0, chain.cells());
    }
  }
  if (found) carry_backward(0, sections_.size());
  return found;
}

bool SectionTimingSearch::exchange(std::size_t section, const Speeds& before, std::size_t move) {
  const StraightMove& m = straight(move)->move;
  Timed changed = timed(sections_[section].first, sections_[section].last);
  const double limit = sections_[move].duration + sections_[section].duration - changed.duration;
  if (changed.chains.empty() || !(duration_of(m, m.fastest) < limit * (1 - worth))) {
    restore(section, before);
    return false;
  }
  std::swap(sections_[section], changed);
  // The move is constrained by the other section through the reachable set before it, or the controllable set behind
  // it.
  auto& states = section < move ? forward_ : backward_;
  const std::size_t low = section < move ? section + 1 : move + 1, high = section < move ? move + 1 : section + 1;
  std::vector<std::vector<ControllableSet>> kept(states.begin() + static_cast<std::ptrdiff_t>(low),
                                                 states.begin() + static_cast<std::ptrdiff_t>(high));
  section < move ? carry_forward(section, move) : carry_backward(move + 1, section + 1);
  if (quickest_move(move, limit * (1 - worth))) {
    carry_forward(std::min(section, move), sections_.size());
    carry_backward(0, std::max(section, move) + 1);
    return true;
  }
  restore(section, before);
  std::swap(sections_[section], changed);
  std::move(kept.begin(), kept.end(), states.begin() + static_cast<std::ptrdiff_t>(low));
  return false;
}

bool SectionTimingSearch::exchanges() {
  bool found = false;
  const std::size_t n = sections_.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i > reach ? i - reach : 0; j < std::min(n, i + reach + 1); ++j) {
      if (j == i || !straight(j)) continue;
      const bool from = slowed(i), to = slowed(j);
      if (!from && !(to && straight(i))) continue;
      found = (straight(i) ? exchange_moves(i, j, from, to) : exchange_cut(i, j)) || found;
    }
  return found;
}

bool SectionTimingSearch::exchange_cut(std::size_t section, std::size_t move) {
  const Speeds before = speeds(section);
  for (std::size_t k = sections_[section].first; k < sections_[section].last; ++k)
    plan_.section_limits().feeds[k] = plan_.feed(k);
  plan_.section_limits().acceleration_share.erase(sections_[section].first);
  return exchange(section, before, move);
}

bool SectionTimingSearch::exchange_moves(std::size_t section, std::size_t move, bool slowed, bool other_slowed) {
  SectionLimits::Straight& own = *straight(section);
  const StraightMove& m = own.move;
  const Speeds before = speeds(section);
  const auto changed = [&](const Pace& pace) {
    own.pace = {std::min(pace.feed, m.fastest.feed), std::min(pace.rise, m.fastest.rise),
                std::min(pace.fall, m.fastest.fall)};
    own.slowed = true;
    return exchange(section, before, move);
  };
  const Pace now = before.pace;
  for (const double by : shifts) {
    if (by > 1 ? !other_slowed : !slowed) continue;
    const double duration = duration_of(m, now) * by;
    if (duration < duration_of(m, {m.fastest.feed, now.rise, now.fall})) continue;
    if (changed(lasting(m, now, duration))) return true;
  }
  if (!other_slowed) return false;
  for (const double by : ends)
    for (const bool rise : {true, false})
      if (changed({now.feed, rise ? now.rise * by : now.rise, rise ? now.fall : now.fall * by})) return true;
  return false;
}

double SectionTimingSearch::total() const {
  double sum = 0;
  for (const Timed& t : sections_) sum += t.duration;
  return sum;
}

bool SectionTimingSearch::run() {
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
