#include "api/setpoints/setpoint_rows.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

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

SetpointSeries envelope(SetpointSeries series, std::size_t first, std::size_t rows, std::size_t points,
                        std::vector<std::size_t> columns) {
  SetpointSeries result;
  result.count = std::min(points, rows);
  result.cycle_time = series.cycle_time;
  result.independent = series.independent;
  result.columns.push_back({"index", "1"});
  for (std::size_t c : columns) {
    result.columns.push_back({series.columns[c].name + "_min", series.columns[c].unit});
    result.columns.push_back({series.columns[c].name + "_max", series.columns[c].unit});
  }
  const std::size_t width = result.columns.size(), buckets = result.count;
  // Bucket limits without rows · buckets, which could overflow: rows = quotient · buckets + remainder.
  const auto begin = [=](std::size_t b) { return b * (rows / buckets) + b * (rows % buckets) / buckets; };
  auto table = std::make_shared<std::vector<double>>();
  result.read = [=, series = std::move(series), columns = std::move(columns)](std::size_t from, std::size_t count,
                                                                              std::vector<double>& out) {
    if (table->empty()) {
      table->reserve(buckets * width);
      RowCursor cursor(series, first, 1, rows);
      for (std::size_t b = 0; b < buckets; ++b) {
        const std::size_t base = table->size();
        table->resize(base + width);
        double* line = table->data() + base;
        line[0] = static_cast<double>(first + begin(b));
        for (std::size_t k = begin(b); k < begin(b + 1); ++k) {
          const double* row = cursor.next();
          for (std::size_t i = 0; i < columns.size(); ++i) {
            const double value = row[columns[i]];
            double &low = line[1 + 2 * i], &high = line[2 + 2 * i];
            low = k == begin(b) ? value : std::min(low, value);
            high = k == begin(b) ? value : std::max(high, value);
          }
        }
      }
    }
    out.assign(table->begin() + static_cast<std::ptrdiff_t>(from * width),
               table->begin() + static_cast<std::ptrdiff_t>((from + count) * width));
  };
  return result;
}

}  // namespace bahnwerk::api
