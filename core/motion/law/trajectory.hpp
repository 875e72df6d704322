#pragma once
/// A path, a law and a machine: the state of every axis at any time, and the series of setpoints.
#include <memory>

#include "core/base/setpoint_source.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// State of the tool head: position mm, velocity mm/s, acceleration mm/s², jerk mm/s³; and of the path.
struct State {
  Vec position, velocity, acceleration, jerk;
  LawState path;
};

/// Immutable and thread-safe once made. sample() costs a binary search and one path evaluation; a good hint saves the
/// search.
class Trajectory {
 public:
  Trajectory(std::shared_ptr<const Contour> contour, TimeLaw law)
      : contour_(std::move(contour)), law_(std::move(law)) {}
  const Contour& contour() const { return *contour_; }
  const TimeLaw& law() const { return law_; }
  double duration() const { return law_.duration(); }
  /// State just after t (right limits); `piece` is the hint and is updated.
  State sample(double t, std::size_t& piece) const;

 private:
  std::shared_ptr<const Contour> contour_;
  TimeLaw law_;
};

/// How many cycles a motion of `duration` takes and by what factor (≥ 1) it is slowed to end exactly on the last one.
struct Cycles {
  std::size_t count = 0;  ///< setpoints = count + 1
  double factor = 1;
};
Cycles whole_cycles(double duration, double cycle_time);

/// Columns x y [z] vx … ax … s v mode block, row k at k · cycle_time; the last row is at rest. `mode` is 1 in a block
/// that cuts, 0 in one that positions; `block` is the index of that block in the contour, from 0. Both come from the
/// times of the blocks, not from the place on the path; a row at the moment where two blocks meet belongs to the later
/// one, the last row to the last block that is not empty.
class CartesianSetpoints final : public SetpointSource {
 public:
  /// `trajectory` must already last a whole number of cycles. O(pieces + blocks).
  CartesianSetpoints(std::shared_ptr<const Trajectory> trajectory, const Machine& machine, std::size_t cycles);
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return cycles_ + 1; }
  double cycle_time() const override { return cycle_time_; }
  double duration() const override { return static_cast<double>(cycles_) * cycle_time_; }
  void read(std::size_t first, std::size_t rows, double* out) const override;

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  std::vector<Column> columns_;
  struct Label {
    double begin;  // s: from here to the next label's begin
    std::size_t block;
    bool cut;
  };
  std::vector<Label> labels_;  // of the blocks that are not empty, in order; one at least
  std::size_t cycles_;
  std::size_t dimension_;
  double cycle_time_;
};

}  // namespace bahnwerk
