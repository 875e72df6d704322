#include "core/base/row_check.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

/// Rows that hold their own number, and count how often each is computed.
class Numbers final : public SetpointSource {
 public:
  explicit Numbers(std::size_t rows) : computed(rows) {}
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return computed.size(); }
  double cycle_time() const override { return 0.001; }
  double duration() const override { return 0.001 * static_cast<double>(computed.size() - 1); }
  void read(std::size_t first, std::size_t rows, double* out) const override {
    for (std::size_t k = first; k < first + rows; ++k) ++computed[k], *out++ = static_cast<double>(k);
  }
  mutable std::vector<int> computed;

 private:
  std::vector<Column> columns_{{"k", "1"}};
};

class Sum final : public RowCheck {
 public:
  explicit Sum(bool reads) : reads_(reads) {}
  void row(std::size_t k, const double* row) override {
    EXPECT_EQ(k, next_++);
    EXPECT_EQ(row[0], static_cast<double>(k));
    sum_ += row[0];
  }
  bool reads() const override { return reads_; }
  std::vector<Check> checks() override { return {{named(CheckGroup::limit, "sum", "1"), 0, sum_, 0, true}}; }

 private:
  bool reads_;
  std::size_t next_ = 0;
  double sum_ = 0;
};

TEST(RowCheck, AllChecksShareOnePass) {
  const Numbers numbers(5000);
  RowChecks all;
  for (const bool reads : {true, false, true}) all.push_back(std::make_unique<Sum>(reads));
  Progress progress;
  ProgressScope scope(progress, "rows");
  read_rows(numbers, all, scope);
  for (const int times : numbers.computed) ASSERT_EQ(times, 1);
  EXPECT_EQ(all[0]->checks()[0].value, 4999 * 2500.0);
  EXPECT_EQ(all[1]->checks()[0].value, 0) << "it has nothing to look at";
  EXPECT_EQ(all[2]->checks()[0].value, 4999 * 2500.0);
}

TEST(RowCheck, NoRowIsComputedWithoutAReader) {
  const Numbers numbers(10);
  RowChecks all;
  all.push_back(std::make_unique<Sum>(false));
  Progress progress;
  ProgressScope scope(progress, "rows");
  read_rows(numbers, all, scope);
  EXPECT_EQ(numbers.computed, std::vector<int>(10, 0));
}

TEST(RowCheck, OneAloneReadsTheSeriesForItself) {
  const Numbers numbers(3);
  Progress progress;
  ProgressScope scope(progress, "rows");
  EXPECT_EQ(check_rows(numbers, std::make_unique<Sum>(true), scope).at(0).value, 3);
}

}  // namespace
}  // namespace bahnwerk
