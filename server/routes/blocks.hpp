#pragma once
/// Which part of a job's document takes how long, from the stored views.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "api/views/block_list.hpp"
#include "server/routes/stored_series.hpp"

namespace bahnwerk::server {

/// Returns the segments of a series with views. Throws Problem not-found where it has none.
api::SegmentTable require_segments(const api::SetpointSeries& series, const std::string& id);

/// Returns the page of the list of blocks that the query asks for, with texts of the job's program and limits.
nlohmann::ordered_json blocks_answer(Store& store, const std::string& id, const api::SetpointSeries& series,
                                     const api::SegmentTable& table, const api::BlockQuery& query);

}  // namespace bahnwerk::server
