#include "api/views/segments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "api/views/bytes.hpp"
#include "api/views/view_facts.hpp"
#include "core/base/read_rows.hpp"

namespace bahnwerk::api {
namespace {

constexpr const char* view_name = "segments";
constexpr std::size_t part_size = 8192;  // segments
constexpr std::uint8_t cut_flag = 1, rests_flag = 2, program_flag = 4;

/// Appends a member of every segment of a part.
template <class Get>
void column(std::string& out, const PlannedSegment* segments, std::size_t count, const Get& get) {
  for (std::size_t i = 0; i < count; ++i) put(out, get(segments[i]));
}

std::string part_of(const PlannedSegment* segments, std::size_t count, bool program) {
  std::string out;
  put(out, static_cast<std::uint32_t>(count));
  put(out, segments->start);
  column(out, segments, count, [](const auto& s) { return s.source; });
  column(out, segments, count, [](const auto& s) { return s.block; });
  column(out, segments, count, [&](const auto& s) {
    return static_cast<std::uint8_t>((s.cut ? cut_flag : 0) | (s.rests ? rests_flag : 0) |
                                     (program ? program_flag : 0));
  });
  for (const auto member :
       {&PlannedSegment::time, &PlannedSegment::length, &PlannedSegment::feed, &PlannedSegment::least_time})
    column(out, segments, count, [member](const auto& s) { return static_cast<float>(s.*member); });
  return out;
}

void write_table(const SegmentTable& table, const ViewSink& sink) {
  const auto& all = table.segments;
  for (std::size_t first = 0; first < all.size(); first += part_size)
    sink({view_name, first / part_size,
          part_of(all.data() + first, std::min(part_size, all.size() - first), table.program)});
}

class SegmentView final : public View {
 public:
  SegmentView(std::shared_ptr<const SegmentTable> table, const ViewSink& sink)
      : table_(std::move(table)), sink_(sink) {}
  void add(std::size_t, std::size_t, const double*) override {}
  void finish() override { write_table(*table_, sink_); }

 private:
  std::shared_ptr<const SegmentTable> table_;
  const ViewSink& sink_;
};

/// Finds the times of a document's segments in the rows.
class RowSegments final : public View {
 public:
  RowSegments(const ViewInput& input, const ViewSink& sink)
      : table_(*input.facts->document),
        sink_(sink),
        step_(input.cycle_time),
        width_(input.columns.size()),
        s_(column_index(input.columns, "s")),
        v_(column_index(input.columns, "v")),
        block_(column_index(input.columns, "block")) {}
  bool possible() const { return std::max({s_, v_, block_}) < width_ && !table_.segments.empty(); }

  void add(std::size_t first, std::size_t rows, const double* values) override {
    for (std::size_t k = 0; k < rows; ++k, values += width_)
      row({static_cast<double>(first + k) * step_, values[s_], values[v_], static_cast<std::uint32_t>(values[block_])});
  }
  void finish() override {
    while (next_ < table_.segments.size()) begin(last_.time, last_.v);
    table_.segments[next_ - 1].time = last_.time - table_.segments[next_ - 1].start;
    write_table(table_, sink_);
  }

 private:
  struct Row {
    double time = 0, s = 0, v = 0;
    std::uint32_t block = 0;
  };
  static constexpr double at_rest = 1e-9, rounding = 1e-9;  // mm/s, mm

  /// Ends the segment before the next one, which begins.
  void begin(double time, double v) {
    PlannedSegment& next = table_.segments[next_];
    next.start = time;
    next.rests = std::abs(v) <= at_rest;
    if (next_ > 0) table_.segments[next_ - 1].time = time - table_.segments[next_ - 1].start;
    end_ += next.length;
    ++next_;
  }
  void row(const Row& now) {
    const auto& all = table_.segments;
    const auto slower = [&] { return std::min(std::abs(now.v), std::abs(last_.v)); };
    while (next_ < all.size() && all[next_].block < now.block) begin(now.time, slower());
    if (next_ < all.size() && all[next_].block == now.block && (next_ == 0 || all[next_ - 1].block < now.block)) {
      end_ = now.s;  // lengths count from where the block begins
      begin(now.time, slower());
    }
    while (next_ < all.size() && all[next_].block == now.block && now.s >= end_ - rounding) {
      const double way = now.s - last_.s, share = way > 0 ? std::clamp((end_ - last_.s) / way, 0.0, 1.0) : 1;
      begin(std::max(last_.time + share * (now.time - last_.time), all[next_ - 1].start), slower());
    }
    last_ = now;
  }

  SegmentTable table_;
  const ViewSink& sink_;
  double step_;
  std::size_t width_, s_, v_, block_;
  std::size_t next_ = 0;  // the segment that begins next
  double end_ = 0;        // mm, column s where it begins
  Row last_;
};

void append(const std::string& part, SegmentTable& table) {
  TakeBytes bytes(part);
  const auto count = bytes.one<std::uint32_t>();
  double start = bytes.one<double>();
  const auto source = bytes.array<std::uint32_t>(count), block = bytes.array<std::uint32_t>(count);
  const auto flags = bytes.array<std::uint8_t>(count);
  const auto time = bytes.array<float>(count), length = bytes.array<float>(count), feed = bytes.array<float>(count),
             least = bytes.array<float>(count);
  for (std::size_t i = 0; i < count; ++i) {
    table.segments.push_back({source[i], block[i], (flags[i] & cut_flag) != 0, (flags[i] & rests_flag) != 0, start,
                              time[i], length[i], feed[i], least[i]});
    start += time[i];
    table.program = (flags[i] & program_flag) != 0;
  }
}

}  // namespace

std::unique_ptr<View> segment_view(const ViewInput& input, const ViewSink& sink) {
  if (!input.facts) return nullptr;
  if (input.facts->segments) return std::make_unique<SegmentView>(input.facts->segments, sink);
  if (!input.facts->document) return nullptr;
  auto view = std::make_unique<RowSegments>(input, sink);
  return view->possible() ? std::move(view) : nullptr;
}

std::optional<SegmentTable> read_segments(const ViewReader& read) {
  SegmentTable table;
  for (std::size_t i = 0;; ++i) {
    const auto part = read(view_name, i);
    if (!part) break;
    append(*part, table);
  }
  return table.segments.empty() ? std::nullopt : std::optional(std::move(table));
}

}  // namespace bahnwerk::api
