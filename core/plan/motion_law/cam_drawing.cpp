#include "core/plan/motion_law/cam_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include "core/drawing/panel.hpp"
#include "core/drawing/spline_dxf.hpp"
#include "core/drawing/svg.hpp"
#include "core/drawing/ticks.hpp"

namespace bahnwerk {
namespace {

using cam::CamType;
using cam::FollowerType;

constexpr double degree = std::numbers::pi / 180;
constexpr double left = 84, right = 20, top = 64, width = 760, panel_height = 150;  // px
constexpr const char *ink = "fill=\"#20242a\"", *small = "fill=\"#20242a\" font-size=\"11\"";
constexpr const char *profile_colour = "#1f5fbf", *pitch_colour = "#8a919b", *follower_colour = "#d9730d";

Point at(const NurbsPath& curve, double angle) {
  const SplinePoint p = curve.at(std::clamp(angle, curve.begin(), curve.end()))[0];
  return {p[0], p[1]};
}

/// Points of a curve at half degrees.
std::vector<Point> points(const NurbsPath& curve) {
  std::vector<Point> out;
  for (int k = 0; k <= 720; ++k) out.push_back(at(curve, curve.begin() + (curve.end() - curve.begin()) * k / 720));
  return out;
}

class CamDrawing {
 public:
  explicit CamDrawing(const CamPlan& plan) : plan_(plan), g_(plan.geometry) {
    profile_ = points(plan.profile), pitch_ = points(plan.pitch);
    if (plan.other_flank) flank_ = points(*plan.other_flank);
    for (const auto* list : {&profile_, &pitch_, &flank_})
      for (const Point& p : *list) hold(p, 0);
    for (const Place& place : places()) hold(follower(place.angle), g_.has_roller() ? g_.roller_radius : 0);
    if (g_.type == CamType::radial) hold({0, 0}, plan.figures.base_radius);
    const double room = 0.04 * std::max(high_.x - low_.x, high_.y - low_.y);
    low_ -= {room, room}, high_ += {room, room};
    const double highest = 520;
    scale_ = std::min(width / (high_.x - low_.x), highest / (high_.y - low_.y));
    height_ = std::max(scale_ * (high_.y - low_.y), 120.0);
  }

  std::string draw() const {
    const int panels = g_.has_roller() ? 2 : 1;
    const double whole = top + height_ + 60 + panels * (panel_height + 64);
    std::string out = svg::open(left + width + right, whole);
    out += svg::text({6, 20}, title(), ink) + svg::text({6, 38}, figures(), small) + legend();
    out += grid();
    if (g_.type == CamType::radial) {
      out += svg::circle(px({0, 0}), scale_ * plan_.figures.base_radius,
                         "fill=\"none\" stroke=\"#aab1ba\" stroke-dasharray=\"2 3\"");
      for (const Point arm : {Point{1, 0}, Point{0, 1}})
        out += svg::segment(px(-(8 / scale_) * arm), px((8 / scale_) * arm), "stroke=\"#20242a\"");
    }
    if (g_.has_roller()) out += line(pitch_, std::string("stroke=\"") + pitch_colour + "\" stroke-dasharray=\"5 3\"");
    for (const auto* list : {&profile_, &flank_})
      out += line(*list, std::string("stroke-width=\"1.8\" stroke=\"") + profile_colour + "\"");
    for (const Place& place : places()) out += contact(place);
    double y = top + height_ + 60;
    if (g_.has_roller()) out += panel(true, y), y += panel_height + 64;
    return out + panel(false, y) + "</svg>\n";
  }

 private:
  struct Place {
    double angle;  // deg
    std::string words;
    bool other = false;  // whether the follower touches the other flank
  };
  void hold(Point p, double reach) {
    low_ = {std::min(low_.x, p.x - reach), std::min(low_.y, p.y - reach)};
    high_ = {std::max(high_.x, p.x + reach), std::max(high_.y, p.y + reach)};
  }
  Point px(Point p) const { return {left + scale_ * (p.x - low_.x), top + height_ - scale_ * (p.y - low_.y)}; }

