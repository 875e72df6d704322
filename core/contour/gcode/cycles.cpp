// Canned cycles, as RS274NGC (3.5.16) has them: the moves that a line with G73, G81 … G89 stands for.
#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double chip_break = 0.254;     // mm: by which G73 draws back, and above the bottom where G83 feeds again
constexpr double max_repeats = 100'000;  // L
constexpr double max_pecks = 100'000;    // largest number of pecks of one hole

CycleAxes axes_of(Plane plane) {
  if (plane == Plane::xy) return {0, 1, 2};
  if (plane == Plane::zx) return {2, 0, 1};
  return {1, 2, 0};
}

Vec with(Vec v, std::size_t axis, double value) {
  v[axis] = value;
  return v;
}

}  // namespace

/// The words of the line and those of the lines before it, in mm.
std::optional<CycleHole> Interpreter::cycle_words(const Line& line) {
  const CycleAxes axes = axes_of(plane_);
  const char depth_letter = "XYZ"[axes.depth];
  takes(line, letters("XYZRL"));
  const auto keeps = [&](std::optional<CycleLevel>& level, char letter) {
    if (line.has(letter)) level = {line[letter] * unit_, absolute_};
  };
  keeps(cycle_.r, 'R');
  keeps(cycle_.depth, depth_letter);
  const bool pecks = cycle_.code == 73 || cycle_.code == 83;
  const bool dwells = cycle_.code == 82 || cycle_.code == 86 || cycle_.code == 89;
  if (pecks && takes(line, letters("Q"))) cycle_.peck = line['Q'] * unit_;
  if (dwells && (used_ & letters("P")) == 0 && takes(line, letters("P"))) cycle_.dwell = line['P'];
  if (pecks && (used_ & letters("P")) == 0 && takes(line, letters("P"))) peck_word(line);
  if (!cycle_.r) fault("a canned cycle needs the retract plane R");
  if (!cycle_.depth) fault(std::string("a canned cycle needs the depth ") + depth_letter);
  if (pecks && !(cycle_.peck && *cycle_.peck > 0)) fault("G73 and G83 need the peck Q, greater than zero");
  if (dwells && !cycle_.dwell) fault("G82, G86 and G89 need the dwell P");
  if (cycle_.dwell && !(*cycle_.dwell >= 0 && *cycle_.dwell <= longest_rest))
    fault("a dwell (P) lasts between 0 and 86400 s");
  const double repeats = line.has('L') ? line['L'] : 1;
  if (!(repeats >= 1 && repeats <= max_repeats && repeats == std::floor(repeats)))
    fault("the number of holes L must be a whole one from 1 to 100000");
  if (inverse_time_) fault("canned cycles have no inverse time feed (G93): program F per minute, with G94");
  if (!sound_) return std::nullopt;

  const Vec at = mover_.position(), origin = offsets_.origin();
  CycleHole hole{axes, at, {}, static_cast<std::size_t>(repeats), 0, 0, 0, 0};
  for (const std::size_t k : {axes.a, axes.b}) {
    const char letter = "XYZ"[k];
    if (!line.has(letter)) continue;
    moved_ |= letters({&letter, 1});
    if (absolute_)
      hole.at[k] = line[letter] * unit_ + origin[k];
    else
      hole.step[k] = line[letter] * unit_, hole.at[k] += hole.step[k];
  }
  moved_ |= letters({&depth_letter, 1});
  hole.r = cycle_.r->value + (cycle_.r->absolute ? origin : at)[axes.depth];
  hole.bottom = cycle_.depth->value + (cycle_.depth->absolute ? origin[axes.depth] : hole.r);
  hole.peck = cycle_.peck.value_or(0);
  if (!cycle_.start_level) cycle_.start_level = at[axes.depth];
  hole.clear = cycle_.back_to_start ? std::max(hole.r, *cycle_.start_level) : hole.r;
  if (hole.r < hole.bottom) {
    fault(std::string("the retract plane R lies below the depth ") + depth_letter);
    return std::nullopt;
  }
  if (pecks && !((hole.r - hole.bottom) / hole.peck <= max_pecks)) {
    fault("the peck Q is too small: more than 100000 for one hole");
    return std::nullopt;
  }
  if (!in_range(with(hole.at, axes.depth, hole.clear)) || !in_range(with(hole.at, axes.depth, hole.bottom)) ||
      !in_range(hole.at + static_cast<double>(hole.repeats) * hole.step))
    return std::nullopt;
  return hole;
}

/// P of G73 and G83: for LinuxCNC how far above the last depth the tool feeds again, for other controls a dwell at the
/// bottom. A clearance is less than the peck.
void Interpreter::peck_word(const Line& line) {
  cycle_.clearance.reset();
  cycle_.dwell.reset();
  const double value = line['P'];
  if (value == 0) return;
  if (value > 0 && cycle_.peck && value * unit_ < *cycle_.peck) {
    cycle_.clearance = value * unit_;
    note(key_peck, line,
         "P of a peck cycle (G73, G83) taken as LinuxCNC does: how far above the last depth the tool feeds again");
    return;
  }
  cycle_.dwell = value;
  note(
      key_peck, line,
      "P of a peck cycle (G73, G83) is no clearance, for it is not less than the peck: taken as a dwell at the bottom");
}

void Interpreter::cycle(const Line& line) {
  const auto given = cycle_words(line);
  if (!given) return;
  if (!fed_ && feed_lost_)
    return fault("no feed after G94: F of inverse time (G93) holds no longer, program F per minute");
  if (!fed_) note(key_no_feed, line, "a move other than G0 without F: only the axes limit its speed");
  CycleHole hole = *given;
  const std::size_t depth = hole.axes.depth;
  for (std::size_t i = 0; i < hole.repeats && mover_.builder().segments() <= options_.max_segments; ++i) {
    const Vec from = mover_.position();
    if (from[depth] < hole.r) rapid_to(with(from, depth, hole.r));
    rapid_to(with(hole.at, depth, mover_.position()[depth]));
    rapid_to(with(hole.at, depth, hole.r));
    drill(hole);
    if (i % 64 == 0) progress_.report("reading", 0);
    hole.at += hole.step;
  }
  if (cycle_.dwell) note(key_dwell, line, "");
}

void Interpreter::drill(const CycleHole& hole) {
  const std::size_t axis = hole.axes.depth;
  const Mode mode = spindle_ && output_ ? Mode::cut : Mode::position;
  const auto rapid = [&](double level) { rapid_to(with(hole.at, axis, level)); };
  const auto feed = [&](double level) {
    mover_.use(mode, feed_);
    mover_.line(with(hole.at, axis, level));
  };
  if (cycle_.code == 73 || cycle_.code == 83) {
    std::size_t pecks = 0;
    for (double level = hole.r - hole.peck; level > hole.bottom;
         level = hole.r - static_cast<double>(++pecks) * hole.peck - hole.peck) {
      if (mover_.builder().segments() > options_.max_segments) return;
      if (pecks % 1024 == 1023) progress_.report("reading", 0);
      feed(level);
      if (cycle_.code == 83) rapid(hole.r);
      rapid(std::min(hole.r, level + cycle_.clearance.value_or(chip_break)));
    }
  }
  feed(hole.bottom);
  if (cycle_.dwell) rest_here(*cycle_.dwell);
  if (cycle_.code == 85 || cycle_.code == 89) return feed(hole.clear);
  rapid(hole.clear);
}

}  // namespace bahnwerk::gcode
