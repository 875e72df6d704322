#pragma once
/// Result of a method for motion laws: the law, its value, the conversions of ranges, and bounds of what any law can
/// reach.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/cam/cam_law.hpp"

namespace bahnwerk::cam {

/// A range became a value.
struct Conversion {
  std::size_t point = 0;
  int order = 0;
  double value = 0;  ///< the end of the range that holds, unit/s^order
  bool at_maximum = false;
  bool operator==(const Conversion&) const = default;
};

/// Ranges that became values, in this order, and J of the law afterwards.
struct ConversionOrder {
  std::vector<Conversion> conversions;
  double objective = 0;
};

/// Lower bound of J: no law under the same values, ranges, continuity and section limits, of whatever degree and with
/// whatever angles in their ranges, has a smaller one.
struct LawBound {
  double objective = 0;
  std::string basis;
};

/// Lower bound of the cycle's duration within a drive's limits, over all laws.
struct CycleBound {
  double duration = 0;  ///< s
  std::string basis;
};

struct LawSolution {
  CamLaw law;
  std::vector<double> at;  ///< chosen angles, one per point, master's unit
  LawValue value;
  double cycle_duration = 0;            ///< s
  std::vector<Conversion> conversions;  ///< `active_set`, in the order in which they happened
  /// `active_set` in the source's order of conversion, where another one (`conversions`) gave less.
  std::optional<ConversionOrder> source_order;
  std::vector<int> degrees;         ///< one per section
  std::size_t distributions = 0;    ///< balanced distributions of degrees that were compared for `conversions`
  std::optional<double> condition;  ///< `active_set`: condition number (2-norm) of the scaled linear system
  std::size_t systems = 0;          ///< number of linear systems or programs solved
  /// `optimal`: J of the dual at the same degree, pieces and angles, ≤ value.objective.
  std::optional<double> lower;
  std::optional<LawBound> bound;
  std::optional<CycleBound> cycle_bound;  ///< `optimal` with a drive
  std::vector<std::string> notes;         ///< sentences for the user
};

}  // namespace bahnwerk::cam
