#include "core/motion/law/dwell.hpp"

#include <algorithm>

#include "core/base/progress.hpp"

namespace bahnwerk {

namespace {
constexpr std::size_t pieces_per_report = 1 << 18;  // pieces that take about 10 ms
}

TimeLaw with_dwells(TimeLaw law, const PathTask& task, Progress progress) {
  if (!(task.dwell() > 0) || law.pieces().empty()) return law;
  TimeLaw result;
  result.reserve(law.pieces().size() + task.dwells.size());
  std::size_t next = 0;
  const auto rest = [&](std::size_t before, double s) {
    for (; next < task.dwells.size() && task.dwells[next].segment <= before; ++next) {
      if (!(task.dwells[next].seconds > 0)) continue;
      LawPiece piece;
      piece.duration = task.dwells[next].seconds;
      piece.s = piece.s_end = s;
      piece.segment = std::min(before, task.path.size() - 1);
      result.append(piece);
      if (result.pieces().size() % pieces_per_report == 0) progress.report("planning", 1);
    }
  };
  for (const LawPiece& piece : law.pieces()) {
    rest(piece.segment, piece.s);
    result.append(piece);
    if (result.pieces().size() % pieces_per_report == 0) progress.report("planning", 1);
  }
  rest(task.path.size(), law.pieces().back().s_end);
  return result;
}

}  // namespace bahnwerk
