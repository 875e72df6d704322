// The pictures and the table of docs/methods/fill_factor.md: layouts of the example slots as the service draws them,
// and the slots' parameters.
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "core/base/progress.hpp"
#include "core/drawing/svg.hpp"
#include "core/plan/fill_drawings.hpp"
#include "docs/draw/pictures.hpp"

namespace bahnwerk::draw {
namespace {

using namespace winding;

void save(const std::string& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file);
}

FillRequest request(const Slot& slot, std::vector<Wire> wires, std::vector<Algorithm> algorithms) {
  FillRequest r;
  r.slot = slot;
  r.wires = std::move(wires);
  r.algorithms = std::move(algorithms);
  r.tie_in = slot.tension_point;
  return r;
}

FillRequest stator_sweep() {
  FillRequest r = request(make_slot(StatorSlot{}), standard_wires(2, 0.5, 1.6, Series::r20),
                          {Algorithm::orthocyclic_base, Algorithm::orthocyclic_flank, Algorithm::raabe,
                           Algorithm::potential, Algorithm::needle});
  r.heads = StatorHeads{};
  return r;
}

/// A slot without wires, its parameters beside it.
class Labelled {
 public:
  explicit Labelled(const Slot& slot, double right)
      : box_(slot.iron.box()),
        scale_(std::min(600 / (box_.high.x - box_.low.x), 640 / (box_.high.y - box_.low.y))),
        out_(svg::open(2 * side + right + scale_ * (box_.high.x - box_.low.x),
                       2 * side + scale_ * (box_.high.y - box_.low.y))) {
    outline(slot.iron, "fill=\"#e6e9ed\" stroke=\"#4a525c\" stroke-width=\"1.6\"");
    outline(slot.usable_area, "fill=\"#ffffff\" stroke=\"#8a919b\" stroke-width=\"1\"");
  }
  /// A line with ticks from `a` to `b`, its name beside the middle.
  void length(Point a, Point b, const std::string& name, Point offset = {0, 8}) {
    const Point p = at(a), q = at(b), tick = 5.0 * left_of(unit(q - p));
    const std::string blue = "stroke=\"#1f5fbf\" stroke-width=\"1.2\"";
    out_ += svg::segment(p, q, blue) + svg::segment(p - tick, p + tick, blue) + svg::segment(q - tick, q + tick, blue);
    note(0.5 * (a + b), name, offset);
  }
  void note(Point p, const std::string& name, Point offset = {0, 0}) {
    const Point q = at(p);
    out_ += svg::text({q.x + offset.x, q.y - offset.y}, name, "fill=\"#1f5fbf\" text-anchor=\"middle\"");
  }
  void save_as(const std::string& file) const { save(file, out_ + "</svg>\n"); }

 private:
  static constexpr double side = 70;  // px
  Box box_;
  double scale_;
  std::string out_;

