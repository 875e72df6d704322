# The planning library to embed: `cmake --install BUILD --prefix DIR` puts one static library of all layers of core/, the headers of its public surface
# (docs/library.md) and what find_package(bahnwerk) reads into DIR. The installed target is bahnwerk::core.
include(CMakePackageConfigHelpers)

# Their includes are installed with them, and may change.
set(BAHNWERK_PUBLIC_HEADERS
  base/errors.hpp base/progress.hpp base/read_rows.hpp base/setpoint_source.hpp base/verification.hpp
  contour/builder.hpp contour/contour.hpp contour/dxf.hpp contour/gcode.hpp contour/polyline.hpp
  machine/limits.hpp machine/machine.hpp
  plan/contour/contour_plan.hpp plan/method_options.hpp)

get_property(objects GLOBAL PROPERTY BAHNWERK_OBJECTS)
find_package(NLopt REQUIRED)
add_library(bahnwerk_core STATIC ${objects})
set_target_properties(bahnwerk_core PROPERTIES LINKER_LANGUAGE CXX OUTPUT_NAME bahnwerk EXPORT_NAME core)
target_link_libraries(bahnwerk_core PRIVATE NLopt::nlopt)
target_include_directories(bahnwerk_core INTERFACE $<INSTALL_INTERFACE:include>)
target_compile_features(bahnwerk_core INTERFACE cxx_std_20)
# Functions of headers are compiled by whoever includes them, and the linker keeps one of them: they have to give the library's bits.
target_compile_options(bahnwerk_core INTERFACE -ffp-contract=off)

install(TARGETS bahnwerk_core EXPORT bahnwerk ARCHIVE DESTINATION lib COMPONENT library)
install(EXPORT bahnwerk NAMESPACE bahnwerk:: FILE bahnwerk-targets.cmake DESTINATION lib/cmake/bahnwerk COMPONENT library)
configure_package_config_file(cmake/bahnwerk-config.cmake.in ${CMAKE_BINARY_DIR}/bahnwerk-config.cmake INSTALL_DESTINATION lib/cmake/bahnwerk
  NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/bahnwerk-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/bahnwerk-config.cmake ${CMAKE_BINARY_DIR}/bahnwerk-config-version.cmake DESTINATION lib/cmake/bahnwerk COMPONENT library)
install(CODE "set(headers \"${BAHNWERK_PUBLIC_HEADERS}\")\nset(core \"${PROJECT_SOURCE_DIR}/core\")\nset(made \"${CMAKE_BINARY_DIR}/include\")" COMPONENT library)
install(SCRIPT cmake/install_headers.cmake COMPONENT library)
