#include "core/plan/contour/contour_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/progress.hpp"
#include "core/drawing/path_lines.hpp"
#include "core/drawing/svg.hpp"
#include "core/drawing/ticks.hpp"

namespace bahnwerk {
namespace {

using drawing::for_each_tick;
using drawing::nice;
using drawing::Sampler;
using drawing::Thinned;
using drawing::tick_label;

constexpr double plot_size = 720, least_width = 780, left = 64, right = 16, top = 60, gap = 44;  // px
constexpr double first_tolerance = 0.2, last_tolerance = 52;                                     // px
constexpr const char* ink = "fill=\"#20242a\"";

// Colours from rest to the largest speed of a cut.
constexpr char speed_colours[][8] = {"#2f3a9e", "#2c6fb0", "#2a97a8", "#35a77a", "#86b82f",
                                     "#c8b21f", "#e8971a", "#e06a18", "#cf3a1c", "#a3121a"};
// Classes of lines: positioning, the path of the coarse axes, and cuts, one class per colour.
constexpr std::size_t position_lines = 0, way_lines = 1, cut_lines = 2, classes = cut_lines + std::size(speed_colours);
const char* class_name(std::size_t of) {
  return of == position_lines ? "position" : of == way_lines ? "coarse" : "cut";
}

/// Returns the style of a class of lines on a canvas whose unit is `unit` px.
std::string style(std::size_t of, bool by_speed, double unit = 1) {
  char text[120];
  if (of >= cut_lines)
    std::snprintf(text, sizeof text, "stroke=\"%s\" stroke-width=\"%.4g\"",
                  by_speed ? speed_colours[of - cut_lines] : "#1f5fbf", (by_speed ? 2.2 : 1.6) / unit);
  else if (of == way_lines)
    std::snprintf(text, sizeof text, "stroke=\"#1d8a5f\" stroke-width=\"%.4g\"", 0.9 / unit);
  else
    std::snprintf(text, sizeof text, "stroke=\"%s\" stroke-width=\"%.4g\" stroke-dasharray=\"%.4g %.4g\"",
                  by_speed ? "#8a919b" : "#d9730d", 1 / unit, 4 / unit, 3 / unit);
  return text;
}

/// Speed along a path by its time law, at ascending places.
class Speeds {
 public:
  explicit Speeds(const TimeLaw& law) : pieces_(law.pieces()) {}
  /// Returns the speed, mm/s; within a piece v² is interpolated linearly in s, which is exact for a constant
  /// acceleration.
  double operator()(double s) {
    while (at_ + 1 < pieces_.size() && pieces_[at_].s_end < s) ++at_;
    const LawPiece& piece = pieces_[at_];
    const double end = piece.at(piece.duration).v, way = piece.s_end - piece.s,
                 share = way > 0 ? std::clamp((s - piece.s) / way, 0.0, 1.0) : 0;
    return std::sqrt(std::max(0.0, (1 - share) * piece.v * piece.v + share * end * end));
  }

