# SPDX-License-Identifier: GPL-3.0-or-later
# weft_build_facts(TARGET): build_facts.h, which says of what the program was built: the commit, looked up at each build,
# and the libraries. Outside a checkout there is no commit. Run as a script it writes the commit, where it has changed.
if(CMAKE_SCRIPT_MODE_FILE)
  set(commit "")
  find_program(GIT git)
  if(GIT)
    execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel OUTPUT_VARIABLE top ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(top STREQUAL SOURCE)  # not the checkout of something that holds a copy of the sources
      execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --abbrev=12 --dirty=+ --exclude=*
        OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    endif()
  endif()
  file(CONFIGURE OUTPUT ${OUT} CONTENT "#pragma once\n#include <string_view>\n\n/// The commit built from; '+' behind it: with changes. Empty: not known.\ninline constexpr std::string_view built_commit = \"${commit}\";\n")
  return()
endif()

function(weft_build_facts target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/facts)
  add_custom_target(weft_commit BYPRODUCTS ${folder}/built_commit.h VERBATIM
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUT=${folder}/built_commit.h -P ${PROJECT_SOURCE_DIR}/cmake/build_facts.cmake)
  add_dependencies(${target} weft_commit)
  find_file(clipper clipper.hpp PATHS ${polyclipping_INCLUDE_DIRS} PATH_SUFFIXES polyclipping)
  if(NOT polyclipping_VERSION AND clipper)  # its .pc file says none
    file(STRINGS ${clipper} line REGEX "define CLIPPER_VERSION")
    string(REGEX MATCH "[0-9][0-9.]*" polyclipping_VERSION "${line}")
  endif()
  set(libraries "Boost ${Boost_VERSION_STRING}, CGAL ${CGAL_VERSION}, Clipper ${polyclipping_VERSION}, Eigen ${Eigen3_VERSION}, expat ${expat_VERSION}, fmt ${fmt_VERSION}, libpng ${libpng_VERSION}, minizip ${minizip_VERSION}, nettle ${nettle_VERSION}, nlohmann_json ${nlohmann_json_VERSION}, PCRE2 ${pcre2_VERSION}, TBB ${TBB_VERSION}")
  file(CONFIGURE OUTPUT ${folder}/built_with.h CONTENT "#pragma once\n#include <string_view>\n\ninline constexpr std::string_view built_with = \"${libraries}\";\n")
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
