#pragma once
#include "audit/comments.h"
#include "audit/klipper.h"
#include "audit/path.h"

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

/// One motion of the nozzle, in machine coordinates, mm.
struct Motion {
  enum class Kind : std::uint8_t { travel, extrude, arc, lift };
  Kind kind = Kind::travel;
  bool extrudes = false;   ///< lays filament down along its way
  bool judgeable = true;   ///< false: a curve whose extent this reader does not know (G5, arcs of G18 and G19)
  bool from_known = true;  ///< X and Y of where it starts
  bool from_home = false;  ///< starts where homing left the nozzle
  bool x_known = true, y_known = true, z_known = true;  ///< of where it ends
  Path path;                                            ///< straight from `to` to `to` when only the end is known
  double z_from = 0, z_to = 0;                          ///< equal when where it starts is not known
  double e_mm = 0;  ///< filament pushed forward, or drawn back when negative; mm³ when `volumetric`
  bool volumetric = false;
  int tool = 0;
};

/// A line that cannot be read as what it looks like.
struct Problem {
  std::string_view what;  ///< a clause that lives as long as the program
};

/// A command after which the reader does not know where the nozzle is.
struct Opaque {
  std::string name;  ///< "G29", "PRINT_START"
  std::int64_t count = 0;
  std::int64_t first_line = 0;
};

class Reader {
 public:
  /// @param home where G28 leaves the nozzle, mm; nullopt: not known
  explicit Reader(std::optional<Vec> home);

  /// Reads one line. Pre: *end can be read and is a line feed. Ends at a carriage return count as ends of a line.
  void line(const char* begin, const char* end);

  /// What the last line did. Valid until the next call.
  std::span<const Motion> motions() const { return motions_; }
  std::span<const Problem> problems() const { return problems_; }

  const Context& context() const { return context_; }
  std::int64_t line_number() const { return line_number_; }
  double speed_mm_s() const { return speed_mm_s_; }  ///< of the last motion, as F asks for it; 0 when it never did
  std::span<const Opaque> opaque() const { return opaque_; }  ///< in order of first use, at most 64 names
  std::int64_t opaque_count() const { return opaque_count_; }

  /// A line that was dropped because it is too long to be held: counted, nothing else known of it.
  void skip_line() { ++line_number_; }

 private:
  enum Axis { x, y, z };
  struct State {
    std::array<double, 3> position{};  ///< machine, mm
    std::array<bool, 3> known{};
    std::array<double, 3> offset{};  ///< machine = written + offset
    std::array<bool, 3> offset_known{true, true, true};
    std::array<double, 3> homing_offset{};  ///< of SET_GCODE_OFFSET, mm: homing keeps it
    double homing_e = 0;
    double e = 0;
    bool homed = false;  ///< no move since G28
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

  const char* words(const char* p, const char* end, bool strict, Words& out);
  const char* command(const char* p, const char* end);
  const char* g_command(int number, bool fraction, const char* p, const char* end);
  const char* m_command(int number, const char* p, const char* end);
  const char* motion_line(const char* p, const char* end);
  const char* skip_words(const char* p, const char* end);
  const char* extended_command(const char* p, const char* end);
  void comment(const char* p, const char* end, bool alone);
  void move(const Words& w);
  bool target(const Words& w, std::array<double, 3>& to, std::array<bool, 3>& known);
  void arc(const Words& w, Motion& m, Vec from, Vec to, bool ends_known);
  void bezier(const Words& w);
  void home(const Words& w);
  void set_position(const Words& w);
  using KlipperHandler = void (Reader::*)(const klipper::Arguments& arguments);
  void klipper_command(KlipperHandler handler, std::string_view text);
  void klipper_offset(const klipper::Arguments& arguments);
  void klipper_activate(const klipper::Arguments& arguments);
  void klipper_save(const klipper::Arguments& arguments);
  void klipper_restore(const klipper::Arguments& arguments);
  void klipper_object(const klipper::Arguments& arguments);
  void klipper_object_end(const klipper::Arguments& arguments);
  bool klipper_moves(const klipper::Arguments& arguments);
  std::optional<double> klipper_number(const std::string& text);
  Motion& begin_motion(const std::array<double, 3>& to, const std::array<bool, 3>& known);
  void move_straight_to(const std::array<double, 3>& to, const std::array<bool, 3>& known);
  void forget_position();
  void lose_offsets(const Words& w);
  void opaque_command(std::string_view name);
  void problem(std::string_view what) { problems_.push_back({what}); }

  std::optional<Vec> home_;
  State state_;
  std::array<bool, 3> offset_lost_{};                ///< by M206, G55 …: not mended by homing
  std::map<std::string, State, std::less<>> saved_;  ///< by SAVE_GCODE_STATE
  int motion_mode_ = -1;                             ///< G0 … G3, for lines that are only words
  int plane_ = 17, tool_ = 0;
  bool machine_coordinates_ = false;  ///< G53 on this line
  bool volumetric_ = false, line_is_numbered_ = false;
  const char* line_begin_ = nullptr;
  std::int64_t line_number_ = 0, opaque_count_ = 0;
  double speed_mm_s_ = 0;
  std::vector<Motion> motions_;
  std::vector<Problem> problems_;
  std::vector<Opaque> opaque_;
  Context context_;
};

}  // namespace weft::audit
