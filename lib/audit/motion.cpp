// SPDX-License-Identifier: GPL-3.0-or-later
// From words to motions: where a move leads, and whether that is known.
#include "audit/reader.h"
#include "audit/scan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::audit {
namespace {

constexpr char axis_letters[] = {'X', 'Y', 'Z'};
constexpr double mm_per_inch = 25.4;

constexpr Known lesser(Known a, Known b) {
  return std::max(a, b);
}

}  // namespace

/// Start G-code raises the nozzle before it homes, off whatever it stands on. Where the last job left it no file can
/// say; a raise by as much as people write there is taken for what it is.
bool Reader::raises_before_homing(const Words& w, double by_mm) {
  constexpr double highest_mm = 20;
  if (state_.cause[z] != 0 || w.has('X') || w.has('Y') || by_mm < 0) return false;
  return (raised_mm_ += by_mm) <= highest_mm;
}

/// Where the words lead; false when no axis is named.
bool Reader::target(const Words& w, std::array<double, 3>& to, std::array<Known, 3>& known,
                    std::array<std::int16_t, 3>& cause) {
  const double unit_mm = state_.inches ? mm_per_inch : 1.0;
  bool named = false;
  const bool elsewhere = machine_.firmware == Firmware::reprapfirmware && motion_mode_ <= 1 &&
                         (w.names('R') || (w.has('H') && w['H'] != 0));
  to = state_.position;
  known = state_.known;
  cause = state_.cause;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!w.has(axis_letters[i])) continue;
    named = true;
    const double v = w[axis_letters[i]] * unit_mm;
    const auto unknown = [&](std::int16_t because) {
      known[i] = Known::no;
      cause[i] = because;
    };
    if (mode_cause_ >= 0) {
      unknown(mode_cause_);
    } else if (elsewhere) {
      unknown(cause_of("G1 H or R", "RepRapFirmware ends it at a switch, or counts it from a place put aside", true));
    } else if (machine_coordinates_) {
      to[i] = v;
      known[i] = Known::yes;
    } else if (state_.relative) {
      to[i] += v;
      if (!frame_known_[i] && lost_[scaled][i] >= 0)
        unknown(lost_[scaled][i]);
      else if (!frame_known_[i] && lost_[turned][i] >= 0)
        unknown(lost_[turned][i]);
      else if (known[i] == Known::in_reach && !(i == z && raises_before_homing(w, v)))
        known[i] = Known::no;  // it may have stood at the edge
    } else if (!frame_known_[i]) {
      unknown(frame_lost(i));
    } else {
      to[i] = v + state_.offset[i];
      known[i] = Known::yes;
    }
  }
  // Turned coordinates lead both axes elsewhere when one is named.
  if (lost_[turned][x] >= 0 && (w.has('X') || w.has('Y'))) {
    known[x] = known[y] = Known::no;
    cause[x] = frame_lost(x);
    cause[y] = frame_lost(y);
  }
  return named;
}

/// The filament of a move, as written.
double Reader::filament(const Words& w) {
  if (!w.has('E')) return 0;
  const double e = w['E'] * (state_.inches ? mm_per_inch : 1.0);
  const bool relative = state_.e_relative || state_.relative;
  const double pushed = relative ? e : e - state_.e;
  state_.e = relative ? state_.e + e : e;
  return pushed;
}

