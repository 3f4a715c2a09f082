// SPDX-License-Identifier: GPL-3.0-or-later
// Klipper's extended commands: what they do to where the next move goes.
#include "audit/klipper.h"
#include "audit/reader.h"
#include "audit/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace weft::audit {
namespace {

using namespace std::string_view_literals;

/// Klipper's commands that leave the nozzle and the coordinates alone. Everything else that is spelt out is a macro,
/// and a macro may do anything. Sorted.
constexpr std::array harmless_commands{
    "BED_MESH_CLEAR"sv,
    "BED_MESH_OUTPUT"sv,
    "BED_MESH_PROFILE"sv,
    "CANCEL_PRINT_BASE"sv,
    "CLEAR_PAUSE"sv,
    "DEFINE_OBJECT"sv,
    "EXCLUDE_OBJECT"sv,
    "EXCLUDE_OBJECT_DEFINE"sv,
    "GET_POSITION"sv,
    "RESPOND"sv,
    "SAVE_VARIABLE"sv,
    "SET_DISPLAY_GROUP"sv,
    "SET_DISPLAY_TEXT"sv,
    "SET_EXTRUDER_ROTATION_DISTANCE"sv,
    "SET_FAN_SPEED"sv,
    "SET_FILAMENT_SENSOR"sv,
    "SET_GCODE_VARIABLE"sv,
    "SET_HEATER_TEMPERATURE"sv,
    "SET_IDLE_TIMEOUT"sv,
    "SET_INPUT_SHAPER"sv,
    "SET_LED"sv,
    "SET_PIN"sv,
    "SET_PRESSURE_ADVANCE"sv,
    "SET_PRINT_STATS_INFO"sv,
    "SET_RETRACTION"sv,
    "SET_SERVO"sv,
    "SET_STEPPER_ENABLE"sv,
    "SET_TEMPERATURE_FAN_TARGET"sv,
    "SET_TMC_CURRENT"sv,
    "SET_VELOCITY_LIMIT"sv,
    "STATUS"sv,
    "TEMPERATURE_WAIT"sv,
    "TURN_OFF_HEATERS"sv,
};
static_assert(std::is_sorted(harmless_commands.begin(), harmless_commands.end()));

using klipper::Arguments;

const std::string* find(const Arguments& arguments, std::string_view key) {
  const auto at = arguments.find(key);
  return at == arguments.end() ? nullptr : &at->second;
}

std::string_view name_in(const Arguments& arguments, std::string_view otherwise) {
  const auto* const name = find(arguments, "NAME");
  return name ? std::string_view(*name) : otherwise;
}

}  // namespace

/// A number of an extended command; nothing, and a problem, when it is none or beyond any machine.
std::optional<double> Reader::klipper_number(const std::string& text) {
  const auto v = klipper::number_of(text);
  if (!v)
    problem("an argument that is no number");
  else if (!(std::abs(*v) <= scan::furthest_mm))
    problem("a number beyond any machine");
  else
    return v;
  return std::nullopt;
}

/// MOVE=1: does the command move the nozzle, too?
bool Reader::klipper_moves(const Arguments& arguments) {
  const auto* const text = find(arguments, "MOVE");
  if (!text) return false;
  const auto v = klipper::integer_of(*text);
  if (!v) problem("an argument that is no number"), damaged_position();
  return v.value_or(0) != 0;
}

/// One axis of SET_GCODE_OFFSET, E being the fourth. @param to where MOVE=1 then leads
void Reader::klipper_offset_of(std::size_t i, const std::string& text, bool step, std::array<double, 3>& to) {
  const auto v = klipper_number(text);
  if (!v) return damaged_position();
  double& old = i < 3 ? state_.homing_offset[i] : state_.homing_e;
  const double wanted = *v + (step ? old : 0), by = wanted - old;
  if (!(std::abs(wanted) <= scan::furthest_mm)) return problem("a number beyond any machine"), damaged_position();
  if (i < 3)
    shift(i, by), to[i] += by;
  else
    state_.e -= by;
  old = wanted;
}

