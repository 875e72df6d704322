#include "api/setpoints/setpoint_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "api/views/envelope_view.hpp"
#include "core/base/read_rows.hpp"

namespace bahnwerk::api {
namespace {
constexpr std::size_t block_rows = 2048;
}

RowCursor::RowCursor(const SetpointSeries& series, std::size_t first, std::size_t every, std::size_t rows)
    : series_(&series), first_(first), every_(every), rows_(rows) {}

void RowCursor::rewind() { given_ = loaded_ = 0; }

const double* RowCursor::next() {
  if (given_ == rows_) return nullptr;
  const std::size_t width = series_->columns.size();
  if (given_ == loaded_) {
    const std::size_t wanted = std::min(rows_ - given_, 1 + (block_rows - 1) / every_);
    block_.clear();
    series_->read(first_ + given_ * every_, (wanted - 1) * every_ + 1, block_);
    if (block_.size() != ((wanted - 1) * every_ + 1) * width) throw std::runtime_error("setpoints: short read");
    for (double& value : block_) value += 0.0;  // -0 becomes 0: the formats of text do not distinguish them
    loaded_ += wanted;
    offset_ = 0;
  }
  const double* row = block_.data() + offset_;
  offset_ += every_ * width;
  ++given_;
  return row;
}

SetpointSeries in_base_frame(SetpointSeries series) {
  struct Turn {
    std::size_t x, y, z, phi, vx, vy, width;
    double c, s;
    PoseFrame frame;
    void turn(double* row, std::size_t a, std::size_t b) const {
      if (a >= width || b >= width) return;
      const double p = row[a], q = row[b];
      row[a] = c * p - s * q, row[b] = s * p + c * q;
    }
    void operator()(double* row) const {
      turn(row, x, y);
      turn(row, vx, vy);
      const auto shift = [&](std::size_t column, double by) {
        if (column < width) row[column] += by;
      };
      shift(x, frame.x), shift(y, frame.y), shift(z, frame.z), shift(phi, frame.angle);
    }
  };
  const auto at = [&](const char* name) { return column_index(series.columns, name); };
  const PoseFrame frame = *series.pose_frame;
  const double angle = frame.angle * std::numbers::pi / 180;
  series.view = nullptr;  // it is of the part's frame
  const Turn turn{at("x"),         at("y"),         at("z"), at("phi"), at("vx"), at("vy"), series.columns.size(),
                  std::cos(angle), std::sin(angle), frame};
  series.read = [read = std::move(series.read), turn](std::size_t first, std::size_t rows, std::vector<double>& out) {
    read(first, rows, out);
    for (std::size_t k = 0; k < rows; ++k) turn(out.data() + k * turn.width);
  };
  return series;
}

SetpointSeries with_mark(SetpointSeries series, const std::string& name) {
  const std::size_t width = series.columns.size();
  series.columns.push_back({name, "1"});
  series.view = nullptr;
  series.read = [read = std::move(series.read), width](std::size_t first, std::size_t rows, std::vector<double>& out) {
    std::vector<double> narrow;
    read(first, rows, narrow);
    out.assign(rows * (width + 1), 1.0);
    for (std::size_t k = 0; k < rows; ++k)
      std::copy_n(narrow.begin() + static_cast<std::ptrdiff_t>(k * width), width,
                  out.begin() + static_cast<std::ptrdiff_t>(k * (width + 1)));
  };
  return series;
}

SetpointSeries delayed(SetpointSeries series, std::size_t rows) {
  if (rows == 0) return series;
  std::vector<bool> rates;
  for (const Column& column : series.columns) {
    const bool rate = column.name.size() > 1 && std::string_view("vajs").find(column.name[0]) != std::string_view::npos;
    rates.push_back(rate && column_index(series.columns, column.name.substr(1)) < series.columns.size());
  }
  SetpointSeries result;
  result.columns = series.columns;
  result.count = series.count + (series.count > 0 ? rows : 0);
  result.cycle_time = series.cycle_time;
  result.independent = series.independent;
  result.pose_frame = series.pose_frame;
  result.read = [rows, series = std::move(series), rates = std::move(rates)](std::size_t first, std::size_t count,
                                                                             std::vector<double>& out) {
    const std::size_t width = series.columns.size(), waiting = first < rows ? std::min(count, rows - first) : 0;
    std::vector<double> moving;
    if (count > waiting) series.read(first + waiting - rows, count - waiting, moving);
    if (waiting == 0) {
      out = std::move(moving);
      return;
    }
    std::vector<double> row;
    series.read(0, 1, row);
    for (std::size_t c = 0; c < width; ++c)
      if (rates[c]) row[c] = 0;
    out.clear();
    out.reserve(count * width);
    for (std::size_t i = 0; i < waiting; ++i) out.insert(out.end(), row.begin(), row.end());
    out.insert(out.end(), moving.begin(), moving.end());
  };
  return result;
}

SetpointSeries with_limits(SetpointSeries series) {
  series.limits = std::make_shared<LimitsReader>(series.view, series.count);
  const auto limits = std::make_shared<const RowLimits>(series.limits->list(), series.columns, series.cycle_time);
  const std::size_t width = series.columns.size(), count = series.count;
  series.columns.push_back({"use", "1"});
  series.columns.push_back({"limit", "1"});
  series.read = [read = std::move(series.read), limits, width, count](std::size_t first, std::size_t rows,
                                                                      std::vector<double>& out) {
    // Differences of the last rows are those of the rows before them.
    const std::size_t from = std::min(first, count - std::min(count, RowLimits::rows_behind + 1));
    const std::size_t to = std::min(count, first + rows + RowLimits::rows_behind);
    std::vector<double> narrow;
    read(from, to - from, narrow);
    std::vector<double> uses(rows);
    std::vector<std::uint8_t> numbers(rows);
    limits->compute(narrow.data(), to - from, first - from, first - from + rows, {uses.data(), numbers.data()});
    out.resize(rows * (width + 2));
    for (std::size_t k = 0; k < rows; ++k) {
      double* row = out.data() + k * (width + 2);
      std::copy_n(narrow.data() + (first - from + k) * width, width, row);
      row[width] = uses[k];
      row[width + 1] = numbers[k];
    }
  };
  return series;
}

namespace {

/// Makes the table of an envelope: a line per bucket.
class EnvelopeTable {
 public:
  EnvelopeTable(SetpointSeries series, std::size_t first, std::size_t rows, std::size_t points,
                std::vector<std::size_t> columns)
      : series_(std::move(series)),
        columns_(std::move(columns)),
        bounds_(bucket_bounds(first, rows, points, series_.view ? series_.count : 0)),
        by_cells_(series_.view && grouped_by_cells(rows, points, series_.count)) {}

