# SPDX-License-Identifier: GPL-3.0-or-later
# weft_module(NAME [ONCE | GLUE] [USES module...] [PUBLIC lib...] [PRIVATE lib...] [HEADS head...])
#
# A module is a folder of lib/ and the library made of the .cpp files in it and in folders of it. USES names the modules whose headers it may
# include; the row also goes to modules.txt, from which a test checks every #include (tests/architecture.cmake). What
# runs once a job is compiled to be small: a page of a program that is never run still takes memory beside one that is.
# GLUE calls what takes time and has no such loop itself: with sanitizers it is compiled as what runs once.
# HEADS are included by so many of its files that they are precompiled with the common ones (precompiled.cmake).
set_property(GLOBAL PROPERTY WEFT_MODULES "")
file(WRITE ${CMAKE_BINARY_DIR}/modules.txt "")

# weft_row(NAME USES PUBLIC PRIVATE): what a test holds every #include of that folder against.
function(weft_row name uses public private)
  string(REPLACE ";" " " row "${name}:${uses}:${public}:::${private}")
  file(APPEND ${CMAKE_BINARY_DIR}/modules.txt "${row}\n")
endfunction()

function(weft_module name)
  cmake_parse_arguments(arg "ONCE;GLUE" "" "USES;PUBLIC;PRIVATE;HEADS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(TRANSFORM arg_USES PREPEND weft_ OUTPUT_VARIABLE used)
  if(sources)
    add_library(weft_${name} STATIC ${sources})
    set(scope PUBLIC)
    set(kind fast)
    if(arg_ONCE OR (arg_GLUE AND WEFT_SANITIZE AND NOT WEFT_SANITIZE MATCHES fuzzer))
      set(kind small)
      target_compile_options(weft_${name} PRIVATE ${weft_small})
    endif()
    if(CGAL::CGAL IN_LIST arg_PRIVATE)
      set(rounding EXACT)
    endif()
    weft_precompiled(weft_${name} ${kind} ${rounding} HEADS ${arg_HEADS})
    target_link_libraries(weft_${name} PRIVATE $<BUILD_INTERFACE:weft_options> ${arg_PRIVATE})
  else()
    add_library(weft_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(weft_${name} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/weft>)
  target_link_libraries(weft_${name} ${scope} ${used} ${arg_PUBLIC})
  target_compile_features(weft_${name} ${scope} cxx_std_20)  # also of programs that embed it
  set_property(GLOBAL APPEND PROPERTY WEFT_MODULES ${name})
  weft_row(${name} "${arg_USES}" "${arg_PUBLIC}" "${arg_PRIVATE}")
endfunction()
