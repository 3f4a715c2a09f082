// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/tower.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::tools {
namespace {

/// Lines of a tower are a quarter wider than the nozzle: they hold together without being neat.
constexpr double lines_by_nozzle = 1.25;
/// The least side of a tower that stands by itself: a fifth of its height, and not less than this.
constexpr Um least_side = 10'000;
constexpr double side_by_height = 0.2;

/// What is filled lies within the wall's middle line.
Um inner(Um side, Um line) {
  return side - 2 * line;
}

/// How a strip is laid: lines of a width, so far from one to the next.
struct Laid {
  Um width, pitch;
};
/// What is rammed has to be where it was reckoned to be; the lowest section holds the tower.
Laid laid(const ToolSettings& settings, const TowerLayer::Strip& strip, Um line, bool lowest) {
  if (strip.ram) return {line, line};
  const Um width = rounded(line * settings.prime_tower_purge_width / 100);
  return {width, lowest ? width : rounded(width * settings.prime_tower_purge_spacing / 100)};
}

/// Lines of a strip joined at their ends, each in the room between walls so far apart.
Um lines_of(const TowerLayer::Strip& strip, const Laid& as, Um height, Um length) {
  const double needed = 1000 * strip.mm3 / (to_mm(as.width) * to_mm(height));
  return static_cast<Um>(std::ceil((needed + as.pitch) / (length - as.width + as.pitch) - 1e-6));
}

/// Do the layer's strips fit when lines are `along` long and lie side by side over `across`?
bool fits(const ToolSettings& settings, const TowerLayer& layer, bool lowest, Um line, Um along, Um across) {
  Um sum = 0;
  for (const auto& strip : layer.strips) {
    const auto as = laid(settings, strip, line, lowest);
    sum += lines_of(strip, as, layer.height_of(strip), along) * as.pitch;
  }
  return sum <= across;
}

/// How far a tower that gets wider leans out, so far up.
Um leans(const ToolSettings& settings, Um up) {
  return rounded(std::tan(settings.prime_tower_flare_angle * std::numbers::pi / 180) * std::max(0, up));
}

/// What a section's strips cover.
double mm2_of(const TowerLayer& section) {
  double sum = 0;
  for (const auto& strip : section.strips) sum += strip.mm3 / to_mm(std::max(section.height_of(strip), Um{1}));
  return sum;
}

Point turned(Point p, double degrees, Point corner) {
  const double a = degrees * std::numbers::pi / 180;
  return {corner.x + rounded(p.x * std::cos(a) - p.y * std::sin(a)),
          corner.y + rounded(p.x * std::sin(a) + p.y * std::cos(a))};
}

Ring rectangle(Um from, Um width, Um depth) {
  return {{from, from}, {width - from, from}, {width - from, depth - from}, {from, depth - from}};
}

Ring placed(Ring ring, double degrees, Point corner) {
  for (auto& p : ring) p = turned(p, degrees, corner);
  return ring;
}

Bead bead_of(std::vector<Point> points, Um line, bool closed) {
  Bead bead;
  for (const Point p : points) bead.path.push_back({p, line, 1.F});
  bead.role = Role::wipe_tower;
  bead.closed = closed;
  return bead;
}

/// Lines side by side from `at` on, joined at alternating ends.
/// @param turned_side whether they run along Y
std::vector<Point> zigzag(Um at, Um pitch, Um count, Um begin, Um end, bool along_y) {
  std::vector<Point> out;
  for (Um i = 0; i < count; ++i) {
    const Um across = at + i * pitch;
    const Um from = i % 2 == 0 ? begin : end, to = i % 2 == 0 ? end : begin;
    out.push_back(along_y ? Point{across, from} : Point{from, across});
    out.push_back(along_y ? Point{across, to} : Point{to, across});
  }
  return out;
}

}  // namespace

bool lay_beside(const TowerLayer& film, TowerLayer& section, Um held, Um nozzle) {
  auto beside = film;
  beside.height += section.height;
  if (film.strips.empty() || beside.height > (2 * film.height < section.height ? nozzle : held)) return false;
  if (mm2_of(beside) + mm2_of(section) >= mm2_of(film)) return false;
  for (auto& strip : section.strips) strip.height = section.height_of(strip);
  section.z = beside.z, section.height = beside.height;
  section.strips.insert(section.strips.end(), beside.strips.begin(), beside.strips.end());
  return true;
}

