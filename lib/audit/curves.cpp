// SPDX-License-Identifier: GPL-3.0-or-later
// Curves: arcs in any plane, and splines.
#include "audit/reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::audit {
namespace {

constexpr double mm_per_inch = 25.4;
// Ends that differ from the radius by more than rounding explains: firmwares draw something else than was meant.
constexpr double radius_slack_mm = 0.5, radius_noise_mm = 0.05, radius_slack_share = 0.01;
/// Curves that are cut into straight pieces leave them by less than this: a tenth of the least tolerance of note.
constexpr double chord_error_mm = 0.001;
constexpr int most_pieces = 4096;

int turns_of(bool has, double p) {
  return has && p >= 1 ? static_cast<int>(std::min(p, 1000.0)) : 0;
}

}  // namespace

/// Does the arc turn left, drawn with the plane's axes to the right and up? G18 is looked at from behind, where X
/// points to the left (NIST RS274), but by Klipper.
bool Reader::turns_left() const {
  return (motion_mode_ == 3) != (plane_ == 18 && !is_klipper());
}

std::optional<Vec> Reader::centre_by_radius(double radius_mm, Vec from, Vec to) {
  const Vec chord = to - from;
  const double length = norm(chord), half = length / 2;
  if (length == 0 || half > std::abs(radius_mm) + radius_noise_mm) {
    problem(length == 0 ? "an arc by radius that ends where it starts" : "an arc whose radius does not span its ends");
    return std::nullopt;
  }
  // The centre lies left of the chord for the shorter arc to the left, right of it otherwise; R < 0 takes the longer
  // one.
  const bool left = turns_left();
  const double height =
      std::sqrt(std::max(0.0, radius_mm * radius_mm - half * half)) * (left == (radius_mm > 0) ? 1 : -1);
  return 0.5 * (from + to) + (height / length) * Vec{-chord.y, chord.x};
}

/// The centre that I, J, K or R give, in the plane of the two axes.
std::optional<Vec> Reader::arc_centre(const Words& w, Vec from, Vec to, Axis first, Axis second) {
  static constexpr char offsets[] = {'I', 'J', 'K'};
  const double unit_mm = state_.inches ? mm_per_inch : 1.0;
  const char p = offsets[first], q = offsets[second];
  if (w.has('R')) return centre_by_radius(w['R'] * unit_mm, from, to);
  if (!w.has(p) && !w.has(q)) {
    problem("an arc without centre or radius");
    return std::nullopt;
  }
  const Vec given{w.has(p) ? w[p] * unit_mm : 0.0, w.has(q) ? w[q] * unit_mm : 0.0};
  const Vec centre = state_.absolute_centre ? Vec{w.has(p) ? given.x + state_.offset[first] : from.x,
                                                  w.has(q) ? given.y + state_.offset[second] : from.y}
                                            : from + given;
  const double r_from = norm(from - centre), r_to = norm(to - centre), apart = std::abs(r_from - r_to);
  if (r_from == 0)
    problem("an arc of no radius");
  else if (apart > radius_slack_mm || (apart > radius_noise_mm && apart > radius_slack_share * r_from))
    problem("an arc that ends at another radius than it starts");
  return centre;
}

/// Turns the motion's path into the arc that G2 or G3 means.
void Reader::arc(const Words& w, Motion& m, Vec from, Vec to) {
  const auto centre = arc_centre(w, from, to, x, y);
  if (!centre) return unjudged(m, "an arc that says neither centre nor radius");
  m.path = arc_about(from, to, *centre, turns_left(), turns_of(w.has('P'), w['P']));
}

/// Puts straight pieces in the place of motion `at`: place_at(t), 0 … 1, is where the curve leads.
template <class PlaceAt>
void Reader::replace_by_pieces(std::size_t at, int pieces, PlaceAt place_at) {
  const Motion whole = motions_[at];
  motions_.resize(at);
  Place3 before = place_at(0.0);
  const double lift = retracted_ ? retract_lift_mm_ : 0;
  double length = 0;
  for (int i = 1; i <= pieces; ++i) {
    const Place3 p = place_at(static_cast<double>(i) / pieces);
    Motion& m = motions_.emplace_back(whole);
    m.path = {.from = {before.x, before.y}, .to = {p.x, p.y}};
    m.z_from = before.z + lift, m.z_to = p.z + lift;
    m.continues = i > 1;
    m.moves_z = true;
    length += length_mm(m.path);
    before = p;
  }
  for (std::size_t i = at; i < motions_.size(); ++i)  // the filament is spread evenly
    motions_[i].e_mm = length > 0 ? whole.e_mm * length_mm(motions_[i].path) / length : 0;
}

