#include "core/motion/interpolation/piece_series.hpp"

#include <algorithm>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

PieceSeries::PieceSeries(const Path& path) : path_(path) {
  pieces_.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    Piece piece;
    const Curve& curve = path[i].curve();
    if (curve.kind() == CurveKind::rational && static_cast<const Rational&>(curve).rational()) {
      const auto& r = static_cast<const Rational&>(curve);
      const Polynomial rows[] = {r.coordinate(0), r.coordinate(1), r.coordinate(2), r.weight()};
      piece = {c_.size(), 0, r.pivot(), 1 / r.reach()};
      for (const Polynomial& row : rows) piece.terms = std::max(piece.terms, row.size());
      c_.resize(c_.size() + 4 * piece.terms);
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t n = 0; n < rows[k].size(); ++n) c_[piece.first + 4 * n + k] = rows[k][n];
    }
    pieces_.push_back(piece);
  }
}

QuotientJet PieceSeries::at(std::size_t segment, double u) const {
  const Piece& piece = pieces_[segment];
  if (piece.terms == 0) {
    const Jet jet = path_[segment].curve().at(u);
    return {jet.d1, jet.d2, 1, 0, 0};
  }
  const double t = (u - piece.pivot) * piece.inverse;
  double value[4] = {}, d1[4] = {}, d2[4] = {};
  for (std::size_t n = piece.terms; n-- > 0;)
    for (std::size_t k = 0; k < 4; ++k) {
      d2[k] = d2[k] * t + 2 * d1[k];
      d1[k] = d1[k] * t + value[k];
      value[k] = value[k] * t + c_[piece.first + 4 * n + k];
    }
  const double scale = piece.inverse, square = scale * scale;
  const Vec place = (1 / value[3]) * Vec{value[0], value[1], value[2]};
  return {scale * (Vec{d1[0], d1[1], d1[2]} - d1[3] * place), square * (Vec{d2[0], d2[1], d2[2]} - d2[3] * place),
          value[3], scale * d1[3], square * d2[3]};
}

}  // namespace bahnwerk
