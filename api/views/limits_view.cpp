#include "api/views/limits_view.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/views/envelope_view.hpp"
#include "api/views/view_facts.hpp"
#include "core/base/read_rows.hpp"

namespace bahnwerk::api {
namespace {

constexpr std::size_t part_rows = 32768;
constexpr std::size_t part_changes = 4096;
constexpr std::size_t first_counted = 1;  // the level from which on cells have counts; below it rows are counted

std::string counts_name(std::size_t level) { return "limits/counts/" + std::to_string(cell_rows[level]); }
std::string changes_name(std::size_t declared) { return "limits/changes/" + std::to_string(declared); }
std::string steps_name(std::size_t declared) { return "limits/steps/" + std::to_string(declared); }
constexpr const char *rows_name = "limits/rows", *head_name = "limits";

template <class Number>
void put(std::string& out, Number value) {
  static_assert(std::endian::native == std::endian::little);
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class Number>
Number get(const std::string& bytes, std::size_t index) {
  Number value{};
  if ((index + 1) * sizeof value > bytes.size()) throw std::runtime_error("a view of limits is damaged");
  std::memcpy(&value, bytes.data() + index * sizeof value, sizeof value);
  return value;
}

/// JSON has no infinity: null stands for none.
nlohmann::json bound(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }
double bound(const nlohmann::json& value, double none) { return value.is_null() ? none : value.get<double>(); }

class LimitsView final : public View {
 public:
  LimitsView(const ViewInput& input, const ViewSink& sink)
      : input_(input),
        sink_(sink),
        width_(input.columns.size()),
        list_(input.facts ? input.facts->limits : DeclaredLimits{}),
        limits_(list_, input.columns, input.cycle_time),
        use_("use", input.count, sink),
        levels_(stored_levels(input.count)),
        changes_(list_.size()) {
    if (list_.size() > limits_.numbers() - row_states) list_.resize(limits_.numbers() - row_states);
    for (std::size_t i = 0; i < list_.size(); ++i) changes_[i].key = column_index(input.columns, list_[i].key);
    for (std::size_t level = first_counted; level < levels_; ++level)
      open_.push_back({std::vector<std::uint32_t>(limits_.numbers(), 0)});
  }

  void add(std::size_t, std::size_t rows, const double* values) override {
    window_.insert(window_.end(), values, values + rows * width_);
    const std::size_t held = window_.size() / width_;
    if (held > done_ + RowLimits::rows_behind) compute(held - RowLimits::rows_behind);
  }

  void finish() override {
    compute(width_ > 0 ? window_.size() / width_ : 0);
    use_.finish();
    if (!rows_.empty()) flush_rows();
    for (std::size_t k = 0; k < open_.size(); ++k) close(k);
    for (Level& level : open_)
      if (!level.bytes.empty()) flush(level);
    nlohmann::json head = nlohmann::json::array();
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const DeclaredLimit& limit = list_[i];
      if (!changes_[i].bytes.empty()) flush(i);
      head.push_back({{"name", limit.name},
                      {"unit", limit.unit},
                      {"of", limit.of},
                      {"order", limit.order},
                      {"lowest", bound(limit.permitted.lowest)},
                      {"highest", bound(limit.permitted.highest)},
                      {"key", limit.key},
                      {"column", limits_.column(i)},
                      {"changes", changes_[i].part}});
      if (limit.steps.empty()) continue;
      std::string steps;
      for (const LimitStep& step : limit.steps)
        put(steps, step.from), put(steps, step.permitted.lowest), put(steps, step.permitted.highest);
      sink_({steps_name(i), 0, std::move(steps)});
    }
    sink_({head_name, 0, head.dump()});
  }

 private:
  struct Level {
    std::vector<std::uint32_t> counts;
    std::size_t filled = 0, part = 0;
    std::string bytes = {};
  };
  struct Changes {
    std::size_t key = 0;  // index of the key column
    double last_key = 0;
    Permitted last;
    std::string bytes;
    std::size_t part = 0;
    bool any = false;
  };

  /// Computes the window's rows [done_, to) and keeps what later rows need.
  void compute(std::size_t to) {
    if (to > done_) {
      found_.resize(to - done_);
      uses_.resize(to - done_);
      limits_.compute(window_.data(), window_.size() / width_, done_, to, {uses_.data(), found_.data()});
      note(window_.data() + done_ * width_);
      done_ = to;
    }
    const std::size_t drop = done_ > 1 ? done_ - 1 : 0;
    window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(drop * width_));
    done_ -= drop;
  }

