#include "core/motion/feed/spline_feed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/feed/speed_spline.hpp"
#include "core/motion/law/law_between.hpp"
#include "core/motion/law/law_excess.hpp"
#include "core/numeric/gauss_legendre.hpp"
#include "core/numeric/optimise/optimise.hpp"
#include "core/numeric/windows.hpp"

namespace bahnwerk {
namespace {

/// Gauss's rule gives the places at which limits are evaluated, and the duration's quadrature.
constexpr std::size_t per_part = 4;
constexpr int parts = 2;  // parts of a span, each with these places
constexpr std::size_t per_span = parts * per_part;
constexpr double slack = 1e-6;  // part of a limit that each window leaves for rounding

std::vector<double> breaks(const Path& tool, std::size_t spans) {
  std::vector<double> all{0};
  for (std::size_t i = 0; i < tool.size(); ++i)
    for (std::size_t n = 1; n <= spans; ++n)
      all.push_back(n == spans ? tool[i].s1()
                               : tool[i].s0() + tool[i].length() * static_cast<double>(n) / static_cast<double>(spans));
  return all;
}

class SplinePlanner {
 public:
  SplinePlanner(const PathTask& task, const SplineFeedOptions& options, Progress progress)
      : task_(task),
        options_(options),
        progress_(progress),
        spline_(breaks(task.path.tool(), options.spans),
                task.path.size() > 1 ? options.spans : options.spans / 2),  // the first and the last segment
        control_(spline_.points(), 0.0) {}

  SplineFeed run() {
    ProgressScope stage_progress(progress_, "spline feed");
    sample(stage_progress);
    start();
    const std::size_t first = SpeedSpline::fixed, last = control_.size() - SpeedSpline::fixed;
    const std::size_t step = options_.window - options_.overlap;
    const WindowLengths lengths{step, options_.overlap, step};
    for (std::size_t pass = 0; pass < options_.passes; ++pass)
      solve_windows(first, last, [&](std::size_t begin, auto*) {
        const Window window = lengths.at(begin, last);
        const auto share = [&](std::size_t at) {
          return (static_cast<double>(pass) + static_cast<double>(at - first) / static_cast<double>(last - first)) /
                 static_cast<double>(options_.passes);
        };
        improve(begin, window.end, progress_.part(share(begin), share(window.keep)).named("spline feed"));
        return window.keep;
      });
    write();
    result_.law.slow(law_excess(task_, result_.law, options_.path, stage_progress));
    return std::move(result_);
  }

 private:
  struct Node {
    SpeedSpline::Place place;
    double weight = 0;  // weight of σ_w/v in the duration
    double fastest = unlimited;
    AxisArray d1, d2, d3;
  };

  void sample(ProgressScope& stage_progress) {
    for (std::size_t i = 0; i < spline_.spans(); ++i)
      for (std::size_t k = 0; k < per_span; ++k) {
        Node node;
        const std::size_t part = k / per_part;
        const auto [place, weight] = gauss_legendre<per_part>()[k % per_part];
        node.place = spline_.at(i, (static_cast<double>(part) + (1 + place) / 2) / parts);
        node.weight = weight / 2 / parts * spline_.width(i) * node.place.s1;
        const std::size_t segment = i / options_.spans;
        const AxisJet q = task_.path.at(segment, node.place.s);
        node.d1 = q.d1, node.d2 = q.d2, node.d3 = q.d3;
        node.fastest = std::min(options_.path.velocity, task_.feeds[segment]);
        for (std::size_t axis = 0; axis < task_.path.axes(); ++axis)
          node.fastest =
              std::min(node.fastest, task_.machine.axes[axis].velocity / std::max(std::abs(q.d1[axis]), 1e-12));
        nodes_.push_back(node);
        stage_progress.work(4);
      }
  }

