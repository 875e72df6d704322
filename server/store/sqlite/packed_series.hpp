#pragma once
/// A plan's setpoints on their way into the store, with bounded memory: what fits a budget is packed before the
/// transaction starts (so that it is short), the rest is packed inside it, chunk by chunk.
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/plan.hpp"

namespace bahnwerk::server {

class PackedSeries {
 public:
  static constexpr std::size_t chunk_rows = 4096;
  /// `source` may be nullptr (a plan without setpoints) and must outlive this. `budget`: bytes of packed chunks kept in
  /// memory.
  explicit PackedSeries(const SetpointSource* source, std::size_t budget = std::size_t{64} << 20);
  /// Calls `store(first row, rows, packed)` for every chunk in order; repeatable.
  void each(const std::function<void(std::size_t, std::size_t, const std::string&)>& store) const;

 private:
  std::string pack(std::size_t first, std::size_t rows) const;
  const SetpointSource* source_;
  std::vector<std::string> ready_;
};

}  // namespace bahnwerk::server