/// SET_GCODE_OFFSET: what is written means another place from now on; the nozzle stays, unless MOVE=1.
void Reader::klipper_offset(const Arguments& arguments) {
  static constexpr std::string_view axes[] = {"X", "Y", "Z", "E"},
                                    steps[] = {"X_ADJUST", "Y_ADJUST", "Z_ADJUST", "E_ADJUST"};
  std::array<double, 3> to = state_.position;
  for (std::size_t i = 0; i < 4; ++i) {
    if (const auto* const whole = find(arguments, axes[i]))
      klipper_offset_of(i, *whole, false, to);
    else if (const auto* const step = find(arguments, steps[i]))
      klipper_offset_of(i, *step, true, to);
  }
  if (klipper_moves(arguments)) step_to(to);
}

void Reader::klipper_save(const Arguments& arguments) {
  constexpr std::size_t most_saved = 64;
  const auto name = name_in(arguments, "default");
  if (saved_.size() < most_saved || saved_.contains(name))
    saved_.insert_or_assign(std::string(name), state_);
  else
    problem("more saved states than are kept");
}

void Reader::klipper_restore(const Arguments& arguments) {
  const auto at = saved_.find(name_in(arguments, "default"));
  if (at == saved_.end()) {  // Klipper stops here, but a macro may have saved it
    opaque_command("RESTORE_GCODE_STATE");
    return lose(stored, nullptr, cause_of("RESTORE_GCODE_STATE", "the file does not say what was saved", true));
  }
  const State& then = at->second;
  const State now = std::exchange(state_, then);
  state_.position = now.position, state_.known = now.known, state_.cause = now.cause, state_.homed = now.homed;
  for (std::size_t i = 0; i < 3; ++i) frame_known_[i] = frame_lost(i) < 0;
  if (klipper_moves(arguments)) move_straight_to(then.position, then.known, then.cause);
}

/// SET_KINEMATIC_POSITION, FORCE_MOVE: the machine stands elsewhere than it believes, until it is homed.
void Reader::klipper_forced(const Arguments&) {
  const auto cause = cause_of("SET_KINEMATIC_POSITION", "the machine stands elsewhere than it believes", true);
  state_.shift_lost.fill(cause);
  frame_known_.fill(false);
  forget_position(cause, Known::no);
}

/// ACTIVATE_EXTRUDER EXTRUDER=extruder1: the tool in use.
void Reader::klipper_extruder(const Arguments& arguments) {
  const auto* const name = find(arguments, "EXTRUDER");
  const std::string_view stem = "extruder";
  if (!name || !name->starts_with(stem)) return opaque_command("ACTIVATE_EXTRUDER");
  const auto number = klipper::integer_of(name->size() == stem.size() ? "0" : name->substr(stem.size()));
  if (!number || *number < 0) return opaque_command("ACTIVATE_EXTRUDER");
  tool_ = *number;
  take_tool_offsets();
}

/// SET_TMC_FIELD: most fields are about currents and noise; steps of a millimetre and the way round are not.
void Reader::klipper_field(const Arguments& arguments) {
  const auto* const name = find(arguments, "FIELD");
  if (!name) return;
  std::string upper = *name;
  std::transform(upper.begin(), upper.end(), upper.begin(), scan::upper);
  if (upper == "MRES" || upper == "SHAFT")
    lose(stored, nullptr, cause_of("SET_TMC_FIELD", "it changes how far motors turn, or which way", true));
}

/// TUNING_TOWER: gives a command again and again as Z grows.
void Reader::klipper_tower(const Arguments& arguments) {
  const auto* const command = find(arguments, "COMMAND");
  std::string name = command ? command->substr(0, command->find_first_of(" \t")) : std::string();
  std::transform(name.begin(), name.end(), name.begin(), scan::upper);
  if (!std::binary_search(harmless_commands.begin(), harmless_commands.end(), std::string_view(name)))
    lose(stored, nullptr, cause_of("TUNING_TOWER", "it gives a command at every height", true));
}

