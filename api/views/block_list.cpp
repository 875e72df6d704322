#include "api/views/block_list.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <unordered_map>

#include "api/text/query_values.hpp"
#include "core/base/named.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

constexpr Named<ListedBy> groupings[] = {
    {ListedBy::block, "block"}, {ListedBy::segment, "segment"}, {ListedBy::line, "line"}};
constexpr Named<ListOrder> orders[] = {
    {ListOrder::start, "start"}, {ListOrder::time, "time"}, {ListOrder::lost, "lost"}};

template <class T, std::size_t N>
T one_of(const std::string& name, const std::string& value, const Named<T> (&list)[N]) {
  std::string known;
  for (const auto& each : list) {
    if (each.name == value) return each.value;
    known += (known.empty() ? "" : ", ") + std::string(each.name);
  }
  refuse_parameter(name, "must be one of " + known);
}

std::size_t whole_number(const std::string& name, const std::string& value) {
  const auto number = natural(value);
  if (!number) refuse_parameter(name, "must be a whole number");
  return *number;
}

void add(ListedBlock& entry, const PlannedSegment& segment) {
  entry.end = segment.start + segment.time;
  entry.time += segment.time;
  entry.length += segment.length;
  entry.least_time += segment.least_time;
  entry.stops += segment.rests ? 1 : 0;
  entry.feed = std::max(entry.feed, segment.feed);
}

ListedBlock begin_entry(const PlannedSegment& segment, std::size_t number) {
  ListedBlock entry;
  entry.number = number;
  entry.source = segment.source;
  entry.cut = segment.cut;
  entry.start = segment.start;
  return entry;
}

double lost(const ListedBlock& entry) { return entry.time - entry.least_time; }

std::size_t key_of(const SegmentTable& table, ListedBy by, std::size_t i) {
  const PlannedSegment& segment = table.segments[i];
  return by == ListedBy::block ? segment.block : by == ListedBy::line ? segment.source : i;
}

/// Returns the entries in the order of their first visits.
std::vector<ListedBlock> gathered(const SegmentTable& table, ListedBy by) {
  std::vector<ListedBlock> list;
  std::unordered_map<std::size_t, std::size_t> places;  // places of blocks and lines in the list
  std::size_t last = static_cast<std::size_t>(-1);      // place of the entry that is being visited
  for (std::size_t i = 0; i < table.segments.size(); ++i) {
    const PlannedSegment& segment = table.segments[i];
    const std::size_t key = key_of(table, by, i);
    std::size_t place = list.size();
    if (by != ListedBy::segment) place = places.try_emplace(key, list.size()).first->second;
    if (place == list.size()) list.push_back(begin_entry(segment, key));
    if (place != last) ++list[place].visits;
    add(list[place], segment);
    last = place;
  }
  return list;
}

ordered_json or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

using Intervals = std::vector<std::pair<double, double>>;

/// Returns when the entries of a page are driven.
std::vector<Intervals> intervals_of(const SegmentTable& table, ListedBy by, std::span<const ListedBlock> page) {
  std::unordered_map<std::size_t, std::size_t> places;
  for (std::size_t i = 0; i < page.size(); ++i) places[page[i].number] = i;
  std::vector<Intervals> list(page.size());
  for (std::size_t i = 0; i < table.segments.size(); ++i) {
    const auto place = places.find(key_of(table, by, i));
    if (place == places.end()) continue;
    const PlannedSegment& segment = table.segments[i];
    Intervals& intervals = list[place->second];
    const double end = segment.start + segment.time;
    if (!intervals.empty() && intervals.back().second == segment.start)
      intervals.back().second = end;
    else
      intervals.emplace_back(segment.start, end);
  }
  return list;
}

ordered_json entry_document(const ListedBlock& entry, const SegmentTable& table, const char* by,
                            const BlockTexts& texts, const Intervals& intervals) {
  ordered_json out{{by, entry.number}};
  out[table.program ? "line" : "source"] = entry.source;
  std::string text = table.program && texts.line ? texts.line(entry.source) : std::string();
  out["text"] = table.program ? ordered_json(std::move(text)) : ordered_json();
  out["mode"] = entry.cut ? "cut" : "position";
  out["start_time"] = entry.start;
  out["end_time"] = entry.end;
  out["visits"] = entry.visits;
  out["length"] = entry.length;
  out["feed"] = or_null(entry.feed);
  out["time"] = entry.time;
  out["lost"] = lost(entry);
  out["mean_speed"] = entry.time > 0 ? entry.length / entry.time : 0;
  const MainLimit limit = texts.limit ? texts.limit(intervals) : MainLimit{};
  out["limit"] = limit.name.empty() ? ordered_json() : ordered_json(limit.name);
  out["limit_share"] = limit.share;
  out["stops"] = entry.stops;
  return out;
}

}  // namespace

BlockQuery parse_block_query(const std::vector<std::pair<std::string, std::string>>& query) {
  BlockQuery out;
  for (const auto& [name, value] : query) {
    if (name == "by") out.by = one_of(name, value, groupings);
    if (name == "sort") out.sort = one_of(name, value, orders);
    if (name == "first") out.first = whole_number(name, value);
    if (name == "count") out.count = whole_number(name, value);
  }
  if (out.count == 0 || out.count > BlockQuery::most) refuse_parameter("count", "must be between 1 and 1000");
  return out;
}

std::vector<ListedBlock> list_blocks(const SegmentTable& table, ListedBy by, ListOrder sort) {
  if (by == ListedBy::line && !table.program) refuse_parameter("by", "line is for programs; this contour has segments");
  std::vector<ListedBlock> list = gathered(table, by);
  const auto by_figure = [&](auto figure) {
    std::stable_sort(list.begin(), list.end(),
                     [&](const ListedBlock& a, const ListedBlock& b) { return figure(a) > figure(b); });
  };
  if (sort == ListOrder::time) by_figure([](const ListedBlock& e) { return e.time; });
  if (sort == ListOrder::lost) by_figure(lost);
  return list;
}

ordered_json blocks_document(const SegmentTable& table, const BlockQuery& query, const std::vector<ListedBlock>& list,
                             const BlockTexts& texts) {
  double time = 0, length = 0, to_feed = 0, to_axes = 0;
  for (const PlannedSegment& segment : table.segments) {
    time += segment.time;
    length += segment.length;
    (std::isfinite(segment.feed) ? to_feed : to_axes) += segment.time - segment.least_time;
  }
  const char* const by = name_of<ListedBy>(query.by, groupings);
  ordered_json page = ordered_json::array();
  const std::size_t first = std::min(query.first, list.size()), count = std::min(query.count, list.size() - first);
  const std::span<const ListedBlock> shown(list.data() + first, count);
  const std::vector<Intervals> intervals =
      texts.limit ? intervals_of(table, query.by, shown) : std::vector<Intervals>(count);
  for (std::size_t i = 0; i < count; ++i) page.push_back(entry_document(shown[i], table, by, texts, intervals[i]));
  return {{"by", by},
          {"sort", name_of<ListOrder>(query.sort, orders)},
          {"first", query.first},
          {"total", list.size()},
          {"time", time},
          {"length", length},
          {"lost", {{"to_feed", to_feed}, {"to_axes", to_axes}}},
          {"blocks", std::move(page)}};
}

}  // namespace bahnwerk::api
