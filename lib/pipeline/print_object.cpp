// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/outline_length.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "model/flow.h"
#include "overhangs/overhangs.h"
#include "pipeline/cached.h"
#include "pipeline/handed_to.h"
#include "pipeline/infill_figures.h"
#include "pipeline/inner_infill.h"
#include "pipeline/key_bytes.h"
#include "pipeline/object_scopes.h"
#include "pipeline/prepared_infill.h"
#include "pipeline/printed_outlines.h"
#include "pipeline/shelled.h"
#include "pipeline/slice_object.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"
#include "pipeline/support_object.h"
#include "pipeline/swaying.h"
#include "pipeline/told_apart.h"
#include "pipeline/wall_object.h"
#include "slice/slice.h"
#include "tasks/parallel.h"
#include "tasks/spare.h"
#include "walls/walls.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Of an object that stands there: places are told as they are on the bed.
void append(Notices& to, std::vector<PlacedNotice> from, Point offset) {
  for (auto& notice : from) {
    const Point at = notice.at + offset;
    to.push_back(
        {std::move(notice.code), fmt::format("{}, at {:.2f}, {:.2f}", notice.message, to_mm(at.x), to_mm(at.y))});
  }
}

using Walls = ResultOf<Stage::walls>;

/// What walls tell of an object, one notice a kind: of its first place, and how many more there are in the layers that
/// have walls.
void tell_walls(const std::string& object, Walls& walls, const Sample& sample, Point offset, Notices& to) {
  struct Kind {
    PlacedNotice first;
    std::size_t count = 0;
    std::size_t last_layer = 0;
  };
  std::vector<Kind> kinds;
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (auto& notice : walls[i].notices) {
      auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.first.code == notice.code; });
      if (kind == kinds.end()) kind = kinds.insert(kinds.end(), Kind{std::move(notice)});
      ++kind->count, kind->last_layer = i;
    }
  for (auto& [first, count, last_layer] : kinds) {
    const Point at = first.at + offset;
    auto message = fmt::format("{}: {}, at {:.2f}, {:.2f}", object, first.message, to_mm(at.x), to_mm(at.y));
    if (count > 1)
      message +=
          fmt::format(", and so in {} more place{} up to layer {}", count - 1, count == 2 ? "" : "s", last_layer);
    if (!sample.all()) message += fmt::format("; one of {} layers was looked at", sample.stride);
    to.push_back({std::move(first.code), std::move(message)});
  }
}

/// What the nozzle would bend aside, above all that support holds.
void tell_swaying(const Settings& settings, const Object& object, const Cuts& cuts, const std::vector<Regions>& held,
                  Notices& to) {
  const auto above = std::find_if(held.rbegin(), held.rend(), [](const Regions& r) { return !r.empty(); });
  const Um nozzle = settings.machine.nozzle_diameter;
  const auto found =
      most_swaying(cuts, static_cast<std::size_t>(held.rend() - above),
                   length_or(settings.walls.wall_line_width_0, nozzle, flow::automatic_outer_width(nozzle)));
  if (!found) return;
  const Point at = found->at + object.copies.front();
  to.push_back(
      {"part_sways",
       fmt::format("{}: {:.1f} mm of it stand on {:.2f} mm² at ({:.3f}, {:.3f}, {:.3f}) and give way to the "
                   "nozzle; lay it down (--orient auto), or hold it with support (--support-mesh)",
                   object.name, found->height_mm, found->area_mm2, to_mm(at.x), to_mm(at.y), to_mm(found->z))});
}

using Fills = ResultOf<Stage::infill>;

/// What rests on support is printed otherwise than what hangs.
StageKey with_held(StageKey key, const std::vector<Regions>& held) {
  std::string bytes;
  for (const auto& regions : held) bytes += bytes_of(regions);
  if (!held.empty()) key.with(sha256(bytes));
  return key;
}

/// The parts of a layer that lie in these regions.
infill::LayerAreas parts_in(const infill::LayerAreas& parts, const std::vector<std::uint32_t>& regions) {
  infill::LayerAreas out;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(out),
               [&](const auto& part) { return std::binary_search(regions.begin(), regions.end(), part.part); });
  return out;
}

/// Of a layer of several areas.
template <class Fill>
FillLayer fill_of_areas(const std::vector<Told>& told, const infill::LayerAreas& parts, const Fill& fill) {
  FillLayer out;
  for (const auto& [scope, regions] : told) put_behind(fill(scope, parts_in(parts, regions)), out);
  return out;
}

