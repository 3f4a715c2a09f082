// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/comments.h"
#include "audit/klipper.h"
#include "audit/path.h"
#include "settings/groups/machine.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The audit's own G-code reader: what a line makes the machine do. It shares no code with the writer, allocates
/// nothing per line, and understands G-code from any slicer and from people. `preview` reads through it too.
namespace weft::audit {

/// What is known of a place along one axis.
enum class Known : std::uint8_t {
  yes,
  in_reach,  ///< no number, but the machine is within what it can reach: after homing, after a printer's macro
  no,        ///< it may be anywhere: what was written did not say where it leads
};

/// One motion of the nozzle, in machine coordinates, mm.
struct Motion {
  enum class Kind : std::uint8_t { travel, extrude, arc, lift, lift_slope, lift_spiral };
  Kind kind = Kind::travel;
  bool extrudes = false;    ///< lays filament down along its way
  bool judgeable = true;    ///< false: a curve whose extent this reader does not know
  bool from_known = true;   ///< X and Y of where it starts
  bool from_home = false;   ///< starts where homing left the nozzle
  bool moves_xy = true;     ///< names X or Y, or is a curve
  bool moves_z = false;     ///< names Z
  bool continues = false;   ///< a further piece of the curve whose first piece stands before it
  Known from = Known::yes;  ///< X and Y of where it starts, the lesser known of both
  std::int16_t cause = -1;  ///< Reader::causes(): why not all of it is known; −1: it is
  bool x_known = true, y_known = true, z_known = true;  ///< of where it ends
  Known x = Known::yes, y = Known::yes, z = Known::yes;
  Path path;                    ///< straight from `to` to `to` when only the end is known
  double z_from = 0, z_to = 0;  ///< equal when where it starts is not known
  double e_mm = 0;              ///< filament pushed forward, or drawn back when negative; mm³ when `volumetric`
  bool volumetric = false;
  int tool = 0;
};

/// A line that cannot be read as what it looks like.
struct Problem {
  std::string_view what;  ///< a clause that lives as long as the program
};

/// A command that does what only the printer knows: a macro, a calibration, a tool change.
struct Opaque {
  std::string name;  ///< "G29", "PRINT_START"
  std::int64_t count = 0;
  std::int64_t first_line = 0;
};

/// Why the place of moves is not known.
struct Cause {
  std::string command;    ///< "G68"; empty: the start of the file
  std::string_view why;   ///< "the coordinates are turned", as a clause
  std::int64_t line = 0;  ///< of its first use
  bool frame = false;     ///< what is written means another place; else only where the nozzle was is not known
};

class Reader {
 public:
  /// What the reader must know of the machine.
  struct Machine {
    std::optional<Vec> home{};         ///< where G28 leaves the nozzle, mm; nullopt: somewhere in the reach
    std::optional<double> home_z{};    ///< likewise
    std::optional<Vec> after_macro{};  ///< where macros leave the nozzle
    std::optional<double> after_macro_z{};
    Firmware firmware = Firmware::marlin2;
  };
  explicit Reader(Machine machine);

  /// Reads one line. Pre: *end can be read and is a line feed. Ends at a carriage return count as ends of a line.
  void line(const char* begin, const char* end);

  /// What the last line did. Valid until the next call.
  std::span<const Motion> motions() const { return motions_; }
  std::span<const Problem> problems() const { return problems_; }

  /// Where the nozzle is, from above; nullopt: not known.
  std::optional<Vec> place() const {
    if (state_.known[x] != Known::yes || state_.known[y] != Known::yes) return std::nullopt;
    return Vec{state_.position[x], state_.position[y]};
  }

  const Context& context() const { return context_; }
  std::int64_t line_number() const { return line_number_; }
  /// Filament of all lines so far that moved nothing else: pushed forward, and drawn back. Firmware's own retraction
  /// (G10) is not in it: see retracted().
  double pushed_alone() const { return pushed_alone_; }
  double drawn_alone() const { return drawn_alone_; }
  bool retracted() const { return retracted_; }      ///< by G10
  double speed_mm_s() const { return speed_mm_s_; }  ///< of the last motion, as F asks for it; 0 when it never did
  std::span<const Opaque> opaque() const { return opaque_; }  ///< in order of first use, at most 64 names
  std::int64_t opaque_count() const { return opaque_count_; }
  std::span<const Cause> causes() const { return causes_; }

  /// A line that was dropped because it is too long to be held: counted, nothing else known of it.
  void skip_line() { ++line_number_; }

  /// The table of commands that move the nozzle or change what coordinates mean, and what the audit does with each.
  struct Meaning {
    std::string command;
    std::string_view what;
  };
  static std::vector<Meaning> meanings();

