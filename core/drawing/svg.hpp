#pragma once
/// Elements of SVG text. Lengths and positions are in px.
#include <cstdio>
#include <string>

#include "core/geometry/region/point.hpp"

namespace bahnwerk::svg {

/// Returns a number with at most four digits behind the decimal point.
inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4f", value);
  std::string s = text;
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s == "-0" ? "0" : s;
}

/// Returns ` name="value"`.
inline std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

/// Returns the opening tag of a drawing with a white background.
inline std::string open(double width, double height) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", number(width)) +
         attribute("height", number(height)) + attribute("viewBox", "0 0 " + number(width) + " " + number(height)) +
         " font-family=\"system-ui,sans-serif\" font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" "
         "fill=\"#ffffff\"/>\n";
}

inline std::string circle(Point at, double radius, const std::string& style) {
  return "<circle" + attribute("cx", number(at.x)) + attribute("cy", number(at.y)) + attribute("r", number(radius)) +
         " " + style + "/>\n";
}

/// Returns a straight line from a to b.
inline std::string segment(Point a, Point b, const std::string& style) {
  return "<path" +
         attribute("d", std::string("M") + number(a.x) + " " + number(a.y) + "L" + number(b.x) + " " + number(b.y)) +
         " " + style + "/>\n";
}

/// Returns text with & and < escaped.
inline std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      out += c;
    }
  }
  return out;
}

inline std::string text(Point at, const std::string& words, const std::string& style) {
  return "<text" + attribute("x", number(at.x)) + attribute("y", number(at.y)) + " " + style + ">" + escaped(words) +
         "</text>\n";
}

}  // namespace bahnwerk::svg
