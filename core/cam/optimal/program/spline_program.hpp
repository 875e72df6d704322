#pragma once
/// The least J = Σ w_r max |s^(r)| over splines of one degree with fixed angles: a semi-infinite linear program.
///
/// Variables are the coefficients of the sections (section_basis.hpp) and one peak per order. Values and continuity are
/// equalities, ranges at points are rows, peaks and section limits are rows at sample points that are exchanged: each
/// round adds the extrema of its law. The objective of a law is its true one (enclosures); the lower bound is that of
/// the dual of a program with some sample points, hence valid for all of them. Rounds end when both agree. Cost: linear
/// in the number of sections; some 5 to 8 rounds of 5 to 15 iterations.
///
/// Variables are scaled by coefficient_of_variable(): they are derivatives themselves.
///
/// A given section keeps its place among the variables, which are 0 there: its ends are conditions of its neighbours,
/// its peaks lower limits of the shared peaks.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/cam/optimal/program/law_basis.hpp"
#include "core/cam/optimal/task/law_task.hpp"
#include "core/numeric/interior_point/bordered_band.hpp"

namespace bahnwerk::cam {

inline constexpr int effort_order = max_degree + 1;  ///< the order of samples of LawTask::effort

/// A limit at a point of a section: the peak of an order, or the section's own limit.
struct LawSample {
  std::size_t section, piece;
  double v;  ///< parameter inside the piece, [0, 1]
  int order;
  bool limit;
};

struct SplineResult {
  bool feasible = false;                       ///< values and continuity do not contradict each other, limits hold
  bool converged = false;                      ///< objective and lower agree
  std::vector<double> breaks;                  ///< times at which sections begin, and the end; the task's units
  std::vector<double> coefficients;            ///< those of LawBasis
  double objective = 0;                        ///< J of the true peaks
  double lower = 0;                            ///< no spline of this degree, with these angles, has less
  std::array<double, limited_orders> peaks{};  ///< largest ones of the whole law
  std::vector<std::array<double, limited_orders>> group_peaks{};  ///< those of each group of sections
  double violation = 0;        ///< the largest one of section limits and ranges, in parts of the order's unit
  double limit_violation = 0;  ///< largest violation of section limits alone
  int rounds = 0, iterations = 0;
  std::vector<LawSample> samples;  ///< samples of the last round, a start for a neighbouring program
};

struct SplineOptions {
  double gap = 9e-10;  ///< (J − lower bound)/J; a basis that contains another is not worse by 1e-9
  double violation = 1e-10;
  int max_rounds = 25;
};

/// Point at which a joint program in coefficients and times is linearised.
struct JointReference {
  const std::vector<double>& coefficients;  ///< coefficients of the law at the program's times
  std::vector<double> radius;               ///< largest change of each point's time; 0: the time is fixed
};
struct JointStep {
  bool converged = false;
  std::vector<double> times;  ///< one per point
  double objective = 0;       ///< J that the linear model expects there
};

/// Why no law exists: conditions and limits that stand against each other.
struct LawConflict {
  bool values = false;                              ///< values and continuity alone contradict each other
  double violation = 0;                             ///< the least excess over ranges and limits, in the orders' units
  std::vector<std::size_t> conditions;              ///< numbers in LawTask::conditions
  std::vector<std::pair<std::size_t, int>> limits;  ///< numbers of sections, and orders or effort_order
};

class SplineProgram {
 public:
  /// `reference` outlives the program, which then serves joint_step() alone.
  SplineProgram(const LawTask& task, const LawBasis& basis, const std::vector<double>& times,
                const JointReference* reference = nullptr);
  /// Finds the least violation of ranges and limits, with Farkas' multipliers. If it is next to nothing, a law exists.
  LawConflict find_conflict(Progress progress);
  JointStep joint_step(const std::vector<LawSample>& samples, Progress progress);
  /// Finds the law with the least RMS value of s^(order) among those whose J is 1e-9 above that of `first` at most: a
  /// convex quadratic program. Returns `first` itself where none with less is found. The program serves this alone.
  SplineResult least_rms(int order, const SplineResult& first, Progress progress);
  SplineResult solve(const SplineOptions& options, Progress progress, const std::vector<LawSample>* samples = nullptr);