void Reader::klipper_skew(const Arguments& arguments) {
  const auto* const clear = find(arguments, "CLEAR");
  if (!clear || klipper::integer_of(*clear).value_or(0) == 0)
    lose(stored, nullptr, cause_of("SET_SKEW", "it skews the axes", true));
}

void Reader::klipper_delayed(const Arguments& arguments) {
  const auto* const duration = find(arguments, "DURATION");
  if (!duration || klipper::number_of(*duration) != 0.0) opaque_command("UPDATE_DELAYED_GCODE");
}

/// SKEW_PROFILE: what a calibration measured, like a mesh.
void Reader::klipper_skew_profile(const Arguments&) {
  list_opaque("SKEW_PROFILE");
}

/// Reads the arguments as Klipper's host does and hands them to the command.
void Reader::klipper_command(KlipperHandler handler, std::string_view text) {
  if (line_is_numbered_)  // only then Klipper cuts the checksum
    if (const auto star = text.rfind('*');
        star != std::string_view::npos && text.find_first_not_of("0123456789\r", star + 1) == std::string_view::npos)
      text = text.substr(0, star);
  // Anything but white space before the first letter is part of the command's name for Klipper, which it does not know.
  const auto first = text.find_first_not_of(" \t\r");
  const bool named = first == std::string_view::npos || text[first] == ';' || text[first] == '_' ||
                     text[first] == '*' || scan::is_letter(text[first]);
  const auto arguments = named ? klipper::arguments_of(text) : std::nullopt;
  if (arguments) return (this->*handler)(*arguments);
  problem("arguments that the firmware refuses");
  damaged_position();
}

void Reader::klipper_object(const Arguments& arguments) {
  context_.set_object(name_in(arguments, {}));
}

void Reader::klipper_object_end(const Arguments&) {
  context_.set_object({});
}

const char* Reader::extended_command(const char* p, const char* end) {
  struct Modelled {
    std::string_view name;
    KlipperHandler handler;
  };
  static constexpr Modelled modelled[] = {
      {"ACTIVATE_EXTRUDER", &Reader::klipper_extruder},
      {"EXCLUDE_OBJECT_END", &Reader::klipper_object_end},
      {"EXCLUDE_OBJECT_START", &Reader::klipper_object},
      {"FORCE_MOVE", &Reader::klipper_forced},
      {"RESTORE_GCODE_STATE", &Reader::klipper_restore},
      {"SAVE_GCODE_STATE", &Reader::klipper_save},
      {"SET_GCODE_OFFSET", &Reader::klipper_offset},
      {"SET_KINEMATIC_POSITION", &Reader::klipper_forced},
      {"SET_SKEW", &Reader::klipper_skew},
      {"SET_TMC_FIELD", &Reader::klipper_field},
      {"SKEW_PROFILE", &Reader::klipper_skew_profile},
      {"TUNING_TOWER", &Reader::klipper_tower},
      {"UPDATE_DELAYED_GCODE", &Reader::klipper_delayed},
  };
  const char* name_end = p;
  while (name_end < end && (scan::is_letter(*name_end) || scan::is_digit(*name_end) || *name_end == '_')) ++name_end;
  if (static_cast<unsigned char>(*name_end) >= 0x80) {  // Python's upper() may make a letter of it
    problem("not a command");
    return skip_words(p, end);
  }
  std::array<char, 48> upper;
  const auto n = std::min(static_cast<std::size_t>(name_end - p), upper.size());
  std::transform(p, p + n, upper.begin(), scan::upper);
  const std::string_view name(upper.data(), n);
  for (const Modelled& m : modelled)
    if (m.name == name) {
      klipper_command(m.handler, {name_end, static_cast<std::size_t>(end - name_end)});
      return end;
    }
  if (name == "SDCARD_LOOP_BEGIN") lose(stored, nullptr, cause_of(name, "the lines from here are run again", true));
  const auto at = std::lower_bound(harmless_commands.begin(), harmless_commands.end(), name);
  if (at == harmless_commands.end() || *at != name) opaque_command(name);
  return skip_words(p, end);
}

}  // namespace weft::audit
