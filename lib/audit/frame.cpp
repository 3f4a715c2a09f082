// SPDX-License-Identifier: GPL-3.0-or-later
// What commands other than moves do to where the next move goes.
#include "audit/reader.h"
#include "audit/scan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace weft::audit {
namespace {

constexpr char axis_letters[] = {'X', 'Y', 'Z'};
constexpr double mm_per_inch = 25.4;

}  // namespace

/// The number of a cause, kept once per command; the last stands for all that do not fit.
std::int16_t Reader::cause_of(std::string_view command, std::string_view why, bool frame) {
  constexpr std::size_t most_causes = 64;
  for (std::size_t i = 0; i < causes_.size(); ++i)
    if (causes_[i].command == command && causes_[i].why == why && causes_[i].frame == frame)
      return static_cast<std::int16_t>(i);
  if (causes_.size() < most_causes) causes_.push_back({std::string(command), why, line_number_, frame});
  return static_cast<std::int16_t>(causes_.size() - 1);
}

/// Why what is written along an axis no longer says where it leads; −1: it does.
std::int16_t Reader::frame_lost(std::size_t axis) const {
  if (state_.shift_lost[axis] >= 0) return state_.shift_lost[axis];
  for (const auto& axes : lost_)
    if (axes[axis] >= 0) return axes[axis];
  return -1;
}

/// The named axes, or all, mean from now on what the firmware keeps to itself.
void Reader::lose(Source source, const Words* axes, std::int16_t cause) {
  const bool all = !axes || (!axes->names('X') && !axes->names('Y') && !axes->names('Z'));
  for (std::size_t i = 0; i < 3; ++i)
    if (all || axes->names(axis_letters[i])) lost_[source][i] = cause, frame_known_[i] = false;
}

void Reader::regain(Source source) {
  lost_[source].fill(-1);
  for (std::size_t i = 0; i < 3; ++i) frame_known_[i] = frame_lost(i) < 0;
}

/// What is written means a place that is further on from now on; the nozzle stays.
void Reader::shift(std::size_t axis, double by_mm) {
  state_.offset[axis] += by_mm;
}

void Reader::forget_position(std::int16_t cause, Known as) {
  state_.known.fill(as);
  state_.cause.fill(cause);
}

void Reader::list_opaque(std::string_view name) {
  constexpr std::size_t most_names = 64;
  ++opaque_count_;
  for (auto& o : opaque_)
    if (o.name == name) return void(++o.count);
  if (opaque_.size() < most_names) opaque_.push_back({std::string(name), 1, line_number_});
}

/// A command that only the printer knows: it keeps what coordinates mean, and leaves the nozzle where the profile says,
/// or somewhere.
void Reader::opaque_command(std::string_view name) {
  list_opaque(name);
  forget_position(cause_of(name, "only the printer knows where it leaves the nozzle", false));
  if (machine_.after_macro) {
    state_.position[x] = machine_.after_macro->x, state_.position[y] = machine_.after_macro->y;
    state_.known[x] = state_.known[y] = Known::yes;
  }
  if (machine_.after_macro_z) state_.position[z] = *machine_.after_macro_z, state_.known[z] = Known::yes;
}

void Reader::opaque_code(const Call& c) {
  opaque_command(c.sub < 0 ? fmt::format("{}{}", c.letter, c.number)
                           : fmt::format("{}{}.{}", c.letter, c.number, c.sub));
}

/// M0, M1: a person is asked for something.
void Reader::waits(const Call& c) {
  list_opaque(fmt::format("M{}", c.number));
}

void Reader::retract(const Call& c) {
  const Words& w = c.words;
  if (w.has('L')) return coordinate_data(c);
  if (w.has('P') || w.names('X') || w.names('Y') || w.names('Z')) return tool_offset(c);
  if (retracted_ || w.has('S') || w.has('R') || retract_lift_mm_ == 0) return void(retracted_ = true);
  retracted_ = true;
  move_straight_to(state_.position, state_.known, state_.cause);
}

void Reader::unretract(const Call&) {
  retracted_ = false;
}

/// M207 Z: so far G10 lifts the nozzle. Repetier's M207 is about jerk.
void Reader::retract_lift(const Call& c) {
  if (machine_.firmware != Firmware::repetier && c.words.has('Z')) retract_lift_mm_ = c.words['Z'];
}

void Reader::plane(const Call& c) {
  plane_ = c.number;
}

void Reader::units(const Call& c) {
  if (c.number == 20 && is_klipper()) problem("inches, which this firmware refuses");
  state_.inches = c.number == 20;
  const char* const behind = c.text.data() + c.text.size();
  const std::string_view comment(behind, static_cast<std::size_t>(line_end_ - behind));
  if (c.number == 21 && comment.find("set units to millimeters") != std::string_view::npos)
    context_.begin();  // PrusaSlicer and Slic3r write it behind the start G-code
}

