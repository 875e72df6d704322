// The members of JerkSolver stand in files by idea; here they are compiled for every number of rows.
#include "core/motion/jerk/solver.hpp"

#include "core/motion/jerk/adopt.ipp"
#include "core/motion/jerk/newton.ipp"
#include "core/motion/jerk/solver.ipp"

namespace bahnwerk {

template class JerkSolver<2>;
template class JerkSolver<3>;
template class JerkSolver<4>;
template class JerkSolver<5>;
template class JerkSolver<6>;
template class JerkSolver<8>;
template class JerkSolver<9>;

}  // namespace bahnwerk
