#include "core/winding/path/quick_links.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/geometry/spline/search/link_variables.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
// Largest numbers of calls of the timer: for a link unlike all others, for one similar to another link of its turn, and
// for later turns.
constexpr std::size_t first_betas = 30, first_weights = 15, twin_betas = 20, twin_weights = 10, later_betas = 15;
constexpr double rougher = 5;            // largest factor of J
constexpr double turn = 0.5;             // rad that the tangent may turn more
constexpr double swing = 0.02;           // rad that an angle may go farther beyond those of both ends
constexpr double worse = 0.002;          // largest loss of a link's saving, compared with the turn before
constexpr double most_log_weight = 1.5;  // ln of a weight

/// Returns the largest excess of φ and ψ over their values at both ends, rad.
double overshoot(const BezierPiece& piece) {
  const SplinePoint a = piece.at(0)[0], b = piece.at(1)[0];
  double most = 0;
  for (int i = 1; i < 48; ++i) {
    const SplinePoint p = piece.at(i / 48.0)[0];
    for (const std::size_t d : {3, 4})
      most = std::max({most, p[d] - std::max(a[d], b[d]), std::min(a[d], b[d]) - p[d]});
  }
  return most;
}

/// The variables of the search: γ, then the logarithm of a weight for each half.
struct Point {
  std::vector<double> gamma;
  std::array<double, 2> log_weight{};
};

class Quickener {
 public:
  Quickener(const std::vector<FixedPiece>& fixed, const NeedlePath& smooth, const NeedlePath& other,
            const LinkOptions& options, const PieceTimer& time, Progress progress)
      : fixed_(fixed),
        other_(other),
        options_(options),
        time_(time),
        progress_(progress),
        rule_(options.continuity, 256),
        result_{smooth, 0, 0} {
    for (const NeedlePiece& piece : smooth.pieces) curves_.push_back(piece.curve);
  }

  QuickLinks run() {
    for (std::size_t i = 0; i < result_.path.links.size(); ++i) quicken(i);
    return std::move(result_);
  }

 private:
  /// The state of the search for the link at one place.
  struct Search {
    const NeedleLink& link;
    LinkVariables variables;
    std::vector<BezierPiece> window;
    std::size_t at;  // index of the link in `window`
    double smoothness, angle, swing;
    double best_time = unknown;
    Point best{};
  };

  LinkShape shape(const Search& search, const Point& point) const {
    LinkShape shape = search.variables.own(point.gamma);
    if (point.log_weight == std::array<double, 2>{}) return shape;
    const std::size_t n = link_points(options_.continuity);
    shape.weights.assign(n, 1);
    for (std::size_t i = 1; i + 1 < n; ++i) shape.weights[i] = std::exp(point.log_weight[i < n / 2 ? 0 : 1]);
    return shape;
  }
  double timed(const std::vector<BezierPiece>& window) {
    ++result_.evaluations;
    return time_(window);
  }
  /// Returns the time with this link in its window, and keeps the best link.
  double look(Search& search, const Point& point) {
    const LinkShape shape = this->shape(search, point);
    const BezierPiece piece = link(options_.continuity, search.link.ends, shape);
    const double j = bahnwerk::smoothness(rule_, search.link.ends, shape, options_.weights);
    if (!(j <= rougher * search.smoothness) || !(turned_angle(piece) <= search.angle + turn) ||
        !(overshoot(piece) <= search.swing + swing) || !(sharpest_curvature(piece) <= sharpest_usable))
      return unknown;
    search.window[search.at] = piece;
    const double time = timed(search.window);
    if (time < search.best_time) search.best_time = time, search.best = point;
    return time;
  }

  Search start(std::size_t i) const {
    const auto& pieces = result_.path.pieces;
    const NeedleLink& link = result_.path.links[i];
    // The range extends to the beginning of the fixed piece before and to the end of the one after, which may have
    // several parts.
    std::size_t begin = link.piece, end = link.piece + 1;
    while (pieces[begin].link) --begin;
    while (begin > 0 && !pieces[begin - 1].link && pieces[begin - 1].fixed == pieces[begin].fixed) --begin;
    while (pieces[end].link) ++end;
    const std::size_t after = pieces[end].fixed;
    while (end < pieces.size() && !pieces[end].link && pieces[end].fixed == after) ++end;
    const BezierPiece& piece = curves_[link.piece];
    const auto from = curves_.begin() + static_cast<std::ptrdiff_t>(begin);
    return {link,
            LinkVariables(options_.continuity, link.ends),
            std::vector<BezierPiece>(from, curves_.begin() + static_cast<std::ptrdiff_t>(end)),
            link.piece - begin,
            link.best.smoothness,
            turned_angle(piece),
            overshoot(piece)};
  }

  void quicken(std::size_t i) {
    Search search = start(i);
    const double before = timed(search.window);
    if (!std::isfinite(before)) return;
    search.best_time = before * (1 - 1e-4);
    const std::vector<double> own = search.variables.of(search.link.best.shape);
    const FixedPiece &from = fixed_[search.link.from], &to = fixed_[search.link.from + 1];
    const auto& links = result_.path.links;
    const bool second = i > 0 && links[i - 1].from == search.link.from,
               first_of_two = i + 1 < links.size() && links[i + 1].from == search.link.from;
    std::optional<Known>& known = known_[{from.kind, from.region, to.kind, second}];
    if (known) {
      look(search, known->point);
      if (search.best_time > (known->ratio + worse) * before) minimise_betas(search, own, before, later_betas);
    } else {
      look(search, {search.variables.of(other_.links[i].best.shape)});
      const bool like = look_at_twins(search, from, to, second, first_of_two);
      minimise_betas(search, own, before, like ? twin_betas : first_betas);
      minimise_weights(search, own, before, like ? twin_weights : first_weights);
    }
    const bool found = !search.best.gamma.empty();
    if (!known || (found && search.best_time < known->ratio * before))
      known = {found ? search.best : Point{own}, search.best_time / before};
    if (found) take(i, search);
  }

