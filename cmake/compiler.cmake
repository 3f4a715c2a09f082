# SPDX-License-Identifier: GPL-3.0-or-later
# One place for what every target of weft is compiled with.

add_library(weft_options INTERFACE)
target_compile_features(weft_options INTERFACE cxx_std_20)
target_compile_options(weft_options INTERFACE
  -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow
  # The same bytes from every compiler: no fused multiply-add where the source does not say so.
  -ffp-contract=off
  $<$<BOOL:${WEFT_WERROR}>:-Werror>)

# -O3 pays in the medial axis and the raster loops.
string(REPLACE "-O2" "-O3" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")
set(CMAKE_CXX_FLAGS_RELEASE "-O3")
set(weft_fast "")
set(weft_small $<$<CONFIG:Release>:-Os>)  # for what runs once a job
set(weft_tested $<$<CONFIG:Release>:-O0>)     # for tests: compiled in half the time
set(weft_reckoning $<$<CONFIG:Release>:-O1>)  # for tests whose own loops take longer than that saves
if(WEFT_SANITIZE AND NOT WEFT_SANITIZE MATCHES fuzzer)
  # Checks at every access make optimising slow: what takes no time to run is compiled in half the time without.
  set(weft_small -O0)
  set(weft_tested -O0)
  set(weft_reckoning -O0)
endif()

if(WEFT_SANITIZE)
  add_compile_options(-fsanitize=${WEFT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${WEFT_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # With instrumentation GCC 12 sees uninitialised members in its own <regex> that are not.
    add_compile_options(-Wno-maybe-uninitialized)
    # A null pointer that is followed ends under the address sanitizer as well, and alignment is checked by the fuzzers'
    # build (clang): asked for at every access, the two are a quarter of the time that GCC takes here.
    add_compile_options(-fno-sanitize=null,alignment)
  endif()
endif()

find_program(CCACHE ccache)
include(${CMAKE_CURRENT_LIST_DIR}/precompiled.cmake)
if(CCACHE AND NOT WEFT_PRECOMPILED)  # one does not know what the other has read
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
