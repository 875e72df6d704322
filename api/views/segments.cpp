#include "api/views/segments.hpp"

#include <algorithm>
#include <optional>

#include "api/views/bytes.hpp"
#include "api/views/view_facts.hpp"

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

class SegmentView final : public View {
 public:
  SegmentView(std::shared_ptr<const SegmentTable> table, const ViewSink& sink)
      : table_(std::move(table)), sink_(sink) {}
  void add(std::size_t, std::size_t, const double*) override {}
  void finish() override {
    const auto& all = table_->segments;
    for (std::size_t first = 0; first < all.size(); first += part_size)
      sink_({view_name, first / part_size,
             part_of(all.data() + first, std::min(part_size, all.size() - first), table_->program)});
  }

 private:
  std::shared_ptr<const SegmentTable> table_;
  const ViewSink& sink_;
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
  if (!input.facts || !input.facts->segments) return nullptr;
  return std::make_unique<SegmentView>(input.facts->segments, sink);
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
