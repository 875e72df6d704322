#pragma once
/// A small SVG writer: one chart with two axes, or a map drawn to scale, on a light background, 800 px wide.
#include <string>
#include <vector>

namespace bahnwerk::draw {

struct Point {
  double x = 0, y = 0;
};
using Line = std::vector<Point>;

struct Style {
  std::string colour = "#000000";
  double width = 1.8;  ///< px
  std::string dash;    ///< SVG dash array, empty = solid
  double opacity = 1;
  bool round = false;  ///< round ends: stretches of different colours join without a gap
};

struct Range {
  double from = 0, to = 1;
};

class Chart {
 public:
  struct Frame {
    std::string title, x_label, y_label;
    Range x, y;
    double width = 800, height = 420;  ///< px
    bool equal_scale = false;          ///< a map: one millimetre is as long in x as in y
    double right = 24;                 ///< margin, px
    std::string id = "frame";          ///< charts of one file need different ones
    bool legend = true;                ///< leaves room for it
  };
  explicit Chart(Frame frame);

  /// Clipped to the frame. With a label the line appears in the legend above the chart.
  void line(const Line& points, const Style& style, const std::string& label = {});
  /// All that is at most `reach` (units of x) away from the points; only in a map.
  void tube(const Line& points, double reach, const std::string& colour, const std::string& label);
  /// A vertical bar of colours from `low` to `high` with its label, right of the frame.
  void colour_bar(Range values, const std::string& label);
  /// Colour of a fraction 0 … 1: dark blue, green, yellow, red; readable on white.
  static std::string colour(double fraction);
  void note(Point at, const std::string& text, const std::string& anchor = "middle");

  void save(const std::string& file) const;  ///< throws std::runtime_error when it cannot be written
  /// Several charts of one width below each other; throws as above.
  static void save(const std::string& file, const std::vector<Chart>& charts);

 private:
  double px(double x) const;
  double py(double y) const;
  void axes();
  void legend(const std::string& label);
  void text(double x, double y, const std::string& words, const std::string& extra);

  Frame frame_;
  double left_ = 72, top_ = 68, bottom_ = 52;  // px
  std::string body_;
  double legend_x_ = 0;
};

}  // namespace bahnwerk::draw