 private:
  enum Axis { x, y, z };
  /// What can take the meaning of coordinates away, each with its own remedy in G-code.
  enum Source { stored, workspace, turned, scaled, by_length, by_tool, sources };
  struct State {
    std::array<double, 3> position{};  ///< machine, mm
    std::array<Known, 3> known{Known::in_reach, Known::in_reach, Known::in_reach};
    std::array<std::int16_t, 3> cause{0, 0, 0};          ///< why it is not known
    std::array<double, 3> offset{};                      ///< machine = written + offset
    std::array<std::int16_t, 3> shift_lost{-1, -1, -1};  ///< by G92 from a place that is not known: the cause
    std::array<double, 3> homing_offset{};               ///< of SET_GCODE_OFFSET, mm: homing keeps it
    double homing_e = 0;
    double e = 0;
    bool homed = false;  ///< no move in X and Y since G28
    bool relative = false, e_relative = false, inches = false, absolute_centre = false;
  };
  /// The words of a command: value['X' - 'A'] where bit 'X' - 'A' of `valued` is set.
  struct Words {
    double value[26];
    std::uint32_t seen = 0, valued = 0;
    bool sound = true;
    bool has(char letter) const { return (valued >> (letter - 'A')) & 1U; }
    bool names(char letter) const { return (seen >> (letter - 'A')) & 1U; }
    double operator[](char letter) const { return value[letter - 'A']; }
  };
  /// A command as it stands in the file.
  struct Call {
    char letter;
    int number, sub;  ///< G92.1: 92 and 1; sub is −1 when there is none
    const Words& words;
    std::string_view text;  ///< behind the number
  };
  using Handler = void (Reader::*)(const Call& call);
  using KlipperHandler = void (Reader::*)(const klipper::Arguments& arguments);
  /// How the words behind a command are read: with nothing else allowed, with anything else passed over, not at all.
  enum class Reading : std::uint8_t { strict, lenient, text };
  struct Command {
    char letter;
    std::int16_t number;
    std::int8_t sub;  ///< −1: without; any_sub: with any or none, unless another row says more
    Reading reading;
    Handler handler;        ///< nullptr: it leaves nozzle and coordinates alone
    std::string_view why;   ///< of what it takes away, as a clause
    std::string_view what;  ///< in the table
    bool frame = true;      ///< it moves or changes what coordinates mean
  };
  static constexpr std::int8_t any_sub = -2;
  struct Table;
  static std::span<const Command> commands();
  static const Command* find_command(char letter, int number, int sub);

  // reader.cpp: bytes to words
  const char* words(const char* p, const char* end, bool strict, Words& out);
  const char* take_word(const char* p, bool strict, Words& out);
  const char* command(const char* p, const char* end);
  const char* odd_command(const char* p, const char* end);
  const char* numbered_command(char letter, const char* p, const char* end);
  bool klipper_knows(const char* digits, const char* behind, const char* end) const;
  const char* motion_line(const char* p, const char* end);
  const char* skip_words(const char* p, const char* end);
  const char* extended_command(const char* p, const char* end);
  void comment(const char* p, const char* end, bool alone);
  void begin_command(bool frame);
  bool obeys_first_only() const;
  bool is_klipper() const { return machine_.firmware == Firmware::klipper; }
  bool is_marlin() const { return machine_.firmware == Firmware::marlin || machine_.firmware == Firmware::marlin2; }
  bool has_workspaces() const {
    return machine_.firmware == Firmware::reprapfirmware || machine_.firmware == Firmware::smoothie;
  }

  // motion.cpp, curves.cpp: words to motions
  void move(const Words& w);
  bool target(const Words& w, std::array<double, 3>& to, std::array<Known, 3>& known,
              std::array<std::int16_t, 3>& cause);
  Motion& begin_motion(const std::array<double, 3>& to, const std::array<Known, 3>& known,
                       const std::array<std::int16_t, 3>& cause);
  void arrive(const std::array<double, 3>& to, const std::array<Known, 3>& known,
              const std::array<std::int16_t, 3>& cause);
  void move_straight_to(const std::array<double, 3>& to, const std::array<Known, 3>& known,
                        const std::array<std::int16_t, 3>& cause);
  void step_to(const std::array<double, 3>& to);
  bool raises_before_homing(const Words& w, double by_mm);
  double filament(const Words& w);
  void arc(const Words& w, Motion& m, Vec from, Vec to);
  std::optional<Vec> centre_by_radius(double radius_mm, Vec from, Vec to);
  std::optional<Vec> arc_centre(const Words& w, Vec from, Vec to, Axis first, Axis second);
  void upright_arc(const Words& w, std::size_t at);
  bool turns_left() const;
  struct Place3 {
    double x, y, z;
  };
  template <class PlaceAt>
  void replace_by_pieces(std::size_t at, int pieces, PlaceAt place_at);
  void unjudged(Motion& m, std::string_view why);

