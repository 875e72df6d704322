#pragma once
/// The views of a job's setpoints as they are stored.
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "api/views/views.hpp"
#include "server/routes/context.hpp"

namespace bahnwerk::server {

struct StoredViews {
  SeriesInfo series;
  api::ViewReader read;
  /// Reads rows, row-major; the last chunk is kept.
  std::function<void(std::size_t first, std::size_t rows, std::vector<double>& out)> rows;
};
/// Returns the views of a job that succeeded. Those of a job of an older version are made from its rows and its
/// document and stored first, which takes some µs per row. Throws Problem not-found if the job has no setpoints.
StoredViews stored_views(Context& context, const std::string& id);

}  // namespace bahnwerk::server
