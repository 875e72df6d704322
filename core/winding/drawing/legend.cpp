#include "core/winding/drawing/legend.hpp"

#include <cmath>
#include <cstdio>

#include "core/drawing/svg.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pitch = 24, symbol = 30;  // px

std::string format(const char* text, double a, double b = 0) {
  char out[100];
  std::snprintf(out, sizeof out, text, a, b);
  return out;
}

class Entries {
 public:
  explicit Entries(Point at) : at_(at), top_(at.y) {}

  void swatch(const char* fill, const char* stroke, const std::string& words, double round = 2) {
    out_ += rect(0, symbol - 8, fill, stroke, round);
    words_of(words);
  }
  /// Draws the colours in their order.
  void colours(const std::string& words) {
    const double wide = (symbol - 4) / static_cast<double>(look::layer_count);
    for (std::size_t k = 0; k < look::layer_count; ++k)
      out_ += rect(static_cast<double>(k) * wide, wide, look::layers[k], "none", 0);
    words_of(words);
  }
  void stroke(const char* colour, double width, const char* more, const std::string& words) {
    out_ += line(at_, at_ + Point{symbol - 8, 0}, colour, width, more);
    words_of(words);
  }
  void sign(const char* sign, const char* colour, const std::string& words) {
    out_ += svg::text({at_.x + 8, at_.y + 4}, sign, std::string("text-anchor=\"middle\" fill=\"") + colour + "\"");
    words_of(words);
  }
  /// Draws the scale with a round length in millimetres.
  void scale(double pixels) {
    const double power = std::pow(10, std::floor(std::log10(100 / pixels)));
    const double left = 100 / pixels / power, mm = power * (left >= 5 ? 5 : left >= 2 ? 2 : 1);
    const double end = at_.x + mm * pixels;
    out_ += line(at_, {end, at_.y}, look::outline, 2, "");
    for (const double x : {at_.x, end}) out_ += line({x, at_.y - 5}, {x, at_.y + 5}, look::outline, 2, "");
    out_ += svg::text({end + 8, at_.y + 4}, format("%g mm", mm), "font-size=\"12\" fill=\"#20242a\"");
    at_.y += pitch;
  }
  Legend finish() && { return {std::move(out_), at_.y - top_}; }

 private:
  Point at_;
  double top_;
  std::string out_;

  static std::string line(Point a, Point b, const char* colour, double width, const char* more) {
    using svg::attribute;
    return "<line" + attribute("x1", svg::number(a.x)) + attribute("y1", svg::number(a.y)) +
           attribute("x2", svg::number(b.x)) + attribute("y2", svg::number(b.y)) + attribute("stroke", colour) +
           attribute("stroke-width", svg::number(width)) + more + "/>\n";
  }
  std::string rect(double x, double width, const char* fill, const char* stroke, double round) const {
    using svg::attribute;
    return "<rect" + attribute("x", svg::number(at_.x + x)) + attribute("y", svg::number(at_.y - 7)) +
           attribute("width", svg::number(width)) + attribute("height", "14") + attribute("rx", svg::number(round)) +
           attribute("fill", fill) + attribute("stroke", stroke) + "/>\n";
  }
  void words_of(const std::string& words) {
    out_ += svg::text({at_.x + symbol, at_.y + 4}, words, "font-size=\"12\" fill=\"#20242a\"");
    at_.y += pitch;
  }
};

}  // namespace

Legend legend(const Slot& slot, const DrawnWires& drawn, bool layerless, Point at, double pixels) {
  Entries entries(at);
  entries.scale(pixels);
  if (!drawn.wires.empty()) {
    entries.swatch(look::layers[0], look::enamel,
                   format("wire: copper %.4g mm, %.4g with enamel", drawn.copper, 2 * drawn.radius), 7);
    if (drawn.numbered) entries.sign("7", "#20242a", "number: order of laying");
    entries.colours(drawn.rows && std::abs(std::sin(*drawn.rows)) > 0.5 ? "colour: layer, a row along the flank"
                                                                        : "colour: layer, from the base up");
    if (layerless) entries.swatch(look::nowhere, look::enamel, "wire that no layer carries", 7);
  }
  if (!drawn.slipping.empty()) entries.sign("✕", look::slips, "wire that does not stay");
  if (drawn.unreached) entries.sign("○", look::unreached, "wire out of the needle's reach");
  if (slot.iron.area() > slot.usable_area.area() + slot.taken.area() + 1e-6)
    entries.swatch(look::liner, look::outline, "slot liner, usable area not used");
  if (!slot.wedge.empty()) entries.swatch(look::wedge, look::outline, "wedge");
  if (!slot.taken.empty()) entries.swatch(look::taken, look::outline, "other coil side");
  if (slot.opening) {
    if (slot.type == Slot::Type::stator) entries.stroke(look::outline, 5, "", "tooth tip");
    entries.stroke(look::opening, 2, " stroke-dasharray=\"5 3\"",
                   format("opening, %.4g mm clear", slot.opening->clear));
  }
  return std::move(entries).finish();
}

}  // namespace bahnwerk::winding
