/// Long series go into the store piece by piece; nobody sees them before the result is there.
#include <random>

#include "api/planned_job.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

/// Rows that do not compress, of no path: 16 MB a million.
class Random final : public SetpointSource {
 public:
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return 1'000'000; }
  double cycle_time() const override { return 0.001; }
  double duration() const override { return 999.999; }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    std::mt19937_64 bits(first);
    for (std::size_t k = 0; k < 2 * rows; ++k) *out++ = static_cast<double>(bits());
  }

 private:
  std::vector<Column> columns_{{"p", "mm"}, {"q", "mm"}};
};

api::PlannedJob long_plan() {
  api::PlannedJob planned;
  planned.result = {{"kind", "ramp"}};
  planned.setpoints = std::make_unique<Random>();
  planned.verified = true;
  return planned;
}

/// A table over a master's angle, whose poses are of the part if it is told so.
class Table final : public SetpointSource {
 public:
  explicit Table(std::optional<PoseFrame> frame) : frame_(frame) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return 5; }
  double cycle_time() const override { return 0.125; }
  double duration() const override { return 0.5; }
  Independent independent() const override { return {"phi", "deg", 90}; }
  std::optional<PoseFrame> pose_frame() const override { return frame_; }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k) *out++ = 90.0 * static_cast<double>(k);
  }

 private:
  std::optional<PoseFrame> frame_;
  std::vector<Column> columns_{{"phi", "deg"}};
};

struct StoppingAt final : ProgressSink {
  explicit StoppingAt(int k) : left(k) {}
  void report(std::string_view stage, double, std::string_view) override {
    EXPECT_EQ(stage, "storing");
    if (--left == 0) throw Stopped(StopReason::cancelled);
  }
  int left;
};

std::size_t chunks(const std::filesystem::path& store) {
  SqliteConnection connection(store, false);
  return static_cast<std::size_t>(connection.query("SELECT count(*) FROM chunks").one_int());
}

TEST_F(StoreTest, KeepsWhatTheRowsAreTakenOver) {
  for (const bool framed : {false, true}) {
    const std::string id = insert_id(*store);
    claim(*store, 1);
    api::PlannedJob planned = ramp_plan(0);
    planned.setpoints = std::make_unique<Table>(framed ? std::optional(PoseFrame{1, 2, 3, 45}) : std::nullopt);
    Progress progress;
    ASSERT_TRUE(store->succeed({id, 1}, planned, 2, nothing_seen, progress));
    const auto series = store->series(id);
    ASSERT_TRUE(series);
    EXPECT_EQ(series->independent.name, "phi");
    EXPECT_EQ(series->independent.unit, "deg");
    EXPECT_EQ(series->independent.step, 90);
    EXPECT_EQ(series->cycle_time, 0.125);
    EXPECT_EQ(series->columns.at(0).name, "phi");
    EXPECT_EQ(series->pose_frame.has_value(), framed);
    if (framed) {
      EXPECT_EQ(series->pose_frame->angle, 45);
    }
  }
  const std::string id = insert_id(*store);
  claim(*store, 1);
  Progress progress;
  ASSERT_TRUE(store->succeed({id, 1}, ramp_plan(3), 2, nothing_seen, progress));
  EXPECT_TRUE(store->series(id)->independent.time());
  EXPECT_EQ(store->series(id)->independent.step, 0.001);
}

TEST_F(StoreTest, StoresLongSeriesPieceByPiece) {
  const std::string id = insert_id(*store);
  claim(*store, 1);
  const auto planned = long_plan();
  StoppingAt never(0);
  EXPECT_TRUE(store->succeed({id, 1}, planned, 2, nothing_seen, never));
  EXPECT_LE(never.left, -1'000'000 / 4096) << "asked before every chunk";
  const auto series = store->series(id);
  ASSERT_TRUE(series);
  std::vector<double> stored, expected(2 * 4096);
  for (const std::size_t first : {std::size_t{0}, std::size_t{100} * 4096, std::size_t{243} * 4096}) {
    store->read_chunk(*series, first, stored);
    planned.setpoints->read(first, 4096, expected.data());
    EXPECT_EQ(stored, expected);
  }
}

