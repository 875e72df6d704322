#pragma once
/// The answer to GET …/blocks: blocks, segments or lines with their times and what they lose.
#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "api/views/segments.hpp"

namespace bahnwerk::api {

enum class ListedBy { block, segment, line };
enum class ListOrder { start, time, lost };

struct BlockQuery {
  ListedBy by = ListedBy::block;
  ListOrder sort = ListOrder::start;  ///< time and lost time: the largest first
  std::size_t first = 0, count = 100;
  static constexpr std::size_t most = 1000;
};
/// Parses a decoded query string. Throws Problem schema-violation with pointers like /query/sort.
BlockQuery parse_block_query(const std::vector<std::pair<std::string, std::string>>& query);

/// An entry of the list. A line that is driven several times is one entry.
struct ListedBlock {
  std::size_t number = 0;  ///< number of the block, of the segment in the order of driving, or of the line
  std::size_t source = 0;  ///< line of the program, or segment of the document, that is driven first
  bool cut = false;
  double start = 0, end = 0;  ///< s: begin of the first visit, end of the last one
  std::size_t visits = 0, stops = 0;
  double length = 0, time = 0, least_time = 0;
  double feed = 0;  ///< largest one, mm/s; infinite: none
};
/// Returns all entries in the order asked for; the earlier ones of equals first. O(n log n).
std::vector<ListedBlock> list_blocks(const SegmentTable& table, ListedBy by, ListOrder sort);

/// The limit that is met during most of an interval of time, and the fraction of the time.
struct MainLimit {
  std::string name;
  double share = 0;
};
struct BlockTexts {
  std::function<std::string(std::size_t line)> line;  ///< text of a line of the program; empty: none
  /// Returns the main limit of intervals of time, s, in ascending order; empty: it is unknown.
  std::function<MainLimit(const std::vector<std::pair<double, double>>& intervals)> limit = {};
};
/// Returns the page of the list that the query asks for, with totals over all entries.
nlohmann::ordered_json blocks_document(const SegmentTable& table, const BlockQuery& query,
                                       const std::vector<ListedBlock>& list, const BlockTexts& texts);

}  // namespace bahnwerk::api
