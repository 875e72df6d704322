#include "core/plan/motion_law/law_drawings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/cam/law_table.hpp"
#include "core/drawing/svg.hpp"
#include "core/drawing/ticks.hpp"
#include "core/plan/motion_law/law_spectrum.hpp"

namespace bahnwerk {
namespace {

using cam::CamLaw;
using cam::Range;

constexpr double left = 84, right = 20, top = 56, gap = 30, width = 760, height = 150, columns = 900;  // px
constexpr const char *ink = "fill=\"#20242a\"", *small = "fill=\"#20242a\" font-size=\"11\"";
constexpr const char *law_colour = "#1f5fbf", *other_colour = "#8a919b", *box_colour = "#d9730d";

std::string px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string rectangle(double x, double y, double w, double h, const std::string& style) {
  return "<rect" + svg::attribute("x", px(x)) + svg::attribute("y", px(y)) + svg::attribute("width", px(w)) +
         svg::attribute("height", px(h)) + " " + style + "/>\n";
}

/// A panel: the master across, one derivative up.
class LawPanel {
 public:
  LawPanel(const LawPlan& plan, int order, double y)
      : plan_(plan), order_(order), y_(y), first_(cam::table_begin(plan.problem)), scale_(width / plan.problem.length) {
    hold_law(plan.solution.law);
    if (const CamLaw* other = compared()) hold_law(*other);
    for (const cam::MotionPoint& p : plan.problem.points) hold(p.value(order));
    hold_near_limits();
    // What rounding leaves of a derivative that is constant is no range.
    const auto positions = plan.solution.law.extremes(0);
    const double stroke = positions.highest.value - positions.lowest.value;
    const double usual = stroke / std::pow(plan.solution.law.duration(), order);
    const bool flat = !(high_ - low_ > 1e-9 * std::max({std::abs(low_), std::abs(high_), usual}));
    if (flat && std::abs(high_) < 1e-9 * usual) low_ = high_ = 0;
    const double room = flat ? std::max(1.0, std::abs(high_)) : 0.06 * (high_ - low_);
    low_ -= room, high_ += room;
  }

  std::string draw() const {
    std::string out = frame() + limits();
    if (const CamLaw* other = compared()) out += curve(*other, other_colour, 1.2, " stroke-dasharray=\"5 3\"");
    out += curve(plan_.solution.law, law_colour, 1.8, "");
    return out + boxes() + peaks();
  }

  const CamLaw* compared() const {
    if (plan_.source_law) return &plan_.source_law->law;
    return plan_.classical ? &*plan_.classical : nullptr;
  }

 private:
  void hold(Range range) {
    if (std::isfinite(range.min)) low_ = std::min(low_, range.min), high_ = std::max(high_, range.min);
    if (std::isfinite(range.max)) low_ = std::min(low_, range.max), high_ = std::max(high_, range.max);
  }
  /// Limits of sections that are not far from the curves.
  void hold_near_limits() {
    const double low = low_, high = high_, near = 0.3 * (high - low);
    for (std::size_t s = 0; s < plan_.problem.sections(); ++s) {
      const Range limit = plan_.problem.points[s].section[static_cast<std::size_t>(order_)];
      for (const double value : {limit.min, limit.max})
        if (value >= low - near && value <= high + near) hold({value, value});
    }
  }
  void hold_law(const CamLaw& law) {
    const auto extremes = law.extremes(order_);
    hold({extremes.lowest.value, extremes.highest.value});
  }
  double x(double angle) const { return left + (angle - first_) * scale_; }
  double y(double value) const {
    return std::clamp(y_ + height * (high_ - value) / (high_ - low_), y_ - 1, y_ + height + 1);
  }