TEST_F(StoreTest, ForgetsWhatAnAttemptStoredThatDidNotSucceed) {
  const auto planned = long_plan();
  for (const int end : {0, 1, 2}) {
    const std::string id = insert_id(*store);
    claim(*store, 1);
    StoppingAt half(150);
    EXPECT_THROW(store->succeed({id, 1}, planned, 2, nothing_seen, half), Stopped);
    EXPECT_GT(chunks(folder.path / "store.db"), 0U) << "else this tests nothing";
    EXPECT_FALSE(store->series(id));
    if (end == 0) {
      EXPECT_TRUE(store->end({id, 1}, {api::JobState::cancelled, "{}", 3, 0}));
    }
    if (end == 1) {
      EXPECT_TRUE(store->requeue({id, 1}, 3, 0));
    }
    if (end == 2) {
      open();  // the process died, and begins again
      EXPECT_EQ(claim(*store, 4)->attempt, 2);
    }
    while (store->expire(4).next == 4) {  // frees a piece at a time
    }
    EXPECT_EQ(chunks(folder.path / "store.db"), 0U);
    if (end == 1) claim(*store, 4);
    if (end > 0) {
      EXPECT_TRUE(store->end({id, 2}, {api::JobState::failed, "{}", 5, 0}));
    }
  }
}

TEST_F(StoreTest, FreesALongSeriesInPiecesWhenItsJobIsRemoved) {
  std::atomic<std::size_t> commits{0};
  SqliteOptions options;
  options.observer = [&](double, std::size_t) { ++commits; };
  open(options);
  const std::string id = insert_id(*store);
  claim(*store, 1);
  EXPECT_TRUE(store->succeed({id, 1}, long_plan(), 2, nothing_seen, silent));
  const std::size_t before = commits;
  EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_GE(commits - before, 4U) << "others write in between";
  EXPECT_EQ(chunks(folder.path / "store.db"), 0U);
}

TEST_F(StoreTest, GoesOnWhereAFullDiskStoppedIt) {
  SqliteOptions options;
  options.max_pages = 6000;  // 24 MB: room for one series and a half
  open(options);
  const auto planned = long_plan();
  const std::string first = insert_id(*store), second = insert_id(*store);
  claim(*store, 1);
  ASSERT_TRUE(store->succeed({first, 1}, planned, 2, nothing_seen, silent));
  claim(*store, 1);
  StoppingAt count(0);
  try {
    store->succeed({second, 1}, planned, 2, nothing_seen, count);
    FAIL();
  } catch (const StoreError& error) {
    EXPECT_TRUE(error.full);
  }
  EXPECT_EQ(store->remove(first), Removed::yes);
  const int once = count.left;
  EXPECT_TRUE(store->succeed({second, 1}, planned, 3, nothing_seen, count));
  EXPECT_LT(once - count.left, 1'000'000 / 4096) << "what was stored is not packed again";
  const auto series = store->series(second);
  ASSERT_TRUE(series);
  std::vector<double> stored, expected(2 * 4096);
  for (std::size_t first_row = 0; first_row + 4096 <= series->count; first_row += 4096) {
    store->read_chunk(*series, first_row, stored);
    planned.setpoints->read(first_row, 4096, expected.data());
    ASSERT_EQ(stored, expected) << first_row;
  }
}

TEST_F(StoreTest, KnowsAJobUntilTheNextCommit) {
  const std::string id = insert_id(*store);
  EXPECT_FALSE(store->at_hand(id));
  store->get(id, false);
  ASSERT_TRUE(store->at_hand(id));
  EXPECT_EQ(store->at_hand(id)->state, api::JobState::queued);
  claim(*store, 1);
  EXPECT_FALSE(store->at_hand(id)) << "it has changed";
  EXPECT_EQ(store->get(id, false)->state, api::JobState::running);
  EXPECT_EQ(store->at_hand(id)->state, api::JobState::running);
  insert_id(*store);
  EXPECT_FALSE(store->at_hand(id)) << "it may have changed";
  EXPECT_TRUE(store->end({id, 1}, {api::JobState::failed, "{}", 2, 0}));
  EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_FALSE(store->get(id, false));
  EXPECT_FALSE(store->at_hand(id));
}

}  // namespace
}  // namespace bahnwerk::server
