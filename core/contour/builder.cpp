#include "core/contour/builder.hpp"

#include <cstdio>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/nurbs.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

namespace {

constexpr std::size_t max_notes = 50;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// Returns "line 12 and 3 more: ".
std::string counted(std::size_t line, std::size_t count) {
  return "line " + std::to_string(line) + (count > 1 ? " and " + std::to_string(count - 1) + " more: " : ": ");
}

bool finite(Vec v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

ContourBuilder::ContourBuilder(std::size_t dimension, Vec start, std::string reader)
    : position_(start), reader_(std::move(reader)) {
  contour_.dimension = dimension;
  if (!finite(start)) keep({"contour", "start"}, "the start point is not finite");
}

void ContourBuilder::keep(std::vector<std::string> place, std::string message) {
  if (reader_.empty()) {
    if (!full()) faults_.push_back({std::move(place), std::move(message)});
    return;
  }
  const auto same = std::find_if(causes_.begin(), causes_.end(), [&](const Cause& c) { return c.message == message; });
  if (same != causes_.end())
    ++same->count;
  else if (!full())
    causes_.push_back({std::move(message), line_, 1});
}

void ContourBuilder::block(Mode mode, double feed) {
  const std::size_t at = contour_.path.size();
  if (!contour_.blocks.empty()) contour_.blocks.back().last = at;
  contour_.blocks.push_back({mode, feed, at, at});
  segment_ = 0;
  if (!(feed > 0))
    keep({"contour", "blocks", std::to_string(contour_.blocks.size() - 1), "feed"}, "the feed must be positive");
}

std::vector<std::string> ContourBuilder::place(std::vector<std::string> inner) const {
  if (!reader_.empty()) return {};  // keep() knows it
  std::vector<std::string> whole{"contour", "blocks", std::to_string(contour_.blocks.size() - 1), "segments",
                                 std::to_string(segment_ - 1)};
  whole.insert(whole.end(), inner.begin(), inner.end());
  return whole;
}

void ContourBuilder::fault(std::vector<std::string> inner, std::string message) {
  keep(place(std::move(inner)), std::move(message));
}

void ContourBuilder::next_segment() {
  if (contour_.blocks.empty()) block(Mode::cut, std::numeric_limits<double>::infinity());
  ++segment_;
  ++total_;
}

void ContourBuilder::drop(const std::string& why) {
  ++dropped_;
  if (!reader_.empty()) {
    if (dropped_ == 1) first_dropped_ = line_;
  } else if (dropped_ <= max_notes) {
    contour_.notes.push_back("block " + std::to_string(contour_.blocks.size() - 1) + " segment " +
                             std::to_string(segment_ - 1) + " dropped: " + why);
  }
}

/// Returns false, with its faults stored, for a segment that cannot be made.
template <class Make>
bool ContourBuilder::guarded(Make make) {
  try {
    make();
    return true;
  } catch (const InvalidInput& e) {
    for (const InputFault& f : e.faults) fault(f.place, f.message);
    return false;
  }
}

/// Returns false, with a note, for a curve without length.
bool ContourBuilder::add(const std::shared_ptr<const Curve>& curve, Vec end) {
  try {
    contour_.path.append(curve, reader_.empty() ? total_ - 1 : line_);
  } catch (const InvalidInput& e) {
    drop(e.what());
    return false;
  }
  position_ = end;
  return true;
}

bool ContourBuilder::meets(Vec start, const char* what) {
  const double gap = norm(start - position_);
  if (!(gap <= joint_tolerance)) {
    fault({what}, "starts " + number(gap) + " mm away from where the contour stands (tolerance " +
                      number(joint_tolerance) + " mm)");
    return false;
  }
  if (gap > 0) {
    ++moved_;
    worst_move_ = std::max(worst_move_, gap);
  }
  return true;
}

void ContourBuilder::line(Vec to) {
  next_segment();
  if (!finite(to)) return fault({"line"}, "the end point is not finite");
  const double length = norm(to - position_);
  if (length < min_segment_length) {
    drop("a line of " + number(length) + " mm");
    // The end counts: many dropped lines in a row must not lose a real distance.
    return;
  }
  add(std::make_shared<Line>(position_, to), to);
}

void ContourBuilder::arc(Vec to, Vec centre, bool counter_clockwise, Vec normal, double tolerance) {
  next_segment();
  if (!finite(to) || !finite(centre) || !finite(normal)) return fault({"arc"}, "a coordinate is not finite");
  // An arc too short to be one means a full circle whose start came out beside its end by rounding, unless its radius
  // is as small.
  constexpr double rounding = 0.01;  // part of the radius that counts as rounding
  const double chord = norm(to - position_);
  if (chord < min_segment_length && chord < rounding * norm(centre - position_)) to = position_;
  const bool made = guarded([&] {
    auto arc = std::make_shared<Arc>(Arc::through(position_, to, centre, normal, counter_clockwise, tolerance));
    if (const double length = arc->speed(arc->begin()) * (arc->end() - arc->begin()); length < min_segment_length)
      return drop("an arc of " + number(length) + " mm");
    add(arc, to);
  });
  if (!made) position_ = to;
}

void ContourBuilder::polynomial(const std::vector<std::vector<double>>& rows) {
  next_segment();
  guarded([&] {
    auto moved = rows;
    Vec start;
    for (std::size_t k = 0; k < rows.size() && k < 3; ++k) {
      if (rows[k].empty()) throw InvalidInput({{{"polynomial", "coefficients", std::to_string(k)}, "no coefficients"}});
      start[k] = rows[k].front();
    }
    if (!meets(start, "polynomial")) return;
    for (std::size_t k = 0; k < rows.size() && k < 3; ++k) moved[k][0] = position_[k];
    auto curve = std::make_shared<Rational>(Rational::from_power_basis(moved));
    add(curve, curve->at(curve->end()).value);
  });
}

void ContourBuilder::nurbs(int degree, std::vector<Vec> points, std::vector<double> weights,
                           std::vector<double> knots) {
  next_segment();
  guarded([&] {
    const Nurbs given(degree, points, weights, knots);
    const Vec start = given.at(given.begin()).value;
    if (!meets(start, "nurbs")) return;
    // A start that misses by rounding: shift the whole curve, its shape stays.
    const Vec shift = position_ - start;
    for (Vec& p : points) p += shift;
    for (auto& piece : Nurbs(degree, std::move(points), std::move(weights), std::move(knots)).pieces()) {
      const Vec end = piece.at(piece.end()).value;
      add(std::make_shared<Rational>(std::move(piece)), end);
    }
  });
}

void ContourBuilder::dwell(double seconds) {
  next_segment();
  if (!(seconds >= 0 && seconds <= longest_rest))
    return fault({"dwell"}, "a dwell lasts between 0 and " + number(longest_rest) + " s");
  contour_.rests.push_back({contour_.path.size(), seconds, contour_.blocks.size() - 1});
}

Contour ContourBuilder::finish() {
  if (!contour_.blocks.empty()) contour_.blocks.back().last = contour_.path.size();
  if (faults_.empty() && causes_.empty() && contour_.path.empty())
    keep({"contour"}, "the contour has no length: nothing to move along");
  for (const Cause& cause : causes_)
    faults_.push_back({{"contour", reader_}, counted(cause.line, cause.count) + cause.message});
  if (!faults_.empty()) throw InvalidInput(std::move(faults_));
  if (dropped_ > 0 && !reader_.empty())
    contour_.notes.push_back(counted(first_dropped_, dropped_) + "dropped: shorter than " + number(min_segment_length) +
                             " mm");
  else if (dropped_ > max_notes)
    contour_.notes.push_back("… and " + std::to_string(dropped_ - max_notes) + " more segments without length dropped");
  if (moved_ > 0)
    contour_.notes.push_back(std::to_string(moved_) + " curve starts moved onto the end before them, at most " +
                             number(worst_move_) + " mm");
  return std::move(contour_);
}

}  // namespace bahnwerk