TowerSize tower_size(const ToolSettings& settings, std::span<const TowerLayer> layers, Um nozzle) {
  TowerSize out;
  out.line = rounded(lines_by_nozzle * nozzle);
  double most_mm2 = 0;
  Um top = 0;
  for (const auto& layer : layers) {
    most_mm2 = std::max(most_mm2, mm2_of(layer));
    top = std::max(top, layer.z);
  }
  const auto first =
      std::find_if(layers.begin(), layers.end(), [](const auto& layer) { return !layer.strips.empty(); });
  if (first != layers.end()) out.first = first->z - first->height;
  const Um least = std::max(least_side, rounded(side_by_height * top));
  const Um square = rounded(1000 * std::sqrt(most_mm2)) + 2 * out.line;
  out.width = settings.prime_tower_width.value_or(std::max(least, square));
  out.depth = settings.prime_tower_width ? least : out.width;
  const auto all_fit = [&] {
    const Um w = inner(out.width, out.line), d = inner(out.depth, out.line);
    return std::all_of(layers.begin(), layers.end(), [&](const TowerLayer& layer) {
      const bool lowest = &layer == &layers.front();
      return fits(settings, layer, lowest, out.line, w, d) && fits(settings, layer, lowest, out.line, d, w);
    });
  };
  while (!all_fit()) {
    out.depth += out.line;
    if (!settings.prime_tower_width) out.width += out.line;
  }
  out.height = top;
  if (settings.prime_tower_shape == TowerShape::plain && !layers.empty()) {
    const Um in = leans(settings, out.first - layers.front().z);
    out.foot = {std::clamp((out.width - least) / 2, 0, in), std::clamp((out.depth - least) / 2, 0, in)};
  }
  return out;
}

namespace {

/// How much narrower a section that ends at z is, on either side.
Point narrower(const ToolSettings& settings, const TowerSize& size, Um z) {
  const Um in = leans(settings, size.first - z);
  return {std::min(size.foot.x, in), std::min(size.foot.y, in)};
}

/// Where a layer's lines run.
struct Lines {
  Um line = 0;
  bool along_y = false;
  Um begin = 0, end = 0;   ///< of each line; the ends are round
  Um first = 0, last = 0;  ///< of their middles, across
  Um height = 0;
  Um pitch = 0;  ///< of those of a strip …
  Um aside = 0;  ///< … whose middles lie so much farther in, as they are wider

