#include "core/redundant/head/head_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/redundant/coarse/coarse_task.hpp"
#include "core/redundant/head/section_law.hpp"

namespace bahnwerk {
namespace {

constexpr double coarse_share =
    1 - 1e-5;  // used share of the coarse axes' limits; the rest exceeds the reduction of their boxes

Machine shared(Machine machine, double share) {
  for (AxisLimits& axis : machine.axes) axis.scale(share);
  return machine;
}

Machine with_reserve(Machine head, const CoarseFineMachine& machine, const HeadReserve& reserve) {
  for (std::size_t k = 0; k < head.axes.size(); ++k) {
    if (!(machine.axes[k].stroke > 0)) continue;  // no fine axis, which could leave the coarse one more
    const auto lower = [&](double& value, double without) {
      value += reserve.unused_share * (std::min(value, without) - value);
    };
    lower(head.axes[k].acceleration, machine.axes[k].fine.acceleration);
    head.axes[k].acceleration *= reserve.acceleration_share;
    lower(head.axes[k].velocity, machine.axes[k].coarse.velocity);
  }
  return head;
}

/// Returns the index behind the last piece of the section that begins with piece `begin`.
std::size_t end_of_section(const TimeLaw& law, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < law.pieces().size() && law.pieces()[end].v > 0) ++end;
  return end;
}

}  // namespace

template <std::size_t order>
HeadPlan<order>::HeadPlan(const JointTask& task, double corner_angle, double share, Progress progress,
                          const HeadReserve& reserve)
    : task_(task),
      corner_angle_(corner_angle),
      progress_(progress),
      limits_(with_reserve(shared(head_limits(task.machine), share), task.machine, reserve)),
      section_limits_{task.feeds, {}},
      base_(planned(limits_, task.feeds, task.rests)) {
  for (std::size_t i = 0; i < base_.pieces().size();) {
    const std::size_t end = end_of_section(base_, i), segment = base_.pieces()[i].segment;
    sections_.push_back(segment);
    if (const auto move = straight_move(*task.path, task.machine, limits_, task.feeds[segment], segment,
                                        base_.pieces()[end - 1].segment + 1))
      section_limits_.straight.insert({segment, {*move, move->fastest}});
    i = end;
  }
  sections_.push_back(task.path->size());
}

template <std::size_t order>
std::size_t HeadPlan<order>::section_begin(std::size_t segment) const {
  return *(std::upper_bound(sections_.begin(), sections_.end() - 1, segment) - 1);
}

template <std::size_t order>
std::size_t HeadPlan<order>::section_end(std::size_t segment) const {
  return *std::upper_bound(sections_.begin(), sections_.end() - 1, segment);
}

template <std::size_t order>
TimeLaw HeadPlan<order>::planned(const PathTask& path) const {
  if constexpr (order == 2) {
    AccelerationLimitedOptions o;
    o.corner_angle = corner_angle_;
    return plan_acceleration_limited(path, o, progress_).law;
  } else {
    JerkLimitedOptions o;
    o.corner_angle = corner_angle_;
    return plan_jerk_limited(path, o, progress_).law;
  }
}

template <std::size_t order>
TimeLaw HeadPlan<order>::planned(const Machine& limits, const std::vector<double>& feeds,
                                 const std::vector<bool>& rests) const {
  return planned({*task_.path, limits, feeds, rests, task_.dwells});
}

template <std::size_t order>
const TimeLaw* HeadPlan<order>::slower_law(std::size_t first, std::size_t last) {
  const auto begin = section_limits_.feeds.begin() + static_cast<std::ptrdiff_t>(first),
             end = section_limits_.feeds.begin() + static_cast<std::ptrdiff_t>(last);
  const auto gentle = section_limits_.acceleration_share.find(first);
  const double share = gentle == section_limits_.acceleration_share.end() ? 1 : gentle->second;
  if (share == 1 && std::equal(begin, end, task_.feeds.begin() + static_cast<std::ptrdiff_t>(first))) return nullptr;
  SlowerLaw& slower = slower_[first];
  if (slower.share != share || !std::equal(begin, end, slower.feeds.begin(), slower.feeds.end())) {
    Machine limits = limits_;
    for (AxisLimits& axis : limits.axes) axis.acceleration *= share;
    slower.law = section_law(*task_.path, first, last, limits, section_limits_.feeds,
                             [&](const PathTask& task) { return planned(task); });
    slower.feeds.assign(begin, end);
    slower.share = share;
  }
  return &slower.law;
}

template <std::size_t order>
double HeadPlan<order>::peak(std::size_t first, std::size_t last) const {
  const auto& pieces = base_.pieces();
  double speed = 0;
  for (auto p = std::lower_bound(pieces.begin(), pieces.end(), first,
                                 [](const LawPiece&piece, std::size_t s) { return piece.segment < s; });
       p != pieces.end() && p->segment < last; ++p)
    speed = std::max({speed, p->v, p->at(p->duration).v});
  return speed;
}

