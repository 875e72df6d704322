/// What holds where two processes have one store, at once.
#include <random>
#include <thread>

#include "core/base/errors.hpp"
#include "stores.hpp"

namespace bahnwerk::server {
namespace {

template <class S>
struct Replicas : Conformance<S> {};
TYPED_TEST_SUITE(Replicas, Stores, StoreNames);

/// Rows that do not compress, so that they are stored in several pieces.
class NoisyRows final : public SetpointSource {
 public:
  static constexpr std::size_t rows = 400'000;
  explicit NoisyRows(std::uint64_t seed) : seed_(seed) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return rows; }
  double cycle_time() const override { return 0.001; }
  double duration() const override { return 0.001 * (rows - 1); }
  void read(std::size_t first, std::size_t count, double* out) const override {
    std::mt19937_64 bits(seed_ + first);
    for (std::size_t k = 0; k < 2 * count; ++k) *out++ = static_cast<double>(bits());
  }
  static api::PlannedJob plan(std::uint64_t seed) {
    api::PlannedJob planned;
    planned.result = {{"kind", "ramp"}};
    planned.setpoints = std::make_unique<NoisyRows>(seed);
    planned.verified = true;
    return planned;
  }

 private:
  const std::uint64_t seed_;
  std::vector<Column> columns_{{"p", "mm"}, {"q", "mm"}};
};

struct StoppingNearTheEnd final : ProgressSink {
  void report(std::string_view, double, std::string_view) override {
    if (--left == 0) throw Stopped(StopReason::cancelled);
  }
  int left = static_cast<int>(NoisyRows::rows / 4096) - 2;
};

TYPED_TEST(Replicas, MakeOneJobOfPostsWithOneKeyAtOnce) {
  for (int round = 0; round < 10; ++round) {
    const std::string key = "key " + std::to_string(round);
    Inserted first, second;
    std::thread neighbour([&] { second = insert(*this->other, new_job(0, key, "body")); });
    first = insert(*this->here, new_job(0, key, "body"));
    neighbour.join();
    EXPECT_EQ(first.id, second.id);
    using What = Inserted::What;
    EXPECT_TRUE((first.what == What::created && second.what == What::replayed) ||
                (first.what == What::replayed && second.what == What::created));
    EXPECT_EQ(insert(*this->other, new_job(0, key, "another")).what, What::conflict);
  }
  EXPECT_EQ(this->here->counts()[api::JobState::queued], 10U);
}

TYPED_TEST(Replicas, ShowNothingOfTheSetpointsOfALostAttempt) {
  const std::string id = insert_id(*this->here);
  const Attempt stale{id, claim(*this->here, 1000, "a", 500)->token};
  StoppingNearTheEnd stopping;
  EXPECT_THROW(this->here->succeed(stale, NoisyRows::plan(1), 1100, nothing_seen, stopping), Stopped);
  EXPECT_FALSE(this->here->series(id)) << "pieces are stored, and nobody sees them";
  const auto again = claim(*this->other, 1500, "b", 500);
  ASSERT_TRUE(again);
  EXPECT_FALSE(this->here->succeed(stale, NoisyRows::plan(1), 1600, nothing_seen, this->silent));
  ASSERT_TRUE(this->other->succeed({id, again->token}, NoisyRows::plan(2), 1700, nothing_seen, this->silent));
  EXPECT_FALSE(this->here->succeed(stale, NoisyRows::plan(1), 1800, nothing_seen, this->silent));
  for (Expired expired = this->here->expire(1900); expired.next; expired = this->here->expire(1900)) {
  }
  const auto series = this->here->series(id);
  ASSERT_TRUE(series);
  std::vector<double> chunk, expected(2 * 4096);
  for (std::size_t first = 0; first + 4096 <= series->count; first += 4096) {
    this->here->read_chunk(*series, first, chunk);
    NoisyRows(2).read(first, 4096, expected.data());
    ASSERT_EQ(chunk, expected) << "row " << first;
  }
}

TYPED_TEST(Replicas, CancelWhatAnotherRuns) {
  const std::string id = insert_id(*this->here);
  const Attempt attempt{id, claim(*this->here, 1000, "a", 500)->token};
  this->other->cancel(id, 1100);
  EXPECT_TRUE(this->here->cancel_requested(id));
  EXPECT_TRUE(this->here->requeue(attempt, 1200, 7));
  EXPECT_EQ(this->other->get(id)->state, api::JobState::cancelled);
}

}  // namespace
}  // namespace bahnwerk::server