/// What the beads of a layer grow with. @param inside of its walls, as `inside_of` has it, whether it has beads or not
LayerMeasure measure_of(const SlicedLayer& layer, const Regions& inside, const infill::LayerAreas& areas) {
  LayerMeasure out;
  const double height_mm = to_mm(layer.height);
  const auto add = [&](Growth to, const Regions& regions, int layers = 1) {
    const double mm2 = area_mm2(regions);
    out[to].length += mm2, out[to].volume += mm2 * height_mm * layers;
  };
  out[Growth::walls] = {geometry::outline_mm(layer.regions), (area_mm2(layer.regions) - area_mm2(inside)) * height_mm};
  out[Growth::layers] = {1, 1};
  for (const auto& part : areas) {
    add(Growth::solid, part.solid);
    add(Growth::solid, part.belted);
    add(Growth::top, part.top);
    add(Growth::sparse, part.sparse);
    add(Growth::sparse, part.combined, part.combined_layers);
    for (const auto& bridge : part.bridges) add(bridge.ledge ? Growth::solid : Growth::bridge, bridge.regions);
  }
  return out;
}

/// Adds the object's layers above its bottom to what a sample stands for.
void measure(const Running& job, const WallHands& handed, const Cuts& cuts, const std::vector<Areas>& areas,
             const std::vector<infill::LayerAreas>& parts, std::size_t copies) {
  const auto measures = tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    const auto& layer = cuts[i].layer;
    return measure_of(layer, nominal_inside(handed, areas[i], layer, i), parts[i]);
  });
  for (std::size_t i = Sample::own_kind; i < measures.size(); ++i)
    (job.sample.has(i) ? job.measure->planned : job.measure->left_out).add(measures[i], static_cast<double>(copies));
}

/// How an object lies on the bed.
struct Lying {
  Point at;               ///< its first copy
  double turned_rad = 0;  ///< against its file
};

/// Fills what is of other settings than its areas. @returns how many beads each has @param parts then know of it
template <class Fill>
std::vector<std::uint32_t> fill_inner(std::vector<InnerInfill> inner, const Fill& fill, FillLayer& to,
                                      infill::LayerAreas& parts) {
  std::vector<std::uint32_t> out;
  for (auto& [scope, own] : inner) {
    const std::size_t before = to.beads.size();
    put_behind(fill(scope, own), to);
    out.push_back(static_cast<std::uint32_t>(to.beads.size() - before));
    std::move(own.begin(), own.end(), std::back_inserter(parts));
  }
  return out;
}

/// Beads of a layer, and what later stages are told of its areas.
FilledLayer told_of(infill::LayerAreas parts, FillLayer filled, std::vector<std::uint32_t> inner_beads) {
  FilledLayer out{{}, {}, {}, std::move(filled.beads), std::move(inner_beads), std::move(filled.notices)};
  for (auto& part : parts) {
    out.skin.insert(out.skin.end(), part.top.begin(), part.top.end());
    std::move(part.solid.begin(), part.solid.end(), std::back_inserter(out.skin));
    std::move(part.belted.begin(), part.belted.end(), std::back_inserter(out.skin));
    std::move(part.top.begin(), part.top.end(), std::back_inserter(out.top));
    std::move(part.sparse.begin(), part.sparse.end(), std::back_inserter(out.sparse));
    std::move(part.combined.begin(), part.combined.end(), std::back_inserter(out.sparse));
  }
  return out;
}

/// What the walls left, as shells look at it.
Shelled shelled(const FillHands& handed, const Scopes& scopes, const Cuts& cuts, const std::vector<Areas>& areas,
                const Walls& walls, const std::vector<Regions>& held, const Lying& lying) {
  Shelled object{handed, scopes, areas, std::vector<infill::ShellLayer>(cuts.size()), {}, 0, {}};
  std::vector<const Regions*> outlines;
  for (const auto& cut : cuts) outlines.push_back(&cut.layer.regions);
  object.open = open_to_infill(scopes, areas, outlines);
  for (std::size_t i = 0; i < cuts.size(); ++i)
    object.layers[i] = {cuts[i].layer.z,
                        cuts[i].layer.height,
                        outlines[i],
                        &walls[i].inside,
                        i < held.size() ? &held[i] : nullptr,
                        object.open.empty() ? nullptr : &object.open[i]};
  object.box = infill::box_of(object.layers), object.turned_rad = lying.turned_rad;
  return object;
}

/// Fills a narrow area of a layer as walls fill one: its lines follow its edge, and are together as wide as it is.
Beads lines_along_edge(const Region& area, Um band, const SlicedLayer& layer, Um nozzle) {
  WallSettings lines;
  lines.wall_line_count = 2;            // from both sides
  lines.min_feature_size = nozzle / 2;  // less is left open by all fills
  lines.wall_line_width_0 = lines.wall_line_width_x = LengthOrShare{flow::line_width(band, layer.height)};
  lines.wall_outline = WallOutline::volume;  // what is beside it is no air
  const SlicedLayer alone{layer.z, layer.height, {area}};
  return walls::build(lines, {.layer = alone, .nozzle_diameter = nozzle}).beads;
}

