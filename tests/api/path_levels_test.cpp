#include "api/views/path_levels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "api/problem.hpp"
#include "api/setpoints/path_answer.hpp"

namespace bahnwerk::api {
namespace {

/// A path with straight parts, curves, rests and corners, in the columns block, x, y (, z), v.
struct Series {
  std::vector<Column> columns{{"block", "1"}, {"x", "mm"}, {"y", "mm"}};
  std::vector<double> values;
  std::size_t count = 0;
  Series(std::size_t rows, bool space, unsigned seed) : count(rows) {
    if (space) columns.push_back({"z", "mm"});
    columns.push_back({"v", "mm/s"});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    double x = 0, y = 0, z = 0, direction = 0, turn = 0, step = 0.01;
    for (std::size_t k = 0; k < rows; ++k) {
      if (random() % 97 == 0) turn = 0.1 * uniform(random), step = 0.05 * std::abs(uniform(random));
      if (random() % 191 == 0) direction += 3 * uniform(random), step = 0;
      direction += turn;
      x += step * std::cos(direction), y += step * std::sin(direction), z += 0.1 * step * turn;
      values.push_back(static_cast<double>(k / 100));
      values.insert(values.end(), {x, y});
      if (space) values.push_back(z);
      values.push_back(step);
    }
  }
  Vec at(std::size_t k) const {
    const double* row = values.data() + k * columns.size() + 1;
    return {row[0], row[1], columns.size() == 5 ? row[2] : 0};
  }
};

using Parts = std::map<std::pair<std::string, std::size_t>, std::string>;

Parts stored(const Series& series) {
  Parts parts;
  const ViewInput input{series.columns, series.count, 0.001};
  const ViewSink sink = [&](ViewPart part) {
    EXPECT_TRUE(parts.emplace(std::pair(part.name, part.part), part.bytes).second) << part.name << part.part;
  };
  const auto view = path_view(input, sink);
  if (!view) return parts;
  const std::size_t width = series.columns.size();
  for (std::size_t first = 0; first < series.count; first += 1000)
    view->add(first, std::min<std::size_t>(1000, series.count - first), series.values.data() + first * width);
  view->finish();
  return parts;
}

PathRows rows_of(const Series& series) {
  const std::size_t width = series.columns.size();
  return {series.count, width, RowVertices(series.columns, path_columns(series.columns).at(0)),
          [&series, width](std::size_t first, std::size_t rows, std::vector<double>& out) {
            const auto begin = series.values.begin() + static_cast<std::ptrdiff_t>(first * width);
            out.assign(begin, begin + static_cast<std::ptrdiff_t>(rows * width));
          }};
}

ViewReader reader(const Parts& parts) {
  return [&parts](std::string_view name, std::size_t part) -> std::optional<std::string> {
    const auto at = parts.find({std::string(name), part});
    return at == parts.end() ? std::nullopt : std::optional(at->second);
  };
}

double distance(Vec p, Vec a, Vec b) {
  const Vec way = b - a;
  const double length = dot(way, way), t = length > 0 ? std::clamp(dot(p - a, way) / length, 0.0, 1.0) : 0;
  return norm(p - (a + t * way));
}

Vec at(const PathVertex& v) { return {v.at[0], v.at[1], v.at[2]}; }

/// Expects that the rows [first, end) in the box are within the tolerance of the chord over them.
void expect_held(const Series& series, const ChosenPath& path, std::size_t first, std::size_t end,
                 const std::optional<PathBox>& box) {
  std::vector<bool> held(series.count, false);
  for (const auto& run : path.runs) {
    for (const PathVertex& v : run) {
      ASSERT_LE(norm(at(v) - series.at(v.row)), 1e-6 * (1 + norm(at(v))));
      ASSERT_EQ(v.block, v.row / 100);
      held[v.row] = true;
    }
    for (std::size_t i = 1; i < run.size(); ++i)
      for (std::size_t k = run[i - 1].row; k <= run[i].row; ++k) {
        held[k] = true;
        ASSERT_LE(distance(series.at(k), at(run[i - 1]), at(run[i])), path.tolerance) << k;
      }
  }
  for (std::size_t k = first; k < end; ++k) {
    const Vec p = series.at(k);
    if (!box || (p.x >= box->x0 && p.x <= box->x1 && p.y >= box->y0 && p.y <= box->y1)) {
      ASSERT_TRUE(held[k]) << k;
    }
  }
}

/// A rapid move in line with the cuts before and behind it keeps its ends in every level.
TEST(PathLevels, AChordIsOfOneMode) {
  Series series(0, false, 1);
  series.columns.push_back({"mode", "1"});
  series.count = 300;
  const auto cut = [](std::size_t row) { return row < 100 || row >= 200; };
  for (std::size_t k = 0; k < series.count; ++k)
    series.values.insert(series.values.end(),
                         {static_cast<double>(k / 100), 0.1 * static_cast<double>(k), 0, 1, cut(k) ? 1.0 : 0.0});
  const Parts parts = stored(series);
  const StoredPath path(reader(parts), "tool");
  for (std::size_t level = 0; level < path_tolerances.size(); ++level)
    for (const auto& run : path.read(level, 0, series.count, std::nullopt))
      for (std::size_t i = 1; i < run.size(); ++i)
        for (std::size_t k = run[i - 1].row + 1; k <= run[i].row; ++k)
          EXPECT_EQ(run[i].cut, cut(k)) << level << ' ' << k;
}

TEST(PathLevels, RowsAreWithinTheToleranceAtRandomZooms) {
  std::mt19937 random(7);
  for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 1000U, 30000U})
    for (const bool space : {false, true}) {
      const Series series(count, space, static_cast<unsigned>(count));
      const Parts parts = stored(series);
      const StoredPath path(reader(parts), "tool");
      ASSERT_TRUE(path.exists());
      ASSERT_EQ(path.dimension(), space ? 3U : 2U);
      for (int trial = 0; trial < 30; ++trial) {
        PathQuery query;
        query.first = random() % count;
        query.count = 1 + random() % (count - query.first);
        const Vec middle = series.at(random() % count);
        const double size = std::pow(10.0, static_cast<double>(random() % 5) - 2);
        if (random() % 2) query.box = {middle.x - size, middle.y - size, middle.x + size, middle.y + size};
        if (random() % 2)
          query.points = 2 + random() % 300;
        else
          query.tolerance = std::pow(10.0, static_cast<double>(random() % 50) / 10 - 4);
        const ChosenPath chosen = choose_path(path, query, rows_of(series));
        expect_held(series, chosen, query.first, query.first + *query.count, query.box);
        std::size_t vertices = 0;
        for (const auto& run : chosen.runs) vertices += run.size();
        EXPECT_LE(query.points ? vertices : 0, std::max(query.points.value_or(0), 2 * chosen.runs.size()));
        EXPECT_LE(query.tolerance ? chosen.tolerance : 0, query.tolerance.value_or(0) + 1e-4);
      }
    }
}

