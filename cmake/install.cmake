# `cmake --install` and `cpack -G DEB`: the program, its profiles and manual, and the library for programs that embed it.
include(CMakePackageConfigHelpers)

install(DIRECTORY profiles/ DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/profiles FILES_MATCHING PATTERN "*.ini")
install(DIRECTORY lib/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft FILES_MATCHING PATTERN "*.h")
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES app/weft.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

get_property(modules GLOBAL PROPERTY WEFT_MODULES)
list(TRANSFORM modules PREPEND weft_)
install(TARGETS ${modules} weft EXPORT weft ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/weft)
install(EXPORT weft NAMESPACE weft:: FILE weft-targets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/weft)
configure_package_config_file(cmake/weft-config.cmake.in weft-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/weft)
write_basic_package_version_file(weft-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/weft-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/weft-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/weft)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "weft maintainers <weft@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
include(CPack)
