#pragma once
/// A series of setpoints to slice, and readers of every format of the answer.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "api/setpoints/setpoints.hpp"

namespace bahnwerk::api::test {

using Table = std::vector<std::vector<double>>;

inline double cell(std::size_t row, std::size_t column) {
  return std::sin(0.01 * static_cast<double>(row) + static_cast<double>(column)) *
         std::pow(10.0, static_cast<double>(column));
}

/// A series that counts how much of it is read at once and in total.
struct Source {
  std::size_t rows;
  std::size_t widest = 0, total = 0;
  SetpointSeries series() {
    SetpointSeries s;
    s.columns = {{"x", "mm"}, {"vx", "mm/s"}, {"a,\"b\"", "mm/s²"}};
    s.count = rows;
    s.cycle_time = 0.001;
    s.read = [this](std::size_t first, std::size_t n, std::vector<double>& out) {
      ASSERT_LE(first + n, rows);
      widest = std::max(widest, n);
      total += n;
      out.clear();
      for (std::size_t r = first; r < first + n; ++r)
        for (std::size_t c = 0; c < 3; ++c) out.push_back(cell(r, c));
    };
    return s;
  }
};

inline std::string answer(Source& source, SetpointQuery query, SetpointFormat format) {
  SetpointStream stream(source.series(), std::move(query), format);
  std::string whole, piece;
  while (stream.next(piece)) {
    EXPECT_FALSE(piece.empty());
    EXPECT_LT(piece.size(), 80u * 1024);
    whole += piece;
    piece.clear();
  }
  EXPECT_TRUE(piece.empty());
  EXPECT_FALSE(stream.next(piece));
  return whole;
}

inline Table expected(std::size_t first, std::size_t end, std::size_t every) {
  Table rows;
  for (std::size_t r = first; r < end; r += every) rows.push_back({cell(r, 0), cell(r, 1), cell(r, 2)});
  return rows;
}

inline Table from_csv(const std::string& text, std::string* header = nullptr) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  if (header) *header = line;
  Table rows;
  while (std::getline(lines, line)) {
    std::vector<double> row;
    const char *at = line.data(), *end = at + line.size();
    for (;;) {
      double value;
      at = std::from_chars(at, end, value).ptr;
      row.push_back(value);
      if (at == end) break;
      ++at;
    }
    rows.push_back(row);
  }
  return rows;
}

inline Table from_json(const nlohmann::json& document) {
  const auto& columns = document["columns"];
  Table rows(columns[0]["values"].size());
  for (const auto& column : columns)
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r].push_back(column["values"][r].get<double>());
  return rows;
}

inline Table from_ndjson(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  Table rows;
  while (std::getline(lines, line)) {
    const auto row = nlohmann::json::parse(line);
    rows.push_back({row["x"].get<double>(), row["vx"].get<double>(), row["a,\"b\""].get<double>()});
  }
  return rows;
}

inline Table from_f64(const std::string& bytes) {
  Table rows(bytes.size() / 24, std::vector<double>(3));
  for (std::size_t i = 0; i < rows.size() * 3; ++i) std::memcpy(&rows[i / 3][i % 3], bytes.data() + 8 * i, 8);
  return rows;
}

inline Table table(Source& source, const SetpointQuery& query, SetpointFormat format) {
  const auto text = answer(source, query, format);
  if (format == SetpointFormat::csv) return from_csv(text);
  if (format == SetpointFormat::ndjson) return from_ndjson(text);
  if (format == SetpointFormat::f64) return from_f64(text);
  return from_json(nlohmann::json::parse(text));
}

}  // namespace bahnwerk::api::test
