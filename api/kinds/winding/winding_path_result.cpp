// The needle's path as it is reported: support points, one NURBS, links.
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kinds/winding/winding_result.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::ordered_json;
using winding::FixedPiece;

constexpr double degrees = 180 / std::numbers::pi;
constexpr std::size_t per_report = 1024;

ordered_json support_point(const FixedPiece& piece, const winding::SupportPoint& point, const char* end, double time) {
  const auto& [tip, phi, psi] = point.pose;
  return {{"coil", piece.coil + 1},
          {"turn", piece.turn + 1},
          {"region", laying_region(piece)},
          {"end", end},
          {"time", time},
          {"position", {tip.x, tip.y, tip.z}},
          {"orientation", {degrees * phi, degrees * psi}},
          {"pivot_shift", degrees * point.pivot_shift},
          {"exit_angle", degrees * point.exit_angle}};
}

}  // namespace

ordered_json support_points(const WindingPlan& plan, Progress progress) {
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < plan.support.size(); ++i) {
    if (i % per_report == 0) progress.report("writing", 1);
    const FixedPiece& piece = plan.support[i];
    const auto& [begin, end] = plan.support_times.at(i);
    list.push_back(support_point(piece, piece.begin, "begin", begin));
    list.push_back(support_point(piece, piece.end, "end", end));
  }
  return list;
}

ordered_json path(const WindingRequest& request, const WindingPlan& plan, Progress progress) {
  const NurbsPath nurbs = plan.path.united();
  ordered_json points = ordered_json::array(), weights = ordered_json::array(), joints = ordered_json::array();
  for (std::size_t i = 0; i < nurbs.points.size(); ++i) {
    if (i % per_report == 0) progress.report("writing", 1);
    const SplinePoint p = projected(nurbs.points[i]);
    points.push_back({p[0], p[1], p[2], degrees * p[3], degrees * p[4]});
    weights.push_back(nurbs.points[i].back());
  }
  for (std::size_t i = 1; i < plan.path.pieces.size(); ++i)
    joints.push_back({{"parameter", i}, {"continuity", request.links.continuity}});
  return {{"length", plan.path_length},    {"degree", nurbs.degree}, {"points", std::move(points)},
          {"weights", std::move(weights)}, {"knots", nurbs.knots},   {"joints", std::move(joints)}};
}

ordered_json links(const WindingRequest& request, const WindingPlan& plan, Progress progress) {
  const std::size_t k = request.links.continuity;
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < plan.path.links.size(); ++i) {
    if (i % per_report == 0) progress.report("writing", 1);
    const auto& all = plan.path.links;
    const winding::NeedleLink& link = all[i];
    // Two links with an extra point between them start from the same piece.
    const bool after_point = i > 0 && all[i - 1].from == link.from,
               before_point = i + 1 < all.size() && all[i + 1].from == link.from;
    const FixedPiece& from = plan.support[link.from];
    ordered_json beta = ordered_json::array();
    for (const Betas* end : {&link.best.shape.before, &link.best.shape.after})
      for (std::size_t j = 0; j < k; ++j) beta.push_back((*end)[j]);
    list.push_back({{"coil", from.coil + 1},
                    {"turn", from.turn + 1},
                    {"from", after_point ? "extra_point" : laying_region(from)},
                    {"to", before_point ? "extra_point" : laying_region(plan.support[link.from + 1])},
                    {"beta", std::move(beta)},
                    {"curvature_integral", link.curvature},
                    {"smoothness", link.best.smoothness}});
  }
  return list;
}

}  // namespace bahnwerk::api::winding_kind
