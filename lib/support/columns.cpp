// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/columns.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "support/lengths.h"

#include <algorithm>
#include <cmath>
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

/// Strips thinner than two lines, made as wide as that.
void thicken(Regions& area, const Regions& fresh, Um line) {
  Regions thin = geometry::subtract(area, grown(geometry::opening(area, line), 20));
  if (thin.empty()) return;
  thin = geometry::intersect(thin, fresh);
  if (thin.empty()) return;
  append(area, grown(thin, line));
  area = geometry::unite(area);
}

}  // namespace

void let_rest(const SupportSettings& s, const Object& object, const Stack& stack, std::vector<Regions>& levels) {
  constexpr Um sinks = 0.6_mm;  // what hangs so far above the part comes to lie on it
  const Um line = line_width(s, object.nozzle);
  for (std::size_t k = 1; k < levels.size(); ++k) {
    if (levels[k].empty()) continue;
    stop_if_asked();
    if (geometry::subtract(levels[k], levels[k - 1]).empty()) continue;
    const auto& level = stack.levels[k];
    Regions base = levels[k - 1];
    if (s.support_type == SupportType::everywhere)
      append(base, outlines_between(object, level.bottom() - bottom_gap(s) - sinks, level.bottom()));
    levels[k] = geometry::intersect(levels[k], grown(base, std::max(line * 6 / 10, level.height)));
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

std::vector<Regions> columns(const SupportSettings& settings, const Object& object, const Stack& stack,
                             const std::vector<KeepOut>& keep_out, const std::vector<Regions>& contacts,
                             const std::vector<Regions>& given) {
  const Um line = line_width(settings, object.nozzle);
  std::vector<Regions> out(stack.levels.size());
  std::vector<Regions> shadow;
  if (settings.support_type == SupportType::buildplate) shadow = shadows(settings, object, stack);
  Regions falling;  // what comes down from above
  for (std::size_t k = stack.levels.size(); k-- > 0;) {
    stop_if_asked();
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
    falling = free_part(falling, keep_out[k], contacts[k], object);
    if (!shadow.empty()) falling = geometry::subtract(falling, shadow[k]);
    falling = geometry::opening(falling, line * 4 / 10);
    out[k] = falling;
  }
  let_rest(settings, object, stack, out);
  return out;
}

}  // namespace weft::support
