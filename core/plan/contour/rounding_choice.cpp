#include "core/plan/contour/rounding_choice.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/base/borrowed.hpp"
#include "core/base/progress_scope.hpp"
#include "core/plan/contour/stopping_time.hpp"

namespace bahnwerk {
namespace {

constexpr double quicker = 1 - 1e-9;  // a ratio of durations closer to 1 is rounding

/// Returns the range of pieces of a law on the path's segments [first, last).
struct Part {
  std::size_t begin = 0, end = 0;
  double duration = 0;
};

/// A section in both contours: segments [given, given_end) and [rounded, rounded_end).
struct Section {
  std::size_t given = 0, given_end = 0, rounded = 0, rounded_end = 0;
  bool changed = false;
  Part law;
  bool stops = false;  // is driven as given
  std::size_t stopping = 0;
  Part stopping_law;
};

Part part_of(const TimeLaw& law, std::size_t& next, std::size_t last) {
  const auto& pieces = law.pieces();
  Part part{next, next, 0};
  for (; part.end < pieces.size() && pieces[part.end].segment < last; ++part.end)
    part.duration += pieces[part.end].duration;
  next = part.end;
  return part;
}

class Chooser {
 public:
  Chooser(const PreparedContour& prepared, const MethodOptions& options, Progress progress)
      : prepared_(prepared),
        given_(prepared.given),
        rounded_(prepared.rounded),
        options_(options),
        progress_(progress),
        stage_progress_(progress, "planning") {
    const std::vector<BlendSection>& places = prepared.sections;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool last = i + 1 == places.size();
      sections_.push_back({places[i].given,
                           last ? given_->path.size() : places[i + 1].given,
                           places[i].blended,
                           last ? rounded_->path.size() : places[i + 1].blended,
                           places[i].changed,
                           {},
                           false,
                           0,
                           {}});
    }
  }

  DrivenContour run() {
    constexpr double first = 0.9;  // part of the progress
    MethodResult law = plan(rounded_, progress_.part(0, first));
    stage_progress_.done(first);
    find_times(law.law);
    if (!plan_with_stops(progress_.part(first, 1))) return {rounded_, std::move(law)};
    for (Section& s : sections_) {
      s.stops = s.stopping_law.duration > 0 && s.stopping_law.duration < quicker * s.law.duration;
      count_ += s.stops ? 1 : 0;
    }
    law.iterations += stopping_result_.iterations;
    if (count_ == 0) return {rounded_, std::move(law)};
    return put_together(std::move(law));
  }

 private:
  MethodResult plan(const std::shared_ptr<const Contour>& contour, Progress progress) {
    const std::shared_ptr<const AxisPath> axes = prepared_.axes->along(contour).moving;
    const PathTask task{*axes, prepared_.moving, contour->feeds(), contour->rest_places()};
    return prepared_.method.plan(task, options_, 0, progress);
  }

  /// Computes the rounded law's time of every section; a section at whose begin it does not rest belongs to the one
  /// before.
  void find_times(const TimeLaw& law) {
    std::vector<Section> found;
    std::size_t next = 0;
    for (const Section& s : sections_) {
      const bool rests = found.empty() || (next < law.pieces().size() && !(law.pieces()[next].v > 0));
      const Part part = part_of(law, next, s.rounded_end);
      stage_progress_.work(part.end - part.begin + 1);
      if (rests) {
        found.push_back(s);
        found.back().law = part;
        continue;
      }
      Section& before = found.back();
      before.given_end = s.given_end, before.rounded_end = s.rounded_end;
      before.changed = before.changed || s.changed;
      before.law.end = part.end, before.law.duration += part.duration;
    }
    sections_ = std::move(found);
  }

  /// Plans the sections that may be quicker with stops, concatenated to a path of their own. Returns false if there are
  /// none.
  bool plan_with_stops(Progress progress) {
    const std::shared_ptr<const AxisPath> axes = prepared_.axes->along(given_).moving;
    const StoppingTime stopping(*given_, *axes, prepared_.moving, options_.corner_angle);
    const std::vector<double> feeds = given_->feeds();
    stopping_.dimension = given_->dimension, stopping_.height = given_->height;
    for (Section& s : sections_) {
      stage_progress_.work(1);
      if (!s.changed || !(stopping.least(s.given, s.given_end, stage_progress_) < quicker * s.law.duration)) continue;
      s.stopping = stopping_.path.size();
      s.stopping_law.end = 1;  // the stop counts until it is planned
      stopping_.rests.push_back({s.stopping, 0, 0});
      for (std::size_t i = s.given; i < s.given_end; ++i) {
        if (stopping_.blocks.empty() || stopping_.blocks.back().feed != feeds[i])
          stopping_.blocks.push_back({Mode::cut, feeds[i], stopping_.path.size(), stopping_.path.size()});
        append(stopping_.path, given_, i);
        stage_progress_.work(2);
        ++stopping_.blocks.back().last;
      }
    }
    if (stopping_.path.empty()) return false;
    stopping_result_ = plan(borrowed(stopping_), progress);
    stage_progress_.done(1);
    std::size_t next = 0;
    for (Section& s : sections_)
      if (s.stopping_law.end > 0)
        s.stopping_law = part_of(stopping_result_.law, next, s.stopping + s.given_end - s.given);
    return true;
  }

