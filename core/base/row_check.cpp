#include "core/base/row_check.hpp"

#include <utility>

#include "core/base/read_rows.hpp"

namespace bahnwerk {

namespace {
constexpr std::size_t units_per_row = 4;  // units of work per row, for progress
}

void read_rows(const SetpointSource& setpoints, std::span<const std::unique_ptr<RowCheck>> all,
               ProgressScope& progress) {
  std::vector<RowCheck*> readers;
  for (const auto& each : all)
    if (each->reads()) readers.push_back(each.get());
  if (readers.empty()) return;
  const double rows = static_cast<double>(setpoints.count());
  for_each_row(
      setpoints,
      [&](std::size_t k, const double* row) {
        for (RowCheck* reader : readers) reader->row(k, row);
      },
      [&](std::size_t done, std::size_t count) {
        progress.done(static_cast<double>(done) / rows);
        progress.work(count * units_per_row * readers.size());
      });
}

std::vector<Check> check_rows(const SetpointSource& setpoints, std::unique_ptr<RowCheck> check,
                              ProgressScope& progress) {
  progress.report();
  const RowChecks one = [&] {
    RowChecks list;
    list.push_back(std::move(check));
    return list;
  }();
  read_rows(setpoints, one, progress);
  progress.done(1);
  progress.report();
  return one.front()->checks();
}

}  // namespace bahnwerk
