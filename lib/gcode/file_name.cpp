// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/file_name.h"

#include "core/error.h"
#include "gcode/custom_code.h"

#include <algorithm>

namespace weft::gcode {

std::string file_name(const Job& job) {
  constexpr auto setting = "output_filename_format";
  const macro::Template format(job.settings.gcode.output_filename_format, setting);
  const auto variables = print_variables(job);
  macro::Variables globals;
  format.check(variables, globals);
  macro::Scope scope;
  auto name = format.expand(variables, scope);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || static_cast<unsigned char>(c) < ' '; }, '_');
  if (name.empty() || name == "." || name == "..")
    throw Error{Error::Kind::settings, "names no file", setting, "as in {input_filename_base}.gcode; or say -o"};
  return name;
}

}  // namespace weft::gcode
