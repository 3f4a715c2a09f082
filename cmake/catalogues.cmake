# SPDX-License-Identifier: GPL-3.0-or-later
# weft_catalogues(TARGET po-file...): compiles gettext catalogues and builds their bytes into the target, so that labels
# need neither a locale of the system nor a folder beside the program. Run as a script it writes the C++ of one of them.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${IN} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" hex "${hex}")
  string(REGEX REPLACE "((\\\\x[0-9a-f][0-9a-f])+)" "\\1" hex "${hex}")
  file(SIZE ${IN} size)
  string(LENGTH "${hex}" length)
  set(lines "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${hex}" ${at} 128 line)
    string(APPEND lines "\n    \"${line}\"")
    math(EXPR at "${at} + 128")
  endwhile()
  file(WRITE ${OUT} "#include <string_view>\nextern const std::string_view catalogue_${NAME};\nconst std::string_view catalogue_${NAME}{${lines},\n    ${size}};\n")
  return()
endif()

find_program(MSGFMT msgfmt)
if(NOT MSGFMT)
  message(FATAL_ERROR "msgfmt is missing: Debian package gettext")
endif()

function(weft_catalogues target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/catalogues)
  file(MAKE_DIRECTORY ${folder})
  set(declarations "")
  set(rows "")
  foreach(po ${ARGN})
    get_filename_component(name ${po} NAME_WE)
    add_custom_command(OUTPUT ${folder}/${name}.cpp
      COMMAND ${MSGFMT} --check --endianness=little -o ${folder}/${name}.mo ${po}
      COMMAND ${CMAKE_COMMAND} -DIN=${folder}/${name}.mo -DOUT=${folder}/${name}.cpp -DNAME=${name} -P ${PROJECT_SOURCE_DIR}/cmake/catalogues.cmake
      DEPENDS ${po} ${PROJECT_SOURCE_DIR}/cmake/catalogues.cmake VERBATIM)
    target_sources(${target} PRIVATE ${folder}/${name}.cpp)
    string(APPEND declarations "extern const std::string_view catalogue_${name};\n")
    string(APPEND rows "    {\"${name}\", catalogue_${name}},\n")
    math(EXPR count "${count} + 1")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/catalogues.h CONTENT
"#pragma once
#include <array>
#include <string_view>

${declarations}
struct Catalogue {
  std::string_view language;
  std::string_view bytes;
};
inline const std::array<Catalogue, ${count}> catalogues{{
${rows}}};
" @ONLY)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
