// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/arranged.h"

#include "core/error.h"
#include "core/tolerances.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "pipeline/add_raft.h"
#include "pipeline/room_around.h"
#include "plate/nest.h"
#include "plate/silhouette.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

Point turned(Point p, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  return {rounded(c * p.x - s * p.y), rounded(s * p.x + c * p.y)};
}
void turn(Ring& ring, double degrees) {
  for (Point& p : ring) p = turned(p, degrees);
}

/// The outline as it lies when the model is turned: the middle of the model's box stays where it was.
Regions turned(Regions outline, Ring hull, double degrees) {
  turn(hull, degrees);
  const Point middle = weft::box_of(hull).centre();
  for (auto& region : outline) {
    turn(region.outer, degrees);
    for (auto& hole : region.holes) turn(hole, degrees);
  }
  return moved(std::move(outline), Point{} - middle);
}

/// Outlines that differ by less than rounding are one.
bool alike(const Regions& a, const Regions& b) {
  constexpr double least_share = 0.002;
  return area_mm2(geometry::exclusive_or(a, b)) < least_share * area_mm2(a);
}

/// The ways to lie that differ, and how far each is turned.
struct Ways {
  std::vector<Regions> outlines;
  std::vector<double> turn_deg;
};

Ways ways_of(const mesh::PlacedModel& model, double step_deg) {
  const Regions outline = plate::silhouette_of(model.objects);
  Ways out{{outline}, {0}};
  if (step_deg <= 0) return out;
  for (double turn = step_deg; turn < 359.9; turn += step_deg) {
    auto other = turned(outline, model.hull, turn);
    if (std::any_of(out.outlines.begin(), out.outlines.end(), [&](const Regions& one) { return alike(one, other); }))
      continue;
    out.outlines.push_back(std::move(other));
    out.turn_deg.push_back(turn);
  }
  return out;
}

/// The bed, as large as skirt, tower and head leave it.
plate::NestBed bed_of(const Job& job, const mesh::Plate& free) {
  const Um skirt = skirt_of(job.settings);
  const auto within = skirt > 0 ? geometry::offset({{free.surface, {}}}, {.by = -skirt}) : Regions{};
  const Um apart = apart_of(job.settings);
  plate::NestBed out{within.empty() ? free.surface : within.front().outer,
                     free.keep_out,
                     job.placement.centre.value_or(weft::box_of(free.surface).centre()),
                     std::max(job.placement.spacing, apart > 0 ? apart + tolerances::border : 0),
                     brim_of(job.settings) + wider_of(job.settings),
                     plate::Bar::none};
  if (const auto tower = tower_of(job.settings, out.surface)) out.keep_out.push_back(*tower);
  const PlateSettings& own = job.settings.plate;
  if (own.print_sequence == PrintSequence::one_at_a_time && own.gantry_height)
    out.bar = own.gantry_axis == GantryAxis::x ? plate::Bar::along_x : plate::Bar::along_y;
  return out;
}

std::string file_of(const mesh::ToPlace& model) {
  return std::filesystem::path(model.model->path).filename().string();
}

std::size_t count_of(const std::vector<plate::NestKind>& kinds) {
  std::size_t out = 0;
  for (const auto& kind : kinds) out += kind.copies;
  return out;
}

[[noreturn]] void refuse(const mesh::ToPlace& model, std::size_t placed, std::size_t asked, bool plates) {
  const auto what = asked == 0 || plates ? std::string("there is no room for it")
                                         : fmt::format("there is room for {} of {} copies of it", placed, asked);
  throw Error{Error::Kind::audit, what, model.model->path,
              plates ? "it does not fit on an empty bed"
                     : "print fewer, or with less --spacing; --plates takes as many plates as it needs, --fill prints "
                       "as many as there is room for"};
}

/// Plate after plate, until nothing is left.
std::vector<std::vector<std::vector<plate::Nested>>> on_plates(std::span<const mesh::ToPlace> models,
                                                               std::vector<plate::NestKind> kinds,
                                                               const plate::NestBed& bed) {
  std::vector<std::vector<std::vector<plate::Nested>>> out;
  while (count_of(kinds) > 0) {
    std::vector<std::size_t> left;  // kinds of which there are some
    std::vector<plate::NestKind> some;
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (kinds[k].copies > 0) left.push_back(k), some.push_back(kinds[k]);
    auto places = plate::nest(some, bed);
    auto& own = out.emplace_back(kinds.size());
    std::size_t placed = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      placed += places[i].size();
      kinds[left[i]].copies -= places[i].size();
      own[left[i]] = std::move(places[i]);
    }
    if (placed == 0) refuse(models[left.front()], 0, 0, true);
  }
  return out;
}

}  // namespace

std::string name_of_plate(const std::string& file, std::size_t plate) {
  std::filesystem::path path(file);
  const auto ending = path.extension().string();
  return path.replace_extension().string() + fmt::format("_plate_{}{}", plate, ending);
}

std::vector<std::vector<mesh::Stand>> arranged(const Job& job, std::span<const mesh::ToPlace> models,
                                               const mesh::Plate& free, Report& report) {
  const auto& p = job.placement;
  const auto ways =
      tasks::parallel_map(models.size(), [&](std::size_t i) { return ways_of(*models[i].model, p.turn_deg); });
  std::vector<plate::NestKind> kinds;
  for (std::size_t i = 0; i < models.size(); ++i)
    kinds.push_back(
        {ways[i].outlines, p.fill && models[i].copies == 1 ? 0 : models[i].copies,
         models[i].model->box.max.z + raft_lift(job.settings) > job.settings.plate.gantry_height.value_or(0)});
  const auto bed = bed_of(job, free);
  std::vector<std::vector<std::vector<plate::Nested>>> plates;
  if (p.plates)
    plates = on_plates(models, kinds, bed);
  else
    plates.push_back(plate::nest(kinds, bed));
  for (std::size_t k = 0; !p.plates && k < models.size(); ++k)
    if (plates[0][k].size() < std::max<std::size_t>(kinds[k].copies, 1))
      refuse(models[k], plates[0][k].size(), kinds[k].copies, false);
  if (static_cast<std::size_t>(p.on_plate) > std::max<std::size_t>(plates.size(), 1))
    throw Error{Error::Kind::usage, fmt::format("there are {} plates", plates.size()), "on_plate", {}};
  for (const auto& own : plates) {
    auto& told = report.plates.emplace_back();
    for (std::size_t k = 0; k < models.size(); ++k)
      if (!own[k].empty()) told.push_back({file_of(models[k]), own[k].size()});
  }
  report.plate = p.on_plate;
  std::vector<std::vector<mesh::Stand>> out(models.size());
  if (plates.empty()) return out;
  const auto& own = plates[static_cast<std::size_t>(p.on_plate) - 1];
  for (std::size_t k = 0; k < models.size(); ++k)
    for (const auto& [at, turn] : own[k]) out[k].push_back({at, ways[k].turn_deg[turn]});
  return out;
}

}  // namespace weft::pipeline
