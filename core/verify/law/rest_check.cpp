#include "core/verify/law/rest_check.hpp"

#include <algorithm>
#include <limits>

#include "core/base/progress_scope.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

Vec begin_of(const Path& path, std::size_t segment) {
  const bool end = segment >= path.size();
  const Segment& s = path[end ? path.size() - 1 : segment];
  return s.at_parameter(end ? s.curve().end() : s.curve().begin()).value;
}

/// The moments at rest of a law, one after the other.
class Rests {
 public:
  Rests(const Contour& driven, const TimeLaw& law, ProgressScope& stage_progress)
      : path_(driven.path), law_(law), progress_(stage_progress) {}

  double begin = 0, lasts = 0;  ///< s
  Vec place;                    ///< mm

  /// Goes to the next rest; returns false behind the last one.
  bool next() {
    const auto& pieces = law_.pieces();
    for (; next_ < pieces.size() && !(pieces[next_].v == 0); ++next_) progress_.work(1);
    progress_.work(8);
    if (next_ > pieces.size() || pieces.empty()) return false;
    if (next_ == pieces.size()) {  // the end, which other checks hold to be at rest
      begin = law_.duration();
      lasts = 0;
      place = begin_of(path_, path_.size());
      ++next_;
      return true;
    }
    const LawPiece& first = pieces[next_];
    begin = first.t0;
    lasts = 0;
    if (first.segment >= path_.size()) return false;
    place = path_[first.segment].at(first.s).value;
    while (next_ < pieces.size() && stands(pieces[next_]) && pieces[next_].s == first.s)
      lasts += pieces[next_++].duration, progress_.work(1);
    if (lasts > 0 && next_ == pieces.size()) ++next_;  // it was the end
    if (lasts == 0) ++next_;
    return true;
  }

 private:
  static bool stands(const LawPiece& p) { return p.v == 0 && p.a == 0 && p.j == 0 && p.snap == 0; }

  const Path& path_;
  const TimeLaw& law_;
  ProgressScope& progress_;
  std::size_t next_ = 0;
};

}  // namespace

Check rest_check(const Contour& given, const Contour& driven, const TimeLaw& law, Progress progress,
                 double position_tolerance) {
  ProgressScope stage_progress(progress, "verify");
  Check check = verify::make_check({{"dwell"}, 0, "s"}, rounding * law.duration(), 0, 0, false);
  Rests at(driven, law, stage_progress);
  for (std::size_t i = 0, j = 0; i < given.rests.size(); i = j) {
    double seconds = 0;
    for (j = i; j < given.rests.size() && given.rests[j].segment == given.rests[i].segment; ++j)
      seconds += given.rests[j].seconds;
    const Vec place = begin_of(given.path, given.rests[i].segment);
    double missing = std::numeric_limits<double>::infinity(), when = 0;
    while (missing > check.limit && at.next()) {
      if (!(norm(at.place - place) <= position_tolerance)) continue;
      const double lacks = std::max(0.0, seconds - at.lasts);
      if (lacks < missing) missing = lacks, when = at.begin;
    }
    if (missing > check.value) check.value = missing, check.at = when;
    if (missing > check.limit) break;  // those behind it would not be found either
  }
  check.passed = check.value <= check.limit;
  return check;
}

}  // namespace bahnwerk