  /// The segment shares its curve, so the new path keeps the contour.
  static void append(Path& path, const std::shared_ptr<const Contour>& from, std::size_t segment) {
    const Segment& s = from->path[segment];
    path.append_piece(std::shared_ptr<const Curve>(from, &s.curve()), s.source());
  }

  DrivenContour put_together(MethodResult planned) {
    auto contour = std::make_shared<Contour>();
    contour->dimension = rounded_->dimension, contour->height = rounded_->height;
    contour->notes = rounded_->notes;
    contour->blocks = rounded_->blocks;
    const std::vector<std::size_t> given_owners = owners(*given_), rounded_owners = owners(*rounded_);
    std::vector<std::size_t> owner;
    TimeLaw law;
    law.reserve(planned.law.pieces().size());
    std::size_t rest = 0;
    for (const Section& s : sections_) {
      take_rests(*contour, s.given, rest);
      const std::size_t place = contour->path.size();
      const std::shared_ptr<const Contour>& from = s.stops ? given_ : rounded_;
      const std::size_t first = s.stops ? s.given : s.rounded, last = s.stops ? s.given_end : s.rounded_end;
      for (std::size_t i = first; i < last; ++i) {
        append(contour->path, from, i);
        owner.push_back((s.stops ? given_owners : rounded_owners)[i]);
        stage_progress_.work(4);
      }
      if (s.stops)
        copy(stopping_result_.law, s.stopping_law, {stopping_.path, s.stopping}, {contour->path, place}, law);
      else
        copy(planned.law, s.law, {rounded_->path, s.rounded}, {contour->path, place}, law);
    }
    take_rests(*contour, given_->path.size(), rest);
    std::size_t i = 0;
    for (std::size_t b = 0; b < contour->blocks.size(); ++b) {
      contour->blocks[b].first = i;
      while (i < owner.size() && owner[i] <= b) ++i;
      contour->blocks[b].last = i;
    }
    note(*contour);
    planned.law = std::move(law);
    return {std::move(contour), std::move(planned)};
  }

  static std::vector<std::size_t> owners(const Contour& contour) {
    std::vector<std::size_t> owner(contour.path.size(), 0);
    for (std::size_t b = 0; b < contour.blocks.size(); ++b)
      for (std::size_t i = contour.blocks[b].first; i < contour.blocks[b].last; ++i) owner[i] = b;
    return owner;
  }

  void take_rests(Contour& contour, std::size_t segment, std::size_t& next) const {
    for (; next < given_->rests.size() && given_->rests[next].segment <= segment; ++next)
      contour.rests.push_back({contour.path.size(), given_->rests[next].seconds, given_->rests[next].block});
  }

  /// The segments of a path from `first` on.
  struct Segments {
    const Path& path;
    std::size_t first;
  };
  /// Appends to `out` a part of a law along the segments `from`, for as many segments `to`.
  void copy(const TimeLaw& law, const Part& part, const Segments& from, const Segments& to, TimeLaw& out) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
      LawPiece piece = law.pieces()[i];
      const std::size_t segment = to.first + piece.segment - from.first;
      const Segment &old = from.path[piece.segment], &now = to.path[segment];
      const auto moved = [&](double s) { return s >= old.s1() ? now.s1() : now.s0() + (s - old.s0()); };
      piece.s = moved(piece.s), piece.s_end = moved(piece.s_end);
      piece.segment = segment;
      out.append(piece);
      stage_progress_.work(1);
    }
  }

  void note(Contour& contour) const {
    const auto first = std::find_if(sections_.begin(), sections_.end(), [](const Section& s) { return s.stops; });
    const Vec at = given_->path[first->given].at_parameter(given_->path[first->given].curve().begin()).value;
    char text[200];
    const int end = std::snprintf(
        text, sizeof text,
        "%zu sections between rests driven as given, rounded they would be slower, the first at %.6g, %.6g", count_,
        at.x, at.y);
    if (contour.dimension == 3) std::snprintf(text + end, sizeof text - static_cast<std::size_t>(end), ", %.6g", at.z);
    contour.notes.emplace_back(text);
  }

  const PreparedContour& prepared_;
  const std::shared_ptr<const Contour>&given_, &rounded_;
  const MethodOptions& options_;
  Progress progress_;
  ProgressScope stage_progress_;
  std::vector<Section> sections_;
  Contour stopping_;
  MethodResult stopping_result_;
  std::size_t count_ = 0;
};

}  // namespace

DrivenContour choose_rounding(const PreparedContour& prepared, const MethodOptions& options, Progress progress) {
  if (!prepared.rounded) return {prepared.given, std::nullopt};
  return Chooser(prepared, options, progress).run();
}

}  // namespace bahnwerk