  std::string frame() const {
    static constexpr const char* names[] = {"s", "v", "a", "j"};
    static constexpr const char* powers[] = {"", "/s", "/s²", "/s³"};
    std::string out = rectangle(left, y_, width, height, "fill=\"none\" stroke=\"#8a919b\"");
    const double step = drawing::nice(70 / scale_), up = drawing::nice(34 * (high_ - low_) / height);
    drawing::for_each_tick(first_, first_ + plan_.problem.length, step, [&](double angle) {
      out += svg::segment({x(angle), y_}, {x(angle), y_ + height}, "stroke=\"#e6e9ed\"");
      if (order_ == 3)
        out += svg::text({x(angle), y_ + height + 15}, drawing::tick_label(angle),
                         std::string(small) + " text-anchor=\"middle\"");
    });
    drawing::for_each_tick(low_, high_, up, [&](double value) {
      const bool zero = std::abs(value) < 1e-9 * (high_ - low_);
      out +=
          svg::segment({left, y(value)}, {left + width, y(value)}, zero ? "stroke=\"#aab1ba\"" : "stroke=\"#e6e9ed\"");
      out += svg::text({left - 6, y(value) + 4}, drawing::tick_label(zero ? 0 : value, up),
                       std::string(small) + " text-anchor=\"end\"");
    });
    out +=
        svg::text({left, y_ - 6}, std::string(names[order_]) + ", " + plan_.problem.slave_unit + powers[order_], small);
    if (order_ == 3)
      out += svg::text({left + width, y_ + height + 30}, "phi, " + plan_.problem.master_unit,
                       std::string(small) + " text-anchor=\"end\"");
    return out;
  }

  /// A line per piece: where derivatives jump it does, too.
  std::string curve(const CamLaw& law, const char* colour, double stroke, const std::string& dashes) const {
    std::string d;
    const double angle = plan_.problem.length / law.duration();
    for (std::size_t i = 0; i < law.pieces(); ++i) {
      const double share = law.piece_duration(i) / law.duration();
      const int n = std::max(2, static_cast<int>(std::ceil(share * columns)));
      bool pen = false;
      double before = 0;
      for (int k = 0; k <= n; ++k) {
        const double u = static_cast<double>(k) / n;
        double at = (law.breaks()[i] + u * law.piece_duration(i)) * angle, moved = 0;
        const double travel = order_ == 0 ? law.travel() : 0;
        if (law.periodic()) {
          while (at < first_ - 1e-9 * plan_.problem.length) at += plan_.problem.length, moved -= travel;
          while (at > first_ + plan_.problem.length * (1 + 1e-9)) at -= plan_.problem.length, moved += travel;
        }
        if (pen && at < before) pen = false;
        before = at;
        d += (pen ? "L" : "M") + px(x(at)) + " " + px(y(moved + law.in_piece(i, u, order_)));
        pen = true;
      }
    }
    return "<path" + svg::attribute("d", d) + " fill=\"none\"" + svg::attribute("stroke", colour) +
           svg::attribute("stroke-width", px(stroke)) + dashes + "/>\n";
  }

  /// The highest and the lowest value of a derivative, each a cross with its number.
  std::string peaks() const {
    std::string out;
    if (order_ == 0) return out;
    const auto extremes = plan_.solution.law.extremes(order_);
    const double most = std::max(std::abs(extremes.lowest.value), std::abs(extremes.highest.value));
    for (const cam::LawPeak& peak : {extremes.highest, extremes.lowest}) {
      if (!(std::abs(peak.value) > 1e-3 * most)) continue;
      double at = peak.at * plan_.problem.length / plan_.solution.law.duration();
      while (at < first_ - 1e-9 * plan_.problem.length) at += plan_.problem.length;
      while (at > first_ + plan_.problem.length * (1 + 1e-9)) at -= plan_.problem.length;
      const double px = x(at), py = y(peak.value);
      out += svg::segment({px - 4, py}, {px + 4, py}, std::string("stroke=\"") + law_colour + "\"") +
             svg::segment({px, py - 4}, {px, py + 4}, std::string("stroke=\"") + law_colour + "\"");
      char number[32];
      std::snprintf(number, sizeof number, "%.4g", peak.value);
      const bool right_half = px > left + width / 2;
      out += svg::text({px + (right_half ? -6 : 6), peak.value >= extremes.highest.value ? py + 12 : py - 5}, number,
                       std::string(small) + (right_half ? " text-anchor=\"end\"" : ""));
    }
    return out;
  }

