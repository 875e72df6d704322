#include "server/routes/blocks.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/text/json_member.hpp"
#include "api/views/limits_view.hpp"

namespace bahnwerk::server {
namespace {

/// Texts of lines of the job's program, which is read up to the last of them.
class ProgramLines {
 public:
  ProgramLines(Store& store, const std::string& id, const std::set<std::size_t>& lines) {
    const auto document = store.open_document(id);
    if (!document || lines.empty()) return;
    api::JsonMember member({"spec", "contour", "gcode"});
    std::string piece, text;
    while (number_ <= *lines.rbegin() && !member.ended() && document->next(piece)) {
      member.take(piece, text);
      piece.clear();
      take(text, lines);
      text.clear();
    }
    end_line(lines);
  }
  std::string operator()(std::size_t line) const {
    const auto at = texts_.find(line);
    return at == texts_.end() ? "" : at->second;
  }

 private:
  static constexpr std::size_t longest = 200;  // bytes of a line that are shown

  void take(std::string_view text, const std::set<std::size_t>& lines) {
    for (const char c : text) {
      if (c == '\n' && after_return_) {  // CR LF ends one line
        after_return_ = false;
        continue;
      }
      after_return_ = c == '\r';
      if (c == '\n' || c == '\r')
        end_line(lines);
      else if (line_.size() < longest)
        line_ += c;
    }
  }
  void end_line(const std::set<std::size_t>& lines) {
    if (lines.contains(number_)) texts_[number_] = line_;
    line_.clear();
    ++number_;
  }

  std::map<std::size_t, std::string> texts_;
  std::string line_;
  std::size_t number_ = 1;
  bool after_return_ = false;
};

using Intervals = std::vector<std::pair<double, double>>;

/// Returns the limit to which most cycles that begin in the intervals belong; of an interval without one, the cycle in
/// which it lies.
api::MainLimit main_limit(api::LimitsReader& limits, const api::SetpointSeries& series, const Intervals& intervals) {
  api::LimitsReader::Counts sum(limits.numbers());
  std::uint64_t all = 0;
  const auto cycle = [&](double time, double rounding) {
    return std::min(static_cast<std::size_t>(std::max(0.0, time / series.cycle_time + rounding)), series.count - 1);
  };
  for (const auto& [begin, end] : intervals) {
    std::size_t from = cycle(begin, 1 - 1e-6), to = cycle(end, 1 - 1e-6);
    if (from >= to) to = (from = cycle(begin, 1e-6)) + 1;
    const api::LimitsReader::Counts counts = limits.count(from, to);
    for (std::size_t number = 0; number < counts.size(); ++number) {
      sum[number] += counts[number];
      all += counts[number];
    }
  }
  if (all == 0) return {};
  const std::size_t most = api::most_frequent(sum);
  return {limits.name(most), static_cast<double>(sum[most]) / static_cast<double>(all)};
}

}  // namespace

api::SegmentTable require_segments(const api::SetpointSeries& series, const std::string& id) {
  auto table = api::read_segments(series.view);
  if (!table)
    throw api::Problem("not-found", "The job " + api::shortened(id) +
                                        " has no blocks: contours have them, since the version that stores them.");
  return std::move(*table);
}

nlohmann::ordered_json blocks_answer(Store& store, const std::string& id, const api::SetpointSeries& series,
                                     const api::SegmentTable& table, const api::BlockQuery& query) {
  const std::vector<api::ListedBlock> list = api::list_blocks(table, query.by, query.sort);
  std::set<std::size_t> lines;
  for (std::size_t i = query.first; i < list.size() && i - query.first < query.count; ++i) lines.insert(list[i].source);
  std::optional<ProgramLines> program;
  if (table.program) program.emplace(store, id, lines);
  const auto text = [&](std::size_t line) { return program ? (*program)(line) : std::string(); };
  api::LimitsReader limits(series.view, series.count);
  const auto limit = [&](const Intervals& intervals) { return main_limit(limits, series, intervals); };
  return api::blocks_document(table, query, list, {text, limit});
}

}  // namespace bahnwerk::server
