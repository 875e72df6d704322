#pragma once
/// The filter of a list of jobs, as the parameters of an address give it.
#include "server/http/message.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// Reads state, kind, reference, tag, text, sort (newest, oldest), created_after, created_before, before, limit (1 to
/// 200) and cursor (the `next` of a former page). Throws Problem schema-violation where a value is not valid.
JobFilter parse_filter(const Pairs& query);

}  // namespace bahnwerk::server