  /// The angle inside the curves' range.
  double inside(double rad) const {
    double angle = rad / degree;
    while (angle > plan_.pitch.end()) angle -= 360;
    return std::max(angle, plan_.pitch.begin());
  }
  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-9 ? 0 : value);
    return text;
  }
  static std::string angle_text(double rad) {
    double angle = rad / degree;
    angle -= 360 * std::floor(angle / 360 + 1e-12);
    return number(angle) + " deg";
  }
  const cam::CamExtreme& steepest() const {
    const auto& f = plan_.figures;
    return f.pressure_angle.value > -f.pressure_angle_back.value ? f.pressure_angle : f.pressure_angle_back;
  }
  std::vector<Place> places() const {
    std::vector<Place> out;
    if (g_.has_roller())
      out.push_back({inside(steepest().at), "α " + number(std::abs(steepest().value) / degree) + "°"});
    if (const auto& r = plan_.figures.profile_radius)
      out.push_back({inside(r->at), "ρ " + number(r->value) + " mm",
                     plan_.other_flank && r->at == plan_.figures.pitch_curvature.at});
    return out;
  }
  /// The roller's centre, or the point of contact of a flat face.
  Point follower(double angle) const { return at(g_.has_roller() ? plan_.pitch : plan_.profile, angle); }

  std::string contact(const Place& place) const {
    const Point centre = follower(place.angle),
                touch = at(place.other ? *plan_.other_flank : plan_.profile, place.angle);
    const std::string stroke = std::string("fill=\"none\" stroke=\"") + follower_colour + "\"";
    std::string out = svg::circle(px(touch), 2.6, std::string("fill=\"") + follower_colour + "\"");
    // The words stand on the follower's side of the contact, away from the cam.
    Point words = px(centre);
    const bool leftwards = g_.type == CamType::radial && centre.x < 0;
    if (g_.has_roller() && g_.roller_radius > 0) {
      out += svg::circle(px(centre), scale_ * g_.roller_radius, stroke);
    } else if (!g_.has_roller()) {
      // The face is parallel to the profile's tangent.
      const Point way = unit(at(plan_.profile, place.angle + 0.01) - at(plan_.profile, place.angle - 0.01));
      const double half = std::max(plan_.figures.face_width, 0.2 * plan_.figures.base_radius);
      out += svg::segment(px(touch - half * way), px(touch + half * way), stroke + " stroke-width=\"1.5\"");
    }
    const double reach = scale_ * (g_.has_roller() ? g_.roller_radius : 0) + 6;
    if (g_.type == CamType::barrel)
      words.y -= reach + 4;
    else
      words.x += leftwards ? -reach : reach;
    words.x = leftwards ? std::max(words.x, 70.0) : std::min(words.x, left + width - 60);
    return out + svg::text({words.x, words.y + 4}, place.words,
                           std::string(small) + (leftwards ? " text-anchor=\"end\"" : ""));
  }

