#include "core/plan/coarse_fine/machine_study.hpp"

#include <gmock/gmock.h>

#include "core/base/progress.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

using testing::HasSubstr;

/// 6 holes of 4 mm need no more than a few mm of stroke, and more acceleration makes them quicker.
TEST(MachineStudy, TellsWhatOtherFineAxesBring) {
  Progress progress;
  const Contour contour = test::holes(2, 1, 12, 2);
  const CoarseFinePlan plan = plan_coarse_fine(contour, test::md2(), {}, {}, progress);
  const MachineStudy study = machine_study(contour, test::md2(), {}, {}, usual_studies(), progress);
  ASSERT_EQ(study.size(), std::size(studied_quantities));
  const auto& strokes = study[0].machines;
  ASSERT_EQ(strokes.size(), 10u);
  EXPECT_EQ(strokes[0].value, 0.5);
  EXPECT_EQ(strokes[5].value, 20);
  EXPECT_LE(*strokes[5].duration, plan.contour.duration);
  const auto& accelerations = study[1].machines;
  ASSERT_EQ(accelerations.size(), 6u);
  EXPECT_EQ(accelerations[3].value, 60000);
  EXPECT_LE(*accelerations[3].duration, plan.contour.duration);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_LT(*accelerations[i].duration, *accelerations[i - 1].duration);
  for (const Study& table : study)
    for (std::size_t i = 0; i < table.machines.size(); ++i) {
      ASSERT_TRUE(table.machines[i].duration);
      if (i > 0) {  // what a machine can do one with more can, too
        EXPECT_LE(*table.machines[i].duration, *table.machines[i - 1].duration);
      }
    }
  EXPECT_THAT(machine_study_drawing(study, plan.contour.duration), HasSubstr("stroke of the fine axes"));
}

TEST(MachineStudy, TakesTheValuesThatAreAskedForAndTellsWhyThereIsNoPlan) {
  Progress progress;
  ContourPlanning planning;
  planning.max_setpoints = 30;  // too few for the slow one
  const MachineStudy study = machine_study(
      test::straight(20, 0), test::md2(), planning, {},
      {{StudiedQuantity::coarse_acceleration, {16000, 8000}}, {StudiedQuantity::fine_velocity, {1.5}}}, progress);
  ASSERT_EQ(study.size(), 2u);
  ASSERT_EQ(study[0].machines.size(), 2u);
  EXPECT_EQ(study[0].machines[0].value, 8000);
  EXPECT_EQ(study[1].machines.size(), 1u);
  for (const Study& table : study)
    for (const StudiedMachine& m : table.machines) EXPECT_EQ(m.note.empty(), m.duration.has_value());
  EXPECT_FALSE(study[0].machines[0].duration);
}

/// A long move takes what the coarse axes need for all but two strokes, (800 − 2 S)/1800 + 1800/16000 s; every row has
/// it.
TEST(MachineStudy, EveryStrokeOfALongMoveHasItsDuration) {
  Progress progress;
  const MachineStudy study = machine_study(test::straight(800, 0), test::md2(), {}, {},
                                           {{StudiedQuantity::stroke, {0.005, 5, 10, 40}}}, progress);
  for (const StudiedMachine& m : study[0].machines) {
    ASSERT_TRUE(m.duration) << m.value << " " << m.note;
    EXPECT_NEAR(*m.duration, (800 - 2 * m.value) / 1800 + 0.1125, 1e-6);
  }
}

}  // namespace
}  // namespace bahnwerk