  /// Keeps what was found for rows from row_ on.
  void note(const double* values) {
    use_.add(uses_.data(), uses_.size());
    for (const std::uint8_t number : found_) {
      rows_ += static_cast<char>(number);
      if (rows_.size() == part_rows) flush_rows();
      if (open_.empty()) continue;
      ++open_.front().counts[number];
      if (++open_.front().filled == cell_rows[first_counted]) close(0);
    }
    for (std::size_t i = 0; i < list_.size(); ++i) {
      Changes& changes = changes_[i];
      if (list_[i].key.empty() || changes.key >= width_) continue;
      for (std::size_t k = 0; k < found_.size(); ++k)
        if (const double key = values[k * width_ + changes.key]; !changes.any || key != changes.last_key)
          change(i, row_ + k, key, limits_.permitted(i, values + k * width_));
    }
    row_ += found_.size();
  }

  void change(std::size_t declared, std::size_t row, double key, const Permitted& now) {
    Changes& changes = changes_[declared];
    changes.last_key = key;
    if (changes.any && changes.last == now) return;
    changes.any = true;
    changes.last = now;
    put(changes.bytes, std::uint64_t{row}), put(changes.bytes, now.lowest), put(changes.bytes, now.highest);
    if (changes.bytes.size() == part_changes * 24) flush(declared);
  }

  /// Ends the open cell of a level; it becomes part of the next level's.
  void close(std::size_t k) {
    Level& level = open_[k];
    if (level.filled == 0) return;
    for (const std::uint32_t count : level.counts) put(level.bytes, count);
    if (k + 1 < open_.size()) {
      Level& next = open_[k + 1];
      for (std::size_t i = 0; i < level.counts.size(); ++i) next.counts[i] += level.counts[i];
      next.filled += level.filled;
    }
    std::fill(level.counts.begin(), level.counts.end(), 0);
    level.filled = 0;
    if (level.bytes.size() == part_cells * level.counts.size() * 4) flush(level);
    if (k + 1 < open_.size() && open_[k + 1].filled == cell_rows[first_counted + k + 1]) close(k + 1);
  }
  void flush_rows() {
    sink_({rows_name, row_part_++, std::move(rows_)});
    rows_.clear();
    rows_.reserve(part_rows);
  }
  void flush(Level& level) {
    const auto k = static_cast<std::size_t>(&level - open_.data());
    sink_({counts_name(first_counted + k), level.part++, std::move(level.bytes)});
    level.bytes.clear();
  }
  void flush(std::size_t declared) {
    Changes& changes = changes_[declared];
    sink_({changes_name(declared), changes.part++, std::move(changes.bytes)});
    changes.bytes.clear();
  }

  ViewInput input_;
  const ViewSink& sink_;
  std::size_t width_;
  DeclaredLimits list_;
  RowLimits limits_;
  ColumnEnvelope use_;
  std::size_t levels_;
  std::vector<Level> open_;
  std::vector<Changes> changes_;
  std::vector<double> window_;  // rows from one before the first that is not computed
  std::size_t done_ = 0;        // rows of the window that are computed
  std::vector<double> uses_;    // uses of the rows that were computed last
  std::vector<std::uint8_t> found_;
  std::string rows_;
  std::size_t row_part_ = 0, row_ = 0;
};

}  // namespace

std::unique_ptr<View> make_limits(const ViewInput& input, const ViewSink& sink) {
  return std::make_unique<LimitsView>(input, sink);
}

