// A law as a motion of one axis.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cam/bernstein.hpp"
#include "core/cam/cam_law.hpp"

namespace bahnwerk::cam {
namespace {

class LawMotion final : public Motion {
 public:
  explicit LawMotion(CamLaw law) : law_(std::move(law)) {}
  std::size_t axes() const override { return 1; }
  std::size_t pieces() const override { return law_.pieces(); }
  double begin(std::size_t piece) const override { return law_.breaks()[piece]; }
  double duration() const override { return law_.duration(); }
  int highest_order() const override { return 4; }
  MotionState in_piece(std::size_t piece, double t) const override {
    const double x = (t - law_.breaks()[piece]) / law_.piece_duration(piece);
    MotionState state;
    for (std::size_t order = 0; order < MotionState::orders; ++order)
      state[order][0] = law_.in_piece(piece, x, static_cast<int>(order));
    return state;
  }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override {
    if (axis != 0) return false;
    const auto& b = law_.piece(piece).bernstein;
    out.clear();
    double factorial = 1;
    for (std::size_t r = 0; r < b.size(); ++r) {
      if (r > 0) factorial *= static_cast<double>(r);
      out.push_back(law_.in_piece(piece, 0, static_cast<int>(r)) / factorial);
    }
    return true;
  }

 private:
  CamLaw law_;
};

/// The law's cycle from `start` on (in its first cycle), its times shifted so that it begins at 0, its positions by
/// `moved`.
CamLaw from(const CamLaw& law, double start, double moved) {
  std::vector<double> breaks{0};
  std::vector<LawPiece> pieces, before;
  std::vector<double> before_ends;
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    const double a = law.breaks()[i], b = law.breaks()[i + 1];
    const auto& whole = law.piece(i).bernstein;
    if (b <= start) {
      before.push_back({0, whole}), before_ends.push_back(b - start + law.duration());
    } else if (a >= start) {
      pieces.push_back({0, whole}), breaks.push_back(b - start);
    } else {
      BernsteinArray left, right;
      const auto n = static_cast<std::ptrdiff_t>(whole.size());
      bernstein_split(whole, (start - a) / (b - a), left.data(), right.data());
      before.push_back({0, {left.begin(), left.begin() + n}}), before_ends.push_back(law.duration());
      pieces.push_back({0, {right.begin(), right.begin() + n}}), breaks.push_back(b - start);
    }
  }
  for (LawPiece& piece : before)
    for (double& b : piece.bernstein) b += law.travel();
  pieces.insert(pieces.end(), before.begin(), before.end());
  if (moved != 0)
    for (LawPiece& piece : pieces)
      for (double& b : piece.bernstein) b += moved;
  breaks.insert(breaks.end(), before_ends.begin(), before_ends.end());
  breaks.back() = law.duration();
  return {std::move(breaks), std::move(pieces), law.periodic(), law.travel()};
}

}  // namespace

CamLaw law_from(const CamLaw& law, double first) {
  double start = law.begin(), cycles = 0;
  if (law.periodic()) {
    cycles = std::floor((first - law.begin()) / law.duration());
    start = first - law.duration() * cycles;
    // A cut this close to a break would leave a piece without length.
    for (const double at : law.breaks())
      if (std::abs(start - at) < 1e-12 * law.duration()) start = at;
    if (start >= law.breaks().back()) start = law.begin(), ++cycles;
  }
  return from(law, start, cycles * law.travel());
}

std::shared_ptr<const Motion> law_motion(const CamLaw& law, double first) {
  return std::make_shared<LawMotion>(law_from(law, first));
}

}  // namespace bahnwerk::cam
