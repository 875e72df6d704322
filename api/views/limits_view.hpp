#pragma once
/// The limit of every row: how many rows of an interval belong to each, and where limits change.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "api/views/buckets.hpp"
#include "api/views/row_limits.hpp"
#include "api/views/views.hpp"

namespace bahnwerk::api {

/// The view: numbers of rows (a byte each), counts in cells of 512 rows and more, changes of limits that have a key,
/// and the envelope of the column "use".
std::unique_ptr<View> make_limits(const ViewInput& input, const ViewSink& sink);

/// From row `first` up to the next change, a limit permits this.
struct LimitChange {
  std::size_t first = 0;
  Permitted permitted;
};

/// Reads the view of a series of `count` rows.
class LimitsReader {
 public:
  using Counts = std::vector<std::uint64_t>;  ///< one per number

  /// Throws std::runtime_error if the view is missing.
  LimitsReader(ViewReader read, std::size_t count);

  const DeclaredLimits& list() const { return list_; }
  const std::string& column(std::size_t declared) const { return columns_[declared]; }
  std::size_t numbers() const { return row_states + list_.size(); }
  /// Returns the name of a number: ahead, stop, dwell, or that of a declared limit.
  std::string name(std::size_t number) const;
  /// Returns how many of rows [from, to) belong to each number.
  Counts count(std::size_t from, std::size_t to);
  /// Returns the changes of a limit in rows [from, to), beginning with what is permitted at `from`; at most `most`.
  std::vector<LimitChange> changes(std::size_t declared, std::size_t from, std::size_t to, std::size_t most);

 private:
  std::vector<LimitChange> change_part(std::size_t declared, std::size_t part);
  const std::string& part(const std::string& name, std::size_t number, std::size_t slot);
  ViewReader read_;
  std::size_t count_;
  DeclaredLimits list_;
  std::vector<std::string> columns_;
  std::vector<std::size_t> change_parts_;  // per declared limit
  // Per level, then the rows: the last part that was read.
  std::vector<std::pair<std::size_t, std::string>> parts_;
};

/// Returns the number that most rows belong to, the smaller of equal ones.
std::size_t most_frequent(const LimitsReader::Counts& counts);

}  // namespace bahnwerk::api
