#include "server/routes/stored_series.hpp"

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/views/view_facts.hpp"
#include "core/base/progress.hpp"
#include "server/routes/stored_document.hpp"

namespace bahnwerk::server {
namespace {

/// Returns what the views need of the stored document; nothing where this version refuses it.
std::shared_ptr<const api::ViewFacts> facts_of(Context& context, const std::string& id) {
  return of_stored_spec(context, id, [](const StoredSpec& stored) -> std::shared_ptr<const api::ViewFacts> {
    Progress progress;
    return stored.kind->view_facts ? stored.kind->view_facts(stored.spec, progress) : nullptr;
  });
}

}  // namespace

SeriesInfo require_series(Context& context, const std::string& id) {
  auto info = context.store.series(id);
  if (!info) throw api::Problem("not-found", "The job " + api::shortened(id) + " has no setpoints.");
  return std::move(*info);
}

SeriesInfo require_views(Context& context, const std::string& id) {
  SeriesInfo info = require_series(context, id);
  if (info.views == api::views_version) return info;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  info = require_series(context, id);  // another request may have made them
  if (info.views == api::views_version) return info;
  constexpr std::size_t bytes_at_once = 4 << 20;
  std::vector<api::ViewPart> parts;
  std::size_t bytes = 0;
  const auto keep = [&](api::ViewPart part) {
    bytes += part.bytes.size();
    parts.push_back(std::move(part));
    if (bytes < bytes_at_once) return;
    context.store.put_views(info, parts, false);
    parts.clear();
    bytes = 0;
  };
  api::make_views({info.columns, info.count, info.cycle_time, facts_of(context, id)}, keep,
                  stored_series(context, info).read);
  context.store.put_views(info, parts, true);
  info.views = api::views_version;
  return info;
}

api::ViewReader view_reader(Store& store, const SeriesInfo& info) {
  return [&store, info](std::string_view name, std::size_t part) { return store.read_view(info, name, part); };
}

api::SetpointSeries stored_series(Context& context, const SeriesInfo& info) {
  struct Chunk {
    std::size_t first = static_cast<std::size_t>(-1);
    std::vector<double> values;
  };
  api::SetpointSeries series;
  series.columns = info.columns;
  series.count = info.count;
  series.cycle_time = info.cycle_time;
  series.independent = info.independent;
  series.pose_frame = info.pose_frame;
  if (info.views == api::views_version) series.view = view_reader(context.store, info);
  series.read = [&store = context.store, &metrics = context.metrics, info, chunk = std::make_shared<Chunk>()](
                    std::size_t first, std::size_t rows, std::vector<double>& out) {
    const std::size_t width = info.columns.size();
    out.resize(rows * width);
    for (std::size_t done = 0; done < rows;) {
      const std::size_t at = first + done, start = at - at % info.chunk_rows;
      if (chunk->first != start) {
        store.read_chunk(info, start, chunk->values);
        chunk->first = start;
        metrics.rows_read(chunk->values.size() / width);
      }
      const std::size_t take = std::min(rows - done, start + info.chunk_rows - at);
      std::copy_n(chunk->values.begin() + static_cast<std::ptrdiff_t>((at - start) * width), take * width,
                  out.begin() + static_cast<std::ptrdiff_t>(done * width));
      done += take;
    }
  };
  return series;
}

}  // namespace bahnwerk::server
