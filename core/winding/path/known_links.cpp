#include "core/winding/path/known_links.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::winding {
namespace {

constexpr double alike = 1e-11;

double chord(const LinkEnds& ends) { return norm(place(ends.after[0]) - place(ends.before[0])); }

}  // namespace

bool congruent(const LinkEnds& a, const LinkEnds& b, std::size_t continuity) {
  const Vec from = place(a.before[0]), to = place(b.before[0]);
  const double size = std::hypot(from.x, from.y) * std::hypot(to.x, to.y), distance = chord(a);
  // Compares as complex numbers: b = e^{iθ} a, or the conjugate of a.
  const auto alike_by = [&](double hand) {
    const double c = (from.x * to.x + hand * from.y * to.y) / size, s = (from.x * to.y - hand * from.y * to.x) / size;
    const auto same = [&](const SplineJet& x, const SplineJet& y) {
      const double way = norm(place(x[1]));
      for (std::size_t j = 0; j <= continuity; ++j) {
        const Vec p = place(x[j]), moved{c * p.x - s * hand * p.y, s * p.x + c * hand * p.y, p.z};
        if (!(norm(moved - place(y[j])) <= alike * (j == 0 ? distance : way))) return false;
      }
      return true;
    };
    return same(a.before, b.before) && same(a.after, b.after);
  };
  return alike_by(1) || alike_by(-1);
}

const FoundLink* KnownLinks::find(const LinkEnds& ends) const {
  const double length = chord(ends), slack = 4 * alike * length;
  for (auto i = by_chord_.lower_bound(length - slack); i != by_chord_.end() && i->first <= length + slack; ++i)
    if (congruent(i->second.ends, ends, continuity_)) return &i->second.link;
  return nullptr;
}

void KnownLinks::remember(const LinkEnds& ends, const FoundLink& link) {
  by_chord_.emplace(chord(ends), Known{ends, link});
}

}  // namespace bahnwerk::winding
