#include "api/views/path_levels.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "api/views/bytes.hpp"
#include "api/views/open_chord.hpp"
#include "core/base/read_rows.hpp"

namespace bahnwerk::api {
namespace {

constexpr std::size_t chunk_size = 1024;  // vertices; the first one is the last one of the chunk before

std::string view_name(std::string_view path) { return "path-" + std::string(path); }

using Box = std::array<float, 6>;
constexpr float far = std::numeric_limits<float>::max();
constexpr Box empty_box{far, far, far, -far, -far, -far};

/// Chunks of all levels of one path that are not stored yet.
class ChunkWriter {
 public:
  ChunkWriter(std::string name, std::size_t dimension, const ViewSink& sink)
      : name_(std::move(name)), dimension_(dimension), sink_(sink) {}

  void add(std::size_t level, const PathVertex& vertex) {
    std::vector<PathVertex>& open = open_[level];
    open.push_back(vertex);
    if (open.size() < chunk_size) return;
    write(level);
    open.assign(1, vertex);
  }
  void finish() {
    for (std::size_t level = 0; level < open_.size(); ++level)
      if (open_[level].size() > 1 || parts_of_[level] == 0) write(level);
    std::string index;
    put(index, static_cast<std::uint32_t>(dimension_));
    put(index, static_cast<std::uint32_t>(chunks_));
    for (const std::string& entries : entries_) index += entries;
    sink_({name_, 0, std::move(index)});
  }

 private:
  void write(std::size_t level) {
    const std::vector<PathVertex>& vertices = open_[level];
    if (vertices.empty()) return;
    Box box = empty_box;
    std::string bytes;
    std::uint32_t row = 0;
    for (const PathVertex& v : vertices) put(bytes, std::exchange(row, v.row) - v.row);
    for (std::size_t k = 0; k < dimension_; ++k)
      for (const PathVertex& v : vertices) put(bytes, v.at[k]);
    for (const PathVertex& v : vertices) put(bytes, v.v);
    for (const PathVertex& v : vertices) put(bytes, v.block);
    for (const PathVertex& v : vertices) put(bytes, static_cast<std::uint8_t>(v.cut));
    for (const PathVertex& v : vertices)
      for (std::size_t k = 0; k < 3; ++k)
        box[k] = std::min(box[k], v.at[k]), box[k + 3] = std::max(box[k + 3], v.at[k]);
    std::string& entry = entries_[level];
    put(entry, static_cast<std::uint8_t>(level));
    for (const std::size_t number :
         {++chunks_, vertices.size(), std::size_t{vertices.front().row}, std::size_t{vertices.back().row}})
      put(entry, static_cast<std::uint32_t>(number));
    put(entry, box);
    ++parts_of_[level];
    sink_({name_, chunks_, std::move(bytes)});
  }

  std::string name_;
  std::size_t dimension_;
  const ViewSink& sink_;
  std::array<std::vector<PathVertex>, path_tolerances.size()> open_;
  std::array<std::string, path_tolerances.size()> entries_;  // entries of the index, by level
  std::array<std::size_t, path_tolerances.size()> parts_of_{};
  std::size_t chunks_ = 0;
};

/// Thins one path, level by level: a level takes its vertices from those of the finer one. Its chords are within the
/// difference of both tolerances of them, so that the rows are within its own.
class Thinning {
 public:
  Thinning(const PathColumns& path, const ViewSink& sink)
      : dimension_(path.columns.size()), writer_(view_name(path.name), dimension_, sink) {
    double finer = 0;
    for (const double tolerance : path_tolerances) {
      // Coordinates are rounded to single precision after the choice: the rounding is not part of the tolerance.
      levels_.emplace_back(tolerance - finer, dimension_ == 2);
      finer = tolerance;
    }
  }
  void add(const PathVertex& row, Vec at) { take(0, {row, at}); }
  void finish() {
    for (std::size_t level = 0; level < levels_.size(); ++level)
      if (const auto vertex = levels_[level].finish()) keep(level, *vertex);
    writer_.finish();
  }

 private:
  using Point = OpenChord::Point;

  void take(std::size_t level, const Point& point) {
    if (level == levels_.size()) return;
    if (const auto vertex = levels_[level].take(point)) keep(level, *vertex);
  }
  void keep(std::size_t level, const Point& vertex) {
    writer_.add(level, vertex.vertex);
    take(level + 1, vertex);
  }

  std::size_t dimension_;
  ChunkWriter writer_;
  std::vector<OpenChord> levels_;
};

class PathView final : public View {
 public:
  PathView(const ViewInput& input, const std::vector<PathColumns>& paths, const ViewSink& sink)
      : width_(input.columns.size()) {
    for (const PathColumns& path : paths)
      paths_.push_back({RowVertices(input.columns, path), std::make_unique<Thinning>(path, sink)});
  }
  void add(std::size_t first, std::size_t rows, const double* values) override {
    Vec at;
    for (const Path& path : paths_)
      for (std::size_t i = 0; i < rows; ++i) {
        const PathVertex vertex = path.vertex(first + i, values + i * width_, at);
        path.thinning->add(vertex, at);
      }
  }
  void finish() override {
    for (const Path& path : paths_) path.thinning->finish();
  }

