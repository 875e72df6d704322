#pragma once

namespace bahnwerk::server {

/// Lowers this thread's share of the processor by `nice` steps, 0 to 19 (Linux; elsewhere without effect). Beside a
/// busy thread of nice 0 a thread of nice 10 gets about a tenth, alone it gets all.
void lower_priority(int nice);

}  // namespace bahnwerk::server
