#include "core/redundant/known/split_path.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/base/progress.hpp"
#include "core/redundant/known/geometric.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/frames.hpp"

namespace bahnwerk {
namespace {

/// Whatever the batch held before: of an odd count the last pair is half empty.
TEST(SplitPath, ABatchHasTheRowsOfItsPointsOneByOne) {
  const RedundancyTask task = test::redundancy_task(test::framed(2, {}), test::md2());
  Progress progress;
  const SplitPath path(task.path, coarse_curve(*task.path, task.machine, progress));
  for (std::size_t segment = 0; segment < path.size(); ++segment) {
    const double begin = path[segment].curve().begin(), end = path[segment].curve().end();
    for (std::size_t count = 1; count <= 5; ++count) {
      PathBatch batch;
      batch.count = count;
      for (std::size_t i = 0; i < PathBatch::most; ++i) {
        batch.u.set(i, 1e300), batch.s.set(i, 1e300);
        for (std::size_t k = 0; k < path.axes(); ++k)
          batch.d1[k].set(i, 1e300), batch.d2[k].set(i, 1e300), batch.d3[k].set(i, 1e300);
      }
      for (std::size_t i = 0; i < count; ++i)
        batch.u.set(i, begin + (end - begin) * static_cast<double>(i + 1) / static_cast<double>(count + 1));
      path.at_parameters(segment, batch);
      for (std::size_t i = 0; i < count; ++i) {
        const AxisJet one = path.at_parameter(segment, batch.u[i]);
        for (std::size_t k = 0; k < path.axes(); ++k) {
          EXPECT_NEAR(batch.d1[k][i], one.d1[k], 1e-9) << segment;
          EXPECT_NEAR(batch.d2[k][i], one.d2[k], 1e-8) << segment;
        }
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk
