#pragma once
/// Writes small DXF files for tests.
#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/dxf.hpp"
#include "tests/core/contour/ends_of.hpp"

namespace bahnwerk::test {

class DxfText {
 public:
  template <class T>
  DxfText& tag(int code, const T& value) {
    out_ << code << '\n' << value << '\n';
    return *this;
  }
  template <class T, class... More>
  DxfText& tag(int code, const T& value, const More&... more) {
    tag(code, value);
    return tag(more...);
  }
  DxfText& section(const char* name) { return tag(0, "SECTION", 2, name); }
  DxfText& end() { return tag(0, "ENDSEC"); }
  DxfText& unit(int code) { return section("HEADER").tag(9, "$INSUNITS", 70, code).end(); }
  DxfText& line(double x0, double y0, double x1, double y1, const char* layer = "0") {
    return tag(0, "LINE", 8, layer, 10, x0, 20, y0, 11, x1, 21, y1);
  }
  DxfText& arc(double x, double y, double r, double start, double stop) {
    return tag(0, "ARC", 8, "0", 10, x, 20, y, 40, r, 50, start, 51, stop);
  }
  DxfText& circle(double x, double y, double r) { return tag(0, "CIRCLE", 8, "0", 10, x, 20, y, 40, r); }
  /// x, y, bulge
  DxfText& polyline(const std::vector<std::array<double, 3>>& vertices, bool closed) {
    tag(0, "LWPOLYLINE", 8, "0", 90, vertices.size(), 70, closed ? 1 : 0);
    for (const auto& v : vertices) tag(10, v[0], 20, v[1], 42, v[2]);
    return *this;
  }
  std::string eof() {
    tag(0, "EOF");
    return out_.str();
  }

 private:
  std::ostringstream out_ = [] {
    std::ostringstream out;
    out.precision(17);
    return out;
  }();
};

/// A file with these entities in millimetres.
template <class Fill>
std::string drawing(Fill fill) {
  DxfText text;
  text.unit(4).section("ENTITIES");
  fill(text);
  text.end();
  return text.eof();
}

template <class Fill>
Contour read(Fill fill, const DxfOptions& options = {}) {
  return read_dxf(drawing(fill), options);
}

inline std::vector<std::string> faults(const std::string& text, const DxfOptions& options = {}) {
  std::vector<std::string> list;
  try {
    read_dxf(text, options);
  } catch (const InvalidInput& e) {
    for (const InputFault& f : e.faults) {
      std::string all;
      for (const auto& p : f.place) all += "/" + p;
      list.push_back(all + " " + f.message);
    }
  }
  return list;
}

inline double cut_length(const Contour& c) {
  double sum = 0;
  for (const Block& b : c.blocks)
    for (std::size_t i = b.first; b.mode == Mode::cut && i < b.last; ++i) sum += c.path[i].length();
  return sum;
}
inline std::size_t cut_count(const Contour& c) {
  std::size_t n = 0;
  for (const Block& b : c.blocks) n += b.mode == Mode::cut ? 1 : 0;
  return n;
}
inline bool noted(const Contour& c, const std::string& what) {
  for (const std::string& n : c.notes)
    if (n.find(what) != std::string::npos) return true;
  return false;
}

}  // namespace bahnwerk::test
