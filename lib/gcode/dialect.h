// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/text.h"
#include "model/plan.h"
#include "settings/settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft::gcode {

/// Percent done and minutes left, as displays show them.
struct Progress {
  std::int64_t percent, minutes;
  bool operator==(const Progress&) const = default;
};

/// What firmwares write differently. One function a command.
/// Source: the G-code pages of Marlin, Klipper, RepRapFirmware, Repetier-Firmware and Smoothieware.
struct Dialect {
  Firmware firmware = Firmware::marlin2;
  ObjectLabels labels = ObjectLabels::firmware;
  CommentDialect comments = CommentDialect::prusaslicer;
  ToolSelect tool_select = ToolSelect::firmware;

  /// @param share 0 … 1
  void fan(Text& out, double share) const;

  /// Of the tool that is loaded; nothing where the firmware knows none.
  void pressure_advance(Text& out, double seconds, ToolId tool) const;

  /// Is the acceleration of travels a value of its own, which stays while printing?
  bool separate_travel_acceleration() const {
    return firmware == Firmware::marlin2 || firmware == Firmware::reprapfirmware || firmware == Firmware::repetier;
  }
  void print_acceleration(Text& out, std::int64_t mm_s2) const;
  void travel_acceleration(Text& out, std::int64_t mm_s2) const;

  /// Loads a tool.
  void select(Text& out, ToolId tool) const;
  void temperature(Text& out, const SetTemperature& heat) const;
  /// Before filament is moved by a swap: neither the user's speed nor the firmware's pressure advance changes that.
  /// @param advance is said again with what is loaded then
  void hold(Text& out, bool advance) const;
  /// Afterwards the user's speed holds again.
  void release(Text& out) const;
  /// The command by which pressure advance is set.
  std::string_view advance_command() const;
  /// Heaters of a tool that is not selected are off, whatever temperature it is given: it is selected first.
  bool selects_to_heat() const { return firmware == Firmware::reprapfirmware; }
  /// …or told to stand by, which heats it before it is selected for the first time. Pre: it has a temperature
  void stand_by(Text& out, ToolId tool) const;
  /// What a mixing nozzle makes of two filaments. @param share of the second, 0 … 1
  void mix(Text& out, double share) const;
  /// Waits for the user; what firmwares call this they do in ways of their own.
  void pause(Text& out, const std::string& text) const;
  /// Waits until the user has put other filament in: M600 where the firmware knows it, else a pause.
  void color_change(Text& out, const std::string& text) const;

  /// Limits of speed, acceleration and jerk; nothing for Klipper, which has them in its own configuration.
  std::string machine_limits(const MachineSettings& machine) const;

  /// Nothing where the firmware knows no M73.
  std::string progress(Progress p) const;
  /// The same of a silent mode: nothing but for Marlin, of which some builds have one.
  std::string silent_progress(Progress p) const;

  /// Names of the objects, before the first of them is printed.
  void define_objects(Text& out, const std::vector<ObjectLabel>& objects, const std::vector<std::string>& names) const;
  void object_start(Text& out, std::uint32_t object, const std::vector<std::string>& names) const;
  void object_end(Text& out, std::uint32_t object, const std::vector<std::string>& names) const;

 private:
  /// Firmwares that cannot cancel objects get comments, by which OctoPrint can.
  bool in_commands() const;
  bool in_comments() const;
};

inline Dialect dialect_of(const Settings& s) {
  return {s.machine.firmware, s.gcode.gcode_label_objects, s.gcode.gcode_comment_dialect, s.tools.tool_select};
}

/// Names that every firmware takes as one word, and no two of them alike: letters, digits, '_' and what is not ASCII,
/// at most 60 bytes.
std::vector<std::string> label_names(const std::vector<ObjectLabel>& objects);

}  // namespace weft::gcode