void Reader::home(const Call& c) {
  const Words& w = c.words;
  if (c.sub >= 0) return opaque_code(c);  // Bambu: calibrations about homing
  state_.homed = true;
  const auto cause = cause_of("G28", "home_position does not say where it leaves the nozzle", false);
  const bool all = !w.names('X') && !w.names('Y') && !w.names('Z');
  for (std::size_t i = 0; i < 3; ++i) {
    if (!all && !w.names(axis_letters[i])) continue;
    const bool said = (i == z ? machine_.home_z.has_value() : machine_.home.has_value()) && !w.names('O');
    state_.known[i] = said ? Known::yes : Known::in_reach;  // O: only if it is not homed yet, so it may also stay
    state_.cause[i] = cause;
    if (said) state_.position[i] = i == x ? machine_.home->x : i == y ? machine_.home->y : *machine_.home_z;
    // Klipper keeps its own offset when it homes, and firmwares with workspaces keep these.
    state_.offset[i] = state_.homing_offset[i] + workspaces_[workspace_][i];
    state_.shift_lost[i] = -1;
    frame_known_[i] = frame_lost(i) < 0;
  }
}

/// G53: the next words are machine coordinates. RepRapFirmware sets these, too, by G92; builds of Marlin and Klipper
/// that do not know G53 pass over the line.
void Reader::machine_coordinates(const Call&) {
  const bool plain = std::all_of(state_.offset.begin(), state_.offset.end(), [](double v) { return v == 0; }) &&
                     frame_known_[x] && frame_known_[y] && frame_known_[z];
  if (plain) return;
  if (machine_.firmware == Firmware::smoothie ||
      (machine_.firmware == Firmware::reprapfirmware && state_.offset == workspaces_[workspace_]))
    machine_coordinates_ = true;
  else
    lose(stored, nullptr, cause_of("G53", "not every build of the firmware knows it", true));
}

void Reader::distance_mode(const Call& c) {
  state_.relative = c.number == 91;
  mode_cause_ = -1;
}

/// G90.1, G91.1: whether I and J are counted from the start of the arc. Builds of Marlin and Repetier that do not read
/// the second number take it for G90 and G91.
void Reader::centre_mode(const Call& c) {
  if (c.sub != 1) return opaque_code(c);
  if (is_klipper()) return;
  if (has_workspaces())
    state_.absolute_centre = c.number == 90;
  else
    mode_cause_ = cause_of(fmt::format("G{}.1", c.number), "some builds of the firmware take it for G90 or G91", true);
}

void Reader::set_position(const Call& c) {
  const Words& w = c.words;
  const double unit_mm = state_.inches ? mm_per_inch : 1.0;
  const bool any = w.has('X') || w.has('Y') || w.has('Z') || w.has('E');
  const bool all_to_zero = is_klipper() && !any;  // whatever other words there are
  if (w.has('E')) state_.e = w['E'] * unit_mm;
  if (all_to_zero) state_.e = 0;
  const auto cause = w.seen == 0 && !all_to_zero
                         ? cause_of("G92", "without an axis some firmwares set all to zero and others none", true)
                         : cause_of("G92", "it was given at a place that is not known", true);
  for (std::size_t i = 0; i < 3; ++i) {
    if (w.seen != 0 && !w.has(axis_letters[i]) && !all_to_zero) continue;
    const bool known = (w.seen != 0 || all_to_zero) && state_.known[i] == Known::yes;
    state_.shift_lost[i] = known ? std::int16_t{-1} : cause;
    if (known) state_.offset[i] = state_.position[i] - (all_to_zero ? 0 : w[axis_letters[i]] * unit_mm);
    frame_known_[i] = frame_lost(i) < 0;
  }
}

/// G92.1, G92.2: takes G92 back. Firmwares that do not know the second number do something else.
void Reader::reset_position(const Call& c) {
  const bool shifted = state_.offset != workspaces_[workspace_] || state_.shift_lost != State{}.shift_lost;
  if (!shifted || is_klipper()) return;
  const bool taken_back = machine_.firmware == Firmware::smoothie && c.sub <= 2;
  const auto cause = cause_of(fmt::format("G92.{}", c.sub), "not every build of the firmware knows it", true);
  for (std::size_t i = 0; i < 3; ++i) {
    state_.shift_lost[i] = taken_back ? std::int16_t{-1} : cause;
    if (taken_back) state_.offset[i] = workspaces_[workspace_][i];
    frame_known_[i] = frame_lost(i) < 0;
  }
}

