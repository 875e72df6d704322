#pragma once
/// The setpoints of a job that succeeded, as handlers read them.
#include <string>

#include "api/setpoints/setpoints.hpp"
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// Returns the properties of the job's setpoints. Throws Problem not-found where it has none.
SeriesInfo require_series(Context& context, const std::string& id);
/// Acts like require_series() and makes the views of a job that was stored without the present ones. That reads all
/// rows once: about 1 s for 10^6 rows.
SeriesInfo require_views(Context& context, const std::string& id);

/// Returns a function that reads the stored views. The store must outlive it.
api::ViewReader view_reader(Store& store, const SeriesInfo& info);
/// Returns the series, read chunk by chunk; the last chunk is kept, because rows are read in order, and each one read
/// is counted. It has views where these are present. The context must outlive it.
api::SetpointSeries stored_series(Context& context, const SeriesInfo& info);

}  // namespace bahnwerk::server
