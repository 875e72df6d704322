#include "server/store/sqlite/reserve.hpp"

#include <sys/stat.h>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

std::int64_t allocated(const std::filesystem::path& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 ? static_cast<std::int64_t>(info.st_blocks) * 512 : -1;
}

TEST(Reserve, HoldsSpaceAndGivesItUp) {
  const TempFolder folder;
  const auto path = folder.path / "reserve";
  Reserve reserve(path, 1 << 20);
  EXPECT_FALSE(reserve.held());
  EXPECT_TRUE(reserve.take());
  EXPECT_TRUE(reserve.held());
  EXPECT_GE(allocated(path), 1 << 20) << "really there, not a hole";
  reserve.give_up();
  EXPECT_FALSE(reserve.held());
  EXPECT_EQ(allocated(path), 0);
  EXPECT_TRUE(reserve.take());
  Reserve smaller(path, 1 << 16);  // the next start
  EXPECT_TRUE(smaller.take());
  EXPECT_LT(allocated(path), 1 << 20);
  EXPECT_GT(smaller.free_space(), 0U);
}

TEST(Reserve, MoreThanThereIsIsNotHeld) {
  const TempFolder folder;
  const auto path = folder.path / "reserve";
  Reserve much(path, std::size_t{1} << 60);
  EXPECT_FALSE(much.take());
  EXPECT_FALSE(much.held());
  EXPECT_LE(allocated(path), 4096) << "nothing of it is kept";
}

TEST(Reserve, NoneIsAlwaysHeld) {
  Reserve none("/nowhere/reserve", 0);
  EXPECT_TRUE(none.take());
  none.give_up();
  EXPECT_TRUE(none.held());
}

/// A store whose reserve cannot be had stands for a full disk: nothing is taken in, everything can go.
TEST_F(StoreTest, WithoutItsReserveTakesNothingInButLetsGo) {
  const std::string queued = insert_id(*store), running = insert_id(*store, new_job(1)), ended = insert_id(*store);
  ASSERT_EQ(claim(*store, 1)->id, running);
  ASSERT_EQ(store->cancel(ended, 1)->state, api::JobState::cancelled);
  SqliteOptions options;
  options.reserve = std::size_t{1} << 60;
  store.reset();
  open(options);  // the running one is an orphan: queued again
  const auto is_full = [](const auto& call) {
    try {
      call();
    } catch (const StoreError& error) {
      return error.full;
    }
    return false;
  };
  EXPECT_TRUE(is_full([&] { store->ping(); }));
  EXPECT_TRUE(is_full([&] { insert_id(*store); }));
  EXPECT_TRUE(is_full([&] { claim(*store, 1); }));
  EXPECT_EQ(store->cancel(queued, 2)->state, api::JobState::cancelled);
  EXPECT_EQ(store->remove(ended), Removed::yes);
  EXPECT_FALSE(store->get(ended));
  EXPECT_EQ(store->counts()[api::JobState::queued], 1U);
  store.reset();
  open();
  EXPECT_NO_THROW(store->ping());
  EXPECT_EQ(claim(*store, 3)->id, running);
}

}  // namespace
}  // namespace bahnwerk::server
