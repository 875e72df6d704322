#pragma once
/// The limits that a motion has to keep, as data: name, unit, value, and the quantity of a row to which each applies.
#include <limits>
#include <string>
#include <vector>

#include "core/machine/machine.hpp"

namespace bahnwerk::api {

/// Least and largest permitted value; infinite where there is none.
struct Permitted {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool operator==(const Permitted&) const = default;
  bool none() const { return lowest == -highest && highest == std::numeric_limits<double>::infinity(); }
};

/// Values that are permitted where the key column is at least `from`, up to the next step.
struct LimitStep {
  double from = 0;
  Permitted permitted;
};

/// A limit of derivative `order` of a quantity: of "x" it is the column x, vx, ax, jx or sx; of "", what belongs to the
/// path, v, a or j. Where that column does not exist, it is the first or second difference of the next lower one.
struct DeclaredLimit {
  std::string name;  ///< such as "acceleration x"
  std::string unit;
  std::string of;
  int order = 0;
  Permitted permitted = {};
  std::string key = {};               ///< the column on whose value the limit depends; empty: it is the same everywhere
  std::vector<LimitStep> steps = {};  ///< ascending; before the first one nothing is limited
};

using DeclaredLimits = std::vector<DeclaredLimit>;

/// Appends the finite limits of derivatives 1 to 4 of all axes, by order, then by axis. Axes have the columns' units.
void declare_axes(DeclaredLimits& list, const Machine& machine);
/// Appends the finite ones of speed ("feed"), acceleration and jerk along the path.
void declare_path(DeclaredLimits& list, const Limits& along);
/// Appends largest speeds of the tool by the value of the column `block`, if any is finite.
void declare_feeds(DeclaredLimits& list, const std::vector<double>& feed_of_block);

}  // namespace bahnwerk::api
