#pragma once
/// What every method that plans a machine with coarse and fine axes is given, and what it returns. The methods are the
/// rows of core/redundant/methods/method_table.hpp.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/named.hpp"
#include "core/contour/contour.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

enum class RedundancyMethod { joint, iterative, geometric, filter, follow_up, lag_compensation };
inline constexpr Named<RedundancyMethod> redundancy_methods[] = {
    {RedundancyMethod::joint, "joint"},         {RedundancyMethod::iterative, "iterative"},
    {RedundancyMethod::geometric, "geometric"}, {RedundancyMethod::filter, "filter"},
    {RedundancyMethod::follow_up, "follow_up"}, {RedundancyMethod::lag_compensation, "lag_compensation"}};

/// How the coarse path is fitted to the head's [Bock 4.2, phase 1].
enum class CoarseApproximation { least_squares, chebyshev, schoenberg };
inline constexpr Named<CoarseApproximation> coarse_approximations[] = {
    {CoarseApproximation::least_squares, "least_squares"},
    {CoarseApproximation::chebyshev, "chebyshev"},
    {CoarseApproximation::schoenberg, "schoenberg"}};

/// How it is made to hold the limits [Bock 4.2, phase 2].
enum class CoarseSmoothing { none, smoothing_spline, quadratic_program, linear_program };
inline constexpr Named<CoarseSmoothing> coarse_smoothings[] = {
    {CoarseSmoothing::none, "none"},
    {CoarseSmoothing::smoothing_spline, "smoothing_spline"},
    {CoarseSmoothing::quadratic_program, "quadratic_program"},
    {CoarseSmoothing::linear_program, "linear_program"}};

/// What is planned. Axis k of path and machine is coordinate k.
struct RedundancyTask {
  std::shared_ptr<const AxisPath> path;    ///< Cartesian, with as many axes as the machine
  std::shared_ptr<const Contour> contour;  ///< whose path that is: blocks and their modes, by segment
  CoarseFineMachine machine;
  std::vector<double> feeds;  ///< as those of a PathTask
  std::vector<bool> rests;
  std::vector<Rest> dwells = {};
  double bound = 0;  ///< s, what any motion takes at least, as far as it is known
};

/// Whether the path is one straight line without a rest on the way: then there is a closed form (lone_move.hpp).
inline bool is_lone_straight_move(const RedundancyTask& task) {
  return task.path->size() == 1 && task.path->linear(0) && task.dwells.empty();
}

/// What a document may set; each method takes what it knows.
struct RedundancyOptions {
  RedundancyMethod method = RedundancyMethod::joint;
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps are corners with a stop
  double smoothness = 0;         ///< joint: 0 … 1, how far the duration is stretched for a smoother coarse axis
  double stretch = 0;            ///< joint: ≥ 1, in place of what `smoothness` stands for
  bool coarse_alone = false;     ///< joint: whether the fine axes stand still, the last resort
  double least_stroke = 0.02;    ///< joint: mm; a fine axis with less stands still, unless a closed form knows better
  bool compare = true;           ///< whether to make the table of trades, where the method has one
  bool keep_reserve = false;     ///< whether the head's law keeps the braking reserve K_b [Bock (2.11)]
  double braking_reserve = 0.7;  ///< K_b
  CoarseApproximation approximation = CoarseApproximation::least_squares;
  CoarseSmoothing smoothing = CoarseSmoothing::quadratic_program;
  int degree = 3;             ///< of the coarse axes' splines, 2 … 5
  int knot_multiplicity = 1;  ///< 1 … degree
  int afterburner = 5;        ///< N* [Bock 4.2]
  struct Window {
    std::size_t blocks = 10, overlap = 3;
  };
  std::optional<Window> window;                ///< none: the whole contour at once
  int thinning = 1;                            ///< every how many samples count [Bock 4.3.5]
  bool reparametrise = false;                  ///< whether the finished motion is timed again [Bock chapter 5]
  std::size_t taps = 61;                       ///< filter: coefficients, odd
  double cutoff = 1;                           ///< filter: Hz
  double coarse_lag = 0.02, fine_lag = 0.002;  ///< lag_compensation: time constants T_c > T_f of the drives, s
};

/// What a duration buys.
struct RedundancyTrade {
  double stretch = 1;          ///< of the shortest duration found
  double duration = 0;         ///< s
  std::vector<double> energy;  ///< ∫a_c² dt per axis, mm²/s³
};

/// What one axis reached at most in one iteration.
struct RedundancyPeaks {
  double offset = 0;                                    ///< |x − x_c|, mm
  double coarse_velocity = 0, coarse_acceleration = 0;  ///< mm/s, mm/s²
  double fine_velocity = 0, fine_acceleration = 0;
};

/// One pass of a method that adapts limits until the split is valid.
struct RedundancyIteration {
  double duration = 0;                 ///< s, of the head's motion
  std::size_t violated_blocks = 0;     ///< blocks (or sections) in which a limit was exceeded
  std::vector<RedundancyPeaks> peaks;  ///< per axis; may be empty where they are not looked at
};

/// A section that was made slower than limits and feed allow by themselves, so that the coarse axes can follow.
struct SlowedSegment {
  std::size_t segment = 0;  ///< of the path
  double feed = 0;          ///< mm/s, that it was slowed to; infinite where its accelerations were lowered alone
};

/// What simulated drives make of the set points (lag_compensation).
struct RedundancyLag {
  bool prefilter = false;      ///< whether V(σ) is before the fine drive [Bock 3.4.2]
  double following_error = 0;  ///< largest distance between the tool and where it should be, mm
  double contour_error = 0;    ///< the part of it across the direction of motion, at most, mm
  double overshoot = 0;        ///< of a unit step
  double circle_growth = 0;    ///< of the radius of a circle of 1 mm at 100 mm/s, relative; negative: it gets smaller
};

/// The fine axes make up for what is left: x_f = x − x_c, at every moment. Which limits hold is for the verifier to
/// say.
struct RedundancyResult {
  std::shared_ptr<const PathMotion> head;  ///< the tool's motion, dwells included
  /// As many axes, and as long, as the head; at rest at both ends. Polynomials in time wherever possible: then all
  /// peaks are enclosures. Its pieces end where the head's acceleration jumps.
  std::shared_ptr<const Motion> coarse;
  double fastest = 0;          ///< s, of the head's motion that was planned first
  std::size_t iterations = 0;  ///< passes of the method's inner solver
  std::vector<RedundancyTrade> trades;
  std::vector<RedundancyIteration> passes;
  std::vector<SlowedSegment> slowed;  ///< as far as the method tells
  std::size_t slowed_count = 0;       ///< where it only tells how many
  std::size_t certified = 0;          ///< stretches proven to be too fast for the coarse axes
  bool coarse_jerk_limited = false;   ///< whether the coarse acceleration is continuous though no jerk is limited
  std::size_t fallbacks = 0;          ///< how often the method gave way to another one
  std::vector<RedundancyLag> lags;    ///< without and with the prefilter, where drives were simulated
  std::vector<std::string> notes;     ///< what a user should know, sentences in English
};

}  // namespace bahnwerk