  Point at(Point p) const { return {side + scale_ * (p.x - box_.low.x), side + scale_ * (box_.high.y - p.y)}; }
  void outline(const Region& region, const std::string& style) {
    std::string d;
    for (std::size_t i = 0; i < region.edges().size(); ++i) {
      const Edge& edge = region.edges()[i];
      const int pieces = edge.straight() ? 1 : 24;
      for (int k = region.begins_loop(i) ? 0 : 1; k <= pieces; ++k) {
        const Point p = at(edge.at(static_cast<double>(k) / pieces));
        d += (k == 0 ? "M" : "L") + svg::number(p.x) + " " + svg::number(p.y);
      }
    }
    out_ += "<path d=\"" + d + "Z\" " + style + "/>\n";
  }
};

void slot_parameters(const std::string& folder) {
  const StatorSlot s;
  Labelled stator(make_slot(s), 120);
  const double corner = s.base_radius - std::sqrt(s.base_radius * s.base_radius - s.base_width * s.base_width / 4);
  const double half = s.base_width / 2, top = half - (s.height - corner) * std::tan(s.tip_angle - std::acos(0.0));
  stator.length({-half, -0.7}, {half, -0.7}, "b_N", {0, -18});
  stator.length({-s.opening_width / 2, s.height + 0.6}, {s.opening_width / 2, s.height + 0.6}, "b_t = b_DS");
  stator.length({half + 1.8, 0}, {half + 1.8, s.height}, "h_N", {20, 0});
  stator.note({top, s.height - 0.1}, "φ_et, r_et", {44, 0});
  stator.note({half, 0.3}, "r_eb", {30, 6});
  stator.note({0, 0}, "r_b", {0, -16});
  stator.note({0, s.height - s.wedge_thickness / 2}, "d_DS", {0, -5});
  stator.note({-half, 8}, "d_Iso", {-14, 0});
  stator.save_as(folder + "/stator_slot.svg");

  const RotorSlot r;
  Labelled rotor(make_slot(r), 20);
  const Point root{std::cos(r.root_angle), std::sin(r.root_angle)},
      shoe{-std::cos(r.shoe_angle), std::sin(r.shoe_angle)};
  rotor.length({0, -0.6}, {r.base_width, -0.6}, "b_N", {0, -18});
  rotor.length(Point{-0.5, -0.2}, r.root_flank * root + Point{-0.5, -0.2}, "l_b", {-18, 0});
  const Point foot = Point{r.base_width, r.shoe_radius} + r.shoe_radius * Point{shoe.y, -shoe.x} + Point{0.4, -0.2};
  rotor.length(foot, foot + r.shoe_flank * shoe, "l_t", {18, -4});
  const double first = r.base_width - (r.grooves - 1) * r.groove_pitch;
  rotor.length({first + 4 * r.groove_pitch, 1}, {first + 5 * r.groove_pitch, 1}, "b_Gr", {0, 8});
  rotor.note({first + 2 * r.groove_pitch, 0.5}, "r_Gr", {0, 6});
  rotor.note({0.3, 0.6}, "φ_b", {10, 12});
  rotor.note({r.base_width + 0.3, 0.6}, "φ_t, r_t", {-12, 12});
  rotor.save_as(folder + "/rotor_slot.svg");
}

}  // namespace

void fill_pictures(const std::string& folder) {
  slot_parameters(folder);
  Progress silent;
  const FillRequest sweep = stator_sweep();
  const FillPlan plan = plan_fill(sweep, silent);
  for (const std::size_t best : plan.best)
    save(folder + "/stator_" + name(plan.layouts[best].algorithm) + ".svg", layout_drawing(sweep, plan.layouts[best]));
  save(folder + "/fill_factors.svg", fill_factor_chart(plan, "Fill factors of the example stator slot, grade 2"));
  FillRequest rotor = request(make_slot(RotorSlot{}), standard_wires(2, 1.12, 1.12, Series::r20), {Algorithm::needle});
  rotor.heads = RotorHeads{};
  const FillPlan laid = plan_fill(rotor, silent);
  save(folder + "/rotor_needle.svg", layout_drawing(rotor, laid.layouts.front()));
}

void fill_table() {
  Progress silent;
  const FillRequest sweep = stator_sweep();
  const FillPlan plan = plan_fill(sweep, silent);
  std::printf("| mm | bound |");
  for (const Algorithm a : sweep.algorithms) std::printf(" %s |", name(a));
  for (std::size_t i = 0; i < plan.layouts.size(); i += sweep.algorithms.size()) {
    std::printf("\n| %.2f | %zu |", plan.layouts[i].wire.copper, plan.layouts[i].bound);
    for (std::size_t k = 0; k < sweep.algorithms.size(); ++k) {
      const FilledLayout& f = plan.layouts[i + k];
      std::printf(" %zu, %.1f, %.1f%s |", f.count(), 100 * f.electrical, 100 * f.mechanical,
                  f.can_be_wound() ? " ✓" : "");
    }
  }
  std::printf("\n");
}

}  // namespace bahnwerk::draw