TEST(PathLevels, ASeriesWithoutAPlaceHasNoPath) {
  const ViewSink sink = [](const ViewPart&) {};
  EXPECT_EQ(path_view({{{"phi", "deg"}, {"s", "mm"}}, 100, 0.001}, sink), nullptr);
  EXPECT_EQ(path_view({{{"x", "mm"}, {"y", "mm"}}, 0, 0.001}, sink), nullptr);
  const Parts none;
  EXPECT_FALSE(StoredPath(reader(none), "tool").exists());
  ASSERT_EQ(path_columns({{"x", ""}, {"y", ""}, {"xc", ""}, {"yc", ""}, {"zc", ""}}).size(), 2U);
}

TEST(PathAnswer, QueriesAreReadAndRefusedAtTheirPlace) {
  const PathQuery query = parse_path_query({{"tolerance", "0.5"}, {"box", "-1,2e0,3.5,4"}, {"columns", "v,line"}});
  EXPECT_EQ(query.tolerance, 0.5);
  EXPECT_EQ(query.box->y0, 2);
  EXPECT_EQ(query.columns, (std::vector<std::string>{"v", "line"}));
  EXPECT_TRUE(parse_path_query({}).points);
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{{"points", "1"},
                                                                                    {"points", "-3"},
                                                                                    {"tolerance", "-1"},
                                                                                    {"tolerance", "inf"},
                                                                                    {"box", "1,2,3"},
                                                                                    {"box", "3,0,1,1"},
                                                                                    {"box", "a,0,1,1"},
                                                                                    {"of", ""},
                                                                                    {"columns", ""},
                                                                                    {"count", "0"},
                                                                                    {"format", "f64"}}) {
    try {
      parse_path_query({{name, value}});
      ADD_FAILURE() << name << "=" << value << " is accepted";
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.errors().at(0).pointer, "/query/" + name);
    }
  }
}

TEST(PathAnswer, BothFormsHaveTheSameNumbers) {
  const Series series(500, false, 3);
  const Parts parts = stored(series);
  PathQuery query;
  query.points = 40;
  const ChosenPath chosen = choose_path(StoredPath(reader(parts), "tool"), query, rows_of(series));
  const std::vector<PathColumn> columns{{"v", "mm/s", [](const PathVertex& v) { return v.v; }}};
  EXPECT_EQ(path_column_names(2, columns), "row,begin,x,y,v");
  const std::string json = path_json(chosen, query, 2, columns), bytes = path_f32(chosen, 2, columns);
  EXPECT_NE(json.find("\"count\":" + std::to_string(bytes.size() / 20) + ","), std::string::npos);
  EXPECT_TRUE(json.starts_with(R"({"of":"tool","tolerance":)"));
  EXPECT_NE(json.find(R"("begin":[1,0)"), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk::api
