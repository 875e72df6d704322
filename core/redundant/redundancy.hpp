#pragma once
/// Input and output of every method that plans a machine with coarse and fine axes (redundancy resolution). The methods
/// are the rows of core/redundant/methods/method_table.hpp.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/named.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/no_plan.hpp"

namespace bahnwerk {

enum class RedundancyMethod { joint, iterative, geometric, filter, follow_up, lag_compensation };
inline constexpr Named<RedundancyMethod> redundancy_methods[] = {
    {RedundancyMethod::joint, "joint"},         {RedundancyMethod::iterative, "iterative"},
    {RedundancyMethod::geometric, "geometric"}, {RedundancyMethod::filter, "filter"},
    {RedundancyMethod::follow_up, "follow_up"}, {RedundancyMethod::lag_compensation, "lag_compensation"}};

/// How the coarse path approximates the head's [Bock 4.2, phase 1].
enum class CoarseApproximation { least_squares, chebyshev, schoenberg };
inline constexpr Named<CoarseApproximation> coarse_approximations[] = {
    {CoarseApproximation::least_squares, "least_squares"},
    {CoarseApproximation::chebyshev, "chebyshev"},
    {CoarseApproximation::schoenberg, "schoenberg"}};

/// How the coarse path is smoothed so that it keeps the limits [Bock 4.2, phase 2].
enum class CoarseSmoothing { none, smoothing_spline, quadratic_program, linear_program };
inline constexpr Named<CoarseSmoothing> coarse_smoothings[] = {
    {CoarseSmoothing::none, "none"},
    {CoarseSmoothing::smoothing_spline, "smoothing_spline"},
    {CoarseSmoothing::quadratic_program, "quadratic_program"},
    {CoarseSmoothing::linear_program, "linear_program"}};

/// The input: path, machine, feeds and rests. Axis k of path and machine is coordinate k.
struct RedundancyTask {
  std::shared_ptr<const AxisPath> path;    ///< Cartesian, with as many axes as the machine
  std::shared_ptr<const Contour> contour;  ///< source of `path`: blocks and their modes, by segment
  CoarseFineMachine machine;
  std::vector<double> feeds;  ///< per segment, mm/s, see PathTask
  std::vector<bool> rests;    ///< per segment: whether the motion rests at its begin
  std::vector<Rest> dwells = {};
  double bound = 0;  ///< s, proven lower bound of the duration of any motion; 0: none is known
};

/// Options of a document; each method reads those that concern it.
struct RedundancyOptions {
  RedundancyMethod method = RedundancyMethod::joint;
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps are corners with a stop
  double smoothness = 0;         ///< joint: 0 … 1, how much longer the motion may be for smoother coarse axes
  double stretch = 0;            ///< joint: ≥ 1, factor of the shortest duration; 0: it follows from `smoothness`
  double least_stroke = 0.02;    ///< joint: mm; a fine axis with a shorter stroke stands still, except in a lone move
  bool compare = true;           ///< whether to compute the table of trade-offs, where the method has one
  bool keep_reserve = false;     ///< whether the head's time law keeps the braking reserve K_b [Bock (2.11)]
  double braking_reserve = 0.7;  ///< K_b
  CoarseApproximation approximation = CoarseApproximation::least_squares;
  CoarseSmoothing smoothing = CoarseSmoothing::quadratic_program;
  int degree = 3;             ///< degree of the coarse axes' splines, 2 … 5
  int knot_multiplicity = 1;  ///< 1 … degree
  int afterburner = 5;        ///< N*: additional passes with more knots [Bock 4.2]
  struct Window {
    std::size_t blocks = 10, overlap = 3;
  };
  std::optional<Window> window;                ///< size of the windows in blocks; none: the whole contour at once
  int thinning = 1;                            ///< n: only every n-th sample is fitted [Bock 4.3.5]
  bool reparametrise = false;                  ///< whether the finished motion is reparametrised [Bock chapter 5]
  std::size_t taps = 61;                       ///< filter: coefficients, odd
  double cutoff = 1;                           ///< filter: Hz
  double coarse_lag = 0.02, fine_lag = 0.002;  ///< lag_compensation: time constants T_c > T_f of the drives, s
};

/// One row of the table of trade-offs between duration and the coarse axes' energy.
struct RedundancyTrade {
  double stretch = 1;          ///< factor of the shortest duration found
  double duration = 0;         ///< s
  std::vector<double> energy;  ///< ∫a_c² dt per axis, mm²/s³
};

/// Peaks of one axis in one iteration.
struct RedundancyPeaks {
  double offset = 0;                                    ///< |x − x_c|, mm
  double coarse_velocity = 0, coarse_acceleration = 0;  ///< mm/s, mm/s²
  double fine_velocity = 0, fine_acceleration = 0;
};

/// One iteration of a method that adapts limits until the split is valid.
struct RedundancyIteration {
  double duration = 0;                 ///< s, duration of the head's motion
  std::size_t violated_blocks = 0;     ///< blocks (or sections) in which a limit was exceeded
  std::vector<RedundancyPeaks> peaks;  ///< per axis; empty if the method does not compute them
};

/// A segment on which the head is slower than its limits and feed require, so that the coarse axes can follow.
struct SlowedSegment {
  std::size_t segment = 0;  ///< index of the segment in the path
  double feed = 0;          ///< mm/s, reduced feed; infinite if only accelerations were reduced
};

/// Figures of simulated drives that follow the setpoints (lag_compensation).
struct RedundancyLag {
  bool prefilter = false;      ///< whether the prefilter V(σ) precedes the fine drive [Bock 3.4.2]
  double following_error = 0;  ///< mm, largest distance between the tool and its setpoint
  double contour_error = 0;    ///< mm, largest component of that distance across the direction of motion
  double overshoot = 0;        ///< overshoot of the step response, relative
  double circle_growth = 0;    ///< relative growth of the radius of a circle of 1 mm at 100 mm/s; negative: it shrinks
};

/// Why a plan gave way to another one: it failed verification, the planner found no motion, or the planner does not fit
/// the machine (an axis without a fine one, fine axes that have to be centred).
enum class GivingWay { verification, no_motion, unsuited };
inline constexpr Named<GivingWay> reasons_to_give_way[] = {
    {GivingWay::verification, "verification"}, {GivingWay::no_motion, "no_motion"}, {GivingWay::unsuited, "unsuited"}};

inline constexpr const char* coarse_axes_alone = "coarse_alone";  ///< planner without fine axes, in GaveWay
inline constexpr const char* timed_again = "timed_again";         ///< motion of a method, reparametrised, in GaveWay

/// A plan that gave way to another one.
struct GaveWay {
  std::string planner;  ///< the method's name, `timed_again` or `coarse_alone`
  GivingWay reason = GivingWay::verification;
  double duration = 0;               ///< s, of its motion; 0: it has none
  std::string used = {};             ///< the planner that took its place
  double used_duration = 0;          ///< s, of that planner's motion
  std::optional<Check> failed = {};  ///< verification: the check that failed by most
};

inline std::string planner_name(RedundancyMethod method) {
  return name_of<RedundancyMethod>(method, redundancy_methods);
}

/// The plan: head and coarse motion. The fine axes move by the difference, x_f = x − x_c, at every time. The verifier
/// decides which limits hold.
struct RedundancyResult {
  std::shared_ptr<const PathMotion> head;  ///< the tool's motion, dwells included
  /// It has as many axes and the same duration as the head, and is at rest at both ends. Its pieces are polynomials in
  /// time wherever possible, so that their peaks are exact enclosures, and end where the head's acceleration jumps.
  std::shared_ptr<const Motion> coarse;
  double fastest = 0;          ///< s, duration of the head that was planned first
  std::size_t iterations = 0;  ///< iterations of the method's inner solver
  std::vector<RedundancyTrade> trades;
  std::vector<RedundancyIteration> passes;
  std::vector<SlowedSegment> slowed;  ///< slowed segments, if the method lists them
  std::size_t slowed_count = 0;       ///< number of slowed segments, if the method only counts them
  std::size_t certified = 0;          ///< intervals with a certificate that the coarse axes cannot follow
  bool coarse_jerk_limited = false;   ///< whether the coarse acceleration is continuous though no jerk is limited
  std::vector<RedundancyLag> lags;    ///< without and with the prefilter, if drives were simulated
  std::vector<std::string> notes;     ///< remarks for the user, English sentences
};

}  // namespace bahnwerk
