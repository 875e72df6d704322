#include "server/store/sqlite/packed_series.hpp"

#include <algorithm>

#include "server/store/codec.hpp"

namespace bahnwerk::server {

PackedSeries::PackedSeries(const SetpointSource* source, std::size_t budget) : source_(source) {
  if (!source_) return;
  std::size_t kept = 0;
  for (std::size_t first = 0; first < source_->count() && kept < budget; first += chunk_rows) {
    ready_.push_back(pack(first, std::min(chunk_rows, source_->count() - first)));
    kept += ready_.back().size();
  }
}

std::string PackedSeries::pack(std::size_t first, std::size_t rows) const {
  const std::size_t columns = source_->columns().size();
  std::vector<double> values(rows * columns);
  source_->read(first, rows, values.data());
  return pack_rows(values.data(), rows, columns);
}

void PackedSeries::each(const std::function<void(std::size_t, std::size_t, const std::string&)>& store) const {
  if (!source_) return;
  std::size_t index = 0;
  for (std::size_t first = 0; first < source_->count(); first += chunk_rows, ++index) {
    const std::size_t rows = std::min(chunk_rows, source_->count() - first);
    store(first, rows, index < ready_.size() ? ready_[index] : pack(first, rows));
  }
}

}  // namespace bahnwerk::server
