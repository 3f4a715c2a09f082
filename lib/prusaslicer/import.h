// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/ini.h"

#include <string>
#include <string_view>
#include <vector>

/// PrusaSlicer's configuration (and SuperSlicer's and Slic3r's, as far as the keys agree) in weft's words.
/// Source: the grammar and the conversions of old spellings as PrusaSlicer 2.9 documents and shows them in its exports.
namespace weft::prusaslicer {

/// Is this ini one of PrusaSlicer's family? Told by content: its first comment, or keys that only that family has.
bool recognises(std::string_view text, const std::vector<IniEntry>& entries);

/// One of weft's settings, and the line it comes from.
struct Assignment {
  std::string key, text;
  int line = 0;        ///< 0: PrusaSlicer's own default, where no line says otherwise
  std::string theirs;  ///< the key of that line in today's spelling; empty: several had a part in it
  std::string source;  ///< that line: "[print:*common*] perimeter_speed = 45"
};

/// A line that does not say all of what it would say to PrusaSlicer.
struct Remark {
  std::string key, text;
  int line = 0;
  std::string why;
};

/// The fate of every line of a configuration.
struct Translation {
  std::vector<Assignment> assignments;  ///< in the order of the table; lines of the same key later win
  std::vector<Remark> not_needed;       ///< without effect here, and why that is no loss
  std::vector<Remark> approximated;     ///< translated to the nearest that weft has
  std::vector<Remark> unsupported;      ///< set to a value that would change the print, and not supported
  std::vector<Remark> unknown;          ///< keys of nobody's table
};

/// @param complete the lines are a whole configuration: what they do not say is as PrusaSlicer has it by default
/// @throws Error{settings} with path:line for a value that does not parse whole
Translation translate(std::vector<IniEntry> entries, const std::string& path, bool complete = false);

}  // namespace weft::prusaslicer
