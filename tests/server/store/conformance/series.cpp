#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct Series : Conformance<S> {};
TYPED_TEST_SUITE(Series, Stores, StoreNames);

TYPED_TEST(Series, GivesBackEveryRowAcrossChunks) {
  auto& store = this->here;
  constexpr std::size_t count = 3 * 4096 + 17;
  const std::string id = insert_id(*store);
  claim(*store, 1);
  ASSERT_TRUE(store->succeed({id, 1}, ramp_plan(count), 2, nothing_seen, this->silent));
  const auto series = store->series(id);
  ASSERT_TRUE(series);
  EXPECT_EQ(series->count, count);
  ASSERT_EQ(series->columns.size(), 2U);
  EXPECT_EQ(series->columns[1].name, "y");
  std::vector<double> all, chunk;
  for (std::size_t first = 0; first < count; first += series->chunk_rows) {
    store->read_chunk(*series, first, chunk);
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  std::vector<double> expected(count * 2);
  Ramp(count).read(0, count, expected.data());
  EXPECT_EQ(all, expected);
  EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_THROW(store->read_chunk(*series, 0, chunk), StoreError);
  EXPECT_FALSE(store->result(id));
}

TYPED_TEST(Series, KnowsPlansWithoutSetpoints) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  claim(*store, 1);
  ASSERT_TRUE(store->succeed({id, 1}, ramp_plan(0), 2, nothing_seen, this->silent));
  EXPECT_TRUE(store->result(id));
  EXPECT_FALSE(store->series(id));
}

}  // namespace
}  // namespace bahnwerk::server