/// Shells and infill.
/// @param looked_at is told what fills the layers, before it is laid
template <class LookedAt>
Fills fill_object(const FillHands& handed, const WallHands& walled, const Scopes& scopes, const ToolScopes& tools,
                  const Cuts& cuts, const std::vector<Areas>& areas, const Walls& walls,
                  const std::vector<Regions>& held, const Sample& sample, const Lying& lying,
                  const LookedAt& looked_at) {
  const Shelled object = shelled(handed, scopes, cuts, areas, walls, held, lying);
  auto parts = find_all_areas(object);
  auto inner = take_all_inner(object, parts);
  look_at_all(object, parts);
  looked_at(parts);
  Box box;  // patterns hang on its centre, so they move with the object
  for (const auto& cut : cuts) box.add(box_of(cut.layer.regions));
  const auto asked = scopes_filling(object, inner);
  const bool on_plate = !asked.empty() && std::get<1>(handed[asked.front()]).infill_phase_frame == InfillFrame::plate;
  const Point origin = box.empty() ? Point{} : on_plate ? Point{} - lying.at : box.centre();
  const auto whole = with_inner(parts, inner);
  const PreparedInfill prepared(handed, asked, {object.layers, object.box, 0, 1, lying.turned_rad},
                                whole ? *whole : parts, origin, lying.at);
  const Um reach =
      box.empty() ? 0
                  : std::max({origin.x - box.min.x, box.max.x - origin.x, origin.y - box.min.y, box.max.y - origin.y});
  // Layers are let go of as they are filled: what the next one must know of their bridges is set aside.
  std::vector<std::vector<infill::BridgeArea>> bridges(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (const auto& part : parts[i]) bridges[i].insert(bridges[i].end(), part.bridges.begin(), part.bridges.end());
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    if (!sample.has(i)) return FilledLayer{};
    const auto& layer = cuts[i].layer;
    const auto fill = [&](ScopeId scope, const infill::LayerAreas& own) {
      const auto& [shells, infill, nozzle, wall_line_width, overlap_factor] = handed[tools.infill_of(scope, scopes)];
      const auto& [own_walls, own_nozzle] = walled[scope];
      return infill::fill(infill, shells,
                          {.areas = own,
                           .index = i,
                           .z = layer.z,
                           .height = layer.height,
                           .nozzle = nozzle,
                           .overlap_factor = overlap_factor,
                           .wall_line_width = length_or(wall_line_width, nozzle, 0),
                           .outer_wall_line_width = length_or(own_walls.wall_line_width_0, own_nozzle, 0),
                           .wall_count = own_walls.wall_line_count,
                           .origin = origin,
                           .turned_rad = lying.turned_rad,
                           .reach = reach,
                           .prepared = prepared.of(object.scope_of(scope)),
                           .topmost = i + 1 == cuts.size(),
                           .above = i + 1 < cuts.size() ? &cuts[i + 1].layer.regions : nullptr,
                           .bridges_below = i > 0 ? std::span<const infill::BridgeArea>(bridges[i - 1])
                                                  : std::span<const infill::BridgeArea>{},
                           .along_edge = [&layer, across = nozzle](const Region& area, Um band) {
                             return lines_along_edge(area, band, layer, across);
                           }});
    };
    auto filled = areas[i].size() == 1 ? fill(areas[i].front().scope, parts[i])
                                       : fill_of_areas(told_apart(handed, areas[i]), parts[i], fill);
    auto inner_beads = fill_inner(std::move(inner[i]), fill, filled, parts[i]);
    return told_of(std::exchange(parts[i], {}), std::move(filled), std::move(inner_beads));
  });
}

/// Each bead is told the scope of its part, or of the inner area that it is of.
/// @param inner_beads how many each inner area has: the last ones
void tell_scopes(const Areas& areas, const std::vector<std::uint32_t>& inner_beads, Beads& beads) {
  std::vector<ScopeId> of_part;
  for (const auto& area : areas) of_part.resize(of_part.size() + area.regions, area.scope);
  for (auto& bead : beads)
    if (areas.size() == 1 || bead.part < of_part.size())
      bead.scope = areas.size() == 1 ? areas.front().scope : of_part[bead.part];
  std::vector<ScopeId> of_inner;
  for (const auto& area : areas)
    for (const auto& inner : area.inner) of_inner.push_back(inner.scope);
  auto end = beads.end();
  for (std::size_t k = std::min(of_inner.size(), inner_beads.size()); k-- > 0;) {
    const auto begin = end - inner_beads[k];
    for (; end != begin;) (--end)->scope = of_inner[k];
  }
}

