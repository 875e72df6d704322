#pragma once
/// A panel of a chart: a frame with ticks, curves and limits.
#include <string>
#include <vector>

#include "core/geometry/region/point.hpp"

namespace bahnwerk::drawing {

struct PanelCurve {
  std::string name, colour;
  std::vector<Point> points;  ///< points in the units of the panel, x ascending
  bool marked = false;        ///< whether every point has a dot
};

struct Panel {
  std::string title, across;  ///< quantity of the vertical axis with its unit; quantity of the horizontal axis, empty:
                              ///< no numbers there
  std::vector<PanelCurve> curves;
  std::vector<double> limits;  ///< values at which dashed lines are drawn
  bool from_zero = false;      ///< whether the range of values begins at 0
};

/// Returns the SVG of the panel; its frame is at (left, top), `width` by `height`, in px; values grow upwards. Curves
/// are polylines through their points, rounded to tenths of a px. O(points).
std::string panel_drawing(const Panel& panel, double left, double top, double width, double height);

/// Margins that a panel needs around its frame, px.
inline constexpr double panel_left = 72, panel_top = 24, panel_bottom = 34;

/// Reduces a curve with many more points than the panel has columns to the lowest and highest value in each of
/// `columns` columns over [0, end]: two points at the column's middle. O(1) per value.
class Envelope {
 public:
  Envelope(std::size_t columns, double end);
  void add(double x, double value);
  std::vector<Point> points() const;

 private:
  double end_;
  std::vector<double> low_, high_;
};

}  // namespace bahnwerk::drawing
