#include "core/base/read_rows.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

/// Row k: k, −k.
class Counted final : public SetpointSource {
 public:
  explicit Counted(std::size_t count) : count_(count) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return count_; }
  double cycle_time() const override { return 0.5; }
  double duration() const override { return 0.5 * static_cast<double>(count_ - 1); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k)
      *out++ = static_cast<double>(k), *out++ = -static_cast<double>(k);
  }

 private:
  std::size_t count_;
  std::vector<Column> columns_{{"a", "mm"}, {"b", "1"}};
};

TEST(ReadRows, EveryRowIsVisitedOnceInOrder) {
  for (const std::size_t count : {0u, 1u, 1023u, 1024u, 1025u, 5000u}) {
    const Counted source(count);
    std::size_t next = 0, told = 0;
    for_each_row(
        source,
        [&](std::size_t k, const double* row) {
          EXPECT_EQ(k, next++);
          EXPECT_EQ(row[0], static_cast<double>(k));
          EXPECT_EQ(row[1], -static_cast<double>(k));
        },
        [&](std::size_t done, std::size_t since) {
          EXPECT_EQ(done, next);
          EXPECT_EQ(done - told, since);
          told = done;
        });
    EXPECT_EQ(next, count);
    EXPECT_EQ(told, count);
  }
}

TEST(ReadRows, AColumnIsFoundByItsName) {
  const Counted source(1);
  EXPECT_EQ(column_index(source.columns(), "b"), 1u);
  EXPECT_EQ(column_index(source.columns(), "c"), 2u);
}

TEST(ReadRows, NobodyNeedsToBeToldHowFarItIs) {
  std::size_t next = 0;
  for_each_row(Counted(1500), [&](std::size_t k, const double* row) {
    EXPECT_EQ(k, next++);
    EXPECT_EQ(row[1], -static_cast<double>(k));
  });
  EXPECT_EQ(next, 1500u);
}

}  // namespace
}  // namespace bahnwerk
