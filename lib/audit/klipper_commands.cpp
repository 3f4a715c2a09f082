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
    "SET_SKEW"sv,
    "SET_STEPPER_ENABLE"sv,
    "SET_TEMPERATURE_FAN_TARGET"sv,
    "SET_TMC_CURRENT"sv,
    "SET_TMC_FIELD"sv,
    "SET_VELOCITY_LIMIT"sv,
    "SKEW_PROFILE"sv,
    "STATUS"sv,
    "TEMPERATURE_WAIT"sv,
    "TURN_OFF_HEATERS"sv,
    "UPDATE_DELAYED_GCODE"sv,
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
  if (!v) problem("an argument that is no number"), forget_position();
  return v.value_or(0) != 0;
}

/// A straight way to a place in machine coordinates that a command, not a move, asks for.
void Reader::move_straight_to(const std::array<double, 3>& to, const std::array<bool, 3>& known) {
  Motion& m = begin_motion(to, known);
  m.kind = m.z_known && state_.known[z] && m.z_to > m.z_from ? Motion::Kind::lift : Motion::Kind::travel;
  state_.position = to;
  state_.known = known;
}

/// SET_GCODE_OFFSET: what is written means another place from now on; the nozzle stays, unless MOVE=1.
void Reader::klipper_offset(const Arguments& arguments) {
  static constexpr std::string_view axes[] = {"X", "Y", "Z", "E"},
                                    steps[] = {"X_ADJUST", "Y_ADJUST", "Z_ADJUST", "E_ADJUST"};
  std::array<double, 3> to = state_.position;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto* const whole = find(arguments, axes[i]);
    const auto* const step = whole ? nullptr : find(arguments, steps[i]);
    if (!whole && !step) continue;
    const auto v = klipper_number(whole ? *whole : *step);
    double& old = i < 3 ? state_.homing_offset[i] : state_.homing_e;
    const double wanted = v.value_or(0) + (whole ? 0 : old), by = wanted - old;
    if (i == 3) {
      state_.e -= v ? by : 0;
    } else if (!v || !(std::abs(wanted) <= scan::furthest_mm)) {
      if (v) problem("a number beyond any machine");
      offset_lost_[i] = true, state_.offset_known[i] = false;
      continue;
    } else {
      state_.offset[i] += by;
      to[i] += by;
    }
    if (v) old = wanted;
  }
  if (klipper_moves(arguments)) move_straight_to(to, state_.known);
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
    lose_offsets({});
    return opaque_command("RESTORE_GCODE_STATE");
  }
  const State now = std::exchange(state_, at->second);
  const State& then = at->second;
  state_.position = now.position, state_.known = now.known, state_.homed = now.homed;
  for (std::size_t i = 0; i < 3; ++i) state_.offset_known[i] = then.offset_known[i] && !offset_lost_[i];
  if (klipper_moves(arguments)) move_straight_to(then.position, then.known);
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
  lose_offsets({});
  forget_position();
}

/// "extruder" is the first tool, "extruder1" the one with that number; what else it is called tells none.
void Reader::klipper_activate(const Arguments& arguments) {
  constexpr std::string_view first = "extruder";
  const auto* const found = find(arguments, "EXTRUDER");
  if (!found || !found->starts_with(first)) return;
  const std::string_view name = *found;
  const auto number = klipper::integer_of(name.substr(first.size()));
  if (name == first || number) tool_ = number.value_or(0);
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
      {"ACTIVATE_EXTRUDER", &Reader::klipper_activate},  {"EXCLUDE_OBJECT_END", &Reader::klipper_object_end},
      {"EXCLUDE_OBJECT_START", &Reader::klipper_object}, {"RESTORE_GCODE_STATE", &Reader::klipper_restore},
      {"SAVE_GCODE_STATE", &Reader::klipper_save},       {"SET_GCODE_OFFSET", &Reader::klipper_offset},
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
  const auto at = std::lower_bound(harmless_commands.begin(), harmless_commands.end(), name);
  if (at == harmless_commands.end() || *at != name) opaque_command(name);
  return skip_words(p, end);
}

}  // namespace weft::audit