  std::string limits() const {
    std::string out;
    const auto& problem = plan_.problem;
    for (std::size_t s = 0; s < problem.sections(); ++s) {
      const Range limit = problem.points[s].section[static_cast<std::size_t>(order_)];
      const double from = plan_.solution.at[s];
      const double to =
          s + 1 < plan_.solution.at.size() ? plan_.solution.at[s + 1] : plan_.solution.at[0] + problem.length;
      for (const double value : {limit.min, limit.max}) {
        if (!std::isfinite(value) || value < low_ || value > high_) continue;
        out += svg::segment({x(from), y(value)}, {x(std::min(to, first_ + problem.length)), y(value)},
                            "stroke=\"#c1121f\" stroke-dasharray=\"4 3\"");
      }
    }
    return out;
  }

  std::string boxes() const {
    std::string out;
    for (const cam::MotionPoint& p : plan_.problem.points) {
      const Range value = p.value(order_);
      if (value.free()) continue;
      const double w = std::max(7.0, (p.at.max - p.at.min) * scale_), middle = x((p.at.min + p.at.max) / 2);
      if (value.fixed() && p.at.fixed()) {
        out += svg::circle({x(p.at.min), y(value.min)}, 3.2, std::string("fill=\"") + box_colour + "\"");
        continue;
      }
      const double upper = y(value.max), lower = y(value.min);
      out += rectangle(middle - w / 2, upper - (value.fixed() ? 2 : 0), w,
                       std::max(lower - upper, value.fixed() ? 4.0 : 1.0),
                       std::string("fill=\"") + box_colour + "\" fill-opacity=\"0.18\" stroke=\"" + box_colour + "\"");
    }
    return out;
  }