/// @param held of each layer, what rests on support; empty: nothing does
PrintedLayers put_together(Cuts cuts, const std::vector<Areas>& areas, Walls walls, Fills fills,
                           const std::vector<Regions>& held, Notices& notices) {
  PrintedLayers out(cuts.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    auto& layer = cuts[i].layer;
    auto& fill = fills[i];
    out[i] = {layer.z,
              layer.height,
              std::move(layer.regions),
              std::move(fill.skin),
              std::move(fill.top),
              std::move(fill.sparse),
              std::move(walls[i].over_air),
              std::move(walls[i].beads)};
    std::move(fill.beads.begin(), fill.beads.end(), std::back_inserter(out[i].beads));
    tell_scopes(areas[i], fill.inner_beads, out[i].beads);
    if (i < held.size()) mark_supported(held[i], out[i].beads);
    std::move(fill.notices.begin(), fill.notices.end(), std::back_inserter(notices));
  }
  return out;
}

/// Tips are thinner than any bead: the print ends where the last one is laid, not where the mesh does.
void drop_empty_top(const Sample& sample, PrintedLayers& layers) {
  while (layers.size() > 1 && sample.has(layers.size() - 1) && layers.back().beads.empty()) layers.pop_back();
}

}  // namespace

PrintedLayers print_object(const Running& job, const Scopes& all_scopes, const ToolScopes& tools,
                           const ObjectScopes& scopes, const Object& object, SupportOf& support) {
  auto& notices = job.report.warnings;
  const Point at = object.copies.front();
  const auto slice_hands = hand<Stage::slice>(all_scopes);
  std::vector<Areas> areas;
  auto sliced = slice_object(job, object, scopes, all_scopes, slice_hands, areas);
  append(notices, slice::notices_of(*sliced, object.name), at);

  Running kept = job;
  if (!job.sample.all()) kept.cache = nullptr;  // a sample is no stage's result
  const auto wall_hands = hand<Stage::walls>(all_scopes);
  WallsOfObject walls_of(wall_hands, all_scopes, *sliced, areas, job.sample);
  // Where columns fall level by level on one thread, others lay walls meanwhile. A cache may have those already.
  tasks::Spare spare(kept.cache == nullptr ? (*sliced).size() : 0, [&](std::size_t i) { walls_of.lay_ahead(i); });
  const auto sliced_by = [&] { return slice_hashes(object, scopes, all_scopes, slice_hands); };
  support_object(job, all_scopes, scopes, object, {*sliced, sliced_by, spare}, support);

  const auto walled_by = [&] {
    auto key = key_of<Stage::walls>(scopes, wall_hands);
    for (const auto& hash : sliced_by()) key.with(hash);
    return with_held(std::move(key), support.held);
  };
  auto walled = run_stage<Stage::walls>(kept, walled_by,
                                        [&] { return walls_of.build(std::move(support.over_air), support.held); });

  tell_missing_support(job, all_scopes, scopes, object, *sliced, *walled);
  tell_swaying(all_scopes[all_scopes.above_first_layer(scopes.front().of_mix.front())], object, *sliced, support.held,
               notices);
  const auto fill_hands = hand<Stage::infill>(all_scopes);
  const auto looked_at = [&](const std::vector<infill::LayerAreas>& parts) {
    if (!job.sample.all()) measure(job, wall_hands, *sliced, areas, parts, object.copies.size());
  };
  const auto filled_by = [&] {
    auto key = key_of<Stage::infill>(scopes, fill_hands)
                   .with(walled_by().hash())
                   .with(files_of_infill(all_scopes, at, object.turned_deg));
    if (tools.several())
      for (const auto& from : scopes)
        for (const ScopeId id : from.of_mix) key.with(fill_hands.bytes_of(tools.infill_of(id, all_scopes)));
    return key;
  };
  auto filled = run_stage<Stage::infill>(kept, filled_by, [&] {
    const Lying lying{at, object.turned_deg * std::numbers::pi / 180};
    return fill_object(fill_hands, wall_hands, all_scopes, tools, *sliced, areas, *walled, support.held, job.sample,
                       lying, looked_at);
  });
  auto cuts = std::move(sliced).take();
  move_outlines(wall_hands, all_scopes, areas, cuts);
  Walls walls = std::move(walled).take();
  tell_walls(object.name, walls, job.sample, at, notices);
  auto out = put_together(std::move(cuts), areas, std::move(walls), std::move(filled).take(), support.held, notices);
  drop_empty_top(job.sample, out);
  for (auto& layer : out) tools.tell(layer.beads, all_scopes);
  if (job.sample.all()) tell_infill(all_scopes[scopes.front().of_mix.front()], out, job.report);
  return out;
}

}  // namespace weft::pipeline
