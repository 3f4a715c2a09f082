# SPDX-License-Identifier: GPL-3.0-or-later
# Every library weft stands on, all from Debian packages; which module uses which stands in lib/CMakeLists.txt.
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_library(GMP_LIBRARIES NAMES libgmp.a gmp)  # for CGAL; an archive for the reason below
find_package(CGAL REQUIRED)
# Else a test of rounding modes runs before main, and ends the program where there is one mode only, as in valgrind.
target_compile_definitions(CGAL INTERFACE CGAL_DISABLE_ROUNDING_MATH_CHECK)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(polyclipping REQUIRED IMPORTED_TARGET polyclipping)
pkg_check_modules(nettle REQUIRED IMPORTED_TARGET nettle)
pkg_check_modules(minizip REQUIRED IMPORTED_TARGET minizip)
pkg_check_modules(expat REQUIRED IMPORTED_TARGET expat)
pkg_check_modules(libpng REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(pcre2 REQUIRED IMPORTED_TARGET libpcre2-8)
find_package(ZLIB REQUIRED)
set(Boost_USE_STATIC_LIBS ON)
find_package(Boost REQUIRED COMPONENTS program_options)

# A run needs a few functions of these; a shared library takes hundreds of kB in memory for its tables alone. Where the
# system has no archive, the shared one does.
find_library(zlib NAMES libz.a z REQUIRED)
foreach(library nettle minizip expat png)
  find_library(${library}_archive lib${library}.a)
  if(${library}_archive)
    string(REPLACE png libpng target ${library})
    set_property(TARGET PkgConfig::${target} PROPERTY INTERFACE_LINK_LIBRARIES ${${library}_archive} ${zlib} m)
  endif()
endforeach()
find_library(pcre2_archive libpcre2-8.a)
if(pcre2_archive)
  set_property(TARGET PkgConfig::pcre2 PROPERTY INTERFACE_LINK_LIBRARIES ${pcre2_archive})
endif()