  const LawPlan& plan_;
  int order_;
  double y_, first_, scale_;
  double low_ = HUGE_VAL, high_ = -HUGE_VAL;
};

std::string title(const LawPlan& plan) {
  char text[200];
  const cam::MotionLawProblem& problem = plan.problem;
  std::snprintf(text, sizeof text, "cycle %.6g s over %.6g %s", plan.solution.cycle_duration, problem.length,
                problem.master_unit.c_str());
  std::string out = text;
  if (problem.travel != 0) {
    std::snprintf(text, sizeof text, ", travel %.6g %s", problem.travel, problem.slave_unit.c_str());
    out += text;
  }
  std::snprintf(text, sizeof text, "; J %.6g, bound %.6g; degree %zu, %s", plan.solution.value.objective, plan.lower,
                plan.solution.law.max_degree(), problem.method == cam::LawMethod::optimal ? "optimal" : "active_set");
  return out + text;
}

/// Names what the panels show, and nothing else.
std::string legend(const LawPlan& plan, double y) {
  std::string out = svg::segment({left, y - 4}, {left + 24, y - 4},
                                 std::string("stroke-width=\"1.8\" stroke=\"") + law_colour + "\"") +
                    svg::text({left + 30, y}, "law", small);
  if (plan.source_law || plan.classical)
    out += svg::segment({left + 80, y - 4}, {left + 104, y - 4},
                        std::string("stroke-dasharray=\"5 3\" stroke=\"") + other_colour + "\"") +
           svg::text({left + 110, y}, plan.source_law ? "active_set" : "modified sines", small);
  bool ranges = false, limits = false;
  for (const cam::MotionPoint& point : plan.problem.points) {
    for (int order = 0; order < cam::limited_orders; ++order) {
      const Range value = point.value(order);
      ranges = ranges || !(value.free() || (value.fixed() && point.at.fixed()));
      limits = limits || !point.section[static_cast<std::size_t>(order)].free();
    }
  }
  // The dot as the panels have it, then what each of the others looks like.
  double x = left + 220;
  out += svg::circle({x + 4, y - 4}, 3.2, std::string("fill=\"") + box_colour + "\"") +
         svg::text({x + 14, y}, "numbers", small);
  x += 84;
  if (ranges) {
    out += rectangle(x, y - 9, 16, 9,
                     std::string("fill=\"") + box_colour + "\" fill-opacity=\"0.18\" stroke=\"" + box_colour + "\"") +
           svg::text({x + 22, y}, "ranges", small);
    x += 84;
  }
  if (limits)
    out += svg::segment({x, y - 4}, {x + 24, y - 4}, "stroke=\"#c1121f\" stroke-dasharray=\"4 3\"") +
           svg::text({x + 30, y}, "limits of sections", small);
  return out;
}

}  // namespace

std::string law_drawing(const LawPlan& plan) {
  std::string out = svg::open(left + width + right, top + 4 * (height + gap) + 20);
  out += svg::text({6, 20}, title(plan), ink) + legend(plan, 38);
  for (int r = 0; r < 4; ++r) out += LawPanel(plan, r, top + 10 + r * (height + gap)).draw();
  return out + "</svg>\n";
}

std::string spectrum_drawing(const LawPlan& plan) {
  constexpr double tall = 300;
  const std::size_t n = shown_harmonics(plan.problem);
  const auto law = acceleration_spectrum(plan.solution.law, n), classical = acceleration_spectrum(*plan.classical, n);
  const double most = std::max(
      {*std::max_element(law.begin(), law.end()), *std::max_element(classical.begin(), classical.end()), 1e-300});
  std::string out = svg::open(left + width + right, top + tall + 50);
  out += svg::text({6, 20}, "Harmonics of the acceleration, " + plan.problem.slave_unit + "/s²", ink);
  out += svg::segment({left, 34}, {left + 24, 34}, std::string("stroke-width=\"4\" stroke=\"") + law_colour + "\"") +
         svg::text({left + 30, 38}, "law", small) +
         svg::segment({left + 80, 34}, {left + 104, 34},
                      std::string("stroke-width=\"4\" stroke=\"") + other_colour + "\"") +
         svg::text({left + 110, 38}, "modified sines", small);
  out += rectangle(left, top, width, tall, "fill=\"none\" stroke=\"#8a919b\"");
  drawing::for_each_tick(0, most, drawing::nice(34 * most / tall), [&](double value) {
    const double y = top + tall * (1 - value / (1.05 * most));
    out += svg::segment({left, y}, {left + width, y}, "stroke=\"#e6e9ed\"");
    out += svg::text({left - 6, y + 4}, drawing::tick_label(value), std::string(small) + " text-anchor=\"end\"");
  });
  const double each = width / static_cast<double>(n), bar = std::max(1.0, 0.36 * each);
  // Writes a number with three digits, or with all before the point.
  const auto frequency = [&](std::size_t k) {
    const double hertz = static_cast<double>(k + 1) / plan.solution.cycle_duration;
    const double unit = std::min(1.0, std::pow(10.0, std::floor(std::log10(hertz)) - 2));
    return drawing::tick_label(std::round(hertz / unit) * unit);
  };
  std::size_t letters = 1;
  for (std::size_t k = 0; k < n; ++k) letters = std::max(letters, frequency(k).size());
  const double label = 7 * static_cast<double>(letters) + 8;  // px that a label takes
  const auto every = static_cast<std::size_t>(std::max(1.0, std::ceil(label / each)));
  for (std::size_t k = 0; k < n; ++k) {
    const double x = left + (static_cast<double>(k) + 0.5) * each;
    const auto draw = [&](double value, double at, const char* colour) {
      const double h = tall * value / (1.05 * most);
      out += rectangle(at, top + tall - h, bar, h, std::string("fill=\"") + colour + "\"");
    };
    draw(law[k], x - bar, law_colour);
    draw(classical[k], x, other_colour);
    if ((k + 1) % every == 0)
      out += svg::text({x, top + tall + 15}, frequency(k), std::string(small) + " text-anchor=\"middle\"");
  }
  out += svg::text({left + width, top + tall + 32}, "frequency, Hz", std::string(small) + " text-anchor=\"end\"");
  return out + "</svg>\n";
}

}  // namespace bahnwerk
