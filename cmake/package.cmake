# What `cpack` puts into bahnwerk_VERSION_ARCH.deb. The target `package_files` makes what is written from the program itself and from the changelog;
# ./release builds both and runs cpack.
if(NOT TARGET bahnwerk)
  return()
endif()
set(package ${PROJECT_SOURCE_DIR}/deploy/package)
set(packaged ${CMAKE_BINARY_DIR}/package)
set(doc /usr/share/doc/bahnwerk)
set(library_doc /usr/share/doc/libbahnwerk-dev)

find_package(Python3 COMPONENTS Interpreter)
set(described ${packaged}/bahnwerk.1.gz ${packaged}/bash ${packaged}/zsh)
set(forms man bash zsh)
foreach(form file IN ZIP_LISTS forms described)
  add_custom_command(OUTPUT ${file} COMMAND ${Python3_EXECUTABLE} ${package}/describe.py ${form} $<TARGET_FILE:bahnwerk> ${file}
    DEPENDS bahnwerk ${package}/describe.py VERBATIM)
endforeach()
add_custom_command(OUTPUT ${packaged}/CHANGELOG.md.gz COMMAND sh -c "gzip -9nc '${PROJECT_SOURCE_DIR}/CHANGELOG.md' >'${packaged}/CHANGELOG.md.gz'"
  DEPENDS ${PROJECT_SOURCE_DIR}/CHANGELOG.md VERBATIM)
add_custom_target(package_files DEPENDS ${described} ${packaged}/CHANGELOG.md.gz)

file(STRINGS ${PROJECT_SOURCE_DIR}/LICENSE license)
list(GET license 2 COPYRIGHT)
string(REPLACE "Copyright (c) " "" COPYRIGHT "${COPYRIGHT}")
list(JOIN license "\n " LICENSE_TEXT)
string(PREPEND LICENSE_TEXT " ")
string(REGEX REPLACE "\n \n" "\n .\n" LICENSE_TEXT "${LICENSE_TEXT}")
configure_file(${package}/copyright.in ${packaged}/copyright @ONLY)

# `cmake --install` alone installs the library (cmake/library.cmake); the service has folders of its own and comes with the package.
function(install_service)
  install(${ARGN} COMPONENT service EXCLUDE_FROM_ALL)
endfunction()
install_service(TARGETS bahnwerk RUNTIME DESTINATION /usr/bin)
install_service(FILES ${PROJECT_SOURCE_DIR}/deploy/systemd/bahnwerk.service DESTINATION /lib/systemd/system)
install_service(FILES ${PROJECT_SOURCE_DIR}/deploy/systemd/bahnwerk.default DESTINATION /etc/default RENAME bahnwerk)
install_service(FILES ${packaged}/bahnwerk.1.gz DESTINATION /usr/share/man/man1)
install_service(FILES ${packaged}/bash DESTINATION /usr/share/bash-completion/completions RENAME bahnwerk)
install_service(FILES ${packaged}/zsh DESTINATION /usr/share/zsh/vendor-completions RENAME _bahnwerk)
install_service(FILES ${packaged}/copyright ${packaged}/CHANGELOG.md.gz ${PROJECT_SOURCE_DIR}/docs/operations.md DESTINATION ${doc})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${doc} COMPONENT service EXCLUDE_FROM_ALL PATTERN "*.py" EXCLUDE PATTERN "embed" EXCLUDE PATTERN "generator" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install_service(FILES ${PROJECT_SOURCE_DIR}/examples/clients/python/bahnwerk.py DESTINATION ${doc}/examples/clients/python)

# libbahnwerk-dev: what `cmake --install` installs, with its documents.
function(install_library_document)
  install(${ARGN} COMPONENT library EXCLUDE_FROM_ALL)
endfunction()
install_library_document(FILES ${packaged}/copyright ${packaged}/CHANGELOG.md.gz ${PROJECT_SOURCE_DIR}/docs/library.md DESTINATION ${library_doc})
install_library_document(FILES ${PROJECT_SOURCE_DIR}/examples/embed/CMakeLists.txt ${PROJECT_SOURCE_DIR}/examples/embed/main.cpp DESTINATION ${library_doc}/examples/embed)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME bahnwerk)
set(CPACK_PACKAGE_VENDOR Bahnwerk)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL service library)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "Bahnwerk <bahnwerk@localhost>")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_SERVICE_PACKAGE_NAME bahnwerk)
set(CPACK_DEBIAN_SERVICE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SERVICE_DESCRIPTION "motion planning service
Plans motions of machines over HTTP: a contour and the limits of a machine's
axes go in, verified setpoints for every cycle of its drives come out; a
motor's slot goes in, layouts of its wires come out. Jobs are durable.")
set(CPACK_DEBIAN_SERVICE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SERVICE_PACKAGE_DEPENDS "adduser, init-system-helpers (>= 1.54~)")
set(CPACK_DEBIAN_SERVICE_PACKAGE_CONTROL_EXTRA ${package}/postinst ${package}/prerm ${package}/postrm ${package}/conffiles)

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libbahnwerk-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "motion planning library (development files)
The planning library of the service bahnwerk, to be linked into other
programs: a static library, the headers of its public surface and what CMake
needs to find them.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS libnlopt-dev)
include(CPack)
