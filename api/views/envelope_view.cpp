#include "api/views/envelope_view.hpp"

#include <bit>
#include <cstdint>
#include <stdexcept>

namespace bahnwerk::api {
namespace {

std::string part_name(const std::string& column, std::size_t level) {
  return "envelope/" + std::to_string(cell_rows[level]) + "/" + column;
}

std::uint64_t zigzag(std::uint64_t v) { return (v << 1) ^ (0 - (v >> 63)); }
std::uint64_t unzigzag(std::uint64_t v) { return (v >> 1) ^ (0 - (v & 1)); }

/// Returns all least values, then all largest ones, as differences of the bit patterns, bytes of equal weight together:
/// a form that a compressor of texts shortens.
std::string encode(const std::vector<LeastAndMost>& cells) {
  const std::size_t n = cells.size();
  std::string bytes(16 * n, '\0');
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(i < n ? cells[i].least : cells[i - n].most);
    const std::uint64_t code = zigzag(bits - before);
    before = bits;
    for (std::size_t b = 0; b < 8; ++b) bytes[b * 2 * n + i] = static_cast<char>(code >> (8 * b));
  }
  return bytes;
}

std::vector<LeastAndMost> decode(const std::string& bytes) {
  const std::size_t n = bytes.size() / 16;
  std::vector<LeastAndMost> cells(n);
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    std::uint64_t code = 0;
    for (std::size_t b = 0; b < 8; ++b)
      code |= std::uint64_t{static_cast<unsigned char>(bytes[b * 2 * n + i])} << (8 * b);
    before += unzigzag(code);
    (i < n ? cells[i].least : cells[i - n].most) = std::bit_cast<double>(before);
  }
  return cells;
}

class Envelope final : public View {
 public:
  Envelope(const ViewInput& input, const ViewSink& sink) {
    columns_.reserve(input.columns.size());
    least_.assign(input.columns.size(), LeastAndMost{}.least);
    most_.assign(input.columns.size(), LeastAndMost{}.most);
    for (const Column& column : input.columns) columns_.emplace_back(column.name, input.count, sink);
  }
  void add(std::size_t, std::size_t rows, const double* values) override {
    const std::size_t width = columns_.size();
    double *const least = least_.data(), *const most = most_.data();
    for (std::size_t k = 0; k < rows; ++k) {
      const double* row = values + k * width;
      for (std::size_t c = 0; c < width; ++c) least[c] = row[c] < least[c] ? row[c] : least[c];
      for (std::size_t c = 0; c < width; ++c) most[c] = row[c] > most[c] ? row[c] : most[c];
      if (++filled_ == cell_rows[0]) close();
    }
  }
  void finish() override {
    close();
    for (ColumnEnvelope& column : columns_) column.finish();
  }

 private:
  void close() {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      columns_[c].add_cell({least_[c], most_[c]}, filled_);
      least_[c] = LeastAndMost{}.least, most_[c] = LeastAndMost{}.most;
    }
    filled_ = 0;
  }
  std::vector<ColumnEnvelope> columns_;
  std::vector<double> least_, most_;  // values of the open cell
  std::size_t filled_ = 0;
};

}  // namespace

ColumnEnvelope::ColumnEnvelope(std::string column, std::size_t count, const ViewSink& sink)
    : column_(std::move(column)), sink_(sink), levels_(stored_levels(count)) {}

void ColumnEnvelope::add_cell(const LeastAndMost& cell, std::size_t rows) {
  if (levels_ == 0) return;
  level_[0].open = cell;
  level_[0].filled = rows;
  close(0);
}

void ColumnEnvelope::add(const double* values, std::size_t rows) {
  if (levels_ == 0) return;
  Level& finest = level_[0];
  for (std::size_t k = 0; k < rows;) {
    const std::size_t end = std::min(rows, k + cell_rows[0] - finest.filled);
    finest.filled += end - k;
    LeastAndMost open = finest.open;
    for (; k < end; ++k) open.add(values[k]);
    finest.open = open;
    if (finest.filled == cell_rows[0]) close(0);
  }
}

/// Ends the open cell of a level; it becomes part of the next level's.
void ColumnEnvelope::close(std::size_t level) {
  Level& from = level_[level];
  if (from.filled == 0) return;
  from.cells.push_back(from.open);
  if (from.cells.size() == part_cells) flush(level);
  if (level + 1 < levels_) {
    Level& to = level_[level + 1];
    to.open.add(from.open);
    to.filled += from.filled;
  }
  from.open = {};
  from.filled = 0;
  if (level + 1 < levels_ && level_[level + 1].filled == cell_rows[level + 1]) close(level + 1);
}

void ColumnEnvelope::flush(std::size_t level) {
  Level& from = level_[level];
  if (from.cells.empty()) return;
  sink_({part_name(column_, level), from.part++, encode(from.cells)});
  from.cells.clear();
}

void ColumnEnvelope::finish() {
  for (std::size_t level = 0; level < levels_; ++level) close(level);
  for (std::size_t level = 0; level < levels_; ++level) flush(level);
}

std::unique_ptr<View> make_envelope(const ViewInput& input, const ViewSink& sink) {
  if (stored_levels(input.count) == 0) return nullptr;
  return std::make_unique<Envelope>(input, sink);
}

const LeastAndMost& EnvelopeReader::cell(const std::string& column, std::size_t level, std::size_t index) {
  if (column != column_)
    for (auto& [part, cells] : parts_) cells.clear();
  column_ = column;
  auto& [part, cells] = parts_[level];
  if (const std::size_t wanted = index / part_cells; cells.empty() || part != wanted) {
    const auto bytes = read_(part_name(column, level), wanted);
    if (!bytes || bytes->empty()) throw std::runtime_error("a view of the setpoints is incomplete");
    cells = decode(*bytes);
    part = wanted;
  }
  return cells.at(index % part_cells);
}

LeastAndMost EnvelopeReader::of(const std::string& column, std::size_t from, std::size_t to,
                                const std::function<LeastAndMost(std::size_t from, std::size_t to)>& rows) {
  LeastAndMost all;
  for_each_cell(
      from, to, count_, [&](std::size_t level, std::size_t index) { all.add(cell(column, level, index)); },
      [&](std::size_t a, std::size_t b) { all.add(rows(a, b)); });
  return all;
}

}  // namespace bahnwerk::api