  std::size_t buckets() const { return bounds_.size() - 1; }
  std::size_t width() const { return 1 + 2 * columns_.size(); }
  const std::vector<double>& lines() {
    if (lines_.empty()) by_cells_ ? read_cells() : read_rows();
    return lines_;
  }

 private:
  bool is_limit(std::size_t column) const { return series_.limits && column + 1 == series_.columns.size(); }
  void put(std::size_t bucket, std::size_t i, const LeastAndMost& values) {
    lines_[bucket * width() + 1 + 2 * i] = values.least + 0.0;  // -0 becomes 0
    lines_[bucket * width() + 2 + 2 * i] = values.most + 0.0;
  }
  void number_lines() {
    lines_.resize(buckets() * width());
    for (std::size_t b = 0; b < buckets(); ++b) lines_[b * width()] = static_cast<double>(bounds_[b]);
  }

  void read_rows() {
    number_lines();
    RowCursor cursor(series_, bounds_.front(), 1, bounds_.back() - bounds_.front());
    std::vector<LeastAndMost> values(columns_.size());
    std::array<std::uint64_t, 256> numbers{};
    for (std::size_t b = 0; b < buckets(); ++b) {
      std::fill(values.begin(), values.end(), LeastAndMost{});
      numbers.fill(0);
      for (std::size_t k = bounds_[b]; k < bounds_[b + 1]; ++k) {
        const double* row = cursor.next();
        for (std::size_t i = 0; i < columns_.size(); ++i) values[i].add(row[columns_[i]]);
        if (series_.limits) ++numbers[static_cast<std::uint8_t>(row[series_.columns.size() - 1])];
      }
      const auto most = static_cast<double>(std::max_element(numbers.begin(), numbers.end()) - numbers.begin());
      for (std::size_t i = 0; i < columns_.size(); ++i)
        put(b, i, is_limit(columns_[i]) ? LeastAndMost{most, most} : values[i]);
    }
  }

  void read_cells() {
    number_lines();
    EnvelopeReader reader(series_.view, series_.count);
    std::map<std::size_t, std::vector<double>> ends;  // rows between the interval's ends and whole cells
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::size_t column = columns_[i];
      const std::string& name = series_.columns[column].name;
      const std::function<LeastAndMost(std::size_t, std::size_t)> rest = [&](std::size_t from, std::size_t to) {
        std::vector<double>& rows = ends[from];
        if (rows.empty()) series_.read(from, to - from, rows);
        LeastAndMost values;
        for (std::size_t k = column; k < rows.size(); k += series_.columns.size()) values.add(rows[k]);
        return values;
      };
      for (std::size_t b = 0; b < buckets(); ++b) {
        if (is_limit(column)) {
          const auto most = static_cast<double>(most_frequent(series_.limits->count(bounds_[b], bounds_[b + 1])));
          put(b, i, {most, most});
        } else {
          put(b, i, reader.of(name, bounds_[b], bounds_[b + 1], rest));
        }
      }
    }
  }

  SetpointSeries series_;
  std::vector<std::size_t> columns_, bounds_;
  bool by_cells_;
  std::vector<double> lines_;
};

}  // namespace

SetpointSeries envelope(SetpointSeries series, std::size_t first, std::size_t rows, std::size_t points,
                        std::vector<std::size_t> columns) {
  SetpointSeries result;
  result.cycle_time = series.cycle_time;
  result.independent = series.independent;
  result.columns.push_back({"index", "1"});
  for (std::size_t c : columns) {
    result.columns.push_back({series.columns[c].name + "_min", series.columns[c].unit});
    result.columns.push_back({series.columns[c].name + "_max", series.columns[c].unit});
  }
  const auto table = std::make_shared<EnvelopeTable>(std::move(series), first, rows, points, std::move(columns));
  result.count = table->buckets();
  result.read = [table](std::size_t from, std::size_t count, std::vector<double>& out) {
    const auto begin = table->lines().begin() + static_cast<std::ptrdiff_t>(from * table->width());
    out.assign(begin, begin + static_cast<std::ptrdiff_t>(count * table->width()));
  };
  return result;
}

}  // namespace bahnwerk::api
