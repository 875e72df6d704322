#include "server/store/sqlite/views.hpp"

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

struct ViewsTest : StoreTest {
  std::string succeeded(std::size_t rows) {
    const std::string id = insert_id(*store);
    claim(*store, 1);
    EXPECT_TRUE(store->succeed({id, 1}, ramp_plan(rows), 2, nothing_seen, silent));
    return id;
  }
  int stored() {
    SqliteConnection connection((folder.path / "store.db").string(), false);
    return connection.query("SELECT count(*) FROM views").one_int();
  }
};

TEST_F(ViewsTest, ASucceededSeriesHasViewsOfTheCurrentVersion) {
  const std::string id = succeeded(10);
  EXPECT_EQ(store->series(id)->views, api::views_version);
}

TEST_F(ViewsTest, PartsAreReadByNameAndNumberAndReplacedByLaterOnes) {
  const auto series = *store->series(succeeded(10));
  store->put_views(series, {{"thing", 0, "first"}, {"thing", 7, std::string("a\0b", 3)}}, false);
  store->put_views(series, {{"thing", 0, "again"}, {"other", 0, ""}}, true);
  EXPECT_EQ(store->read_view(series, "thing", 0), "again");
  EXPECT_EQ(store->read_view(series, "thing", 7), std::string("a\0b", 3));
  EXPECT_EQ(store->read_view(series, "other", 0), "");
  EXPECT_FALSE(store->read_view(series, "thing", 1));
  EXPECT_FALSE(store->read_view(series, "none", 0));
}

TEST_F(ViewsTest, ASeriesWithoutViewsHasThemAfterTheLastPart) {
  const std::string id = succeeded(10);
  {
    SqliteConnection connection((folder.path / "store.db").string(), true);
    connection.execute("UPDATE results SET views = 0");
  }
  const auto series = *store->series(id);
  EXPECT_EQ(series.views, 0);
  store->put_views(series, {{"thing", 0, "x"}}, false);
  EXPECT_EQ(store->series(id)->views, 0) << "there are more parts";
  store->put_views(series, {}, true);
  EXPECT_EQ(store->series(id)->views, api::views_version);
}

TEST_F(ViewsTest, ViewsAreRemovedWithTheirJobInPieces) {
  const std::string id = succeeded(10);
  const auto series = *store->series(id);
  std::string noise(3 << 20, '\0');
  std::uint32_t state = 1;
  for (char& c : noise) c = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
  for (std::size_t part = 0; part < 3; ++part) store->put_views(series, {{"noise", part, noise}}, part == 2);
  EXPECT_GE(stored(), 3);
  EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_EQ(stored(), 0);
  EXPECT_THROW(store->put_views(series, {{"late", 0, "x"}}, true), StoreError) << "the job is gone";
  EXPECT_EQ(stored(), 0);
}

}  // namespace
}  // namespace bahnwerk::server