  double mm3(const Bead& bead) const { return volume_mm3(bead, height); }
  /// @param at where the middle of a line as wide as the tower's would be, nearest to what is laid already
  Bead strip(Um at, Um count) const {
    return bead_of(zigzag(at + aside, pitch, count, begin, end, along_y), line, false);
  }
};

/// Lines of a strip among the tower's.
Lines of_strip(const Lines& lines, const Laid& as, Um height) {
  Lines out = lines;
  out.line = as.width, out.pitch = as.pitch, out.height = height;
  out.aside = (as.width - lines.line) / 2;
  out.begin += out.aside, out.end -= out.aside;
  return out;
}

/// What fills the room behind the strips: dense in the lowest layer.
std::optional<Bead> grid(const ToolSettings& settings, const Lines& lines, std::size_t index, Um at) {
  const Um pitch = index == 0 ? lines.line : std::max(lines.line, settings.prime_tower_max_bridging_distance);
  const Um room = lines.last - at;
  if (room < 0) return std::nullopt;
  const Um first = index == 0 ? at : at + std::min(room, pitch / 2);
  const Um count = (lines.last - first) / pitch + 1;
  return bead_of(zigzag(first, pitch, count, lines.begin, lines.end, lines.along_y), lines.line, false);
}

/// Takes what is too much off the end of the strip's last line, of which as much as two widths stays.
void shorten(Bead& strip, double by_mm3, const Lines& lines) {
  if (by_mm3 <= 0 || strip.path.size() < 2) return;
  const Point from = strip.path[strip.path.size() - 2].at;
  Point& to = strip.path.back().at;
  const double length = distance(from, to);
  const double by = 1000 * by_mm3 / (to_mm(lines.line) * to_mm(lines.height));
  const double stays = std::max(length - std::floor(by), 2.0 * lines.line);
  if (length <= stays) return;
  to = {from.x + rounded((to.x - from.x) * stays / length), from.y + rounded((to.y - from.y) * stays / length)};
}

/// Ribs run along the diagonals, so many lines wide, and reach beyond the corners by a share of what of the tower is
/// above.
constexpr Um lines_of_rib = 4;
constexpr double rib_by_height = 0.12;
constexpr int corners_of_cone = 96;

/// What the tower stands by at a height: beside its walls.
Regions beside_walls(const ToolSettings& settings, const TowerSize& size, Um z) {
  const Regions walls{{rectangle(0, size.width, size.depth), {}}};
  const double above = std::max(0, size.height - z);
  Regions all;
  if (settings.prime_tower_shape == TowerShape::cone) {
    const double radius = std::tan(settings.prime_tower_cone_angle / 2 * std::numbers::pi / 180) * above;
    Ring ring;
    for (int i = 0; i < corners_of_cone; ++i) {
      const double a = 2 * std::numbers::pi * i / corners_of_cone;
      ring.push_back({size.width / 2 + rounded(radius * std::cos(a)), size.depth / 2 + rounded(radius * std::sin(a))});
    }
    all.push_back({std::move(ring), {}});
  }
  if (settings.prime_tower_shape == TowerShape::ribs) {
    const Um out = rounded(rib_by_height * above / std::numbers::sqrt2), side = lines_of_rib * size.line * 5 / 14;
    for (const Point corner : {Point{0, 0}, {size.width, 0}, {size.width, size.depth}, {0, size.depth}}) {
      const Um dx = corner.x == 0 ? -1 : 1, dy = corner.y == 0 ? -1 : 1;
      // Half its width to both sides of the diagonal, from within the walls outwards.
      const auto at = [&](Um along, Um aside) {
        return Point{corner.x + dx * along - dy * aside, corner.y + dy * along + dx * aside};
      };
      Ring ring{at(-side, -side), at(out, -side), at(out, side), at(-side, side)};
      if (double_area(ring) < 0) std::reverse(ring.begin(), ring.end());
      all.push_back({std::move(ring), {}});
    }
  }
  return geometry::subtract(all, walls);
}

/// Loops beside the wall. @param full as many as there is room for, else one
void add_loops(const Regions& regions, Um line, bool full, Beads& out) {
  for (Um in = line / 2;; in += line) {
    const auto rest = geometry::offset(regions, {.by = -in});
    for (const auto& region : rest) out.push_back(bead_of(region.outer, line, true));
    if (rest.empty() || !full) return;
  }
}

/// The outline that the brim goes round.
Regions foot_of(const ToolSettings& settings, const TowerSize& size) {
  auto out = beside_walls(settings, size, 0);
  out.push_back({rectangle(0, size.width, size.depth), {}});
  return geometry::unite(out);
}

/// The wall, and the brim of the lowest layer.
Beads walls(const ToolSettings& settings, const TowerSize& size, std::size_t index, Um z) {
  const Um line = size.line;
  Bead wall = bead_of(rectangle(line / 2, size.width, size.depth), line, true);
  // The seam goes round, so that it is no edge that the tower breaks along.
  std::rotate(wall.path.begin(), wall.path.begin() + static_cast<std::ptrdiff_t>(index % 4), wall.path.end());
  Beads out{std::move(wall)};
  if (settings.prime_tower_shape == TowerShape::plain) {
    if (index == 0)
      for (Um out_by = line; out_by <= settings.prime_tower_brim_width; out_by += line)
        out.push_back(bead_of(rectangle(line / 2 - out_by, size.width, size.depth), line, true));
    return out;
  }
  add_loops(beside_walls(settings, size, z), line, index == 0 || settings.prime_tower_shape == TowerShape::ribs, out);
  if (index == 0)
    for (Um out_by = line; out_by <= settings.prime_tower_brim_width; out_by += line)
      for (const auto& region : geometry::offset(foot_of(settings, size), {.by = out_by - line / 2}))
        out.push_back(bead_of(region.outer, line, true));
  return out;
}

}  // namespace

