// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/columns.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/simplify.h"
#include "support/branch_areas.h"
#include "support/lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace weft::support {
namespace {

/// The squares of a grid, fixed to the object, that an area meets.
Regions squares(const Regions& area, Um cell) {
  std::set<std::pair<Um, Um>> met;
  const auto floor_div = [&](Um v) { return v >= 0 ? v / cell : -((-v + cell - 1) / cell); };
  const Box box = box_of(area);
  if (box.empty()) return {};
  std::vector<Polyline> lines;
  const Um step = std::max<Um>(cell / 4, 100);
  for (Um y = box.min.y + step / 2; y < box.max.y; y += step) lines.push_back({{box.min.x - 1, y}, {box.max.x + 1, y}});
  for (const auto& piece : geometry::clip_lines(lines, area))
    for (Um c = floor_div(std::min(piece.line.front().x, piece.line.back().x));
         c <= floor_div(std::max(piece.line.front().x, piece.line.back().x)); ++c)
      met.insert({floor_div(piece.line.front().y), c});
  std::vector<Ring> rings;
  for (const auto& [row, column] : met) {
    const Um x = column * cell, y = row * cell;
    rings.push_back({{x - 1, y - 1}, {x + cell + 1, y - 1}, {x + cell + 1, y + cell + 1}, {x - 1, y + cell + 1}});
  }
  auto out = geometry::regions_from_rings(rings);
  append(out, area);
  return geometry::unite(out);
}

/// What columns look like that hold an area: gaps are closed, and nothing is too thin to stand.
Regions shaped(const SupportSettings& s, const Object& object, const Regions& contact) {
  const Um line = line_width(s, object.nozzle);
  Regions out = s.support_join_distance > 0 ? geometry::closing(contact, s.support_join_distance / 2) : contact;
  if (s.support_normal_shape == SupportShape::grid) {
    const double share = std::max(0.02, s.support_infill_rate / 100);
    return squares(out, std::clamp<Um>(rounded(line / share), 1000, 10000));
  }
  return out;
}

bool on_tower(const SupportSettings& s, const Region& region) {
  const Point size = box_of(region.outer).size();
  return s.support_use_towers && std::max(size.x, size.y) <= s.support_tower_maximum_supported_diameter;
}

/// Rounds under tiny contacts, as thick as a tower as soon as the slope of its top allows.
class Towers {
 public:
  Towers(const SupportSettings& s) : s_(s) {}
  void begin(const Regions& contacts, Um z) {
    for (const Region& region : contacts)
      if (on_tower(s_, region)) growing_.push_back({box_of(region.outer), z});
  }
  /// Adds what towers are on a level with its top there.
  void add(Um z, Regions& falling) {
    const double most = s_.support_tower_diameter / 2.0;
    std::vector<Ring> rings;
    std::erase_if(growing_, [&](const Tower& tower) {
      const double least = std::max(tower.box.size().x, tower.box.size().y) / 2.0;
      const double slope = std::tan(s_.support_tower_roof_angle * std::numbers::pi / 180);
      const double radius = slope > 0 ? std::min(most, least + (tower.z - z) / slope) : most;
      if (radius > 0) rings.push_back(circle_around({tower.box.centre(), radius}));
      return radius >= most;
    });
    if (rings.empty()) return;
    append(falling, geometry::regions_from_rings(rings));
    falling = geometry::unite(falling);
  }

 private:
  struct Tower {
    Box box;
    Um z;
  };
  const SupportSettings& s_;
  std::vector<Tower> growing_;
};

/// A level further down columns are narrower by that much at each side (wider below 0), but keep their least width.
void lean(const SupportSettings& s, const Object& object, Um height, Regions& falling) {
  const Um rests = line_width(s, object.nozzle) / 2;  // more of a bead would hang
  const Um by =
      std::clamp(rounded(height * std::tan(s.support_conical_angle * std::numbers::pi / 180)), -8 * rests, rests);
  if (by < 0) {
    falling = grown(falling, -by);
    return;
  }
  const auto with = [](Um offset) { return geometry::OffsetOptions{.by = offset, .corner = geometry::Corner::miter}; };
  const Um least = s.support_conical_min_width / 2;
  Regions out = geometry::offset(falling, with(-by));
  append(out, geometry::subtract(falling, geometry::offset(geometry::offset(falling, with(-least)), with(least + 20))));
  falling = geometry::opening(geometry::unite(out), rests / 2);
}

}  // namespace

TowersAndOthers for_towers(const SupportSettings& settings, const std::vector<Regions>& contacts) {
  TowersAndOthers out{std::vector<Regions>(contacts.size()), std::vector<Regions>(contacts.size())};
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const Region& region : contacts[k])
      (on_tower(settings, region) ? out.towers : out.others)[k].push_back(region);
  return out;
}

namespace {

/// The boxes of pieces, wider.
Regions boxes_around(const Regions& pieces, Um by) {
  std::vector<Ring> rings;
  for (const Region& piece : pieces) {
    const Box box = box_of(piece.outer).grown(by);
    rings.push_back({box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}});
  }
  return geometry::regions_from_rings(rings);
}

}  // namespace

