/// The table of docs/methods/coarse_fine_iterative.md: methods × degrees × multiplicities on a sheet of small contours,
/// MD2: durations of cutting, of positioning and of all, iterations, planning time. Over the whole contour, or with two
/// arguments in windows of so many blocks that share so many. Run by hand.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "core/base/progress.hpp"
#include "core/motion/law/block_times.hpp"
#include "core/redundant/iterative/iterative.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/iterative/small_contours.hpp"

namespace bahnwerk {
namespace {

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void row(const RedundancyTask& task, RedundancyOptions options, const char* name) {
  for (const auto& [degree, multiplicity] : {std::pair{2, 1}, {3, 1}, {3, 2}, {4, 1}, {4, 2}, {5, 1}}) {
    options.degree = degree;
    options.knot_multiplicity = multiplicity;
    Progress progress;
    const double begin = processor_time();
    const Expected<RedundancyResult, NoPlan> found = plan_iterative(task, options, progress);
    const double spent = processor_time() - begin;
    if (!found) {
      std::printf("%-34s m=%d k=%d  no split\n", name, degree, multiplicity);
      continue;
    }
    const RedundancyResult& r = *found;
    double cut = 0, position = 0;
    const std::vector<BlockTime> times = block_times(*task.contour, r.head->law());
    for (std::size_t i = 0; i < times.size(); ++i)
      (task.contour->blocks[i].mode == Mode::cut ? cut : position) += times[i].end - times[i].begin;
    std::printf(
        "%-34s m=%d k=%d  cut %.4f position %.4f all %.4f  first %.4f ratio %.5f  iterations %zu  "
        "planning/motion %.4f\n",
        name, degree, multiplicity, cut, position, r.head->duration(), r.fastest, r.head->duration() / r.fastest,
        r.iterations, spent / r.head->duration());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace bahnwerk

int main(int argc, char** argv) {
  using namespace bahnwerk;
  const bool windows = argc > 2;  // BLOCKS OVERLAP
  const RedundancyTask task = test::redundancy_task(test::small_contours(), test::md2());
  for (const auto& approximation : coarse_approximations)
    for (const auto& smoothing : coarse_smoothings) {
      RedundancyOptions options;
      options.approximation = approximation.value;
      options.smoothing = smoothing.value;
      if (windows)
        options.window =
            RedundancyOptions::Window{std::strtoul(argv[1], nullptr, 10), std::strtoul(argv[2], nullptr, 10)};
      row(task, options, (std::string(approximation.name) + ", " + std::string(smoothing.name)).c_str());
    }
}
