# SPDX-License-Identifier: GPL-3.0-or-later
# weft_catalogues(TARGET po-file...): compiles gettext catalogues and builds their bytes into the target, so that labels
# need neither a locale of the system nor a folder beside the program.
include(${CMAKE_CURRENT_LIST_DIR}/embed.cmake)

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
    add_custom_command(OUTPUT ${folder}/${name}.mo
      COMMAND ${MSGFMT} --check --endianness=little -o ${folder}/${name}.mo ${po} DEPENDS ${po} VERBATIM)
    weft_embed(${target} catalogue_${name} ${folder}/${name}.mo)
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
