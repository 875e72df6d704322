#pragma once
/// A lower bound of the duration that takes strokes into account: it raises the bounds of sections in which the coarse
/// axes cannot travel as fast as the head could.
///
/// Proof. Let T be the time that one section takes, from the head's departure from the rest before it to its arrival at
/// the rest behind it. τ seconds before its departure the head is on the part of the path from which it can get to that
/// rest in τ; correspondingly τ seconds after its arrival. These parts follow from bounds, feeds and limits of the
/// neighbouring sections (head_reach.hpp), whatever else they take, and grow with τ. Inside the section, t seconds
/// after its begin, the head is no farther from the begin than it can travel in t, and no farther from the end than in
/// T − t. The coarse axis of each coordinate is within one stroke of the head and keeps its limits of velocity and
/// acceleration; at a rest of the head its velocity is also within the fine axis' limit; it begins and ends at rest
/// where the path does. The states that satisfy these conditions are enclosed forward from the begin of the
/// neighbourhood and backward from its end (reachable_states.hpp). If both enclosures have no state in common, the
/// section takes longer than T. Every smaller time is then excluded as well: a motion that satisfied the conditions for
/// a smaller time, slowed to T about the begin of the section, would have lower velocities and accelerations, and at
/// each time it would be where it had been closer to the section before, so it would satisfy them for T. Each section's
/// bound holds whatever the other sections take, so the bounds may be summed up.
///
/// In closed form: over a section the coarse axis travels at least the distance of the section's ends less two strokes,
/// at its largest speed at most; if the path is one section without dwells, it travels this distance from rest to rest
/// with its limits of velocity, acceleration and jerk. This holds for sections of any length and strokes of any size.
///
/// The conditions neglect motion between the nodes of a time grid, the coupling of the head's axes, the effect of one
/// section's motion on the next (see stroke_chains.hpp), and limits of jerk outside the closed form.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/verify/redundant/stroke_sections.hpp"

namespace bahnwerk {

struct StrokeGain {
  std::size_t sections = 0;  ///< number of sections whose bounds rose
  double duration = 0;       ///< s, sum of the increases
};

/// Raises the bounds in `sections`, which lower_bound() returned, to what the proof gives, by bisection to a relative
/// accuracy of 1e-5. Cost: 0.2 ms per section longer than a stroke, 1 ms if its bound rises.
StrokeGain raise_by_stroke(const StrokeBoundTask& task, std::vector<SectionBound>& sections, Progress progress);

}  // namespace bahnwerk
