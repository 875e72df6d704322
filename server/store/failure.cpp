#include "server/store/failure.hpp"

#include "server/store/values.hpp"

namespace bahnwerk::server {

void log_failure(std::string_view event, const std::exception& error, log::Fields fields) {
  if (dynamic_cast<const StoreAway*>(&error) || dynamic_cast<const StoreReadOnly*>(&error)) return;
  fields.push_back({"detail", std::string(error.what())});
  log::error(event, fields);
}

}  // namespace bahnwerk::server
