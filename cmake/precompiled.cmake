# SPDX-License-Identifier: GPL-3.0-or-later
# weft_precompiled(TARGET KIND [CATCH] [EXACT] [HEADS head...])
#
# The heads that most files include, read once for all targets of one KIND (fast, small, tested or reckoning: what their
# files are compiled with) instead of once a file: where no cache of compiled files helps, this takes a third off a
# build. HEADS, which a whole module includes, make one of the target's own. CATCH: tests. EXACT: CGAL asks for exact
# rounding, which is another way of compiling. What only some files include is not worth it: a head that they all
# load costs each of them (nlohmann's 0.4 s a file, to save 0.6 s in every sixth). Files go on naming what they use: a
# build with a cache, and the one with the other compiler, have nothing precompiled.
if(CCACHE)
  set(without_cache OFF)
else()
  set(without_cache ON)
endif()
option(WEFT_PRECOMPILED "Precompile common heads (on where there is no ccache)" ${without_cache})

function(weft_precompiled target kind)
  if(NOT WEFT_PRECOMPILED)
    return()
  endif()
  cmake_parse_arguments(arg "CATCH;EXACT" "" "HEADS" ${ARGN})
  set(heads <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <optional> <set> <span> <string>
    <string_view> <utility> <variant> <vector> <fmt/format.h>)
  set(libraries fmt::fmt)
  if(arg_HEADS)
    target_precompile_headers(${target} PRIVATE ${heads} ${arg_HEADS})
    return()
  endif()
  set(name weft_precompiled_${kind})
  if(arg_CATCH)
    list(APPEND heads <catch2/catch.hpp>)
    list(APPEND libraries Catch2::Catch2)
  endif()
  if(arg_EXACT)
    string(APPEND name _exact)
    list(APPEND libraries CGAL::CGAL)
  endif()
  if(NOT TARGET ${name})
    set(source ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing: what counts is what is precompiled for it.\n")
    add_library(${name} STATIC ${source})
    target_compile_options(${name} PRIVATE ${weft_${kind}})
    target_link_libraries(${name} PRIVATE weft_options ${libraries})
    target_precompile_headers(${name} PRIVATE ${heads})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()
