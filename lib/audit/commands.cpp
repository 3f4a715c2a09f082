// SPDX-License-Identifier: GPL-3.0-or-later
// The table of commands: what each does to the nozzle and to what coordinates mean.
#include "audit/reader.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

namespace weft::audit {
namespace {

/// M-codes that leave the nozzle and the coordinates alone, first and last of each stretch: temperatures, fans, motors,
/// messages, endstops, limits, probes' figures, files' lists, meshes. What is in neither table is a printer's own.
struct Stretch {
  std::int16_t from, to;
};
constexpr std::array harmless{
    Stretch{3, 5},     Stretch{7, 11},    Stretch{17, 18},   Stretch{20, 22},   Stretch{27, 27},   Stretch{31, 31},
    Stretch{34, 34},   Stretch{42, 44},   Stretch{47, 47},   Stretch{70, 78},   Stretch{80, 81},   Stretch{84, 87},
    Stretch{100, 110}, Stretch{112, 114}, Stretch{116, 116}, Stretch{119, 119}, Stretch{122, 124}, Stretch{126, 127},
    Stretch{130, 136}, Stretch{140, 155}, Stretch{160, 166}, Stretch{190, 194}, Stretch{201, 205}, Stretch{209, 217},
    Stretch{219, 225}, Stretch{231, 233}, Stretch{240, 243}, Stretch{250, 262}, Stretch{280, 283}, Stretch{300, 305},
    Stretch{309, 309}, Stretch{351, 355}, Stretch{374, 381}, Stretch{400, 400}, Stretch{403, 415}, Stretch{420, 423},
    Stretch{425, 425}, Stretch{430, 431}, Stretch{438, 438}, Stretch{450, 453}, Stretch{493, 493}, Stretch{500, 500},
    Stretch{503, 505}, Stretch{510, 512}, Stretch{540, 549}, Stretch{551, 551}, Stretch{553, 555}, Stretch{557, 558},
    Stretch{561, 562}, Stretch{564, 568}, Stretch{570, 578}, Stretch{580, 580}, Stretch{582, 583}, Stretch{586, 586},
    Stretch{588, 599}, Stretch{603, 604}, Stretch{606, 607}, Stretch{610, 610}, Stretch{624, 625}, Stretch{672, 672},
    Stretch{703, 703}, Stretch{710, 710}, Stretch{752, 756}, Stretch{855, 861}, Stretch{863, 879}, Stretch{900, 927},
    Stretch{930, 930}, Stretch{951, 951}, Stretch{960, 969}, Stretch{972, 973}, Stretch{975, 984}, Stretch{990, 999},
};
static_assert(std::is_sorted(harmless.begin(), harmless.end(),
                             [](const Stretch& a, const Stretch& b) { return a.to < b.from; }));

constexpr std::string_view opaque_text =
    "opaque: named in the verdict; coordinates keep their meaning, the nozzle is "
    "where the profile says, or somewhere in the reach";
constexpr std::string_view waits_text = "named in the verdict; the nozzle waits where it is";
constexpr std::string_view motion_text = "judged by its true extent";
constexpr std::string_view lost_text = "moves from here on are not audited";

}  // namespace

struct Reader::Table {
  using R = Reader;
  static constexpr auto strict = Reading::strict, lenient = Reading::lenient, text = Reading::text;
  // letter, number, second number, reading, handler, why it loses, what the table says
  static constexpr Command rows[] = {
      {'G', 4, -1, lenient, nullptr, {}, {}},
      {'G',
       5,
       any_sub,
       strict,
       &R::bezier,
       {},
       "splines: cut into chords within 0.001 mm and judged; those that go on "
       "from the one before, and G5.2, are not audited"},
      {'G', 7, -1, lenient, &R::lose_scaled, "it counts X twice", "not audited until G8"},
      {'G', 8, -1, lenient, &R::regain_scaled, {}, "ends G7"},
      {'G',
       10,
       any_sub,
       lenient,
       &R::retract,
       {},
       "retraction, with the lift of M207 Z judged; L2, L20: workspace, "
       "followed for RepRapFirmware and Smoothie, else not audited; P X Y Z: "
       "as M218"},
      {'G', 11, any_sub, lenient, &R::unretract, {}, "ends G10's lift"},
      {'G', 15, -1, lenient, &R::regain_scaled, {}, "ends G16"},
      {'G', 16, -1, lenient, &R::lose_scaled, "coordinates are polar", "not audited until G15"},
      {'G', 17, -1, lenient, &R::plane, {}, "plane of arcs"},
      {'G', 18, -1, lenient, &R::plane, {}, "plane of arcs: X and Z; judged as curves"},
      {'G', 19, -1, lenient, &R::plane, {}, "plane of arcs: Y and Z; judged as curves"},
      {'G', 20, -1, lenient, &R::units, {}, "inches"},
      {'G', 21, -1, lenient, &R::units, {}, "millimetres"},
      {'G',
       28,
       any_sub,
       lenient,
       &R::home,
       {},
       "the nozzle is at home_position and home_z, or somewhere in the reach; "
       "takes G92 back, keeps SET_GCODE_OFFSET and workspaces"},
      {'G', 29, any_sub, lenient, &R::probe_bed, {}, opaque_text},
      {'G', 40, -1, lenient, nullptr, {}, {}},
      {'G', 43, any_sub, lenient, &R::lose_length, "it applies a tool's length", "Z is not audited until G49"},
      {'G', 49, -1, lenient, &R::regain_length, {}, "ends G43"},
      {'G', 50, -1, lenient, &R::regain_scaled, {}, "ends G51"},
      {'G', 51, any_sub, lenient, &R::lose_scaled, "it scales the coordinates", "not audited until G50"},
      {'G', 52, any_sub, lenient, &R::lose_stored, "it moves the origin", lost_text},
      {'G',
       53,
       -1,
       lenient,
       &R::machine_coordinates,
       {},
       "the next words are machine coordinates: followed where the "
       "firmware knows it, else not audited if any offset is set"},
      {'G', 54, any_sub, lenient, &R::select_workspace, {}, "workspace: zero, or as G10 L2, L20 said"},
      {'G', 55, any_sub, lenient, &R::select_workspace, {}, "workspace: as G10 L2, L20 said, else not audited"},
      {'G', 56, any_sub, lenient, &R::select_workspace, {}, "as G55"},
      {'G', 57, any_sub, lenient, &R::select_workspace, {}, "as G55"},
      {'G', 58, any_sub, lenient, &R::select_workspace, {}, "as G55"},
      {'G', 59, any_sub, lenient, &R::select_workspace, {}, "as G55, with G59.1 to G59.3"},
      {'G', 60, any_sub, lenient, nullptr, {}, {}},
      {'G', 64, any_sub, lenient, nullptr, {}, {}},
      {'G', 68, any_sub, lenient, &R::lose_turned, {}, "X and Y are not audited until G69"},
      {'G', 69, any_sub, lenient, &R::regain_turned, {}, "ends G68"},
      {'G', 90, -1, lenient, &R::distance_mode, {}, "absolute"},
      {'G',
       90,
       any_sub,
       lenient,
       &R::centre_mode,
       {},
       "I and J absolute, where the firmware knows it; else not audited "
       "until G90 or G91"},
      {'G', 91, -1, lenient, &R::distance_mode, {}, "relative"},
      {'G', 91, any_sub, lenient, &R::centre_mode, {}, "I and J relative; as G90.1"},
      {'G',
       92,
       -1,
       strict,
       &R::set_position,
       {},
       "followed; at a place that is not known: not audited until it is homed"},
      {'G',
       92,
       any_sub,
       lenient,
       &R::reset_position,
       {},
       "takes G92 back, where the firmware knows it; else not audited "
       "until it is homed"},
      {'G', 93, -1, lenient, nullptr, {}, {}},
      {'G', 94, -1, lenient, nullptr, {}, {}},
      {'G', 95, -1, lenient, nullptr, {}, {}},
      {'G', 97, -1, lenient, nullptr, {}, {}},
      {'M', 0, any_sub, text, &R::waits, {}, waits_text, false},
      {'M', 1, any_sub, text, &R::waits, {}, waits_text, false},
      {'M', 16, any_sub, text, nullptr, {}, {}},
      {'M', 28, any_sub, text, &R::lose_stored, "what follows is written to a file", lost_text},
      {'M', 29, any_sub, text, &R::opaque_code, {}, opaque_text},
      {'M', 30, any_sub, text, nullptr, {}, {}},
      {'M', 33, any_sub, text, nullptr, {}, {}},
      {'M', 36, any_sub, text, nullptr, {}, {}},
      {'M', 38, any_sub, text, nullptr, {}, {}},
      {'M', 82, -1, lenient, &R::extruder_mode, {}, "E absolute", false},
      {'M', 83, -1, lenient, &R::extruder_mode, {}, "E relative", false},
      {'M', 92, any_sub, lenient, &R::lose_axes_named, "it changes the steps of a millimetre",
       "the axes that it names are not audited; E alone: nothing"},
      {'M', 111, any_sub, text, nullptr, {}, {}},
      {'M', 115, any_sub, text, nullptr, {}, {}},
      {'M', 117, any_sub, text, nullptr, {}, {}},
      {'M', 118, any_sub, text, nullptr, {}, {}},
      {'M', 120, any_sub, lenient, &R::push_state, {}, "RepRapFirmware puts modes aside"},
      {'M', 121, any_sub, lenient, &R::push_state, {}, "RepRapFirmware takes them back"},
      {'M', 200, any_sub, lenient, &R::volumetric, {}, "E in cubic millimetres", false},
      {'M', 206, any_sub, lenient, &R::lose_given, "it moves the origin that the firmware keeps",
       "the axes that it names are not audited"},
      {'M', 207, any_sub, lenient, &R::retract_lift, {}, "Z: the lift of G10", false},
      {'M', 208, any_sub, lenient, &R::lose_in_reprapfirmware, "it says where homing leaves the axes",
       "RepRapFirmware: the axes that it names are not audited"},
      {'M',
       218,
       any_sub,
       lenient,
       &R::tool_offset,
       {},
       "a tool's offset: not audited while that tool is used, but zero"},
      {'M', 290, any_sub, lenient, &R::babystep, {}, "judged as a move; coordinates go along"},
      {'M', 291, any_sub, text, nullptr, {}, {}},
      {'M', 350, any_sub, lenient, &R::lose_axes_named, "it changes the steps of a millimetre", "as M92"},
      {'M', 428, any_sub, lenient, &R::lose_stored, "it moves the origin that the firmware keeps", lost_text},
      {'M', 486, any_sub, text, &R::label_object, {}, "the object that follows", false},
      {'M', 502, any_sub, lenient, &R::lose_stored, "it takes back what the printer was told for good", lost_text},
      {'M', 550, any_sub, text, nullptr, {}, {}},
      {'M', 552, any_sub, text, nullptr, {}, {}},
      {'M', 556, any_sub, lenient, &R::lose_axes_named, "it skews the axes", "the axes that it names are not audited"},
      {'M', 559, any_sub, text, &R::lose_stored, "what follows is written to a file", lost_text},
      {'M', 560, any_sub, text, &R::lose_stored, "what follows is written to a file", lost_text},
      {'M', 563, any_sub, lenient, &R::lose_axes_named, "it gives a tool other axes", "as M92"},
      {'M', 569, any_sub, lenient, &R::lose_in_reprapfirmware, "it turns motors round",
       "RepRapFirmware: moves from here on are not audited"},
      {'M', 579, any_sub, lenient, &R::lose_axes_named, "it scales the axes", "as M92"},
      {'M', 581, any_sub, text, nullptr, {}, {}},
      {'M', 584, any_sub, lenient, &R::lose_axes_named, "it gives the axes other motors", "as M92"},
      {'M', 585, any_sub, lenient, &R::lose_stored, "it probes where a tool's nozzle stands", lost_text},
      {'M', 587, any_sub, text, nullptr, {}, {}},
      {'M', 605, any_sub, lenient, &R::two_carriages, {}, "opaque; S2, S3: moves are not audited"},
      {'M', 665, any_sub, lenient, &R::lose_stored, "it changes the machine's geometry", lost_text},
      {'M', 666, any_sub, lenient, &R::lose_stored, "it changes the machine's geometry", lost_text},
      {'M', 669, any_sub, lenient, &R::lose_stored, "it changes the machine's geometry", lost_text},
      {'M', 808, any_sub, lenient, &R::lose_stored, "the lines from here are run again", lost_text},
      {'M', 852, any_sub, lenient, &R::lose_given, "it skews the axes", lost_text},
      {'M', 862, any_sub, text, nullptr, {}, {}},
      {'M', 928, any_sub, text, nullptr, {}, {}},
      {'M', 929, any_sub, text, nullptr, {}, {}},
      {'M', 1002, any_sub, text, nullptr, {}, {}},
      {'M', 1006, any_sub, text, nullptr, {}, {}},
  };
};

std::span<const Reader::Command> Reader::commands() {
  static_assert(std::is_sorted(std::begin(Table::rows), std::end(Table::rows), [](const Command& p, const Command& q) {
    return std::tuple(p.letter, p.number, p.sub == any_sub) < std::tuple(q.letter, q.number, q.sub == any_sub);
  }));
  return Table::rows;
}

const Reader::Command* Reader::find_command(char letter, int number, int sub) {
  static constexpr Command tool{'T', 0, any_sub, Reading::lenient, &Reader::tool_change, {}, {}};
  static constexpr Command nothing_moves{'M', 0, any_sub, Reading::lenient, nullptr, {}, {}};
  static constexpr Command unknown_file{'M', 0, any_sub, Reading::text, &Reader::opaque_code, {}, {}};
  static constexpr Command slot{'M', 0, any_sub, Reading::text, &Reader::keep_commands, {}, {}};
  if (letter == 'T') return &tool;
  const auto rows = commands();
  const auto key = std::tuple(letter, static_cast<std::int16_t>(number));
  for (auto at = std::lower_bound(rows.begin(), rows.end(), key,
                                  [](const Command&c, const auto&k) { return std::tuple(c.letter, c.number) < k; });
       at != rows.end() && at->letter == letter && at->number == number; ++at)
    if (at->sub == any_sub || at->sub == sub) return &*at;
  if (letter != 'M') return nullptr;
  if (number >= 810 && number <= 819) return &slot;
  if (number == 23 || number == 32 || number == 98) return &unknown_file;  // the name of a file, which is run
  const auto stretch =
      std::lower_bound(harmless.begin(), harmless.end(), number, [](const Stretch& s, int n) { return s.to < n; });
  return stretch != harmless.end() && stretch->from <= number ? &nothing_moves : nullptr;
}

std::vector<Reader::Meaning> Reader::meanings() {
  std::vector<Meaning> out{
      {"G0, G1", motion_text},
      {"G2, G3",
       "arcs by I J K or R, full circles, several turns (P), helices, in every plane: judged by their true extent"},
  };
  for (const Command& c : commands())
    if (c.handler && !c.what.empty())
      out.push_back({fmt::format("{}{}{}", c.letter, c.number,
                                 c.letter == 'G' && (c.number == 90 || c.number == 91) && c.sub == any_sub ? ".1"
                                 : c.letter == 'G' && c.number == 92 && c.sub == any_sub                   ? ".1, G92.2"
                                                                                                           : ""),
                     c.what});
  static constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"M23, M24, M32, M98", opaque_text},
      {"M25, M125, M226, M600, M601, M602, M701, M702", opaque_text},
      {"M810 … M819", "with commands behind it: moves are not audited; alone: opaque"},
      {"T", "another tool than the one in use: opaque; its nozzle stands as nozzle_offsets say"},
      {"P", "a tool changer parks a tool: opaque"},
      {"other G", opaque_text},
      {"other M", "temperatures, fans, motors, messages and the like: nothing; what is not known: opaque"},
      {"SET_GCODE_OFFSET", "followed, read as Klipper reads it; MOVE=1 is judged as a move"},
      {"SAVE_GCODE_STATE, RESTORE_GCODE_STATE",
       "followed; MOVE=1 is judged as a move; a state that was not "
       "saved in the file: moves are not audited"},
      {"SET_KINEMATIC_POSITION, FORCE_MOVE", "not audited until it is homed"},
      {"SET_TMC_FIELD", "mres, shaft: moves are not audited; other fields: nothing"},
      {"TUNING_TOWER", "of a command that leaves the nozzle alone: nothing; else moves are not audited"},
      {"SET_SKEW", "CLEAR=1: nothing; else moves are not audited"},
      {"ACTIVATE_EXTRUDER", "the tool in use"},
      {"UPDATE_DELAYED_GCODE", "DURATION=0: nothing; else opaque"},
      {"other words", "Klipper's own that leave the nozzle alone: nothing; else a printer's macro: opaque"},
      {"@…", "commands to OctoPrint: named in the verdict, nothing else"},
  };
  for (const auto& [command, what] : others) out.push_back({std::string(command), what});
  return out;
}

}  // namespace weft::audit
