# SPDX-License-Identifier: GPL-3.0-or-later
# `cmake --install`, and the two packages of `cpack -G DEB`: weft is the program, its profiles, manual and completions;
# weft-dev (the component dev) the library for programs that embed it. What names no component is of weft.
include(CMakePackageConfigHelpers)

install(DIRECTORY profiles/ DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/profiles FILES_MATCHING PATTERN "*.ini")
install(FILES README.md LICENSE cmake/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY examples/batch DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)
install(FILES app/weft.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

install(DIRECTORY lib/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft COMPONENT dev FILES_MATCHING PATTERN "*.h")
install(FILES cmake/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/weft-dev COMPONENT dev)
get_property(modules GLOBAL PROPERTY WEFT_MODULES)
list(TRANSFORM modules PREPEND weft_)
install(TARGETS ${modules} weft EXPORT weft ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/weft COMPONENT dev)
install(EXPORT weft NAMESPACE weft:: FILE weft-targets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/weft COMPONENT dev)
configure_package_config_file(cmake/weft-config.cmake.in weft-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/weft)
write_basic_package_version_file(weft-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/weft-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/weft-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/weft COMPONENT dev)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "weft maintainers <weft@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL weft dev)
set(CPACK_COMPONENT_WEFT_DESCRIPTION "Turns triangle meshes and ini profiles into G-code for printers that melt filament,
 and audits every byte of it before it is written. For scripts and print farms.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "The library of the slicer weft, for programs that embed it: headers, archives and the
 files that CMake's find_package(weft) reads.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_WEFT_PACKAGE_NAME weft)
set(CPACK_DEBIAN_WEFT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_WEFT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME weft-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# What weft-config.cmake looks for.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libcgal-dev, libeigen3-dev, libpolyclipping-dev, libfmt-dev, libtbb-dev, \
nlohmann-json3-dev, nettle-dev, libminizip-dev, libexpat1-dev, libpng-dev, libpcre2-dev, zlib1g-dev, libboost-dev, pkg-config")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "weft (= ${PROJECT_VERSION})")
set(CPACK_STRIP_FILES ON)
include(CPack)