void thicken(Regions& area, const Regions& fresh, Um line) {
  if (fresh.empty()) return;
  // What a disc inside of the area covers is told by what lies as near as its diameter.
  const Regions around = &area == &fresh ? area : geometry::intersect(area, boxes_around(fresh, 2 * line));
  const Regions thin = geometry::subtract(fresh, grown(opened(around, line), 20));
  if (thin.empty()) return;
  append(area, grown(thin, line));
  area = geometry::unite(area);
}

namespace {

/// What of a level hangs, but for slivers along edges: an area that was opened by 0.4 lines is none.
Regions hanging(const Regions& here, const Regions& below) {
  Regions out = geometry::subtract(here, below);
  std::erase_if(out, [](const Region& piece) {
    constexpr double least_mm2 = 0.05, least_wide_mm = 0.06;
    const double mm2 = area_mm2(piece);
    return mm2 < least_mm2 || 2000 * mm2 < least_wide_mm * perimeter_of(piece.outer);
  });
  return out;
}

}  // namespace

void rest_on(const SupportSettings& s, const Object& object, const Stack::Level& level, const Regions& below,
             Regions& here) {
  constexpr Um sinks = 0.6_mm;  // what hangs so far above the part comes to lie on it
  if (here.empty()) return;
  const Regions hangs = hanging(here, below);
  if (hangs.empty()) return;
  const Um reach = std::max(line_width(s, object.nozzle) * 6 / 10, level.height);
  const Regions near = boxes_around(hangs, 2 * reach);
  Regions base = geometry::intersect(below, near);
  if (s.support_type == SupportType::everywhere) {
    const auto run = layers_between(object, level.bottom() - bottom_gap(s) - sinks, level.bottom());
    for (std::size_t i = run.from; i < run.to; ++i) append(base, geometry::intersect(object.layers[i]->regions, near));
  }
  const Regions free = base.empty() ? hangs : geometry::subtract(hangs, grown(geometry::unite(base), reach));
  if (!free.empty()) here = geometry::subtract(here, free);
}

void let_rest(const SupportSettings& s, const Object& object, const Stack& stack, std::vector<Regions>& levels) {
  for (std::size_t k = 1; k < levels.size(); ++k) {
    stop_if_asked();
    rest_on(s, object, stack.levels[k], levels[k - 1], levels[k]);
  }
}

Regions free_part(const Regions& area, const KeepOut& out, const Regions& contacts, const Object& object) {
  Regions left = area;
  if (object.room != nullptr) left = geometry::intersect(left, *object.room);
  if (left.empty()) return left;
  Regions barred = out.over;
  append(barred, out.touch);
  if (contacts.empty())
    append(barred, out.near);
  else
    append(barred, geometry::subtract(out.near, grown(contacts, object.nozzle)));  // a strip alone could not be printed
  return barred.empty() ? left : geometry::subtract(left, barred);
}

namespace {

constexpr Um corner_bound = 15_um;

/// What is thinner than twice the radius goes. Other corners stay as they are: opened level by level, they would be cut
/// a little each time.
Regions without_thin(const Regions& area, Um radius) {
  return geometry::intersect(area, grown(opened(area, radius), radius / 2));
}

}  // namespace

std::vector<Regions> columns(const SupportSettings& settings, const Object& object, const Stack& stack,
                             const std::vector<KeepOut>& keep_out, const std::vector<Regions>& contacts,
                             const std::vector<Regions>& given) {
  const Um line = line_width(settings, object.nozzle);
  std::vector<Regions> out(stack.levels.size());
  std::vector<Regions> shadow;
  if (settings.support_type == SupportType::buildplate) shadow = shadows(settings, object, stack);
  Regions falling;  // what comes down from above
  Towers towers(settings);
  for (std::size_t k = stack.levels.size(); k-- > 0;) {
    stop_if_asked();
    if (settings.support_conical_enabled && !falling.empty()) lean(settings, object, stack.levels[k].height, falling);
    towers.begin(contacts[k], stack.levels[k].z);
    towers.add(stack.levels[k].z, falling);
    if (!contacts[k].empty()) {
      const Regions fresh = shaped(settings, object, contacts[k]);
      append(falling, fresh);
      falling = geometry::unite(falling);
      thicken(falling, fresh, line);
    }
    if (!given[k].empty()) {
      append(falling, given[k]);
      falling = geometry::unite(falling);
    }
    if (falling.empty()) continue;
    falling = geometry::simplified(falling, corner_bound);  // of corners that the part above has left
    Regions left = free_part(falling, keep_out[k], contacts[k], object);
    if (!shadow.empty()) left = geometry::subtract(left, shadow[k]);
    const bool same = contacts[k].empty() && std::abs(area_mm2(left) - area_mm2(falling)) < 1e-6;
    if (!same) falling = without_thin(left, line * 4 / 10);
    out[k] = falling;
  }
  let_rest(settings, object, stack, out);
  return out;
}

}  // namespace weft::support
