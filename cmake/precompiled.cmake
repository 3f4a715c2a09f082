# SPDX-License-Identifier: GPL-3.0-or-later
# weft_precompiled(TARGET KIND [LIBRARY...])
#
# The heads that most files include, read once for all targets of one KIND (fast, small or tested: what their files are
# compiled with) instead of once a file: where no cache of compiled files helps, this takes a third off a build. Of
# the libraries given, nlohmann_json, Catch2 and CGAL count: what a module may not include is not in what it gets. Files
# go on naming what they use: a build with a cache, and the one with the other compiler, have nothing precompiled.
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
  set(heads <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <optional> <set> <span> <string>
    <string_view> <utility> <variant> <vector> <fmt/format.h>)
  set(name weft_precompiled_${kind})
  set(libraries fmt::fmt)
  if(nlohmann_json::nlohmann_json IN_LIST ARGN)
    string(APPEND name _json)
    list(APPEND heads <nlohmann/json.hpp>)
    list(APPEND libraries nlohmann_json::nlohmann_json)
  endif()
  if(Catch2::Catch2 IN_LIST ARGN)
    list(APPEND heads <catch2/catch.hpp>)
    list(APPEND libraries Catch2::Catch2)
  endif()
  if(CGAL::CGAL IN_LIST ARGN)  # no head of it: it asks for exact rounding, which is another way of compiling
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
