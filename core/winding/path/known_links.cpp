#include "core/winding/path/known_links.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::winding {
namespace {

constexpr double alike = 1e-11;

double chord(const LinkEnds& ends) { return norm(place(ends.after[0]) - place(ends.before[0])); }

}  // namespace

bool turned_alike(const LinkEnds& a, const LinkEnds& b, std::size_t continuity) {
  const Vec from = place(a.before[0]), to = place(b.before[0]);
  // As complex numbers, b = a · e^{iθ}.
  const double size = std::hypot(from.x, from.y) * std::hypot(to.x, to.y), c = (from.x * to.x + from.y * to.y) / size,
               s = (from.x * to.y - from.y * to.x) / size, distance = chord(a);
  const auto same = [&](const SplineJet& x, const SplineJet& y) {
    const double way = norm(place(x[1]));
    for (std::size_t j = 0; j <= continuity; ++j) {
      const Vec p = place(x[j]), turned{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
      if (!(norm(turned - place(y[j])) <= alike * (j == 0 ? distance : way))) return false;
    }
    return true;
  };
  return same(a.before, b.before) && same(a.after, b.after);
}

const FoundLink* KnownLinks::find(const LinkEnds& ends) const {
  const double length = chord(ends), slack = 4 * alike * length;
  for (auto i = by_chord_.lower_bound(length - slack); i != by_chord_.end() && i->first <= length + slack; ++i)
    if (turned_alike(i->second.ends, ends, continuity_)) return &i->second.link;
  return nullptr;
}

void KnownLinks::remember(const LinkEnds& ends, const FoundLink& link) {
  by_chord_.emplace(chord(ends), Known{ends, link});
}

}  // namespace bahnwerk::winding