template <std::size_t order>
std::shared_ptr<const PathMotion> HeadPlan<order>::smoother_head(double share, const HeadReserve& reserve) const {
  HeadPlan other(task_, corner_angle_, share, progress_, reserve);
  other.section_limits_.feeds = section_limits_.feeds;
  other.section_limits_.acceleration_share = section_limits_.acceleration_share;
  if (reserve.acceleration_share < 1) {
    const double most = reserve.acceleration_share * other.peak(0, task_.path->size());
    for (double& feed : other.section_limits_.feeds) feed = std::min(feed, most);
    for (auto& [segment, straight] : other.section_limits_.straight)
      if (straight.pace.feed > most) straight.pace.feed = most, straight.slowed = true;
  }
  double stroke = 0;
  for (const CoarseFineAxis& axis : task_.machine.axes) stroke = std::max(stroke, axis.stroke);
  const double slower = 1 / reserve.longer;
  for (const auto& [segment, straight] : section_limits_.straight) {
    const auto at = other.section_limits_.straight.find(segment);
    if (at == other.section_limits_.straight.end()) continue;
    const bool slows = slower < 1 && straight.move.length > 2 * stroke;
    if (!straight.slowed && !slows) continue;
    Pace& pace = at->second.pace;
    pace = {std::min(pace.feed, straight.pace.feed), std::min(pace.rise, straight.pace.rise),
            std::min(pace.fall, straight.pace.fall)};
    if (slows) {  // from the speed that it really reaches
      const double peak = std::sqrt(2 * straight.move.length / (1 / pace.rise + 1 / pace.fall));
      pace = {std::min(pace.feed, peak) * slower, pace.rise * slower * slower, pace.fall * slower * slower};
    }
    at->second.slowed = true;
  }
  return other.motion();
}

template <std::size_t order>
std::size_t HeadPlan<order>::slowed() const {
  std::size_t count = 0;
  std::size_t gentle_end = 0;
  for (std::size_t i = 0; i < task_.feeds.size(); ++i) {
    if (const auto at = section_limits_.acceleration_share.find(i);
        at != section_limits_.acceleration_share.end() && at->second < 1)
      gentle_end = section_end(i);
    count += i < gentle_end || section_limits_.feeds[i] < task_.feeds[i];
  }
  for (const auto& [segment, s] : section_limits_.straight) count += s.slowed;
  return count;
}

template <std::size_t order>
std::shared_ptr<const PathMotion> HeadPlan<order>::motion(std::size_t first, std::size_t last) {
  const auto& pieces = base_.pieces();
  const auto piece_of = [&](std::size_t segment) {
    const auto at = std::lower_bound(pieces.begin(), pieces.end(), segment,
                                     [](const LawPiece& p, std::size_t s) { return p.segment < s; });
    return static_cast<std::size_t>(at - pieces.begin());
  };
  const std::size_t behind = piece_of(last);
  TimeLaw law;
  law.reserve(behind - piece_of(first) + 8);
  for (std::size_t i = piece_of(first); i < behind;) {
    const std::size_t end = end_of_section(base_, i);
    const auto at = section_limits_.straight.find(pieces[i].segment);
    if (at != section_limits_.straight.end() && at->second.slowed)
      append_move(law, at->second.move, at->second.pace);
    else if (const TimeLaw* slower = slower_law(pieces[i].segment, pieces[end - 1].segment + 1))
      for (const LawPiece& piece : slower->pieces()) law.append(piece);
    else
      for (std::size_t k = i; k < end; ++k) law.append(pieces[k]);
    i = end;
  }
  const auto dwell = [&](std::size_t segment) {
    return std::lower_bound(task_.dwells.begin(), task_.dwells.end(), segment,
                            [](const Rest& r, std::size_t s) { return r.segment < s; });
  };
  const bool all = last >= task_.path->size();
  const PathTask path{*task_.path, limits_, {}, {}, {dwell(first), all ? task_.dwells.end() : dwell(last)}};
  law = with_dwells(std::move(law), path, progress_);
  if (!all) law.append(pieces[behind]);
  return std::make_shared<const PathMotion>(task_.path, std::move(law));
}

template <std::size_t order>
std::shared_ptr<const PathMotion> HeadPlan<order>::coarse_alone() const {
  Machine coarse = coarse_machine(task_.machine, coarse_share);
  for (std::size_t k = 0; k < coarse.axes.size(); ++k)
    coarse.axes[k].jerk = std::min(coarse.axes[k].jerk, limits_.axes[k].jerk);  // what cells take the head to hold
  const PathTask path{*task_.path, coarse, {}, task_.rests, task_.dwells};
  return std::make_shared<const PathMotion>(task_.path,
                                            with_dwells(planned(coarse, task_.feeds, task_.rests), path, progress_));
}

template class HeadPlan<2>;
template class HeadPlan<3>;

}  // namespace bahnwerk