/// G2 and G3 in the upright planes: X with Z, seen from the side of Y, or Y with Z.
void Reader::upright_arc(const Words& w, std::size_t at) {
  Motion& m = motions_[at];
  const bool known = m.from_known && m.x_known && m.y_known && m.z_known && state_.known[z] == Known::yes;
  if (!known) return unjudged(m, "an upright arc from or to a place that is not known");
  const Axis first = plane_ == 18 ? x : y, across = plane_ == 18 ? y : x;
  const std::array<double, 3> a = state_.position, b{m.path.to.x, m.path.to.y, m.z_to};
  const Vec from{a[first], a[z]}, to{b[first], b[z] - (retracted_ ? retract_lift_mm_ : 0)};
  const auto centre = arc_centre(w, from, to, first, z);
  if (!centre) return unjudged(m, "an arc that says neither centre nor radius");
  const int turns = turns_of(w.has('P'), w['P']);
  const Path path = arc_about(from, to, *centre, turns_left(), turns);
  const double step = 2 * std::acos(std::max(0.0, 1 - chord_error_mm / std::max(path.radius_mm, chord_error_mm)));
  const double wanted = std::ceil(2 * std::numbers::pi / step) * (1 + turns);
  if (!(wanted < most_pieces)) return unjudged(m, "an upright arc larger than can be followed");
  replace_by_pieces(at, std::max(2, static_cast<int>(wanted)), [&](double t) {
    const Vec p = audit::at(path, t);
    std::array<double, 3> place{};
    place[first] = p.x;
    place[across] = a[across] + t * (b[across] - a[across]);
    return Place3{place[x], place[y], p.y};
  });
}

/// G5: a cubic spline whose inner control points stand (I, J) from the start and (P, Q) from the end; G5.1: a square
/// one. Source: Marlin's and LinuxCNC's manuals, "G5", "G5.1".
void Reader::bezier(const Call& call) {
  const Words& w = call.words;
  motion_mode_ = 0;
  const std::size_t at = motions_.size();
  const std::array<double, 3> a = state_.position;
  const bool start_known = state_.known[x] == Known::yes && state_.known[y] == Known::yes;
  move(w);
  motion_mode_ = -1;  // nothing goes on with a spline by words alone
  if (motions_.size() == at) return problem("a spline without an end");
  Motion& m = motions_[at];
  m.moves_xy = true;
  const bool cubic = call.sub < 0;
  if (!cubic && call.sub != 1) return unjudged(m, "a spline of a kind that is not followed");
  if (!w.has('I') || !w.has('J') || (cubic && (!w.has('P') || !w.has('Q'))))
    return unjudged(m, "a spline that goes on from the one before");
  if (!start_known || !m.x_known || !m.y_known) return unjudged(m, "a spline from or to a place that is not known");
  const double unit_mm = state_.inches ? mm_per_inch : 1.0;
  const Vec p0{a[x], a[y]}, p3 = m.path.to, given = p0 + unit_mm * Vec{w['I'], w['J']};
  const Vec p1 = cubic ? given : p0 + (2.0 / 3) * (given - p0);
  const Vec p2 = cubic ? p3 + unit_mm * Vec{w['P'], w['Q']} : p3 + (2.0 / 3) * (given - p3);
  // A chord over 1/n of the curve leaves it by at most (greatest second derivative) / 8 n².
  const double bend = 6 * std::max(norm(p0 - 2.0 * p1 + p2), norm(p1 - 2.0 * p2 + p3));
  const double wanted = std::ceil(std::sqrt(bend / (8 * chord_error_mm)));
  if (!(wanted < most_pieces)) return unjudged(m, "a spline larger than can be followed");
  const double z0 = state_.known[z] == Known::yes ? m.z_from - (retracted_ ? retract_lift_mm_ : 0) : m.z_to;
  const double z1 = m.z_to - (retracted_ ? retract_lift_mm_ : 0);
  replace_by_pieces(at, std::max(1, static_cast<int>(wanted)), [&](double t) {
    const double s = 1 - t;
    const Vec p = s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
    return Place3{p.x, p.y, z0 + t * (z1 - z0)};
  });
}

}  // namespace weft::audit
