#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/dxf.hpp"
#include "core/contour/dxf/cut/cut.hpp"
#include "core/contour/dxf/read/drawing.hpp"
#include "core/contour/dxf/read/tags.hpp"

namespace bahnwerk {
namespace {

void check(const DxfOptions& options) {
  std::vector<InputFault> faults;
  if (!(options.tolerance >= 0 && options.tolerance <= 10))
    faults.push_back({{"contour", "tolerance"}, "the chaining tolerance has to be between 0 and 10 mm"});
  if (!(options.feed > 0)) faults.push_back({{"contour", "feed"}, "the feed must be positive"});
  if (const auto unit = options.millimetres_per_unit; unit && !(*unit > 0 && std::isfinite(*unit)))
    faults.push_back({{"contour", "unit"}, "the unit has to be a positive number of millimetres"});
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

/// Returns the dimension, 2 or 3; a planar drawing is put to z = 0.
std::size_t flatten(DxfDrawing& drawing, Progress progress) {
  double most = 0, low = HUGE_VAL, high = -HUGE_VAL;
  ProgressScope reading(progress.part(0, 0), "reading");
  // Heights may differ from curve to curve within one strand, too.
  for (const DxfStrand& strand : drawing.strands) {
    double bottom = HUGE_VAL, top = -HUGE_VAL;
    for (const Drawn& curve : strand.curves) {
      reading.work();
      most = std::max(most, rise(curve));
      const double z = first_point(curve).z;
      bottom = std::min(bottom, z);
      top = std::max(top, z);
    }
    most = std::max(most, top - bottom);
    low = std::min(low, bottom);
    high = std::max(high, top);
  }
  if (most > min_segment_length) return 3;
  if (high - low > min_segment_length) {
    char text[120];
    std::snprintf(text, sizeof text, "flat entities at heights from %.6g to %.6g mm were put into one plane", low,
                  high);
    drawing.notes.emplace_back(text);
  }
  const Affine down{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {}};
  for (DxfStrand& strand : drawing.strands)
    for (Drawn& curve : strand.curves) {
      reading.work();
      curve = mapped(down, std::move(curve));
    }
  return 2;
}

std::string count_of(std::size_t n, const char* one, const char* more) {
  return std::to_string(n) + (n == 1 ? one : more);
}

}  // namespace

Contour read_dxf(std::string_view text, const DxfOptions& options) {
  Progress silent;
  return read_dxf(text, options, silent);
}

Contour read_dxf(std::string_view text, const DxfOptions& options, Progress progress) {
  check(options);
  DxfDrawing drawing = read_dxf_drawing(
      text, {options.layers, options.millimetres_per_unit, options.max_curves, options.hatch}, progress);
  if (drawing.strands.empty()) {
    std::string what = "the drawing holds nothing to move along";
    for (std::size_t i = 0; i < std::min<std::size_t>(drawing.notes.size(), 5); ++i) what += "; " + drawing.notes[i];
    refuse_dxf(1, what);
  }
  const std::size_t dimension = flatten(drawing, progress);
  const double same = std::clamp(0.1 * options.tolerance, 1e-6, 1e-3);
  if (const std::size_t n = drop_duplicates(drawing.strands, same, progress); n > 0)
    drawing.notes.push_back("dropped: " + count_of(n, " entity", " entities") + " drawn a second time");
  std::vector<Cut> list = cuts(std::move(drawing.strands), options.tolerance, progress);
  if (options.order == DxfOrder::nearest) list = nearest(std::move(list), progress);

  ContourBuilder builder(dimension, first_point(list.front().curves.front()), "dxf");
  GapReport gaps;
  ProgressScope reading(progress.part(0, 0), "reading");
  for (Cut& cut : list) {
    builder.at_line(cut.lines.front());
    const Vec start = first_point(cut.curves.front());
    if (norm(start - builder.position()) >= min_segment_length) {
      builder.block(Mode::position, std::numeric_limits<double>::infinity());
      builder.line(start);
    }
    builder.block(Mode::cut, options.feed);
    write_cut(builder, cut, gaps, reading);
    cut = {};
  }
  Contour contour = builder.finish();
  if (gaps.moved + gaps.bridged > 0) {
    char worst[40];
    std::snprintf(worst, sizeof worst, "%.3g", gaps.worst);
    drawing.notes.push_back(count_of(gaps.moved + gaps.bridged, " gap", " gaps") + " between ends closed, at most " +
                            worst + " mm wide, " + std::to_string(gaps.bridged) + " of them by a short line");
  }
  contour.notes.insert(contour.notes.begin(), drawing.notes.begin(), drawing.notes.end());
  return contour;
}

}  // namespace bahnwerk
