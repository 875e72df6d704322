#include "core/cam/optimal/relaxation/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/cam/optimal/relaxation/relaxation_program.hpp"

namespace bahnwerk::cam {
namespace {

/// The dual's value less what its residuals may be worth, after two corrections of the multipliers at most.
double certified_bound(RelaxationProgram& program, const LawTask& task, const KnownLaw& law, InteriorPoint& point) {
  BorderedBand& band = program.band();
  const double upper = law.objective();
  double best = 0;
  for (int refinement = 0; refinement < 2; ++refinement) {
    DualValue value = dual_value(band, point.y, point.z);
    double bound = value.value;
    double largest[3] = {0, 0, 0};
    for (std::size_t i = 0; i < band.band_variables(); ++i)
      largest[i % 3] = std::max(largest[i % 3], std::abs(point.x[i]));
    for (std::size_t r = 1; r < 3; ++r)
      if (program.counted(r))
        largest[r] =
            upper / (task.groups.least_weight() * task.weight[r]) / program.node_unit(static_cast<std::size_t>(r));
      else
        largest[r] *= 1e3;
    const double position = position_bound(task, upper);
    largest[0] = position > 0 ? position : 1e3 * largest[0];
    for (std::size_t i = 0; i < band.band_variables(); ++i) bound -= std::abs(value.residual[i]) * largest[i % 3];
    const auto lose = [&](std::size_t variable, double weight, std::size_t r) {  // peaks are not negative
      bound -= std::max(0.0, -value.residual[variable]) * upper / (weight * task.weight[r] * program.peak_unit(r));
    };
    for (std::size_t r = 1; r < limited_orders; ++r) {
      if (!program.counted(r)) continue;
      for (std::size_t g = 0; g < task.groups.count(); ++g) lose(program.peak_variable(g, r), task.groups.weight[g], r);
      if (const auto any = program.any_peak_variable(r)) lose(*any, task.groups.least_weight(), r);
      if (task.largest_peak) break;
    }
    if (std::isfinite(bound)) best = std::max(best, bound * program.objective_unit());
    std::vector<double> y(point.y.size()), gx(point.z.size()), ex(point.y.size());
    for (double& each : value.residual) each = -each;
    solve_refined(band, band.weights(), value.residual, y);
    band.multiply(value.residual, gx, ex);
    for (std::size_t i = 0; i < point.z.size(); ++i)
      point.z[i] = std::max(point.z[i] * 1e-3, point.z[i] + band.weights()[i] * gx[i]);
    for (std::size_t i = 0; i < y.size(); ++i) point.y[i] += y[i];
  }
  return best;
}

struct Attempt {
  double bound = 0;
  bool converged = false;
};

/// Where the interior-point method starts from a known law.
struct Start {
  double above;  ///< multiple of the law's peaks
  double slack;  ///< least slack of a row
};

/// Solves the program, starting from the known law.
Attempt solve(RelaxationProgram& program, const LawTask& task, const KnownLaw& law, const RelaxationOptions& options,
              const Start& start, Progress progress) {
  BorderedBand& band = program.band();
  const RelaxationGrid& grid = program.grid();
  InteriorPoint point;
  const std::vector<double>& g = band.inequality_side();
  point.x.assign(band.band_variables() + band.borders(), 0);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    for (int r = 0; r < 3; ++r) {
      const RelaxationNode& node = grid.nodes[i];
      point.x[RelaxationProgram::variable(i, r)] =
          law.value(node.time, r, node.before) / program.node_unit(static_cast<std::size_t>(r));
    }
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (program.counted(r)) {
      for (std::size_t group = 0; group < task.groups.count(); ++group)
        point.x[program.peak_variable(group, r)] = start.above * (task.largest_peak ? law.objective() : 1);
      if (const auto any = program.any_peak_variable(r)) point.x[*any] = (1 + start.above) / 2;
    }
  point.y.assign(band.equality_side().size(), 0);
  std::vector<double> gx(g.size()), ex(point.y.size());
  band.multiply(point.x, gx, ex);
  point.s.resize(g.size());
  point.z.resize(g.size());
  double share = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    point.s[i] = std::max(g[i] - gx[i], start.slack);
    share += 1 / point.s[i];
  }
  for (std::size_t i = 0; i < g.size(); ++i) point.z[i] = 1 / share / point.s[i];
  InteriorPointOptions interior;
  interior.gap = options.gap;
  // The bound holds whatever the residuals are, but loses what they may be worth.
  interior.primal_residual = interior.dual_residual = 1e-7;
  interior.max_iterations = 60;
  interior.tick = [&] { progress.report("bound", 0); };
  const InteriorPointResult inner = solve_interior_point(band, point, interior);
  return {certified_bound(program, task, law, point), inner.converged};
}

}  // namespace

double relaxation_bound(const LawTask& task, const std::vector<Range>& ranges, const KnownLaw& law,
                        const RelaxationOptions& options, Progress progress) {
  std::vector<Range> ascending = ranges;
  tighten(task, ascending);
  RelaxationProgram program(task, ascending, law, options.cells);
  const Attempt near = solve(program, task, law, options, {1.1, 0.01}, progress);
  if (near.converged) return near.bound;
  // Factorisations may fail before the end: from farther inside they are others.
  return std::max(near.bound, solve(program, task, law, options, {2, 0.1}, progress).bound);
}

}  // namespace bahnwerk::cam