  /// Begins with equal control points, as quick as the limits allow everywhere.
  void start() {
    for (std::size_t i = SpeedSpline::fixed; i + SpeedSpline::fixed < control_.size(); ++i) control_[i] = 1;
    double most = 0;
    for (const Node& node : nodes_) {
      const SpeedSpline::State x = SpeedSpline::state(node.place, control_);
      most = std::max({most, x.v / node.fastest, std::sqrt(std::abs(x.a) / options_.path.acceleration),
                       std::cbrt(std::abs(x.j) / options_.path.jerk)});
      for (std::size_t k = 0; k < task_.path.axes(); ++k) {
        const AxisLimits& axis = task_.machine.axes[k];
        const double a = node.d2[k] * x.v * x.v + node.d1[k] * x.a;
        const double j = (node.d3[k] * x.v * x.v + 3 * node.d2[k] * x.a) * x.v + node.d1[k] * x.j;
        most = std::max({most, std::sqrt(std::abs(a) / axis.acceleration), std::cbrt(std::abs(j) / axis.jerk)});
      }
    }
    for (double& c : control_) c /= most * (1 + slack);
  }

  /// Rows per node: the speed; squares of accelerations and jerks of the axes and along the path, over their limits.
  std::size_t rows_per_node() const { return 1 + 2 * (task_.path.axes() + 1); }

  /// Optimises the control points [begin, end) with constant others.
  void improve(std::size_t begin, std::size_t end, Progress progress) {
    const std::size_t spans = spline_.spans(), from = (begin - SpeedSpline::fixed) * per_span,
                      to = std::min(end, spans) * per_span;
    const std::size_t dimension = end - begin;
    std::vector<double> control = control_;
    const auto place = [&](std::span<const double> x) {
      std::copy(x.begin(), x.end(), control.begin() + static_cast<std::ptrdiff_t>(begin));
    };
    // Adds `slope` by the span's control points to what moves of them.
    const auto spread = [&](const Node& node, const std::array<double, SpeedSpline::order>& by, double slope,
                            double* row) {
      for (std::size_t i = 0; i < by.size(); ++i)
        if (const std::size_t c = node.place.span + i; c >= begin && c < end) row[c - begin] += slope * by[i];
    };

    OptimisationProblem problem;
    problem.dimension = dimension;
    const double typical = *std::max_element(control_.begin(), control_.end());
    problem.lower.assign(dimension, 1e-3 * typical);
    problem.upper.assign(dimension, unlimited);
    problem.scale.assign(dimension, typical);
    double duration = 0;
    for (std::size_t n = from; n < to; ++n)
      duration += nodes_[n].weight / SpeedSpline::state(nodes_[n].place, control_).v;
    problem.objective_scale = duration;
    problem.objective = [&](std::span<const double> x, std::span<double> gradient) {
      place(x);
      std::fill(gradient.begin(), gradient.end(), 0.0);
      double sum = 0;
      for (std::size_t n = from; n < to; ++n) {
        const SpeedSpline::State at = SpeedSpline::state(nodes_[n].place, control);
        sum += nodes_[n].weight / at.v;
        if (!gradient.empty()) spread(nodes_[n], at.dv, -nodes_[n].weight / (at.v * at.v), gradient.data());
      }
      return sum;
    };
    problem.inequality.rows = (to - from) * rows_per_node();
    problem.inequality.evaluate = [&](std::span<const double> x, std::span<double> values, std::span<double> jacobian) {
      place(x);
      std::fill(jacobian.begin(), jacobian.end(), 0.0);
      std::size_t row = 0;
      for (std::size_t n = from; n < to; ++n) {
        const Node& node = nodes_[n];
        const SpeedSpline::State at = SpeedSpline::state(node.place, control);
        const auto slopes = [&] { return jacobian.empty() ? nullptr : jacobian.data() + row * dimension; };
        values[row] = std::isfinite(node.fastest) ? at.v / node.fastest - 1 : -1;
        if (double* out = slopes(); out && std::isfinite(node.fastest)) spread(node, at.dv, 1 / node.fastest, out);
        ++row;
        // c_v, c_a, c_j are the derivatives of a quantity by v, a, j.
        const auto keep = [&](double quantity, double limit, double c_v, double c_a, double c_j) {
          const double ratio = limit < unlimited ? quantity / limit : 0;
          values[row] = ratio * ratio - 1;
          if (double* out = slopes(); out && limit < unlimited) {
            const double slope = 2 * ratio / limit;
            spread(node, at.dv, slope * c_v, out);
            spread(node, at.da, slope * c_a, out);
            spread(node, at.dj, slope * c_j, out);
          }
          ++row;
        };
        keep(at.a, options_.path.acceleration, 0, 1, 0);
        keep(at.j, options_.path.jerk, 0, 0, 1);
        for (std::size_t k = 0; k < task_.path.axes(); ++k) {
          const AxisLimits& axis = task_.machine.axes[k];
          const double d1 = node.d1[k], d2 = node.d2[k], d3 = node.d3[k], v = at.v;
          keep(d2 * v * v + d1 * at.a, axis.acceleration, 2 * d2 * v, d1, 0);
          keep((d3 * v * v + 3 * d2 * at.a) * v + d1 * at.j, axis.jerk, 3 * (d3 * v * v + d2 * at.a), 3 * d2 * v, d1);
        }
      }
    };
    OptimisationOptions options;
    options.max_evaluations = options_.evaluations;
    options.step_tolerance = 1e-6;
    options.constraint_tolerance = slack;
    const std::vector<double> before(control_.begin() + static_cast<std::ptrdiff_t>(begin),
                                     control_.begin() + static_cast<std::ptrdiff_t>(end));
    const OptimisationResult found = minimise(problem, before, options, progress);
    result_.evaluations += found.evaluations;
    if (found.violation <= 2 * slack && found.objective <= duration)
      std::copy(found.x.begin(), found.x.end(), control_.begin() + static_cast<std::ptrdiff_t>(begin));
  }

