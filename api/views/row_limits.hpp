#pragma once
/// The limit that is closest to being met in every row, and the fraction of it that is used.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "api/views/declared_limits.hpp"
#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

/// What a row is limited by: numbers 0 to 2 are no declared limit, and number i + 3 is entry i of the list.
enum RowState : std::uint8_t {
  ahead = 0,  ///< nothing reaches limit_reached: the motion prepares for something later
  stop = 1,   ///< nothing does, and the tool is at rest at the row's time alone
  dwell = 2,  ///< nothing does, and the tool rests up to the next row
};
inline constexpr std::size_t row_states = 3;
inline constexpr double limit_reached = 0.98;  ///< fraction from which on a row belongs to a limit

/// Where results are written: per row the largest fraction of a limit, 0 if the row has none, and the row's number.
struct RowUse {
  double* use;
  std::uint8_t* limit;
};

/// Computes rows of one series. The fraction of a symmetric limit is |value|/limit; of a range, the distance from its
/// middle by half its width; of a single bound of the value's sign, value/bound. A range of one value is none. The n-th
/// difference of row k is that of rows k to k + n, of the series' last rows that of the last n + 1 rows, and 0 in a
/// series of fewer; divided by step^n. 2 ns per row and limit.
class RowLimits {
 public:
  static constexpr std::size_t rows_behind = 2;  ///< largest n
  /// Limits of which the series lacks the columns are never met; those beyond number 255 are left out.
  RowLimits(const DeclaredLimits& list, const std::vector<Column>& columns, double step);

  std::size_t numbers() const { return row_states + terms_.size(); }
  /// Returns the column from which a declared limit is computed; empty if there is none.
  std::string column(std::size_t declared) const;
  /// Returns what is permitted by a declared limit in a row.
  Permitted permitted(std::size_t declared, const double* row) const;

  /// Computes rows [from, to) of `rows` ones. Behind `to` there are rows_behind more, unless `rows` is the series' end;
  /// rows before `from` are needed where `to` is nearer to that end.
  void compute(const double* values, std::size_t rows, std::size_t from, std::size_t to, RowUse out) const;

 private:
  /// The fraction of a value: |value − middle| · scale, value · scale, or one of the rare forms.
  struct Share {
    enum class Form : std::uint8_t { none, range, upper, lower, at_most_zero, at_least_zero, above } form = Form::none;
    double middle = 0, scale = 0;
    double of(double value) const;
  };
  struct Term {
    std::size_t column = 0, key = 0;
    int differences = 0;
    double per = 1;  // step^-differences
    Share share;
    std::vector<double> from;  // keys at which the steps begin
    std::vector<Share> shares;
    std::vector<Permitted> permitted;  // one per step; one where there are none
    bool exists = false;
  };
  /// Rows [from, to) of a series, and where their results are written.
  struct Block {
    const double* values;  // the series' values, row by row
    std::size_t rows;      // number of rows of the series
    std::size_t from, to;
    RowUse out;  // receives the results, beginning with those of row `from`
  };
  static Share share_of(const Permitted& permitted);
  void apply(std::size_t index, Block block) const;
  template <int differences>
  void apply(std::size_t index, const Share& share, const Block& block) const;
  static std::size_t step_of(const Term& term, double key);

  std::vector<Column> columns_;
  std::vector<Term> terms_;
  std::size_t width_, speed_;  // speed_: column v; width_: there is none
};

}  // namespace bahnwerk::api