 private:
  struct Path {
    RowVertices vertex;
    std::unique_ptr<Thinning> thinning;
  };
  std::size_t width_;
  std::vector<Path> paths_;
};

/// Returns whether the chord from a to b touches the box in the plane [Liang & Barsky 1984].
bool touches(const PathVertex& a, const PathVertex& b, const PathBox& box) {
  double from = 0, to = 1;
  const auto clip = [&](double start, double end, double low, double high) {
    const double way = end - start;
    if (way == 0) return start >= low && start <= high;
    const double t0 = (low - start) / way, t1 = (high - start) / way;
    from = std::max(from, std::min(t0, t1)), to = std::min(to, std::max(t0, t1));
    return from <= to;
  };
  return clip(a.at[0], b.at[0], box.x0, box.x1) && clip(a.at[1], b.at[1], box.y0, box.y1);
}

PathBox grown(const PathBox& box, double by) { return {box.x0 - by, box.y0 - by, box.x1 + by, box.y1 + by}; }

std::vector<PathVertex> vertices_of(const std::string& bytes, std::size_t count, std::size_t dimension) {
  TakeBytes take(bytes);
  std::vector<PathVertex> list(count);
  std::uint32_t row = 0;
  for (PathVertex& v : list) v.row = row -= take.one<std::uint32_t>();
  for (std::size_t k = 0; k < dimension; ++k)
    for (PathVertex& v : list) v.at[k] = take.one<float>();
  for (PathVertex& v : list) v.v = take.one<float>();
  for (PathVertex& v : list) v.block = take.one<std::uint32_t>();
  for (PathVertex& v : list) v.cut = take.one<std::uint8_t>() != 0;
  return list;
}

}  // namespace

std::vector<PathColumns> path_columns(const std::vector<Column>& columns) {
  std::vector<PathColumns> list;
  for (const auto& [name, suffix] : {std::pair("tool", ""), std::pair("coarse", "c")}) {
    PathColumns path{name, {}};
    for (const char* axis : {"x", "y", "z"})
      if (const std::size_t c = column_index(columns, std::string(axis) + suffix); c < columns.size())
        path.columns.push_back(c);
    if (path.columns.size() >= 2) list.push_back(std::move(path));
  }
  return list;
}

RowVertices::RowVertices(const std::vector<Column>& columns, PathColumns path)
    : path_(std::move(path)),
      width_(columns.size()),
      speed_(column_index(columns, "v")),
      block_(column_index(columns, "block")),
      mode_(column_index(columns, "mode")) {}

PathVertex RowVertices::operator()(std::size_t row, const double* values, Vec& at) const {
  PathVertex vertex;
  vertex.row = static_cast<std::uint32_t>(row);
  for (std::size_t k = 0; k < path_.columns.size(); ++k) {
    at[k] = values[path_.columns[k]];
    vertex.at[k] = static_cast<float>(at[k]);
  }
  if (speed_ < width_) vertex.v = static_cast<float>(values[speed_]);
  if (block_ < width_) vertex.block = static_cast<std::uint32_t>(values[block_]);
  if (mode_ < width_) vertex.cut = values[mode_] != 0;
  return vertex;
}

std::unique_ptr<View> path_view(const ViewInput& input, const ViewSink& sink) {
  const std::vector<PathColumns> paths = path_columns(input.columns);
  if (paths.empty() || input.count == 0) return nullptr;
  return std::make_unique<PathView>(input, paths, sink);
}

StoredPath::StoredPath(ViewReader read, std::string_view path) : read_(std::move(read)), name_(view_name(path)) {
  const auto index = read_(name_, 0);
  if (!index) return;
  TakeBytes take(*index);
  dimension_ = take.one<std::uint32_t>();
  chunks_.resize(take.one<std::uint32_t>());
  for (Chunk& c : chunks_) {
    c.level = take.one<std::uint8_t>();
    for (auto member : {&Chunk::part, &Chunk::count, &Chunk::first_row, &Chunk::last_row})
      c.*member = take.one<std::uint32_t>();
    c.box = take.one<Box>();
  }
}

bool StoredPath::overlaps(const Chunk& chunk, std::size_t level, std::size_t first, std::size_t end,
                          const std::optional<PathBox>& box) const {
  if (chunk.level != level || chunk.first_row >= end || chunk.last_row < first) return false;
  if (!box) return true;
  const PathBox b = grown(*box, path_tolerances[level]);
  return chunk.box[0] <= b.x1 && chunk.box[3] >= b.x0 && chunk.box[1] <= b.y1 && chunk.box[4] >= b.y0;
}

std::size_t StoredPath::at_most(std::size_t level, std::size_t first, std::size_t end,
                                const std::optional<PathBox>& box) const {
  std::size_t count = 0;
  for (const Chunk& chunk : chunks_)
    if (overlaps(chunk, level, first, end, box)) count += chunk.count;
  return count;
}

std::vector<StoredPath::Run> StoredPath::read(std::size_t level, std::size_t first, std::size_t end,
                                              const std::optional<PathBox>& box) const {
  std::vector<Run> runs;
  const PathBox area = box ? grown(*box, path_tolerances[level]) : PathBox{};
  for (const Chunk& chunk : chunks_) {
    if (!overlaps(chunk, level, first, end, box)) continue;
    const auto bytes = read_(name_, chunk.part);
    if (!bytes) throw std::runtime_error("a stored view lacks a part");
    const std::vector<PathVertex> list = vertices_of(*bytes, chunk.count, dimension_);
    if (list.size() == 1) runs.push_back(list);  // a path of one row
    for (std::size_t i = 1; i < list.size(); ++i) {
      if (list[i].row < first || list[i - 1].row >= end || (box && !touches(list[i - 1], list[i], area))) continue;
      if (runs.empty() || runs.back().back().row != list[i - 1].row) runs.push_back({list[i - 1]});
      runs.back().push_back(list[i]);
    }
  }
  return runs;
}

}  // namespace bahnwerk::api