void Reader::move(const Words& w) {
  const bool is_arc = motion_mode_ >= 2;
  std::array<double, 3> to;
  std::array<Known, 3> known;
  std::array<std::int16_t, 3> cause;
  const bool named = target(w, to, known, cause);
  if (w.has('F')) speed_mm_s_ = w['F'] * (state_.inches ? mm_per_inch : 1.0) / 60;
  const double e_mm = filament(w);
  if (!named && !(is_arc && (w.has('I') || w.has('J') || w.has('K')))) {
    if (is_arc && w.valued != 1U << ('F' - 'A')) problem("an arc without an end, centre or radius");
    (e_mm < 0 ? drawn_alone_ : pushed_alone_) += std::abs(e_mm);
    return;
  }
  const Vec from{state_.position[x], state_.position[y]}, end{to[x], to[y]};
  const std::size_t at = motions_.size();
  Motion& m = begin_motion(to, known, cause);
  m.moves_xy = is_arc || w.has('X') || w.has('Y');
  m.moves_z = w.has('Z');
  m.e_mm = e_mm;
  m.volumetric = volumetric_;
  const bool ends_known = m.from_known && m.x_known && m.y_known;
  if (is_arc && plane_ == 17 && ends_known) arc(w, m, from, end);
  const bool across = m.path.arc || !ends_known || from.x != end.x || from.y != end.y;
  m.extrudes = e_mm > 0 && across && m.moves_xy;
  const bool rises = m.z_known && m.z_to > m.z_from;
  m.kind = is_arc                 ? (rises && !m.extrudes ? Motion::Kind::lift_spiral : Motion::Kind::arc)
           : m.extrudes           ? Motion::Kind::extrude
           : !rises               ? Motion::Kind::travel
           : m.moves_xy && across ? Motion::Kind::lift_slope
                                  : Motion::Kind::lift;
  if (is_arc && plane_ != 17) upright_arc(w, at);
  if (is_arc && !ends_known && plane_ == 17) unjudged(motions_[at], "an arc from or to a place that is not known");
  arrive(to, known, cause);
}

/// A motion from where the nozzle is, straight.
Motion& Reader::begin_motion(const std::array<double, 3>& to, const std::array<Known, 3>& known,
                             const std::array<std::int16_t, 3>& cause) {
  Motion& m = motions_.emplace_back();
  const Vec end{to[x], to[y]};
  m.from = lesser(state_.known[x], state_.known[y]);
  m.from_known = m.from == Known::yes;
  m.from_home = state_.homed;
  m.x = known[x], m.y = known[y], m.z = known[z];
  m.x_known = m.x == Known::yes, m.y_known = m.y == Known::yes, m.z_known = m.z == Known::yes;
  m.path = {.from = m.from_known && m.x_known && m.y_known ? Vec{state_.position[x], state_.position[y]} : end,
            .to = end};
  for (std::size_t i = 0; i < 3 && m.cause < 0; ++i)
    if (known[i] == Known::no) m.cause = cause[i];
  for (std::size_t i = 0; i < 2 && m.cause < 0; ++i)
    if (state_.known[i] != Known::yes) m.cause = state_.cause[i];
  for (std::size_t i = 0; i < 3 && m.cause < 0; ++i)
    if (known[i] != Known::yes) m.cause = cause[i];
  const double lift = retracted_ ? retract_lift_mm_ : 0;
  m.z_to = to[z] + lift;
  m.z_from = state_.known[z] == Known::yes ? state_.position[z] + lift : m.z_to;
  m.tool = tool_;
  return m;
}

void Reader::arrive(const std::array<double, 3>& to, const std::array<Known, 3>& known,
                    const std::array<std::int16_t, 3>& cause) {
  if (!motions_.empty() && motions_.back().moves_xy) state_.homed = false;
  state_.position = to;
  state_.known = known;
  state_.cause = cause;
}

/// A straight way to a place in machine coordinates that a command, not a move, asks for.
void Reader::move_straight_to(const std::array<double, 3>& to, const std::array<Known, 3>& known,
                              const std::array<std::int16_t, 3>& cause) {
  Motion& m = begin_motion(to, known, cause);
  m.moves_z = true;
  const bool across = to[x] != state_.position[x] || to[y] != state_.position[y];
  m.moves_xy = across;
  m.kind = !(m.z_known && m.z_to > m.z_from) ? Motion::Kind::travel
           : across                          ? Motion::Kind::lift_slope
                                             : Motion::Kind::lift;
  arrive(to, known, cause);
}

/// The same by so much from where the nozzle is: where only the reach is known, it may have stood at its edge. Nor is
/// the height of the first layer known better than people trim it.
void Reader::step_to(const std::array<double, 3>& to) {
  constexpr double most_trim_mm = 1;
  auto known = state_.known;
  for (std::size_t i = 0; i < 3; ++i) {
    const double by_mm = std::abs(to[i] - state_.position[i]);
    if (by_mm > (i == z ? most_trim_mm : 0) && known[i] == Known::in_reach) known[i] = Known::no;
  }
  move_straight_to(to, known, state_.cause);
}

/// The motion's extent is not known, whatever is known of its ends.
void Reader::unjudged(Motion& m, std::string_view why) {
  m.judgeable = false;
  if (m.cause < 0) m.cause = cause_of("a curve", why, true);
}

}  // namespace weft::audit
