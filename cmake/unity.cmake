# Compiles the sources of targets in groups, so that their common headers are read once. Which sources can stand together, cmake/unity.py finds.
#
# The groups are files of our own and not CMake's: those include their sources by absolute paths, and no compiler cache would find what another clone compiled.

# bahnwerk_unity(TARGET SOURCE...): the sources of this target are to be compiled in groups.
function(bahnwerk_unity target)
  if(NOT BAHNWERK_UNITY)
    return()
  endif()
  list(TRANSFORM ARGN REPLACE "^${PROJECT_SOURCE_DIR}/" "" OUTPUT_VARIABLE sources)
  set_property(GLOBAL APPEND PROPERTY BAHNWERK_GROUPED ${target})
  set_property(GLOBAL PROPERTY BAHNWERK_SOURCES_${target} ${sources})
  # What one source declares for itself another one may hide, so -Wshadow looks at local names alone (builds file by file look at all), and a type of an
  # unnamed namespace is not in a header.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local -Wno-subobject-linkage>)
endfunction()

# Makes the groups of all targets: one run of the script for all, because they read the same headers. A source with options of its own stands alone.
function(bahnwerk_group_sources)
  get_property(targets GLOBAL PROPERTY BAHNWERK_GROUPED)
  if(NOT targets)
    return()
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(wanted "")
  foreach(target ${targets})
    get_property(sources GLOBAL PROPERTY BAHNWERK_SOURCES_${target})
    set(line ${target})
    foreach(source ${sources})
      set(source_path ${PROJECT_SOURCE_DIR}/${source})
      get_source_file_property(options ${source_path} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
      get_source_file_property(definitions ${source_path} TARGET_DIRECTORY ${target} COMPILE_DEFINITIONS)
      if(NOT options AND NOT definitions)
        set_source_files_properties(${source_path} TARGET_DIRECTORY ${target} PROPERTIES HEADER_FILE_ONLY ON)
        string(APPEND line " ${source}")
      endif()
    endforeach()
    string(APPEND wanted "${line}\n")
  endforeach()
  file(WRITE ${PROJECT_BINARY_DIR}/unity/targets.txt "${wanted}")
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/unity.py 8 ${PROJECT_BINARY_DIR}/unity COMMAND_ERROR_IS_FATAL ANY)
  foreach(target ${targets})
    file(GLOB files ${PROJECT_BINARY_DIR}/unity/${target}/*.cpp)
    target_sources(${target} PRIVATE ${files})
  endforeach()
endfunction()
