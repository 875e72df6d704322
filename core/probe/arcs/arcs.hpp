#pragma once
/// Method `arcs` [Thielemann, "1. Ansatz: Mathematik"]: straights with turns around the points, corrected.
///
/// Turns (core/probe/arcs/turn.hpp) have their tangents meet at apexes C_i = P_i − M_i (d_i − d_(i−1)), so the
/// directions of the straights are the fixed point d_i ∥ C_(i+1) − C_i, in any dimension; the head rests at a point
/// where the turn's speed is 0. Between turns the speed follows the 15-phase profile. Which speeds are best depends on
/// the speeds next to them: largest speeds may lose to stopping, and dense points may leave no room for turns. Dynamic
/// programming over a geometric series of speeds, 0 among them, chooses them for given directions
/// (core/probe/arcs/speed_choice.hpp), and directions are solved for these speeds; both steps take turns, from the
/// directions of the edges on, with speeds nearer and nearer to those of the quickest path so far. Speeds that the
/// exact geometry does not admit are lowered until it does, down to 0 if need be. Nothing in it depends on the
/// direction in which the points are passed but rounding.
///
/// From rest to rest the motion is the quicker one of this and rests at the ends of rows
/// (core/probe/rest_sections.hpp). Cost: O(points), about 1 ms each.
#include "core/base/progress.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

/// Plans the motion. Throws what progress throws.
ProbeMotion plan_arcs(const ProbeProblem& problem, Progress progress);

}  // namespace bahnwerk