/// G54 … G59.3. Where they are is known as far as this file said so by G10 L2 or L20; of G54 it is taken for zero.
void Reader::select_workspace(const Call& c) {
  const std::size_t to =
      c.number < 59 ? static_cast<std::size_t>(c.number - 53) : 6 + static_cast<std::size_t>(std::clamp(c.sub, 0, 3));
  if (to == workspace_ && lost_[workspace][x] < 0) return;
  if (!has_workspaces() && to != 1)
    return lose(workspace, nullptr,
                cause_of(fmt::format("G{}", c.number), "where the workspace is only the printer knows", true));
  if (!has_workspaces() && lost_[workspace][x] < 0) return;  // G54, as it is
  const auto cause = cause_of(fmt::format("G{}", c.number), "where the workspace is only the printer knows", true);
  for (std::size_t i = 0; i < 3; ++i) {
    lost_[workspace][i] = workspace_known_[to][i] ? std::int16_t{-1} : cause;
    shift(i, workspaces_[to][i] - workspaces_[workspace_][i]);
    frame_known_[i] = frame_lost(i) < 0;
  }
  workspace_ = to;
}

/// G10 L2: where a workspace is; G10 L20: such that the nozzle stands at what is given. Only firmwares with workspaces
/// obey; others take it for a retraction.
void Reader::coordinate_data(const Call& c) {
  const Words& w = c.words;
  if (w['L'] != 2 && w['L'] != 20) return tool_offset(c);
  const auto cause =
      cause_of(fmt::format("G10 L{:g}", w['L']), "it moves a workspace in ways that are not followed", true);
  const double unit_mm = state_.inches ? mm_per_inch : 1.0;
  const double named = w.has('P') ? w['P'] : 0;
  const std::size_t of = named >= 1 && named <= 9 ? static_cast<std::size_t>(named) : workspace_;
  if (!has_workspaces()) return lose(stored, &w, cause);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!w.has(axis_letters[i])) continue;
    const double v = w[axis_letters[i]] * unit_mm, old = workspaces_[of][i];
    const bool known = w['L'] == 2 || state_.known[i] == Known::yes;
    workspace_known_[of][i] = known;
    workspaces_[of][i] = known ? (w['L'] == 2 ? v : state_.position[i] - v) : 0;
    if (of != workspace_) continue;
    shift(i, workspaces_[of][i] - old);
    lost_[workspace][i] = known ? std::int16_t{-1} : cause;
    frame_known_[i] = frame_lost(i) < 0;
  }
}

void Reader::extruder_mode(const Call& c) {
  state_.e_relative = c.number == 83;
}

void Reader::volumetric(const Call& c) {
  if (c.words.has('D')) volumetric_ = c.words['D'] > 0;
}

/// M120, M121 of RepRapFirmware: puts the modes aside and takes them back.
void Reader::push_state(const Call& c) {
  constexpr std::size_t deepest = 32;
  if (machine_.firmware != Firmware::reprapfirmware) return;
  if (c.number == 120) {
    if (pushed_.size() < deepest) pushed_.push_back(state_);
    return;
  }
  if (pushed_.empty()) return;
  state_.relative = pushed_.back().relative;
  state_.e_relative = pushed_.back().e_relative;
  state_.inches = pushed_.back().inches;
  pushed_.pop_back();
}

/// M290: the nozzle goes on by so much, and what is written means that place.
void Reader::babystep(const Call& c) {
  const Words& w = c.words;
  if (w.has('R') && w['R'] == 0)
    return lose(stored, nullptr, cause_of("M290", "it is counted from what the printer was last told", true));
  const double unit_mm = state_.inches ? mm_per_inch : 1.0;
  auto to = state_.position;
  bool moved = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = i == z && !w.has('Z') ? 'S' : axis_letters[i];
    if (!w.has(letter) || w[letter] == 0) continue;
    shift(i, w[letter] * unit_mm);
    to[i] += w[letter] * unit_mm;
    moved = true;
  }
  if (moved) step_to(to);
}

/// M218, G10 P: where the nozzle of a tool stands from the others, which the firmware then allows for.
void Reader::tool_offset(const Call& c) {
  const Words& w = c.words;
  const char letter = c.letter == 'M' ? 'T' : 'P';
  const int tool = w.has(letter) ? static_cast<int>(std::clamp(w[letter], 0.0, 63.0)) : tool_;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!w.names(axis_letters[i])) continue;
    const std::uint64_t bit = std::uint64_t{1} << tool;
    const bool zero = w.has(axis_letters[i]) && w[axis_letters[i]] == 0;
    tools_lost_[i] = zero ? tools_lost_[i] & ~bit : tools_lost_[i] | bit;
    if (!zero)
      tools_cause_ = cause_of(c.letter == 'M' ? "M218" : "G10 P", "it moves a tool's nozzle against the others", true);
  }
  take_tool_offsets();
}

