#include "core/geometry/path/turned.hpp"

#include <memory>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

std::shared_ptr<const Curve> turned(const Curve& curve, const Isometry& map) {
  switch (curve.kind()) {
    case CurveKind::line: {
      const auto& line = static_cast<const Line&>(curve);
      return std::make_shared<const Line>(map(line.from()), map(line.to()));
    }
    case CurveKind::arc: {
      const auto& arc = static_cast<const Arc&>(curve);
      const Vec e1 = map.turned(arc.e1()), e2 = map.turned(arc.e2());
      const bool mirrored = dot(cross(e1, e2), map.turned(arc.normal())) < 0;
      return std::make_shared<const Arc>(map(arc.centre()), e1, e2, arc.radius(), arc.sweep(),
                                         mirrored ? -arc.rise() : arc.rise());
    }
    case CurveKind::rational:
      break;
  }
  return std::make_shared<const Rational>(static_cast<const Rational&>(curve).mapped(map.rows, map.offset));
}

Path turned(const Path& path, const Isometry& map) {
  Path image;
  for (std::size_t i = 0; i < path.size(); ++i) image.append_piece(turned(path[i].curve(), map), path[i].source());
  return image;
}

}  // namespace bahnwerk
