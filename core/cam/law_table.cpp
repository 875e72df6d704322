#include "core/cam/law_table.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace bahnwerk::cam {

double table_begin(const MotionLawProblem& problem) {
  const double first = problem.points.front().at.min;
  if (!problem.periodic) return first;
  return first >= 0 && problem.points.back().at.max <= problem.length ? 0 : first;
}

LawTable::LawTable(CamLaw law, const MotionLawProblem& problem, double cycle_duration, std::size_t steps)
    : law_(std::move(law)),
      begin_(table_begin(problem)),
      length_(problem.length),
      cycle_duration_(cycle_duration),
      steps_(steps) {
  const std::string& unit = problem.slave_unit;
  columns_ = {{"phi", problem.master_unit}, {"s", unit}, {"v", unit + "/s"}, {"a", unit + "/s²"}, {"j", unit + "/s³"}};
}

Independent LawTable::independent() const {
  const std::string& unit = columns_.front().unit;
  if (unit == "s") return SetpointSource::independent();
  return {"phi", unit, length_ / static_cast<double>(steps_)};
}

void LawTable::read(std::size_t first, std::size_t rows, double* out) const {
  const double n = static_cast<double>(steps_);
  std::size_t hint = 0;
  for (std::size_t k = first; k < first + rows; ++k, out += 5) {
    const double share = static_cast<double>(k) / n;
    out[0] = k == steps_ ? begin_ + length_ : begin_ + length_ * share;
    double t = begin_ * (cycle_duration_ / length_) + cycle_duration_ * share;
    // A break within rounding counts as reached, that at the end of a cycle, too.
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * (std::abs(t) + cycle_duration_);
    double moved = 0;
    if (law_.periodic()) {
      const double given = t;
      t = law_.begin() + std::fmod(t - law_.begin() + cycle_duration_, cycle_duration_);
      if (t + rounding >= law_.breaks().back()) t = law_.begin();
      moved = law_.travel() * std::round((given - t) / cycle_duration_);
    }
    law_.evaluate(t + rounding, 0, hint);
    const bool end = k == steps_ && !law_.periodic();
    const double x = end ? 1 : (t - law_.breaks()[hint]) / law_.piece_duration(hint);
    for (int r = 0; r < 4; ++r) out[1 + r] = law_.in_piece(end ? law_.pieces() - 1 : hint, x < 1e-13 ? 0 : x, r);
    out[1] += moved;
  }
}

}  // namespace bahnwerk::cam
