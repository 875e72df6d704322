#pragma once
/// The rows of the relaxation (relaxation.hpp): what node values and peaks of every law satisfy.
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/cam/optimal/relaxation/known_law.hpp"
#include "core/cam/optimal/relaxation/relaxation_grid.hpp"
#include "core/cam/optimal/task/law_task.hpp"
#include "core/numeric/interior_point/bordered_band.hpp"

namespace bahnwerk::cam {

/// Variables are position, velocity and acceleration at every node, and one peak per order that counts. All are in
/// parts of the known law's peaks, J in parts of its J.
class RelaxationProgram {
 public:
  /// `ranges` are ascending as tighten() leaves them; task and ranges outlive the program.
  RelaxationProgram(const LawTask& task, const std::vector<Range>& ranges, const KnownLaw& law, std::size_t cells);

  BorderedBand& band() { return band_; }
  const RelaxationGrid& grid() const { return grid_; }
  /// Returns the variable of s^(order) at a node; that of order 0 is the first of three.
  static std::size_t variable(std::size_t node, int order) { return 3 * node + static_cast<std::size_t>(order); }
  bool counted(std::size_t order) const { return counted_[order]; }
  std::size_t peak_variable(std::size_t group, std::size_t order) const {
    return band_.border_index(border_[group][order]);
  }
  /// Returns the variable of the largest peak that any group may have, where there are several.
  std::optional<std::size_t> any_peak_variable(std::size_t order) const {
    return any_[order] == BorderedRow::none ? std::nullopt : std::optional(band_.border_index(any_[order]));
  }
  double peak_unit(std::size_t order) const { return unit_[order]; }       ///< unit of the peak of an order
  double node_unit(std::size_t order) const { return node_unit_[order]; }  ///< unit of a node's value of an order
  double objective_unit() const { return scale_; }

 private:
  /// |s^(r)| ≤ known + elastic · peak of order `order`, in the task's units.
  struct Reach {
    int order;
    double known, elastic;
  };
  void add_nodes();
  void pin(std::size_t node, int order, double value);
  bool join_constant_sections(std::size_t node);
  void add_floors();
  void add_points();
  Reach reach_of(std::size_t point, int order) const;
  void add_cells();
  /// Makes variable a be b + more.
  void equal(std::size_t a, std::size_t b, bool far, double more = 0);
  /// `elastic` is the shared variable of a peak or none.
  void row(std::size_t first, std::span<const double> weights, Range range, std::size_t elastic, double elastic_weight);
  /// Returns the shared variable of a section's peak. LawTask::none: that of any section.
  std::size_t peak_border(std::size_t section, int order) const;

  const LawTask& task_;
  const std::vector<Range>& ranges_;
  const RelaxationGrid grid_;
  BorderedBand band_;
  std::array<bool, limited_orders> counted_{};
  std::array<double, limited_orders> unit_{};
  std::vector<std::array<std::size_t, limited_orders>> border_;  // shared variables of peaks by group and order
  std::array<std::size_t, limited_orders> any_{};  // the sum of an order's peaks, where there are several groups
  double node_unit_[3];
  double scale_ = 0;
  std::vector<bool> pinned_;  // whether each variable is pinned to 0
};

}  // namespace bahnwerk::cam
