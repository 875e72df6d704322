#pragma once

namespace bahnwerk::api {

/// The level of the planners of this version. It is raised with each version in which a document may ask for what
/// earlier planners cannot do, such as a new kind or member: a job needs the level of the program that took it, and
/// workers of a lower one leave it in the queue.
inline constexpr int engine_level = 1;

}  // namespace bahnwerk::api