  // frame.cpp: what commands do to where the next move goes
  void retract(const Call& call);
  void unretract(const Call& call);
  void retract_lift(const Call& call);
  void plane(const Call& call);
  void units(const Call& call);
  void home(const Call& call);
  void machine_coordinates(const Call& call);
  void distance_mode(const Call& call);
  void centre_mode(const Call& call);
  void set_position(const Call& call);
  void reset_position(const Call& call);
  void select_workspace(const Call& call);
  void coordinate_data(const Call& call);
  void extruder_mode(const Call& call);
  void volumetric(const Call& call);
  void push_state(const Call& call);
  void babystep(const Call& call);
  void tool_offset(const Call& call);
  void tool_change(const Call& call);
  void bezier(const Call& call);
  void label_object(const Call& call);
  void lose_stored(const Call& call);
  void lose_axes_named(const Call& call);
  void lose_given(const Call& call);
  void lose_in_reprapfirmware(const Call& call);
  void keep_commands(const Call& call);
  void lose_length(const Call& call);
  void regain_length(const Call& call);
  void probe_bed(const Call& call);
  void lose_turned(const Call& call);
  void regain_turned(const Call& call);
  void lose_scaled(const Call& call);
  void regain_scaled(const Call& call);
  void two_carriages(const Call& call);
  void opaque_code(const Call& call);
  void waits(const Call& call);
  void lose(Source source, const Words* axes, std::int16_t cause);
  void regain(Source source);
  void take_tool_offsets();
  std::int16_t cause_of(std::string_view command, std::string_view why, bool frame);
  std::int16_t frame_lost(std::size_t axis) const;
  void shift(std::size_t axis, double by_mm);
  void forget_position(std::int16_t cause, Known as = Known::in_reach);
  void damaged_position();
  void opaque_command(std::string_view name);
  void list_opaque(std::string_view name);
  void problem(std::string_view what) { problems_.push_back({what}); }

  // klipper_commands.cpp
  void klipper_command(KlipperHandler handler, std::string_view text);
  void klipper_offset(const klipper::Arguments& arguments);
  void klipper_offset_of(std::size_t axis, const std::string& text, bool step, std::array<double, 3>& to);
  void klipper_save(const klipper::Arguments& arguments);
  void klipper_restore(const klipper::Arguments& arguments);
  void klipper_object(const klipper::Arguments& arguments);
  void klipper_object_end(const klipper::Arguments& arguments);
  void klipper_extruder(const klipper::Arguments& arguments);
  void klipper_field(const klipper::Arguments& arguments);
  void klipper_tower(const klipper::Arguments& arguments);
  void klipper_skew(const klipper::Arguments& arguments);
  void klipper_delayed(const klipper::Arguments& arguments);
  void klipper_skew_profile(const klipper::Arguments& arguments);
  void klipper_forced(const klipper::Arguments& arguments);
  bool klipper_moves(const klipper::Arguments& arguments);
  std::optional<double> klipper_number(const std::string& text);

  Machine machine_;
  State state_;
  std::array<std::array<std::int16_t, 3>, sources> lost_;  ///< cause; −1: not lost
  std::array<bool, 3> frame_known_{true, true, true};      ///< of lost_ and State::shift_lost
  std::array<std::uint64_t, 3> tools_lost_{};              ///< bit: tool whose offset was changed along the axis
  std::int16_t tools_cause_ = -1;
  std::array<std::array<double, 3>, 10> workspaces_{};     ///< offsets; [1] is G54
  std::array<std::array<bool, 3>, 10> workspace_known_{};  ///< said in this file, or G54
  std::size_t workspace_ = 1;
  std::map<std::string, State, std::less<>> saved_;               ///< by SAVE_GCODE_STATE
  std::string object_id_;                                         ///< of M486; empty: none
  std::map<std::string, std::string, std::less<>> object_names_;  ///< by that
  std::vector<State> pushed_;                                     ///< by M120 of RepRapFirmware
  int motion_mode_ = -1;                                          ///< G0 … G3, for lines that are only words
  int plane_ = 17, tool_ = 0;
  std::int16_t mode_cause_ = -1;      ///< G90 or G91 is not known, because of
  double raised_mm_ = 0;              ///< before it was homed
  double retract_lift_mm_ = 0;        ///< of M207
  bool retracted_ = false;            ///< by G10
  bool machine_coordinates_ = false;  ///< G53 on this line
  bool volumetric_ = false, line_is_numbered_ = false;
  bool tool_taken_;              ///< RepRapFirmware starts with none
  int line_commands_ = 0;        ///< on this line so far
  bool line_has_frame_ = false;  ///< one of them moved or changed coordinates
  const char *line_begin_ = nullptr, *line_end_ = nullptr;
  std::int64_t line_number_ = 0, opaque_count_ = 0;
  double speed_mm_s_ = 0;
  double pushed_alone_ = 0, drawn_alone_ = 0;
  std::vector<Motion> motions_;
  std::vector<Problem> problems_;
  std::vector<Opaque> opaque_;
  std::vector<Cause> causes_;
  Context context_;
};

}  // namespace weft::audit
