#pragma once
/// A lower bound that knows the stroke: what sections take at least where the coarse axes cannot travel as fast as the
/// head could.
///
/// The argument. T is what one section takes, from when the head leaves the rest before it until it gets to the rest
/// behind it. τ seconds before that the head is on the stretch of the path from which it can get to the rest in τ, and
/// likewise τ seconds behind it: those stretches follow from the sections' bounds, feeds and limits of the neighbours,
/// whatever they take beyond that (head_reach.hpp), and they only grow with τ. Inside the section, t seconds after its
/// begin, the head is no further from the begin than it can get in t, nor from the end than in T − t. The coarse axis
/// of each coordinate is within a stroke of the head, its velocity and acceleration within their limits, at a rest the
/// velocity within the fine axis', too; it begins and ends at rest where the path does. If no motion satisfies that
/// (reachable_states.hpp: all states that any could be in, from the begin of the neighbourhood on, and backward from
/// its end, have none in common), the section takes longer than T, because the conditions are easier to meet with every
/// longer time T′: a motion that meets them for T, slowed by T′/T about the begin of the section, has lower velocities
/// and accelerations, and at each time it is where it was nearer to the section before, where the stretches are parts
/// of those now. So each section has a bound of its own, whatever the others take, and they may be added up.
///
/// In closed form: the coarse axis travels what the ends of a section are apart, but for two strokes, at its largest
/// speed at most; and where the path is one section, without dwells, it begins and ends at rest, so that it takes the
/// time from rest to rest with its velocity, acceleration and jerk. That holds for sections of any length and strokes
/// of any size.
///
/// Relaxed are: everything between the nodes of a grid of time, how axes of the head depend on each other, what one
/// section's motion takes away from the next one's (but see stroke_chains.hpp), limits of jerk
/// but for that.
#include <cstddef>
#include <vector>

#include "core/verify/redundant/stroke_sections.hpp"

namespace bahnwerk {

class Progress;

struct StrokeGain {
  std::size_t sections = 0;  ///< whose bounds rose
  double duration = 0;       ///< s, by how much all of them did
};

/// Raises the bounds of sections, those of lower_bound(), to what is proven as above, by bisection to 1e-5 of it. Cost:
/// some 0.2 ms per section that is longer than a stroke, 1 ms where its bound rises.
StrokeGain raise_by_stroke(const StrokeBoundTask& task, std::vector<SectionBound>& sections, Progress& progress);

}  // namespace bahnwerk
