// What commands other than moves do to where the next move goes.
#include "audit/reader.h"
#include "audit/scan.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace weft::audit {
namespace {

using namespace std::string_view_literals;

/// M-codes after which the nozzle may be elsewhere: probing, parking, filament changes, files and macros of the
/// firmware, vibration tests, changes of the coordinates that firmwares do in different ways.
constexpr std::array moving_m_codes{48, 98, 125, 226, 428, 600, 601, 602, 701, 702, 970, 974};

/// M-codes followed by a text, which may hold anything.
constexpr std::array text_m_codes{0,   1,   16,  23,  28,  29,  30,  32,  33,  36,  38,  111, 115,
                                  117, 118, 291, 486, 550, 552, 581, 587, 815, 862, 928, 929, 1002};

template <class List, class T>
bool contains(const List& list, const T& wanted) {
  return std::binary_search(list.begin(), list.end(), wanted);
}

}  // namespace

const char* Reader::g_command(int number, bool fraction, const char* p, const char* end) {
  if (number <= 3 && !fraction) {
    motion_mode_ = number;
    return motion_line(p, end);
  }
  Words w;
  const char* const begin = p;
  switch (number) {
    case 4:
      return skip_words(p, end);
    case 5:
      p = words(p, end, true, w);
      if (w.sound)
        bezier(w);
      else
        forget_position();
      return p;
    case 10:
      p = words(p, end, false, w);
      if (w.names('L') && (w['L'] == 2 || w['L'] == 20))
        lose_offsets(w), opaque_command("G10 L");  // else retract, or a tool's offset
      return p;
    case 17:
    case 18:
    case 19:
      plane_ = number;
      break;
    case 20:
      state_.inches = true;
      break;
    case 21:
      state_.inches = false;
      if (std::string_view(p, static_cast<std::size_t>(end - p)).find("set units to millimeters") !=
          std::string_view::npos)
        context_.begin();  // PrusaSlicer and Slic3r write it behind the start G-code
      break;
    case 28:
      p = words(p, end, false, w);
      if (fraction)
        opaque_command("G28.x");  // Bambu: calibrations about homing
      else
        home(w);
      return p;
    case 53:
      machine_coordinates_ = true;
      break;
    case 90:
      (fraction ? state_.absolute_centre : state_.relative) = fraction;
      break;
    case 91:
      (fraction ? state_.absolute_centre : state_.relative) = !fraction;
      break;
    case 92:
      p = words(p, end, true, w);
      if (!w.sound)
        state_.offset_known = {};
      else if (fraction)
        state_.offset = {};
      else
        set_position(w);
      return p;
    case 11:
    case 40:
    case 49:
    case 54:
    case 60:
    case 64:
    case 69:
    case 93:
    case 94:
    case 95:
    case 97:
      break;
    case 29:
      if (fraction) break;  // Bambu: G29.1 trims Z, G29.2 switches the mesh
      [[fallthrough]];
    default:
      p = words(p, end, false, w);
      if ((number >= 55 && number <= 59) || number == 68) lose_offsets({});
      opaque_command(fmt::format("G{}", number));
      return p;
  }
  return p == begin ? words(p, end, false, w) : p;
}

const char* Reader::m_command(int number, const char* p, const char* end) {
  const char* const stop = skip_words(p, end);
  const std::string_view text(p, static_cast<std::size_t>(stop - p));
  if (number == 486) {  // M486 S2 A"bracket": the object that follows; S-1: none
    if (const auto at = text.find('A'); at != std::string_view::npos) {
      auto name = text.substr(at + 1);
      if (name.starts_with('"')) name = name.substr(1, name.find('"', 1) - 1);
      context_.set_object(name);
    } else if (const auto s = text.find('S'); s != std::string_view::npos) {
      const auto id = text.substr(s + 1);
      context_.set_object(id.starts_with("-") ? std::string_view{} : id);
    }
    return stop;
  }
  if (contains(text_m_codes, number)) return stop;
  if (text.find_first_of("{[") != std::string_view::npos) problem("a placeholder that was not filled in");
  Words w;
  p = words(p, end, false, w);
  switch (number) {
    case 82:
      state_.e_relative = false;
      break;
    case 83:
      state_.e_relative = true;
      break;
    case 200:
      volumetric_ = w.has('D') ? w['D'] > 0 : volumetric_;
      break;
    case 206:
      lose_offsets(w);
      opaque_command("M206");
      break;
    default:
      if (contains(moving_m_codes, number)) {
        if (number == 428) lose_offsets({});
        opaque_command(fmt::format("M{}", number));
      }
  }
  return p;
}

void Reader::home(const Words& w) {
  state_.homed = true;
  static constexpr char letters[] = {'X', 'Y', 'Z'};
  const bool all = !w.names('X') && !w.names('Y') && !w.names('Z');
  for (std::size_t i = 0; i < 3; ++i) {
    if (!all && !w.names(letters[i])) continue;
    state_.known[i] = home_ && i != z && !w.names('O');  // O: only if it is not homed yet, so it may also stay
    if (state_.known[i]) state_.position[i] = i == x ? home_->x : home_->y;
    state_.offset[i] = state_.homing_offset[i];  // Klipper keeps its offset when it homes
    state_.offset_known[i] = !offset_lost_[i];
  }
}

void Reader::set_position(const Words& w) {
  static constexpr char letters[] = {'X', 'Y', 'Z'};
  const double unit_mm = state_.inches ? 25.4 : 1.0;
  if (w.has('E')) state_.e = w['E'] * unit_mm;
  // Without words some firmwares set every axis to zero and others none.
  if (w.seen == 0) state_.offset_known.fill(false);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!w.has(letters[i])) continue;
    state_.offset_known[i] = state_.known[i] && !offset_lost_[i];
    if (state_.offset_known[i]) state_.offset[i] = state_.position[i] - w[letters[i]] * unit_mm;
  }
}

/// The firmware shifted the named axes, or all, by what it keeps to itself.
void Reader::lose_offsets(const Words& w) {
  static constexpr char letters[] = {'X', 'Y', 'Z'};
  const bool all = !w.names('X') && !w.names('Y') && !w.names('Z');
  for (std::size_t i = 0; i < 3; ++i)
    if (all || w.names(letters[i])) offset_lost_[i] = true, state_.offset_known[i] = false;
}

}  // namespace weft::audit