  std::string line(const std::vector<Point>& list, const std::string& style) const {
    if (list.empty()) return {};
    std::string d;
    char text[64];
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Point p = px(list[i]);
      std::snprintf(text, sizeof text, "%c%.1f %.1f", i == 0 ? 'M' : 'L', p.x, p.y);
      d += text;
    }
    return "<path" + svg::attribute("d", d) + " fill=\"none\" " + style + "/>\n";
  }

  std::string grid() const {
    const double bottom = top + height_, last = left + scale_ * (high_.x - low_.x);
    const double step = drawing::nice(60 / scale_);
    std::string out;
    drawing::for_each_tick(low_.x, high_.x, step, [&](double x) {
      out += svg::segment({px({x, 0}).x, top}, {px({x, 0}).x, bottom}, "stroke=\"#e6e9ed\"");
      out += svg::text({px({x, 0}).x, bottom + 15}, drawing::tick_label(x),
                       std::string(small) + " text-anchor=\"middle\"");
    });
    drawing::for_each_tick(low_.y, high_.y, step, [&](double y) {
      out += svg::segment({left, px({0, y}).y}, {last, px({0, y}).y}, "stroke=\"#e6e9ed\"");
      out +=
          svg::text({left - 6, px({0, y}).y + 4}, drawing::tick_label(y), std::string(small) + " text-anchor=\"end\"");
    });
    return out + svg::text({left - 6, top - 6}, "mm", std::string(small) + " text-anchor=\"end\"");
  }

  std::string title() const {
    std::string out = std::string(cam::name_of_cam(g_)) + ", ";
    out +=
        (g_.type == CamType::barrel ? "cylinder radius " : "base radius ") + number(plan_.figures.base_radius) + " mm";
    if (g_.has_roller()) out += ", roller radius " + number(g_.roller_radius) + " mm";
    return out + (g_.type == CamType::barrel ? "" : g_.clockwise ? ", turns clockwise" : ", turns counterclockwise");
  }
  std::string figures() const {
    const auto& f = plan_.figures;
    std::string out;
    if (g_.has_roller())
      out = "pressure angle " + number(f.pressure_angle.value / degree) + "° at " + angle_text(f.pressure_angle.at) +
            " and " + number(f.pressure_angle_back.value / degree) + "° at " + angle_text(f.pressure_angle_back.at);
    else
      out = "the contact takes " + number(f.face_width) + " mm of the face";
    if (f.profile_radius)
      out += "; least radius of the profile " + number(f.profile_radius->value) + " mm at " +
             angle_text(f.profile_radius->at);
    if (f.contact && f.contact->stress.value > 0)
      out += "; Hertz pressure " + number(f.contact->stress.value) + " N/mm² at " + angle_text(f.contact->stress.at);
    return out;
  }
  std::string legend() const {
    std::string out;
    double x = left;
    const auto entry = [&](const char* words, const std::string& style, double room) {
      out += svg::segment({x, 52}, {x + 24, 52}, style) + svg::text({x + 30, 56}, words, small);
      x += room;
    };
    entry(plan_.other_flank ? "flanks" : "profile",
          std::string("stroke-width=\"1.8\" stroke=\"") + profile_colour + "\"", 90);
    if (g_.has_roller())
      entry(plan_.other_flank ? "centre line" : "pitch curve",
            std::string("stroke-dasharray=\"5 3\" stroke=\"") + pitch_colour + "\"", 110);
    if (g_.type == CamType::radial) entry("base circle", "stroke-dasharray=\"2 3\" stroke=\"#aab1ba\"", 110);
    entry("follower", std::string("stroke=\"") + follower_colour + "\"", 90);
    return out;
  }

  std::string panel(bool angle, double y) const {
    drawing::Panel panel;
    drawing::PanelCurve curve;
    curve.colour = profile_colour;
    // A straight profile has no radius: what is far larger than the cam is drawn at the frame. A groove's centre line
    // turns to either side: its curvature is drawn.
    const double farthest = 3 * (plan_.figures.base_radius + 10 * g_.roller_radius);
    for (const cam::CamPlace& place : plan_.places) {
      const double radius =
          std::abs(place.curvature) * farthest > 1 ? 1 / place.curvature : std::copysign(farthest, place.curvature);
      const double bend = plan_.other_flank ? place.curvature : radius;
      curve.points.push_back({place.at / degree, angle ? place.pressure_angle / degree : bend});
    }
    panel.curves.push_back(std::move(curve));
    panel.title = angle               ? "pressure angle, deg"
                  : plan_.other_flank ? "curvature of the centre line, 1/mm"
                                      : "radius of curvature of the profile, mm (convex > 0)";
    panel.across = "angle of the cam, deg";
    if (angle && g_.pressure_angle) panel.limits = {*g_.pressure_angle / degree, -*g_.pressure_angle / degree};
    if (!angle && plan_.other_flank && g_.roller_radius + g_.profile_radius > 0)
      panel.limits = {1 / (g_.roller_radius + g_.profile_radius), -1 / (g_.roller_radius + g_.profile_radius)};
    else if (!angle && !plan_.other_flank && g_.profile_radius > 0)
      panel.limits = {g_.profile_radius};
    return drawing::panel_drawing(panel, left, y, width, panel_height);
  }

  const CamPlan& plan_;
  const cam::CamGeometry& g_;
  std::vector<Point> profile_, pitch_, flank_;
  Point low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
  double scale_ = 1, height_ = 0;
};

}  // namespace

std::string cam_drawing(const CamPlan& plan) { return CamDrawing(plan).draw(); }

std::string cam_dxf(const CamPlan& plan) {
  std::vector<NurbsPath> curves{plan.profile};
  if (plan.other_flank) curves.push_back(*plan.other_flank);
  return splines_as_dxf(curves, "cam");
}

}  // namespace bahnwerk
