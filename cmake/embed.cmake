# SPDX-License-Identifier: GPL-3.0-or-later
# weft_embed(TARGET NAME FILE): builds a file's bytes into the target, as `extern const std::string_view NAME`. Run as a
# script it writes the C++ of one of them.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${IN} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" hex "${hex}")
  file(SIZE ${IN} size)
  string(LENGTH "${hex}" length)
  set(lines "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${hex}" ${at} 128 line)
    string(APPEND lines "\n    \"${line}\"")
    math(EXPR at "${at} + 128")
  endwhile()
  file(WRITE ${OUT} "#include <string_view>\nextern const std::string_view ${NAME};\nconst std::string_view ${NAME}{${lines},\n    ${size}};\n")
  return()
endif()

function(weft_embed target name file)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DIN=${file} -DOUT=${out} -DNAME=${name} -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${file} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake VERBATIM)
  target_sources(${target} PRIVATE ${out})
endfunction()
