#pragma once
/// A corner between two edges, and the chain that rests at it.
#include "core/probe/optimal/refine.hpp"

namespace bahnwerk::test {

inline ChainLimits<2> corner() {
  ChainLimits<2> limits;
  limits.points = {{0, 0}, {4, 0}, {4, 3}};
  limits.ball = {0, 0, 0};
  limits.tolerance = 0.05;
  limits.speed = 20;
  limits.derivative = {{{200, 150}, {4000, 5000}, {200000, 180000}}};
  return limits;
}

inline CellChain<2> stops(const ChainLimits<2>& limits) {
  CellChain<2> chain;
  ChainNode<2> begin;
  begin.point = 0;
  begin.given = true;
  begin.state[0] = limits.points[0];
  chain.node = {begin};
  for (std::size_t e = 0; e + 1 < limits.points.size(); ++e) append_stopping_edge(chain, limits, e);
  chain.node.back().given = true;
  return chain;
}

}  // namespace bahnwerk::test