  void write() {
    const std::size_t spans = spline_.spans(), steps = options_.steps;
    const double dx = 1.0 / static_cast<double>(steps), length = task_.path.length();
    LawState here;
    for (std::size_t i = 0; i < spans; ++i) {
      const std::size_t segment = i / options_.spans;
      for (std::size_t n = 0; n < steps; ++n) {
        const bool first = i == 0 && n == 0, last = i + 1 == spans && n + 1 == steps;
        if (last) {
          append_stop(segment, here);
          return;
        }
        const double x0 = static_cast<double>(n) * dx;
        const SpeedSpline::Place at = spline_.at(i, x0 + dx);
        const SpeedSpline::State x = SpeedSpline::state(at, control_);
        const bool joint = n + 1 == steps && (i + 1) % options_.spans == 0;
        LawState next{joint ? task_.path[segment].s1() : at.s, x.v, x.a, 0};
        if (i + 1 == spans && n + 2 == steps) next.a = -3 * next.v * next.v / (4 * (length - next.s));
        if (first) {
          next.a = append_start(segment, next);
        } else {
          append_between(result_.law, segment, here, next, duration(i, x0, dx));
        }
        here = next;
      }
    }
  }
  double duration(std::size_t span, double x0, double dx) const {
    double sum = 0;
    for (const auto& [place, weight] : gauss_legendre<per_part>()) {
      const SpeedSpline::Place at = spline_.at(span, x0 + (1 + place) / 2 * dx);
      sum += weight / 2 * dx * spline_.width(span) * at.s1 / SpeedSpline::state(at, control_).v;
    }
    return sum;
  }
  /// At each end the spline is the law of constant snap but for terms that vanish there: s = snap t⁴/24, so t = 4 s/v,
  /// a = 3 v/t. Returns a.
  double append_start(std::size_t segment, const LawState& to) {
    const double t = 4 * to.s / to.v;
    LawPiece piece;
    piece.segment = segment, piece.duration = t, piece.s_end = to.s, piece.snap = 6 * to.v / (t * t * t);
    result_.law.append(piece);
    return 3 * to.v / t;
  }
  void append_stop(std::size_t segment, const LawState& from) {
    const double t = 4 * (task_.path.length() - from.s) / from.v;
    LawPiece piece;
    piece.segment = segment, piece.duration = t, piece.s = from.s, piece.s_end = task_.path.length();
    piece.v = from.v, piece.a = -3 * from.v / t, piece.j = 6 * from.v / (t * t), piece.snap = -6 * from.v / (t * t * t);
    result_.law.append(piece);
  }

  const PathTask& task_;
  const SplineFeedOptions& options_;
  Progress progress_;
  SpeedSpline spline_;
  std::vector<double> control_;
  std::vector<Node> nodes_;
  SplineFeed result_;
};

}  // namespace

SplineFeed plan_spline_feed(const PathTask& task, const SplineFeedOptions& options, Progress progress) {
  for (std::size_t i = 1; i + 1 < task.rests.size(); ++i)
    if (task.rests[i]) throw InvalidInput({{{"feed", "law"}, "bspline knows no rest within the path"}});
  const Progress part = progress.named("spline feed");
  return SplinePlanner(task, options, part).run();
}

}  // namespace bahnwerk
