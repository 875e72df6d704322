// The members of JerkSectionPlanner stand in files by idea; here they are compiled for every number of axes and rows.
#include "core/motion/jerk/section.hpp"

#include "core/motion/jerk/build_problem.ipp"
#include "core/motion/jerk/certify.ipp"
#include "core/motion/jerk/refine.ipp"
#include "core/motion/jerk/section.ipp"
#include "core/motion/jerk/windows.ipp"

namespace bahnwerk {

template class JerkSectionPlanner<2, 2>;
template class JerkSectionPlanner<2, 3>;
template class JerkSectionPlanner<3, 3>;
template class JerkSectionPlanner<3, 4>;
template class JerkSectionPlanner<5, 5>;
template class JerkSectionPlanner<5, 6>;
template class JerkSectionPlanner<8, 8>;
template class JerkSectionPlanner<8, 9>;

}  // namespace bahnwerk