 private:
  void build_equalities();
  void add_squares(int order);
  double mean_square(int order) const;
  bool find_start();
  void add_rows();
  void initial_samples();
  void set_point(double mu);
  void center(double above);
  void add_floors();
  void set_peaks(const SplineResult& law, double factor);
  void settle_equalities();
  void settle_points();
  double row_weight() const;
  double settle_multipliers(const SplineResult& law);
  void find_contacts();
  void exchange();
  bool shared_begin(const LawSample& sample) const;
  bool pinned(const LawSample& sample) const;
  void evaluate(SplineResult& result, bool enclosed);
  double lower_bound(const SplineResult& law) const;
  std::array<double, limited_orders> differences(const SplineResult& law) const;
  double reach(std::size_t section, double speed) const;
  void law_weights(std::size_t section, std::size_t piece, double v, int order, std::vector<double>& out) const;
  double law_weights_from_end(std::size_t section, std::size_t piece, double v, int order,
                              std::vector<double>& out) const;
  bool known_at(bool end, std::size_t section, int order) const;
  double limit_weights(const LawSample& at, std::vector<double>& out) const;
  Range limit_of(std::size_t section, int order) const;
  double unit_of(int order) const { return order == effort_order ? 1 : unit_[static_cast<std::size_t>(order)]; }
  std::vector<double> derivative(std::size_t section, std::size_t piece, int order) const;
  std::vector<double> coefficients(const std::vector<double>& x) const;
  std::vector<double> variables(const std::vector<double>& coefficients) const;
  bool counted(int order) const { return task_.weight[static_cast<std::size_t>(order)] > 0; }

  void set_units(const SplineResult& law);
  void set_usual_units();
  void set_peak_costs(double factor);
  /// Returns the shared variable of a section's peak.
  std::size_t peak_border(std::size_t section, int order) const {
    return peak_border_[task_.groups.of_section[section]][static_cast<std::size_t>(order)];
  }
  double peak_unit(std::size_t section, int order) const {
    return peak_unit_[task_.groups.of_section[section]][static_cast<std::size_t>(order)];
  }
  /// Returns the weight in J, in parts of unit_objective_, of a group's peak, which is in parts of peak_unit_.
  double peak_cost(std::size_t group, std::size_t order) const {
    return task_.groups.weight[group] * task_.weight[order] * peak_unit_[group][order] / unit_objective_;
  }
  void set_row(std::size_t section, const std::vector<double>& weights, BorderedRow& row) const;
  /// Adds to `out` how a value Σ weights · variables of an order changes with the times of the section's ends where the
  /// law is stretched.
  void add_time_terms(std::size_t section, const std::vector<double>& weights, int order, double factor,
                      std::vector<BorderedRow::Term>& out) const;

  double objective_limit_ = BorderedRow::unlimited;  // largest J of least_rms, in parts of unit_objective_
  std::size_t give_ = BorderedRow::none;             // shared variable of find_conflict: the excess of all rows
  std::vector<std::size_t> equality_condition_;      // condition of each equality, or none
  std::vector<std::vector<std::size_t>> left_out_;   // by equality: sections whose begin's numbers were left out
  const LawTask& task_;
  const LawBasis& basis_;
  const JointReference* reference_;
  std::vector<double> reference_x_;  // the reference in variables
  std::vector<double> times_;
  /// Numbers that points ask for at the begin and at the end of sections, by order.
  using Numbers = std::array<std::optional<double>, SectionBasis::states>;
  std::vector<Numbers> begin_values_, end_values_;
  std::vector<std::size_t> time_border_;  // shared variable of each point's time
  std::vector<double> breaks_, lengths_;
  BorderedBand band_;
  InteriorPoint point_;
  std::vector<double> start_multipliers_;
  std::vector<double> start_;                                         // x of the first law, its peaks
  std::array<double, limited_orders> unit_{};                         // units of the limits
  std::vector<std::array<double, limited_orders>> peak_unit_;         // units of the peaks by group and order
  std::vector<std::array<std::size_t, limited_orders>> peak_border_;  // shared variables by group and order
  double unit_objective_ = 1;
  struct Sampled {
    LawSample sample;
    double upper = -1, lower = -1;  // multipliers, −1: new
    double slack = 0;               // slack of the nearer side
  };
  std::vector<Sampled> samples_;
  std::size_t initial_ = 0;          // samples that always stay
  std::vector<std::size_t> ranges_;  // conditions that are ranges, one row each before the samples
  struct Contact {
    std::size_t section;
    bool end;
    int order;
    double sign;  // sign of the derivative that is not negative
  };
  std::vector<Contact> contacts_;  // one row each behind the ranges
  struct Floor {
    std::size_t section;
    int order;
    double peak;
  };
  std::vector<Floor> floors_;  // peaks of given sections, below which no peak is; one row each behind the contacts
  std::size_t fixed_rows() const { return ranges_.size() + contacts_.size() + floors_.size(); }
  std::vector<Sampled> range_state_;
  std::vector<LawSample> found_;  // extrema of the last law
};

/// Returns a bound of |s| for any law with J ≤ upper, in the task's units; 0 if nothing bounds it.
double position_bound(const LawTask& task, double upper);

}  // namespace bahnwerk::cam
