#include "server/store/series_pieces.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/store/unpacking.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t piece_bytes = 4 << 20;

}  // namespace

SeriesPacker::SeriesPacker(const api::PlannedJob& planned, std::size_t first, Progress progress)
    : source_(*planned.setpoints),
      stored_(first),
      progress_(progress),
      views_({source_.columns(), source_.count(), source_.cycle_time(), planned.view_facts},
             [this](api::ViewPart part) { piece_.views.push_back(packed(std::move(part), compressor_)); }) {}

SeriesPiece SeriesPacker::next(bool& last) {
  const std::size_t columns = source_.columns().size();
  piece_ = {};
  for (std::size_t bytes = 0; row_ < source_.count() && bytes < piece_bytes;) {
    // Rows that are only read take a few ms per 16 chunks.
    if (row_ >= stored_ || row_ % (16 * series_chunk_rows) == 0) progress_.report("storing", 1);
    const std::size_t rows = std::min(series_chunk_rows, source_.count() - row_);
    values_.resize(rows * columns);
    source_.read(row_, rows, values_.data());
    views_.add(rows, values_.data());
    if (row_ >= stored_) {
      piece_.chunks.push_back({row_, rows, compressor_.rows(values_.data(), rows, columns)});
      bytes += piece_.chunks.back().packed.size();
    }
    row_ += rows;
  }
  last = row_ == source_.count();
  if (last) views_.finish();
  return std::move(piece_);
}

api::ViewPart packed(api::ViewPart part, Compressor& compressor) {
  part.bytes = compressor.text(part.bytes);
  return part;
}

std::string series_columns(const SetpointSource& source) {
  nlohmann::json list = nlohmann::json::array();
  for (const Column& column : source.columns()) list.push_back({{"name", column.name}, {"unit", column.unit}});
  const auto frame = source.pose_frame();
  const Independent over = source.independent();
  if (!frame && over.time()) return list.dump();
  nlohmann::json out{{"columns", std::move(list)}};
  if (frame) out["origin"] = {frame->x, frame->y, frame->z}, out["angle"] = frame->angle;
  if (!over.time()) out["independent"] = {over.name, over.unit, over.step};
  return out.dump();
}

void read_series_columns(const std::string& text, SeriesInfo& info) {
  unpacking([&] {
    const auto stored = nlohmann::json::parse(text);
    if (stored.contains("origin")) {
      const auto& origin = stored.at("origin");
      info.pose_frame = PoseFrame{origin.at(0), origin.at(1), origin.at(2), stored.at("angle")};
    }
    for (const auto& column : stored.is_object() ? stored.at("columns") : stored)
      info.columns.push_back({column.at("name").get<std::string>(), column.at("unit").get<std::string>()});
    info.independent.step = info.cycle_time;
    if (stored.contains("independent")) {
      const auto& over = stored.at("independent");
      info.independent = {over.at(0).get<std::string>(), over.at(1).get<std::string>(), over.at(2).get<double>()};
    }
  });
}

}  // namespace bahnwerk::server