/// The tool in use brings its offset along.
void Reader::take_tool_offsets() {
  for (std::size_t i = 0; i < 3; ++i) {
    const bool lost = (tools_lost_[i] >> std::clamp(tool_, 0, 63)) & 1U;
    lost_[by_tool][i] = lost ? tools_cause_ : std::int16_t{-1};
    frame_known_[i] = frame_lost(i) < 0;
  }
}

/// T: another tool is fetched, which only the printer knows how to do. The tool in use again: nothing.
void Reader::tool_change(const Call& c) {
  if (c.number == tool_ && tool_taken_) return;
  tool_ = c.number;
  tool_taken_ = true;
  opaque_command(fmt::format("T{}", c.number));
  take_tool_offsets();
}

/// M486 S2: the object that follows; S-1: none. M486 A"bracket": its name, also where its number comes again.
void Reader::label_object(const Call& c) {
  constexpr std::size_t most_names = 4096;
  const std::string_view text = c.text;
  if (const auto s = text.find('S'); s != std::string_view::npos && s < text.find('A')) {
    auto id = text.substr(s + 1);
    id = id.substr(0, id.find_first_of(" \t\r;*"));
    object_id_ = id.starts_with("-") ? std::string_view{} : id;
    const auto known = object_names_.find(id);
    context_.set_object(known == object_names_.end() ? std::string_view(object_id_) : std::string_view(known->second));
  }
  if (const auto at = text.find('A'); at != std::string_view::npos) {
    auto name = text.substr(at + 1);
    if (name.starts_with('"')) name = name.substr(1, name.find('"', 1) - 1);
    if (!object_id_.empty() && (object_names_.size() < most_names || object_names_.contains(object_id_)))
      object_names_[object_id_] = name;
    context_.set_object(name);
  }
}

/// Changes what coordinates mean for good.
void Reader::lose_stored(const Call& c) {
  lose(stored, nullptr,
       cause_of(fmt::format("{}{}", c.letter, c.number), find_command(c.letter, c.number, c.sub)->why, true));
}

/// The same, along the axes that it names, if it names any.
void Reader::lose_axes_named(const Call& c) {
  if (c.words.names('X') || c.words.names('Y') || c.words.names('Z'))
    lose(stored, &c.words, cause_of(fmt::format("M{}", c.number), find_command(c.letter, c.number, c.sub)->why, true));
}

/// The same, along the axes that it names or all of them, if it says anything; without words it only tells.
void Reader::lose_given(const Call& c) {
  if (c.words.seen != 0)
    lose(stored, &c.words, cause_of(fmt::format("M{}", c.number), find_command(c.letter, c.number, c.sub)->why, true));
}

/// What RepRapFirmware alone takes for a matter of the axes.
void Reader::lose_in_reprapfirmware(const Call& c) {
  if (machine_.firmware == Firmware::reprapfirmware) lose_given(c);
}

/// M810 … M819: Marlin keeps the commands behind it for when it comes alone.
void Reader::keep_commands(const Call& c) {
  if (c.text.find_first_not_of(" \t\r") == std::string_view::npos) return opaque_code(c);
  lose(stored, nullptr, cause_of(fmt::format("M{}", c.number), "it keeps commands that are run elsewhere", true));
}

/// G43: Z is the tip of a tool whose length only the printer knows.
void Reader::lose_length(const Call& c) {
  Words height{};
  height.seen = 1U << ('Z' - 'A');
  lose(by_length, &height, cause_of("G43", find_command('G', c.number, c.sub)->why, true));
}

void Reader::regain_length(const Call&) {
  regain(by_length);
}

/// G29. Bambu's G29.1 trims Z by what the plate asks for, G29.2 switches the mesh.
void Reader::probe_bed(const Call& c) {
  if (c.sub < 0) opaque_code(c);
}

void Reader::lose_turned(const Call& c) {
  Words both{};
  both.seen = 1U << ('X' - 'A') | 1U << ('Y' - 'A');
  lose(turned, &both, cause_of(fmt::format("G{}", c.number), "it turns the coordinates", true));
}

void Reader::regain_turned(const Call&) {
  regain(turned);
}

void Reader::lose_scaled(const Call& c) {
  lose(scaled, nullptr, cause_of(fmt::format("G{}", c.number), find_command('G', c.number, c.sub)->why, true));
}

void Reader::regain_scaled(const Call&) {
  regain(scaled);
}

/// M605: S2 and S3 make a second carriage repeat what the first does, elsewhere.
void Reader::two_carriages(const Call& c) {
  opaque_code(c);
  if (c.words.has('S') && c.words['S'] >= 2)
    lose(stored, nullptr, cause_of("M605", "a second carriage repeats the moves elsewhere", true));
}

}  // namespace weft::audit
