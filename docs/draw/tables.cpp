#include <cstdio>

#include "core/base/progress.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "docs/draw/pictures.hpp"
#include "docs/draw/plans.hpp"
#include "docs/draw/shapes.hpp"

namespace bahnwerk::draw {

namespace {

void convergence(const std::string& name, const Contour& contour) {
  const Machine m = machine();
  Progress silent;
  const double bound = lower_bound(contour, m, GridOptions{}.angle / 2, silent).value;
  GridOptions finest;
  finest.angle = 2.5e-4;
  const double best = plan(contour, m, false, finest, 1e-9).law.duration();
  std::printf("%s: %.9f s on a grid of 0.00025 rad with tolerance 1e-9; lower bound %.9f s\n\n", name.c_str(), best,
              bound);
  std::printf(
      "| angle, rad | cells | duration, s | above the finest | above the bound |\n| --- | --- | --- | --- | --- |\n");
  for (const double angle : {0.032, 0.016, 0.008, 0.004, 0.002, 0.001}) {
    GridOptions grid;
    grid.angle = angle;
    const AccelerationLimitedResult result = plan(contour, m, false, grid);
    std::printf("| %.3f | %zu | %.9f | %.1e | %.1e |\n", angle, result.cells, result.law.duration(),
                result.law.duration() / best - 1, result.law.duration() / bound - 1);
  }
  std::printf("\n");
}

/// Durations against tests/core/motion/reference/circle.csv.
void reference() {
  struct Row {
    double feed, duration;
  };
  std::printf("| feed, mm/s | independent, s | planned, s | relative difference |\n| --- | --- | --- | --- |\n");
  for (const Row row :
       {Row{unlimited, 0.427110407865}, Row{440, 0.635346100218}, Row{400, 0.682079632680}, Row{250, 1.066952412281}}) {
    const double planned = plan(circle(10, 100, row.feed), machine(), false).law.duration();
    std::printf("| %g | %.9f | %.9f | %.1e |\n", row.feed, row.duration, planned, planned / row.duration - 1);
  }
  std::printf("\n");
}

}  // namespace

void convergence_tables() {
  reference();
  convergence("circle between lines", circle(10, 100));
  convergence("window", window());
}

}  // namespace bahnwerk::draw