  /// Evaluates the links found at the other end of the part, whose mirror image this one is, and in the other
  /// direction, reversed. Returns whether there was any.
  bool look_at_twins(Search& search, const FixedPiece& from, const FixedPiece& to, bool second, bool first_of_two) {
    if (from.kind != FixedPiece::Kind::region || to.kind != FixedPiece::Kind::region) return false;
    const bool other_part = second || first_of_two ? !second : second;
    bool any = false;
    const auto look_at = [&](std::size_t region, bool part, bool backwards) {
      const auto twin = known_.find({from.kind, region, to.kind, part});
      if (twin == known_.end() || !twin->second) return;
      any = true;
      look(search, backwards ? reversed(twin->second->point) : twin->second->point);
    };
    look_at((from.region + 2) % 4, second, false);
    look_at((from.region + 1) % 4, other_part, true);
    look_at((from.region + 3) % 4, other_part, true);
    return any;
  }
  /// Returns the derivatives of f⁻¹ of a link that is passed backwards: odd orders keep their sign.
  static Point reversed(const Point& point) {
    const std::size_t k = point.gamma.size() / 2;
    Point back{point.gamma, {point.log_weight[1], point.log_weight[0]}};
    for (std::size_t j = 0; j < 2 * k; ++j) back.gamma[j] = (j % k % 2 == 0 ? 1 : -1) * point.gamma[(j + k) % (2 * k)];
    return back;
  }

  OptimisationOptions options(std::size_t evaluations) const {
    OptimisationOptions options;
    options.method = OptimisationMethod::cobyla;
    options.step_tolerance = 1e-3;
    options.max_evaluations = evaluations;
    return options;
  }
  void minimise_betas(Search& search, const std::vector<double>& own, double before, std::size_t evaluations) {
    const Point from = search.best.gamma.empty() ? Point{own} : search.best;
    OptimisationProblem problem;
    problem.dimension = from.gamma.size();
    for (std::size_t v = 0; v < problem.dimension; ++v) {
      const std::size_t order = search.variables.order(v);
      problem.lower.push_back(LinkVariables::lower(order));
      problem.upper.push_back(LinkVariables::upper(order));
      problem.scale.push_back(LinkVariables::scale(order));
    }
    minimise(search, problem, from.gamma, before, evaluations, [&](std::span<const double> x) {
      return Point{{x.begin(), x.end()}, from.log_weight};
    });
  }
  void minimise_weights(Search& search, const std::vector<double>& own, double before, std::size_t evaluations) {
    const Point from = search.best.gamma.empty() ? Point{own} : search.best;
    OptimisationProblem problem;
    problem.dimension = 2;
    problem.lower.assign(2, -most_log_weight);
    problem.upper.assign(2, most_log_weight);
    problem.scale.assign(2, 0.5);
    minimise(search, problem, from.log_weight, before, evaluations, [&](std::span<const double> x) {
      return Point{from.gamma, {x[0], x[1]}};
    });
  }
  template <class Make>
  void minimise(Search& search, OptimisationProblem& problem, std::span<const double> start, double before,
                std::size_t evaluations, Make&& point) {
    problem.objective_scale = 0.1 * before;
    problem.objective = [&](std::span<const double> x, std::span<double>) {
      // The value is limited, so that far worse points do not distort a linear model of the time.
      return std::min(look(search, point(x)), 1.2 * before);
    };
    bahnwerk::minimise(problem, start, options(evaluations), progress_);
  }

  void take(std::size_t i, const Search& search) {
    NeedleLink& link = result_.path.links[i];
    const LinkShape shape = this->shape(search, search.best);
    const BezierPiece piece = bahnwerk::link(options_.continuity, link.ends, shape);
    link.best = {.shape = shape,
                 .objective = search.best_time,
                 .smoothness = bahnwerk::smoothness(rule_, link.ends, shape, options_.weights),
                 .evaluations = 0};
    link.curvature = turned_angle(piece);
    result_.path.pieces[link.piece].curve = curves_[link.piece] = piece;
    ++result_.changed;
  }

  struct Known {
    Point point;
    double ratio = 1;  // time of the window to that with the smooth link
  };
  const std::vector<FixedPiece>& fixed_;
  const NeedlePath& other_;
  const LinkOptions& options_;
  const PieceTimer& time_;
  Progress progress_;
  SmoothnessRule rule_;
  QuickLinks result_;
  std::vector<BezierPiece> curves_;
  /// Key of a link: kind and region of the piece that it comes from, kind of the piece that it leads to, and whether it
  /// begins at an extra point.
  std::map<std::tuple<FixedPiece::Kind, std::size_t, FixedPiece::Kind, bool>, std::optional<Known>> known_;
};

}  // namespace

QuickLinks quick_links(const std::vector<FixedPiece>& pieces, const NeedlePath& smooth, const NeedlePath& other,
                       const LinkOptions& options, const PieceTimer& time, Progress progress) {
  return Quickener(pieces, smooth, other, options, time, progress).run();
}

}  // namespace bahnwerk::winding
