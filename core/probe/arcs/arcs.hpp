#pragma once
/// Method `arcs` [Thielemann, "1. Ansatz: Mathematik"]: straights with turns around the points, corrected.
///
/// Turns (core/probe/arcs/turn.hpp) have their tangents meet at apexes C_i = P_i − M_i (d_i − d_(i−1)), so the
/// directions of the straights are the fixed point d_i ∥ C_(i+1) − C_i, in any dimension; the head rests at a point
/// where the turn's speed is 0. Between turns the speed follows the 15-phase profile. Which speeds are best depends on
/// the speeds next to them: largest speeds may lose to stopping, and dense points may leave no room for turns. Dynamic
/// programming over a geometric series of speeds per point, 0 among them, chooses them for given directions; then
/// directions are solved for these speeds, and both steps repeat with closer speeds. Speeds that the exact geometry
/// does not admit are lowered until it does, down to 0 if need be. Nothing in it depends on the direction in which the
/// points are passed but rounding.
///
/// The motion is the quickest one from rest to rest (core/probe/rest_sections.hpp) of those through all points, through
/// thinned ones (core/probe/straight/rows.hpp), and with rests at the ends of rows. Cost: O(points), about 1 ms each.
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

class Progress;

/// Plans the motion; reports progress from `progress_from` to `progress_to`. Throws what progress throws.
ProbeMotion plan_arcs(const ProbeProblem& problem, Progress& progress, double progress_from = 0,
                      double progress_to = 1);

}  // namespace bahnwerk
