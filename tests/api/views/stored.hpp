#pragma once
/// The views of a series in memory, and series to make them of.
#include <cmath>
#include <map>
#include <random>

#include "api/setpoints/setpoints.hpp"
#include "api/views/view_facts.hpp"
#include "api/views/views.hpp"

namespace bahnwerk::api::test {

using Parts = std::map<std::pair<std::string, std::size_t>, std::string>;

inline ViewReader reader(const Parts& parts) {
  return [&parts](std::string_view name, std::size_t part) -> std::optional<std::string> {
    const auto found = parts.find({std::string(name), part});
    return found == parts.end() ? std::nullopt : std::optional(found->second);
  };
}

/// Counts of rows about which views change their form.
inline constexpr std::size_t counts[] = {0, 1, 2, 3, 63, 64, 65, 1024, 1025, 4097, 40'000, 140'001};

/// A motion of one axis whose speed, and whose acceleration at other times, reach their limits in turn; it rests in
/// between. Columns x, vx, ax, v, block.
struct Motion {
  std::vector<Column> columns{{"x", "mm"}, {"vx", "mm/s"}, {"ax", "mm/s²"}, {"v", "mm/s"}, {"block", "1"}};
  std::size_t count;
  std::vector<double> values;
  ViewFacts facts;
  Parts parts;

  explicit Motion(std::size_t rows) : count(rows) {
    std::mt19937_64 random(rows);
    std::uniform_real_distribution<double> unit(-1, 1);
    double x = 0, v = 0, a = 0, block = 0;
    std::size_t left = 0;
    int what = 0;
    for (std::size_t k = 0; k < rows; ++k, --left) {
      if (left == 0) {
        left = 1 + random() % 97;
        what = static_cast<int>(random() % 5);
        block += static_cast<double>(random() % 2);
      }
      v = what == 0 ? 0 : what == 1 ? 90 + 10 * (block - 2 * std::floor(block / 2)) : 60 * unit(random);
      a = what == 2 ? (random() % 2 ? 4000 : -4000) : 3000 * unit(random);
      if (what == 0) a = 0;
      x += 0.001 * v;
      for (const double value : {x, v, a, std::abs(v), block}) values.push_back(value);
    }
    declare_feeds(facts.limits, [&] {
      std::vector<double> feeds(static_cast<std::size_t>(block) + 1);
      for (std::size_t b = 0; b < feeds.size(); ++b) feeds[b] = b % 2 == 0 ? 90 : unlimited;
      return feeds;
    }());
    Machine machine;
    machine.axes.emplace_back("x", 100, 4000, 7e6);
    declare_axes(facts.limits, machine);
    make_views(
        {columns, count, 0.001, std::make_shared<const ViewFacts>(facts)},
        [&](ViewPart part) {
          parts[{part.name, part.part}] = std::move(part.bytes);
        },
        [&](std::size_t first, std::size_t n, std::vector<double>& out) { read(first, n, out); });
  }
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
  void read(std::size_t first, std::size_t n, std::vector<double>& out) const {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first * columns.size());
    out.assign(begin, begin + static_cast<std::ptrdiff_t>(n * columns.size()));
  }
  SetpointSeries series() const {
    SetpointSeries s;
    s.columns = columns;
    s.count = count;
    s.cycle_time = 0.001;
    s.independent.step = 0.001;
    s.read = [this](std::size_t first, std::size_t n, std::vector<double>& out) { read(first, n, out); };
    s.view = reader(parts);
    return s;
  }
};

/// An interval of rows that random numbers choose.
struct Zoom {
  std::size_t first, rows, points;
  template <class Random>
  Zoom(Random& random, std::size_t count) {
    first = random() % (count + 1);
    rows = random() % 3 == 0 ? count - first : random() % (count - first + 1);
    if (random() % 4 == 0) first = 0, rows = count;
    points = 1 + random() % 500;
  }
};

}  // namespace bahnwerk::api::test