 private:
  const LargeVector<LawPiece>& pieces_;
  std::size_t at_ = 0;
};

struct Box {
  Vec low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  void hold(Vec p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

/// A view: two coordinates on a frame with axes.
struct View {
  std::size_t across = 0, up = 1;
  Vec low, high;
  double scale = 1, y0 = top;
  double width() const { return scale * (high[across] - low[across]); }
  double height() const { return scale * (high[up] - low[up]); }
  Point operator()(Vec p) const { return {left + scale * (p[across] - low[across]), y0 + scale * (high[up] - p[up])}; }
};

std::string axes(const View& view) {
  static constexpr std::array names{"x, mm", "y, mm", "z, mm"};
  const double bottom = view.y0 + view.height(), end = left + view.width();
  std::string out = "<rect";
  for (const auto& [name, value] :
       {std::pair{"x", left}, {"y", view.y0}, {"width", view.width()}, {"height", view.height()}})
    out += svg::attribute(name, svg::number(value));
  out += " fill=\"none\" stroke=\"#8a919b\"/>\n";
  const std::string grid = "stroke=\"#e6e9ed\"", small = " font-size=\"11\"";
  const double step = nice(70 / view.scale), step_up = nice(36 / view.scale);
  for_each_tick(view.low[view.across], view.high[view.across], step, [&](double value) {
    const double x = left + view.scale * (value - view.low[view.across]);
    out += svg::segment({x, view.y0}, {x, bottom}, grid);
    out += svg::text({x, bottom + 15}, tick_label(value), ink + small + " text-anchor=\"middle\"");
  });
  for_each_tick(view.low[view.up], view.high[view.up], step_up, [&](double value) {
    const double y = view.y0 + view.scale * (view.high[view.up] - value);
    out += svg::segment({left, y}, {end, y}, grid);
    out += svg::text({left - 6, y + 4}, tick_label(value), ink + small + " text-anchor=\"end\"");
  });
  out += svg::text({end, bottom + 30}, names[view.across], ink + small + " text-anchor=\"end\"");
  out += svg::text({6, view.y0 - 6}, names[view.up], ink + small);
  return out;
}

class Drawer {
 public:
  Drawer(const Contour& contour, const ContourDrawingOptions& options, Progress progress)
      : contour_(contour), options_(options), progress_(progress) {}

  std::string run() {
    measure();
    find_fastest();
    arrange();
    double legend_end = 0;
    const std::size_t legend_size = legend(first_tolerance, &legend_end).size();
    std::string frame =
        svg::open(std::max({left + views_[0].width() + right, legend_end, by_speed() ? least_width : 0}),
                  views_.back().y0 + views_.back().height() + gap);
    frame += svg::text({6, 20}, options_.title, ink);
    for (const View& view : views_) frame += axes(view);
    const std::size_t around = frame.size() + legend_size + 400;
    budget_ = options_.max_bytes - std::min(options_.max_bytes, around);
    std::string paths;
    double tolerance = first_tolerance;
    while (tolerance <= last_tolerance && !draw(tolerance, paths)) tolerance *= std::numbers::sqrt2;
    const bool fits = tolerance <= last_tolerance;
    if (!fits)
      paths = svg::text({left + 12, views_[0].y0 + 24}, "The path is too intricate to be drawn.", "fill=\"#c1121f\"");
    return frame + legend(fits ? tolerance : 0) + paths + "</svg>\n";
  }

 private:
  bool cuts(const Block& block) const { return block.mode == Mode::cut; }
  bool by_speed() const { return options_.law && !options_.law->pieces().empty(); }

  /// Returns the largest speed of a cut.
  void find_fastest() {
    if (!by_speed()) return;
    std::vector<bool> cut(contour_.path.size(), false);
    for (const Block& block : contour_.blocks)
      for (std::size_t i = block.first; cuts(block) && i < block.last; ++i) cut[i] = true;
    for (const LawPiece& piece : options_.law->pieces()) {
      stage_progress();
      if (cut.at(piece.segment)) fastest_ = std::max({fastest_, piece.v, piece.at(piece.duration).v});
    }
  }
  std::size_t colour(double speed) const {
    const double n = static_cast<double>(std::size(speed_colours));
    return std::min(static_cast<std::size_t>(std::max(0.0, speed / fastest_ * n)), std::size(speed_colours) - 1);
  }

  void measure() {
    const std::function<void(Vec)> hold = [this](Vec p) { box_.hold(p); };
    for (const Block& block : contour_.blocks) {
      for (std::size_t i = block.first; i < block.last; ++i) {
        const Segment& segment = contour_.path[i];
        if (i == 0) box_.hold(segment.curve().at(segment.curve().begin()).value);
        Sampler(segment.length() / 500, hold)(segment);
        stage_progress();
        length_[cuts(block) ? 0 : 1] += segment.length();
      }
    }
    for (const Vec p : options_.way) box_.hold(p);
  }

  /// Arranges the views below each other at one scale, each with a margin.
  void arrange() {
    const Vec size = box_.high - box_.low;
    const double largest = std::max({size.x, size.y, size.z, 1e-9}), margin = 0.04 * largest;
    View view;
    view.scale = plot_size / (largest + 2 * margin);
    view.low = box_.low - Vec{margin, margin, margin};
    view.high = box_.high + Vec{margin, margin, margin};
    // Leave space for the legend and for ticks of paths along one axis.
    const double least = 320 / view.scale, thin = 60 / view.scale;
    if (const double wide = view.high.x - view.low.x; wide < least) view.high.x += least - wide;
    for (const std::size_t k : {1U, 2U}) {
      double &low = k == 1 ? view.low.y : view.low.z, &high = k == 1 ? view.high.y : view.high.z;
      if (const double more = thin - (high - low); more > 0) low -= more / 2, high += more / 2;
    }
    views_.push_back(view);
    if (contour_.dimension < 3 || !(size.z > 0)) return;
    view.up = 2;
    view.y0 = views_[0].y0 + views_[0].height() + gap + 16;
    views_.push_back(view);
  }

  using Lines = std::vector<Thinned>;  // lines by class

  /// Draws the lines of a cut in all views, coloured by speed.
  class CutLines {
   public:
    CutLines(const Drawer& drawer, std::vector<Lines>& views, double step)
        : drawer_(drawer), views_(views), step_(step) {
      if (drawer.by_speed()) speeds_.emplace(*drawer.options_.law);
    }
    void begin(Vec p, double s) {
      end();
      at_ = p, s_ = s;
      open(colour_at(s));
    }
    /// Draws a straight line; the speed is evaluated every `step` px.
    void to(Vec p) {
      const double length = norm(p - at_);
      const double px = drawer_.views_[0].scale * length;
      const int parts = speeds_ ? static_cast<int>(std::clamp(std::ceil(px / step_), 1.0, 1000.0)) : 1;
      for (int k = 1; k <= parts; ++k) {
        const double share = static_cast<double>(k) / parts;
        const std::size_t colour = colour_at(s_ + length * (share - 0.5 / parts));
        if (colour != colour_) {
          end();
          open(colour, k == 1 ? at_ : at_ + (share - 1.0 / parts) * (p - at_));
        }
        const Vec next = k == parts ? p : at_ + share * (p - at_);
        in_each([&](Thinned& line, const View& view) { line.to(view(next)); });
      }
      at_ = p, s_ += length;
    }
    /// Chords are shorter than the curve, so the length is set to `s` at the next segment's begin.
    void go_on(double s) { s_ = s; }
    void end() {
      if (colour_ < classes) in_each([](Thinned& line, const View&) { line.end(); });
      colour_ = classes;
    }

   private:
    std::size_t colour_at(double s) { return cut_lines + (speeds_ ? drawer_.colour((*speeds_)(s)) : 0); }
    void open(std::size_t colour) { open(colour, at_); }
    void open(std::size_t colour, Vec from) {
      colour_ = colour;
      in_each([&](Thinned& line, const View& view) { line.begin(view(from)); });
    }
    template <class Act>
    void in_each(Act&& act) {
      for (std::size_t v = 0; v < views_.size(); ++v) act(views_[v][colour_], drawer_.views_[v]);
    }

    const Drawer& drawer_;
    std::vector<Lines>& views_;
    double step_;  // px
    std::optional<Speeds> speeds_;
    Vec at_{};
    double s_ = 0;
    std::size_t colour_ = classes;
  };

  /// Draws all views at once, because points of a path take longer to compute than to draw. Returns false if the
  /// drawing exceeds its size limit.
  bool draw(double tolerance, std::string& paths) {
    std::vector<Lines> views(views_.size(), Lines(classes, Thinned(tolerance)));
    const auto size = [&] {
      std::size_t sum = (600 + 200 * std::size(speed_colours)) * views.size();
      for (const Lines& lines : views)
        for (const Thinned& each : lines) sum += each.data().size();
      return sum;
    };
    CutLines cut(*this, views, std::max(3.0, 2 * tolerance));
    for (const Block& block : contour_.blocks) {
      if (block.first == block.last) continue;
      const auto positioned = [&](auto&& act) {
        for (std::size_t v = 0; v < views.size(); ++v) act(views[v][position_lines], views_[v]);
      };
      const Segment& start = contour_.path[block.first];
      const Vec begin = start.curve().at(start.curve().begin()).value;
      if (cuts(block))
        cut.begin(begin, start.s0());
      else
        positioned([&](Thinned& line, const View& view) { line.begin(view(begin)); });
      const std::function<void(Vec)> to = [&](Vec p) {
        if (cuts(block))
          cut.to(p);
        else
          positioned([&](Thinned& line, const View& view) { line.to(view(p)); });
        stage_progress();
      };
      Sampler sampler(0.1 * tolerance / views_[0].scale, to);
      for (std::size_t i = block.first; i < block.last; ++i) {
        cut.go_on(contour_.path[i].s0());
        sampler(contour_.path[i]);
        if (size() > budget_) return false;
      }
      cut.end();
      positioned([](Thinned& line, const View&) { line.end(); });
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      Thinned& line = views[v][way_lines];
      for (const Vec& p : options_.way) {
        if (&p == options_.way.data()) line.begin(views_[v](p));
        line.to(views_[v](p));
        stage_progress();
        if (size() > budget_) return false;
      }
      line.end();
    }
    paths.clear();
    for (std::size_t v = 0; v < views.size(); ++v) {
      std::vector<std::size_t> order{position_lines};  // cuts on top of positioning
      for (std::size_t k = cut_lines; k < classes; ++k) order.push_back(k);
      order.push_back(way_lines);
      for (const std::size_t k : order)
        if (!views[v][k].data().empty()) append(paths, k, views[v][k]);
      if (contour_.path.empty()) continue;
      const Curve& first = contour_.path[0].curve();
      paths += svg::circle(views_[v](first.at(first.begin()).value), 4, "class=\"begin\" fill=\"#1d8a5f\"");
    }
    return paths.size() <= budget_;
  }

  void append(std::string& paths, std::size_t of, const Thinned& lines) const {
    char scale[40];
    std::snprintf(scale, sizeof scale, "scale(%.9g)", lines.lattice());
    paths.append("<path")
        .append(svg::attribute("class", class_name(of)))
        .append(svg::attribute("transform", scale))
        .append(svg::attribute("d", lines.data()))
        .append(" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" ")
        .append(style(of, by_speed(), lines.lattice()))
        .append("/>\n");
  }

  /// `end` is the position, px, at which the longest legend of any tolerance ends.
  std::string legend(double tolerance, double* end = nullptr) const {
    std::string out;
    double x = left;
    const auto entry = [&](const std::string& sample, const std::string& words) {
      out += sample + svg::text({x + 32, 42}, words, std::string(ink) + " font-size=\"12\"");
      x += 46 + 6.6 * static_cast<double>(words.size());
    };
    const auto line = [&](const std::string& look) { return svg::segment({x, 38}, {x + 26, 38}, look); };
    char words[60];
    for (const std::size_t k : {0U, 1U}) {
      std::snprintf(words, sizeof words, "%s %.6g mm", k == 0 ? "cut" : "position", length_[k]);
      if (length_[k] > 0 && k == 0 && by_speed())
        out += speed_key(x, words);
      else if (length_[k] > 0)
        entry(line(style(k == 0 ? cut_lines : position_lines, by_speed())), words);
    }
    if (!options_.way.empty()) entry(line(style(way_lines, by_speed())), "coarse axes");
    entry(svg::circle({x + 20, 38}, 4, "fill=\"#1d8a5f\""), "begin");
    if (tolerance > 0) {
      std::snprintf(words, sizeof words, "drawn to %.2g mm", tolerance / views_[0].scale);
      out += svg::text({x + 8, 42}, words, "fill=\"#5c6570\" font-size=\"12\"");
    }
    if (end) *end = x + 8 + 7.4 * static_cast<double>(std::string("drawn to 1.2e-05 mm").size());
    return out;
  }

  /// Draws "cut 300 mm, 0 [colours] 400 mm/s" and moves `x` behind it.
  std::string speed_key(double& x, const std::string& length) const {
    std::string out = svg::text({x, 42}, length + ": 0", std::string(ink) + " font-size=\"12\"");
    x += 7 * static_cast<double>(length.size() + 3) + 2;
    for (const char* colour : speed_colours) {
      out += "<rect" + svg::attribute("x", svg::number(x)) + " y=\"32\" width=\"9\" height=\"12\"" +
             svg::attribute("fill", colour) + "/>\n";
      x += 9;
    }
    char words[40];
    std::snprintf(words, sizeof words, "%.4g mm/s", fastest_);
    out += svg::text({x + 5, 42}, words, std::string(ink) + " font-size=\"12\"");
    x += 20 + 6.6 * static_cast<double>(std::string(words).size());
    return out;
  }

  void stage_progress() {
    if (++points_ % 4096 == 0) progress_.report("drawing", 1);
  }

  const Contour& contour_;
  const ContourDrawingOptions& options_;
  Progress progress_;
  Box box_;
  std::array<double, 2> length_{};  // mm, cut and positioned
  double fastest_ = 1e-9;           // mm/s, of cuts
  std::vector<View> views_;
  std::size_t points_ = 0, budget_ = 0;
};

}  // namespace

std::string contour_drawing(const Contour& contour, const ContourDrawingOptions& options, Progress progress) {
  return Drawer(contour, options, progress).run();
}

}  // namespace bahnwerk
