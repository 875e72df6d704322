#pragma once
/// Least and largest values of columns in cells of 64, 512, … rows.
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "api/views/buckets.hpp"
#include "api/views/views.hpp"

namespace bahnwerk::api {

struct LeastAndMost {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void add(double value) {
    least = value < least ? value : least;
    most = value > most ? value : most;
  }
  void add(const LeastAndMost& other) {
    least = other.least < least ? other.least : least;
    most = other.most > most ? other.most : most;
  }
};

/// Makes the stored levels of one column.
class ColumnEnvelope {
 public:
  /// `sink` must outlive this object.
  ColumnEnvelope(std::string column, std::size_t count, const ViewSink& sink);
  /// Receives the next values.
  void add(const double* values, std::size_t rows);
  /// Receives the next cell of the finest level; only the series' last one may have fewer rows.
  void add_cell(const LeastAndMost& cell, std::size_t rows);
  void finish();

 private:
  void close(std::size_t level);
  void flush(std::size_t level);
  struct Level {
    LeastAndMost open;
    std::size_t filled = 0;  // rows in the open cell
    std::vector<LeastAndMost> cells;
    std::size_t part = 0;
  };
  std::string column_;
  const ViewSink& sink_;
  std::size_t levels_;
  std::array<Level, cell_rows.size()> level_;
};

/// The view: the envelope of every column; nullptr for a series without levels.
std::unique_ptr<View> make_envelope(const ViewInput& input, const ViewSink& sink);

/// Reads the envelope of one column after the other.
class EnvelopeReader {
 public:
  EnvelopeReader(ViewReader read, std::size_t count) : read_(std::move(read)), count_(count) {}
  /// Returns the envelope of rows [from, to) of a column; `rows` is asked for fewer than 64 rows at either end. Throws
  /// std::runtime_error if a part is missing.
  LeastAndMost of(const std::string& column, std::size_t from, std::size_t to,
                  const std::function<LeastAndMost(std::size_t from, std::size_t to)>& rows);

 private:
  const LeastAndMost& cell(const std::string& column, std::size_t level, std::size_t index);
  ViewReader read_;
  std::size_t count_;
  std::string column_;  // the column of `parts_`
  std::array<std::pair<std::size_t, std::vector<LeastAndMost>>, cell_rows.size()> parts_;
};

}  // namespace bahnwerk::api