std::vector<TowerBeads> tower_beads(const ToolSettings& settings, const TowerSize& full, const TowerLayer& layer,
                                    std::size_t index, Point corner) {
  const bool along_y = index % 2 != 0;
  const Point in = narrower(settings, full, layer.z);
  TowerSize size = full;
  size.width -= 2 * in.x, size.depth -= 2 * in.y;
  const Um line = size.line, half = line + line / 2;
  const Um along = along_y ? size.depth : size.width, across = along_y ? size.width : size.depth;
  const Lines lines{line, along_y, half, along - half, half, across - half, layer.height};
  auto around = walls(settings, size, index, layer.z);
  double of_walls = 0;
  for (const Bead& bead : around) of_walls += lines.mm3(bead);
  std::vector<TowerBeads> out;
  const auto add = [&](std::size_t pass, Bead bead, Um height, bool ram = false) {
    auto at = std::find_if(out.begin(), out.end(), [&](const auto& b) { return b.pass == pass && b.ram == ram; });
    if (at == out.end()) at = out.insert(out.end(), TowerBeads{pass, {}, ram, height});
    for (auto& junction : bead.path) junction.at = turned(junction.at + in, settings.prime_tower_angle, corner);
    at->beads.push_back(std::move(bead));
  };
  // The strip of what prints the wall comes last: it is as wide as wall and grid leave to be purged.
  Um at = half;
  const TowerLayer::Strip* last = nullptr;
  for (const auto& strip : layer.strips) {
    if (strip.mm3 <= 0) continue;
    if (layer.wall_purges && strip.pass == layer.wall_pass && !strip.ram) {
      last = &strip;
      continue;
    }
    const auto as = laid(settings, strip, line, index == 0);
    const auto own = of_strip(lines, as, layer.height_of(strip));
    const Um count = lines_of(strip, as, own.height, inner(along, line));
    Bead bead = own.strip(at, count);
    if (!strip.ram) shorten(bead, own.mm3(bead) - strip.mm3, own);
    add(strip.pass, std::move(bead), own.height, strip.ram);
    at += count * as.pitch;
  }
  const auto as = last != nullptr ? laid(settings, *last, line, index == 0) : Laid{line, line};
  const auto own = of_strip(lines, as, layer.height);
  for (Um count = 0; last != nullptr; ++count) {
    std::optional<Bead> strip;
    if (count > 0) strip = own.strip(at, count);
    const Um behind = at + count * as.pitch;
    const auto rest = grid(settings, lines, index, behind);
    const double sum = of_walls + (strip ? own.mm3(*strip) : 0) + (rest ? lines.mm3(*rest) : 0);
    if (sum < last->mm3 && behind <= lines.last) continue;
    if (strip) {
      shorten(*strip, sum - last->mm3, own);
      add(last->pass, std::move(*strip), layer.height);
    }
    at = behind;
    break;
  }
  if (auto rest = grid(settings, lines, index, at)) add(layer.wall_pass, std::move(*rest), layer.height);
  for (Bead& bead : around) add(layer.wall_pass, std::move(bead), layer.height);
  return out;
}

Ring tower_outline(const ToolSettings& settings, const TowerSize& size, Point corner) {
  const Um brim = settings.prime_tower_brim_width / size.line * size.line;
  const Point in{std::min(size.foot.x - brim, 0), std::min(size.foot.y - brim, 0)};
  if (settings.prime_tower_shape != TowerShape::plain)
    if (const auto foot = geometry::offset(foot_of(settings, size), {.by = brim}); !foot.empty())
      return placed(foot.front().outer, settings.prime_tower_angle, corner);
  const Point end{size.width - in.x, size.depth - in.y};
  return placed({in, {end.x, in.y}, end, {in.x, end.y}}, settings.prime_tower_angle, corner);
}

std::optional<Point> place_for_tower(const ToolSettings& settings, const TowerSize& size, const Ring& surface,
                                     std::span<const Ring> forbidden, std::span<const Box> standing, Um gap) {
  const Ring own = tower_outline(settings, size, {0, 0});
  const Box own_box = box_of(own), bed = box_of(surface);
  Point middle = bed.centre();
  Box all;
  for (const Box& box : standing) all.add(box);
  if (!all.empty()) middle = all.centre();
  const Regions on{{surface, {}}};
  Regions off;
  for (const Ring& ring : forbidden) off.push_back({ring, {}});
  constexpr Um step = 1000;
  std::optional<Point> best;
  double nearest = 0;
  for (Um y = bed.min.y - own_box.min.y; y + own_box.max.y <= bed.max.y; y += step)
    for (Um x = bed.min.x - own_box.min.x; x + own_box.max.x <= bed.max.x; x += step) {
      const Box here{{x + own_box.min.x, y + own_box.min.y}, {x + own_box.max.x, y + own_box.max.y}};
      const double away = distance(here.centre(), middle);
      if (best && away >= nearest) continue;
      const Box kept = here.grown(gap);
      if (std::any_of(standing.begin(), standing.end(), [&](const Box& box) { return box.overlaps(kept); })) continue;
      Ring moved = own;
      for (auto& p : moved) p = p + Point{x, y};
      const Regions area{{moved, {}}};
      if (!geometry::subtract(area, on).empty() || (!off.empty() && !geometry::intersect(area, off).empty())) continue;
      best = Point{x, y}, nearest = away;
    }
  return best;
}

Outside outside_of(const Ring& outline, const Ring& surface) {
  Outside out;
  const Regions beyond = geometry::subtract(Regions{{outline, {}}}, Regions{{surface, {}}});
  for (const auto& region : beyond)
    for (const Point p : region.outer) {
      double least = 1e18;
      for (std::size_t i = 0; i < surface.size(); ++i) {
        const Point a = surface[i], b = surface[(i + 1) % surface.size()];
        const double dx = b.x - a.x, dy = b.y - a.y, sq = dx * dx + dy * dy;
        const double t = sq > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / sq, 0.0, 1.0) : 0.0;
        least = std::min(least, std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy));
      }
      if (rounded(least) > out.by) out = {rounded(least), p};
    }
  return out;
}

}  // namespace weft::tools
