#include "api/views/row_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/read_rows.hpp"

namespace bahnwerk::api {
namespace {

constexpr std::size_t most_numbers = 256;
constexpr double at_rest = 1e-9;  // unit/s

struct Source {
  std::size_t column;
  int differences;
};

/// Returns the column of a derivative, or the highest one below it of which differences exist.
Source find_source(const std::vector<Column>& columns, const std::string& of, int order) {
  constexpr std::array<const char*, 5> prefix{"", "v", "a", "j", "s"};
  for (int d = 0; d <= static_cast<int>(RowLimits::rows_behind) && d <= order; ++d) {
    if (of.empty() && order - d == 0) break;
    const std::size_t c = column_index(columns, prefix[static_cast<std::size_t>(order - d)] + of);
    if (c < columns.size()) return {c, d};
  }
  return {columns.size(), 0};
}

}  // namespace

RowLimits::Share RowLimits::share_of(const Permitted& p) {
  const bool low = std::isfinite(p.lowest), high = std::isfinite(p.highest);
  if (low && high && p.highest > p.lowest)
    return {Share::Form::range, 0.5 * (p.lowest + p.highest), 2 / (p.highest - p.lowest)};
  if (low == high) return {};
  if (high && p.highest > 0) return {Share::Form::upper, 0, 1 / p.highest};
  if (low && p.lowest < 0) return {Share::Form::lower, 0, 1 / p.lowest};
  if (high) return {p.highest == 0 ? Share::Form::at_most_zero : Share::Form::above, 0, p.highest};
  return {p.lowest == 0 ? Share::Form::at_least_zero : Share::Form::above, 0, p.lowest};
}

double RowLimits::Share::of(double value) const {
  switch (form) {
    case Form::range:
      return std::abs(value - middle) * scale;
    case Form::upper:
    case Form::lower:
      return std::max(0.0, value * scale);
    case Form::at_most_zero:
      return value >= -at_rest ? 1 : 0;
    case Form::at_least_zero:
      return value <= at_rest ? 1 : 0;
    case Form::above:
      return scale / value;  // a value of the bound's sign, and of larger magnitude
    case Form::none:
      break;
  }
  return 0;
}

RowLimits::RowLimits(const DeclaredLimits& list, const std::vector<Column>& columns, double step)
    : columns_(columns), width_(columns.size()), speed_(column_index(columns, "v")) {
  for (const DeclaredLimit& limit : list) {
    if (numbers() == most_numbers) break;
    Term term;
    const Source source = find_source(columns, limit.of, limit.order);
    term.column = source.column;
    term.differences = source.differences;
    term.per = std::pow(step, -source.differences);
    term.share = share_of(limit.permitted);
    term.exists = source.column < width_;
    if (!limit.key.empty()) {
      term.key = column_index(columns, limit.key);
      term.exists = term.exists && term.key < width_;
      for (const LimitStep& each : limit.steps) {
        term.from.push_back(each.from);
        term.shares.push_back(share_of(each.permitted));
        term.permitted.push_back(each.permitted);
      }
    } else {
      term.permitted.push_back(limit.permitted);
    }
    terms_.push_back(std::move(term));
  }
}

std::string RowLimits::column(std::size_t declared) const {
  return terms_[declared].exists ? columns_[terms_[declared].column].name : std::string();
}

/// Returns the step of a key; as many as there are: none.
std::size_t RowLimits::step_of(const Term& term, double key) {
  const auto after = std::upper_bound(term.from.begin(), term.from.end(), key);
  return after == term.from.begin() ? term.from.size() : static_cast<std::size_t>(after - term.from.begin()) - 1;
}

Permitted RowLimits::permitted(std::size_t declared, const double* row) const {
  const Term& term = terms_[declared];
  if (!term.exists) return {};
  if (term.from.empty()) return term.permitted.front();
  const std::size_t step = step_of(term, row[term.key]);
  return step < term.from.size() ? term.permitted[step] : Permitted{};
}

/// Offers the limit of term `index`, whose share is the same in all rows of the block.
template <int differences>
void RowLimits::apply(std::size_t index, const Share& share, const Block& block) const {
  const Term& term = terms_[index];
  const auto number = static_cast<std::uint8_t>(row_states + index);
  const std::size_t last = block.rows - 1 - differences;  // last row whose differences exist
  const double* const values = block.values;
  const std::size_t from = block.from, to = block.to;
  const RowUse out = block.out;
  const auto offer = [&](auto&& use_of) {
    for (std::size_t k = from; k < to; ++k) {
      const double* at = values + std::min(k, last) * width_ + term.column;
      double value = at[0];
      if constexpr (differences == 1) value = (at[width_] - at[0]) * term.per;
      if constexpr (differences == 2) value = (at[2 * width_] - 2 * at[width_] + at[0]) * term.per;
      const double use = use_of(value);
      const bool more = use > out.use[k - from];
      out.use[k - from] = more ? use : out.use[k - from];
      out.limit[k - from] = more ? number : out.limit[k - from];
    }
  };
  if (share.form == Share::Form::none) return;
  if (share.form == Share::Form::range)
    offer([middle = share.middle, scale = share.scale](double value) { return std::abs(value - middle) * scale; });
  else
    offer([&share](double value) { return share.of(value); });
}

/// Offers the limit of term `index` in all rows of a block, part by part of the same key.
void RowLimits::apply(std::size_t index, Block block) const {
  const Term& term = terms_[index];
  const auto n = static_cast<std::size_t>(term.differences);
  if (!term.exists || block.rows <= n) return;
  for (const std::size_t to = block.to; block.from < to;) {
    Share share = term.share;
    block.to = to;
    if (!term.from.empty()) {  // up to the next change of the key
      const auto key_of = [&](std::size_t k) { return block.values[k * width_ + term.key]; };
      const double key = key_of(block.from);
      for (block.to = block.from + 1; block.to < to && key_of(block.to) == key;) ++block.to;
      const std::size_t step = step_of(term, key);
      share = step < term.from.size() ? term.shares[step] : Share{};
    }
    if (n == 0) apply<0>(index, share, block);
    if (n == 1) apply<1>(index, share, block);
    if (n == 2) apply<2>(index, share, block);
    block.out.use += block.to - block.from, block.out.limit += block.to - block.from;
    block.from = block.to;
  }
}

void RowLimits::compute(const double* values, std::size_t rows, std::size_t from, std::size_t to, RowUse out) const {
  constexpr std::size_t most = 256;  // rows that stay in the processor's cache while all limits look at them
  for (std::size_t begin = from; begin < to; begin += most) {
    const std::size_t end = std::min(to, begin + most);
    const RowUse at{out.use + (begin - from), out.limit + (begin - from)};
    std::fill_n(at.use, end - begin, 0.0);
    std::fill_n(at.limit, end - begin, std::uint8_t{ahead});
    for (std::size_t i = 0; i < terms_.size(); ++i) apply(i, {values, rows, begin, end, at});
    for (std::size_t k = begin; k < end; ++k) {
      if (at.use[k - begin] >= limit_reached) continue;
      std::uint8_t& limit = at.limit[k - begin];
      limit = ahead;
      if (speed_ == width_ || !(std::abs(values[k * width_ + speed_]) <= at_rest)) continue;
      limit = k + 1 < rows && std::abs(values[(k + 1) * width_ + speed_]) <= at_rest ? dwell : stop;
    }
  }
}

}  // namespace bahnwerk::api
