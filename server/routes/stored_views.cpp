#include "server/routes/stored_views.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "api/kind.hpp"
#include "api/problem.hpp"
#include "api/text/pointer.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t bytes_at_once = 1 << 20;

/// Reads rows in order, chunk by chunk.
class Rows {
 public:
  Rows(Store& store, const SeriesInfo& series) : store_(store), series_(series) {}
  void operator()(std::size_t first, std::size_t rows, std::vector<double>& out) {
    const std::size_t width = series_.columns.size();
    out.clear();
    for (std::size_t row = first; row < first + rows;) {
      const std::size_t begin = row - row % series_.chunk_rows;
      if (begin != begin_ || chunk_.empty()) store_.read_chunk(series_, begin_ = begin, chunk_);
      const std::size_t end = std::min(first + rows, begin + series_.chunk_rows);
      out.insert(out.end(), chunk_.begin() + static_cast<std::ptrdiff_t>((row - begin) * width),
                 chunk_.begin() + static_cast<std::ptrdiff_t>((end - begin) * width));
      row = end;
    }
  }

 private:
  Store& store_;
  const SeriesInfo series_;
  std::size_t begin_ = 0;
  std::vector<double> chunk_;
};

void make_missing(Context& context, const std::string& id, const SeriesInfo& series) {
  const auto job = context.store.get(id);
  if (!job) throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
  const api::Kind* const kind = api::find_kind(job->request.kind);
  api::ViewInput input{series.columns, series.count, series.cycle_time};
  SilentProgress progress;
  if (kind && kind->view_facts) input.facts = kind->view_facts(api::job_spec(job->request.document), progress);
  std::vector<api::ViewPart> parts;
  std::size_t bytes = 0;
  const auto sink = [&](api::ViewPart part) {
    bytes += part.bytes.size();
    parts.push_back(std::move(part));
    if (bytes < bytes_at_once) return;
    context.store.put_views(series, parts, false);
    parts.clear();
    bytes = 0;
  };
  Rows rows(context.store, series);
  api::make_views(input, sink, std::ref(rows));
  context.store.put_views(series, parts, true);
}

}  // namespace

StoredViews stored_views(Context& context, const std::string& id) {
  auto series = context.store.series(id);
  if (!series) throw api::Problem("not-found", "The job " + api::shortened(id) + " has no setpoints.");
  if (series->views != api::views_version) {
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    series = context.store.series(id);
    if (series && series->views != api::views_version) make_missing(context, id, *series);
    series = context.store.series(id);
    if (!series) throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
  }
  return {*series,
          [&store = context.store, info = *series](std::string_view name, std::size_t part) {
            return store.read_view(info, name, part);
          },
          Rows(context.store, *series)};
}

}  // namespace bahnwerk::server