LimitsReader::LimitsReader(ViewReader read, std::size_t count)
    : read_(std::move(read)), count_(count), parts_(cell_rows.size() + 1, {static_cast<std::size_t>(-1), {}}) {
  const auto head = read_(head_name, 0);
  if (!head) throw std::runtime_error("the view of limits is missing");
  for (const auto& each : nlohmann::json::parse(*head)) {
    DeclaredLimit limit{each.at("name"), each.at("unit"), each.at("of"), each.at("order")};
    limit.permitted = {bound(each.at("lowest"), limit.permitted.lowest),
                       bound(each.at("highest"), limit.permitted.highest)};
    limit.key = each.at("key");
    columns_.push_back(each.at("column"));
    change_parts_.push_back(each.at("changes"));
    if (!limit.key.empty()) {
      const auto steps = read_(steps_name(list_.size()), 0);
      for (std::size_t k = 0; steps && k < steps->size() / 24; ++k)
        limit.steps.push_back(
            {get<double>(*steps, 3 * k), {get<double>(*steps, 3 * k + 1), get<double>(*steps, 3 * k + 2)}});
    }
    list_.push_back(std::move(limit));
  }
}

const std::string& LimitsReader::part(const std::string& name, std::size_t number, std::size_t slot) {
  auto& [held, bytes] = parts_[slot];
  if (held != number) {
    auto read = read_(name, number);
    if (!read) throw std::runtime_error("a view of limits is incomplete");
    bytes = std::move(*read);
    held = number;
  }
  return bytes;
}

LimitsReader::Counts LimitsReader::count(std::size_t from, std::size_t to) {
  Counts counts(numbers(), 0);
  const auto rows = [&](std::size_t a, std::size_t b) {
    while (a < b) {
      const std::string& bytes = part(rows_name, a / part_rows, cell_rows.size());
      const std::size_t begin = a % part_rows, end = std::min(bytes.size(), begin + b - a);
      if (begin >= end) throw std::runtime_error("a view of limits is damaged");
      for (std::size_t k = begin; k < end; ++k) ++counts.at(static_cast<unsigned char>(bytes[k]));
      a += end - begin;
    }
  };
  for_each_cell(
      from, to, count_,
      [&](std::size_t level, std::size_t index) {
        if (level < first_counted)
          return rows(index * cell_rows[level], std::min(count_, (index + 1) * cell_rows[level]));
        const std::string& bytes = part(counts_name(level), index / part_cells, level);
        for (std::size_t i = 0; i < counts.size(); ++i)
          counts[i] += get<std::uint32_t>(bytes, index % part_cells * counts.size() + i);
      },
      rows);
  return counts;
}

std::vector<LimitChange> LimitsReader::change_part(std::size_t declared, std::size_t number) {
  const auto bytes = read_(changes_name(declared), number);
  if (!bytes || bytes->empty()) throw std::runtime_error("a view of limits is incomplete");
  std::vector<LimitChange> changes;
  for (std::size_t k = 0; k < bytes->size() / 24; ++k)
    changes.push_back({static_cast<std::size_t>(get<std::uint64_t>(*bytes, 3 * k)),
                       {get<double>(*bytes, 3 * k + 1), get<double>(*bytes, 3 * k + 2)}});
  return changes;
}

std::vector<LimitChange> LimitsReader::changes(std::size_t declared, std::size_t from, std::size_t to,
                                               std::size_t most) {
  std::vector<LimitChange> found;
  std::size_t low = 0, high = change_parts_[declared];
  while (high - low > 1) {  // the last part that begins at or before `from`
    const std::size_t middle = low + (high - low) / 2;
    (change_part(declared, middle).front().first <= from ? low : high) = middle;
  }
  for (std::size_t number = low; number < change_parts_[declared] && found.size() < most; ++number)
    for (const LimitChange& change : change_part(declared, number)) {
      if (change.first >= to || found.size() == most) return found;
      if (change.first <= from)
        found.assign(1, {from, change.permitted});
      else
        found.push_back(change);
    }
  return found;
}

std::string LimitsReader::name(std::size_t number) const {
  static constexpr std::array<const char*, row_states> states{"ahead", "stop", "dwell"};
  return number < row_states ? states[number] : list_[number - row_states].name;
}

std::size_t most_frequent(const LimitsReader::Counts& counts) {
  return static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

}  // namespace bahnwerk::api
