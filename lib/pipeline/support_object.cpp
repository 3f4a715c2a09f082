// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/support_object.h"

#include "core/alike.h"
#include "core/tolerances.h"
#include "geometry/boolean.h"
#include "geometry/box_columns.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "model/flow.h"
#include "pipeline/cached.h"
#include "pipeline/fill_support.h"
#include "pipeline/key_bytes.h"
#include "pipeline/nozzles.h"
#include "pipeline/room_around.h"
#include "pipeline/stopwatch.h"
#include "pipeline/tell_marks.h"
#include "slice/shadow.h"
#include "support/support.h"
#include "tasks/parallel.h"
#include "walls/walls.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

using namespace weft::literals;

Regions moved_ring(const Ring& ring, Point by) {
  return weft::moved(Regions{{ring, {}}}, by);
}

/// The print surface less half a bead, and what a skirt around support takes, as seen from an object whose copies stand
/// at these offsets.
Regions surface_for(const Settings& settings, const Object& object, Um half_bead) {
  const Regions surface =
      geometry::offset({{print_surface(settings.machine), {}}}, {.by = -half_bead - skirt_of(settings)});
  Regions out;
  for (std::size_t i = 0; i < object.copies.size(); ++i) {
    const Regions here = weft::moved(surface, -object.copies[i]);
    out = i == 0 ? here : geometry::intersect(out, here);
  }
  return out;
}

/// What no copy's support may enter.
Regions barred_for(const Settings& settings, const std::vector<Object>& objects, std::size_t of, Um half_bead) {
  Regions out;
  const auto& own = objects[of].copies;
  const Um apart =
      settings.support.support_xy_distance.of(length_or(
          settings.walls.wall_line_width_0, settings.machine.nozzle_diameter, settings.machine.nozzle_diameter)) +
      half_bead;
  for (const Point by : own) {
    for (const Ring& ring : settings.machine.bed_exclude_areas)
      for (auto& region : geometry::offset(moved_ring(ring, -by), {.by = half_bead})) out.push_back(std::move(region));
    for (std::size_t other = 0; other < objects.size(); ++other)
      for (const Point to : objects[other].copies) {
        if (other == of && to == by) continue;
        for (auto& region : geometry::offset(moved_ring(objects[other].hull, to - by), {.by = apart}))
          out.push_back(std::move(region));
      }
  }
  return out.empty() ? out : geometry::unite(out);
}

constexpr double worth_telling_mm2 = 0.5;

void tell(const Settings& settings, const Object& object, const support::Figures& figures, Report& report) {
  auto& total = report.support;
  const std::size_t copies = object.copies.size();  // as plastic and seconds are those of all
  const auto times = static_cast<double>(copies);
  total.needed_mm2 += times * figures.needed_mm2, total.bridged_mm2 += times * figures.bridged_mm2;
  total.left_mm2 += times * figures.left_mm2;
  total.contact_mm2 += times * figures.contact_mm2, total.on_part_mm2 += times * figures.on_part_mm2;
  total.trapped_mm3 += times * figures.trapped_mm3;
  total.islands += copies * figures.islands, total.tips += copies * figures.tips;
  total.trunks += copies * figures.trunks;
  total.slenderest = std::max(total.slenderest, figures.slenderest);
  if (figures.left_mm2 < worth_telling_mm2) return;
  const Point at = Point{figures.left_at.x, figures.left_at.y} + object.copies.front();
  std::string why;
  if (settings.support.support_type == SupportType::buildplate)
    why = " from the plate" +
          (figures.left_to_part_mm2 < worth_telling_mm2
               ? std::string()
               : fmt::format("; support_type = everywhere would reach {:.1f} mm²", figures.left_to_part_mm2));
  report.warnings.push_back(
      {"support_left",
       fmt::format("{}: {:.1f} mm² of overhang, first at ({:.3f}, {:.3f}, {:.3f}), cannot be reached{}", object.name,
                   figures.left_mm2, to_mm(at.x), to_mm(at.y), to_mm(figures.left_at.z), why)});
}

bool says_support(const mesh::Mark& mark) {
  return mark.kind == mesh::MarkKind::support_enforcer || mark.kind == mesh::MarkKind::support_blocker ||
         mark.kind == mesh::MarkKind::support;
}
bool has_marks(const Object& object) {
  return std::any_of(object.marks.begin(), object.marks.end(), says_support);
}

/// Whether anything may ask for support: a volume that is support does, whatever the settings say.
bool supports(const Settings& settings, const Object& object) {
  return settings.support.support_enable || settings.support.support_enforce_layers > 0 ||
         std::any_of(object.marks.begin(), object.marks.end(),
                     [](const mesh::Mark& mark) { return mark.kind == mesh::MarkKind::support; });
}

/// What one mark marks.
struct AreasOfMark {
  std::uint32_t mark = 0;
  std::vector<Regions> by_layer;
};

/// Volumes and painted facets as areas of layers.
std::vector<AreasOfMark> read_marks(const Settings& settings, const Object& object, const std::vector<slice::Cut>& cuts,
                                    SupportOf& out) {
  std::vector<AreasOfMark> of_marks;
  if (!has_marks(object)) return of_marks;
  std::vector<slice::Plane> planes;  // in the middle of layers, as those of the part
  for (const auto& cut : cuts) planes.push_back({cut.layer.z, cut.layer.height, cut.layer.z - cut.layer.height / 2});
  for (std::uint32_t m = 0; m < object.marks.size(); ++m) {
    const auto& mark = object.marks[m];
    if (!says_support(mark)) continue;
    auto& own = of_marks.emplace_back(AreasOfMark{m, {}}).by_layer;
    if (mark.painted) {
      own = slice::shadows(mark.mesh, planes);
    } else {
      const slice::Cutter cutter(mark.mesh, planes);
      own = tasks::parallel_map(planes.size(),
                                [&](std::size_t i) { return std::move(cutter.cut(i, settings.layers).layer.regions); });
    }
    auto& to = mark.kind == mesh::MarkKind::support_enforcer  ? out.enforced
               : mark.kind == mesh::MarkKind::support_blocker ? out.blocked
                                                              : out.given;
    to.resize(planes.size());
    for (std::size_t i = 0; i < own.size(); ++i) to[i].insert(to[i].end(), own[i].begin(), own[i].end());
  }
  for (auto* by_layer : {&out.enforced, &out.blocked, &out.given})
    for (auto& regions : *by_layer)
      if (regions.size() > 1) regions = geometry::unite(regions);
  return of_marks;
}

/// The outlines that support knows, and those of layers.
struct Outlines {
  std::vector<const SlicedLayer*> layers;
  support::Object object;
  Box box;
};

Outlines outlines_of(const Settings& settings, const std::vector<slice::Cut>& cuts) {
  Outlines out;
  for (const auto& cut : cuts) out.layers.push_back(&cut.layer), out.box.add(box_of(cut.layer.regions));
  const Um nozzle = settings.machine.nozzle_diameter;
  out.object = {.layers = out.layers,
                .nozzle = nozzle,
                .outer_line = length_or(settings.walls.wall_line_width_0, nozzle, flow::automatic_outer_width(nozzle))};
  return out;
}

/// Whether walls make anything of a region that small: the tips of what hangs down are thinner than any bead.
bool is_printed(const Settings& settings, const SlicedLayer& layer, std::size_t index, const Region& region) {
  const SlicedLayer alone{layer.z, layer.height, {region}};
  const auto walls = walls::build(
      settings.walls, {.layer = alone, .index = index, .nozzle_diameter = settings.machine.nozzle_diameter});
  return !walls.beads.empty() || !walls.inside.empty();
}

/// The regions of a layer, asked for what lies on them.
class Below {
 public:
  explicit Below(const Regions& regions) : regions_(regions), columns_(boxes_of(regions)) {}

  /// Whether any corner of a region lies on one of them.
  bool holds(const Region& region) const {
    return std::any_of(region.outer.begin(), region.outer.end(), [&](Point p) {
      bool held = false;
      columns_.each_around(p, [&](std::uint32_t r) { held = held || side_of(regions_[r], p) != Side::outside; });
      return held;
    });
  }

 private:
  static std::vector<Box> boxes_of(const Regions& regions) {
    std::vector<Box> out;
    for (const Region& region : regions) out.push_back(box_of(region.outer));
    return out;
  }

  const Regions& regions_;
  geometry::BoxColumns columns_;
};

/// What is too small to be printed asks for no support and lies on none: what is printed first above it does. What lies
/// on something that is printed is held already, so that only the lowest specks of what hangs down are asked, up to the
/// first one that is.
/// @param kept  takes the layers that have less
void leave_out_specks(const Settings& settings, Outlines& outlines, std::vector<SlicedLayer>& kept) {
  const Um least = outlines.object.outer_line;
  const auto specks = tasks::parallel_map(outlines.layers.size(), [&](std::size_t i) {
    const Regions& regions = outlines.layers[i]->regions;
    std::vector<std::size_t> out;
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (const Point size = box_of(regions[r].outer).size(); std::max(size.x, size.y) < least) out.push_back(r);
    return out;
  });
  kept.resize(outlines.layers.size());
  for (std::size_t i = 0; i < specks.size(); ++i) {
    if (specks[i].empty()) continue;
    const SlicedLayer& layer = *outlines.layers[i];
    static const Regions nothing;
    const Below below(i > 0 ? outlines.layers[i - 1]->regions : nothing);
    Regions small;
    for (const std::size_t r : specks[i]) small.push_back(layer.regions[r]);
    const auto held = tasks::parallel_map(small.size(), [&](std::size_t s) { return char{below.holds(small[s])}; });
    const auto like = first_alike(small);  // one of each kind is built
    std::vector<char> asked(small.size(), 0);
    for (std::size_t s = 0; s < small.size(); ++s) asked[like[s]] |= char{held[s] == 0};
    const auto printed = tasks::parallel_map(
        small.size(), [&](std::size_t s) { return char{asked[s] != 0 && is_printed(settings, layer, i, small[s])}; });
    std::vector<char> stays(layer.regions.size(), 1);
    for (std::size_t s = 0; s < small.size(); ++s) stays[specks[i][s]] = char{held[s] != 0 || printed[like[s]] != 0};
    if (std::find(stays.begin(), stays.end(), 0) == stays.end()) continue;
    kept[i] = {layer.z, layer.height, {}};
    for (std::size_t r = 0; r < stays.size(); ++r)
      if (stays[r] != 0) kept[i].regions.push_back(layer.regions[r]);
    outlines.layers[i] = &kept[i];
  }
  outlines.object.layers = outlines.layers;
}

/// What has nothing below, where specks that were left out change nothing.
/// @param of_mesh  of each layer, with its specks
std::vector<const Regions*> known_over_air(const std::vector<const Regions*>& of_mesh,
                                           const std::vector<SlicedLayer>& without_specks) {
  auto out = of_mesh;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (without_specks[i].height > 0 || (i > 0 && without_specks[i - 1].height > 0)) out[i] = nullptr;
  return out;
}

/// Enforcers of which nothing is held: they lie where nothing overhangs.
std::vector<std::uint32_t> idle_enforcers(const Object& object, const std::vector<AreasOfMark>& areas,
                                          const support::Demand& demand) {
  std::vector<std::uint32_t> out;
  for (const auto& mark : areas) {
    if (object.marks[mark.mark].kind != mesh::MarkKind::support_enforcer) continue;
    bool holds = false;
    for (std::size_t i = 0; i < std::min(demand.size(), mark.by_layer.size()) && !holds; ++i)
      holds = !mark.by_layer[i].empty() && !demand[i].wanted.empty() &&
              !geometry::intersect(demand[i].wanted, mark.by_layer[i]).empty();
    if (!holds) out.push_back(mark.mark);
  }
  return out;
}

struct TwoLayers {
  Regions own, below;
};
/// Two layers without what is the same in both: straight legs and pins, on which everything lies. Regions of a layer
/// lie apart.
TwoLayers but_for_equal(const Regions& own, const Regions& below) {
  std::vector<const Region*> sorted;
  for (const Region& region : below) sorted.push_back(&region);
  const auto begins = [](const Region& region) { return region.outer.front(); };
  const auto before = [&](const Region* a, const Region* b) { return begins(*a) < begins(*b); };
  std::sort(sorted.begin(), sorted.end(), before);
  TwoLayers out;
  std::vector<char> equal(below.size(), 0);
  for (const Region& region : own) {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), &region, before);
    const auto same = std::find_if(first, last, [&](const Region* r) { return *r == region; });
    if (same == last)
      out.own.push_back(region);
    else
      equal[static_cast<std::size_t>(*same - below.data())] = 1;
  }
  for (std::size_t i = 0; i < below.size(); ++i)
    if (equal[i] == 0) out.below.push_back(below[i]);
  return out;
}

double plastic_mm3(const PrintedLayer& layer) {
  double um2 = 0;
  for (const Bead& bead : layer.beads) {
    const std::size_t n = bead.path.size();
    for (std::size_t i = 1; i < n + (bead.closed ? 1 : 0); ++i) {
      const Junction &a = bead.path[i - 1], &b = bead.path[i % n];
      um2 += distance(a.at, b.at) * (a.width + b.width) / 2;
    }
  }
  return um2 * layer.height * 1e-9;
}

/// What a stage of support reads besides settings.
StageKey support_key(const std::string& settings, const std::vector<std::string>& sliced, const Object& object,
                     const SupportOf& of) {
  StageKey key(row_of<Stage::support>());
  key.with(settings).with(std::uint64_t{sliced.size()});
  for (const auto& hash : sliced) key.with(hash);
  for (const auto& mark : object.marks)
    if (says_support(mark))
      key.with(std::uint64_t{static_cast<std::uint8_t>(mark.kind)})
          .with(mark.painted)
          .with(sha256(bytes_of(mark.mesh)));
  key.with(of.bounded).with(of.on_raft).with(of.floor).with(sha256(bytes_of(of.room)));
  return key;
}

/// @param of_object  how the object is printed
/// @param settings   how its support is
Supports make_supports(const Settings& of_object, const Settings& settings, const Object& object,
                       const SupportFrom& from, SupportOf& of) {
  const auto& cuts = from.cuts;
  const auto marks = read_marks(of_object, object, cuts, of);
  auto outlines = outlines_of(of_object, cuts);
  std::vector<SlicedLayer> without_specks;
  leave_out_specks(of_object, outlines, without_specks);
  auto& o = outlines.object;
  o.nozzle = settings.machine.nozzle_diameter;
  o.floor = of.floor, o.on_raft = of.on_raft, o.room = of.bounded ? &of.room : nullptr;
  o.enforced = of.enforced, o.blocked = of.blocked, o.given = of.given;
  of.over_air = tasks::parallel_map(cuts.size(), [&](std::size_t i) { return over_air_of(cuts, i); });
  std::vector<const Regions*> over_air;
  for (const Regions& regions : of.over_air) over_air.push_back(&regions);
  over_air = known_over_air(over_air, without_specks);
  o.over_air = over_air;
  const auto demand = support::demand(settings.support, o);
  auto plan = support::plan(settings.support, o, demand, from.spare);
  if (settings.support.support_type == SupportType::buildplate && plan.figures.left_mm2 >= worth_telling_mm2) {
    SupportSettings anywhere = settings.support;  // what the user could have instead
    anywhere.support_type = SupportType::everywhere;
    plan.figures.left_to_part_mm2 =
        plan.figures.left_mm2 - support::plan(anywhere, o, demand, from.spare).figures.left_mm2;
  }
  const Point origin = outlines.box.empty() ? Point{} : outlines.box.centre();
  Supports out;
  out.layers = fill_support(settings, plan.layers, origin);
  for (std::size_t k = 0; k < plan.trapped.size(); ++k)
    plan.figures.trapped_mm3 += plan.trapped[k] * plastic_mm3(out.layers[k]);
  // Levels go all the way up; where nothing stands on one, no layer begins.
  std::erase_if(out.layers, [](const PrintedLayer& layer) { return layer.beads.empty(); });
  if (!plan.layers.empty()) out.held = std::move(plan.held);
  out.figures = plan.figures;
  out.idle_enforcers = idle_enforcers(object, marks, demand);
  return out;
}

}  // namespace

Regions over_air_of(const std::vector<slice::Cut>& cuts, std::size_t i) {
  if (i == 0) return {};
  const Regions &own = cuts[i].layer.regions, &below = cuts[i - 1].layer.regions;
  if (own.size() < 2 && below.size() < 2) return geometry::subtract(own, below);
  const TwoLayers differ = but_for_equal(own, below);
  return geometry::subtract(differ.own, differ.below);
}

std::vector<SupportOf> rooms_of(const Scopes& scopes, const Plate& plate) {
  const auto& objects = plate.objects;
  const Settings& settings = scopes[0];
  std::vector<SupportOf> out(objects.size());
  bool any = false;
  for (std::size_t i = 0; i < scopes.size(); ++i)
    for (const auto& object : objects) any = any || supports(scopes[static_cast<ScopeId>(i)], object);
  if (!any) return out;
  Um width = 0;  // the widest of any scope
  for (std::size_t i = 0; i < scopes.size(); ++i) {
    const Settings own = of_support(settings, scopes[static_cast<ScopeId>(i)]);
    width = std::max(
        width, length_or(own.support.support_line_width, own.machine.nozzle_diameter, own.machine.nozzle_diameter));
  }
  const Um half_bead = (width + 1) / 2 + tolerances::border;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    out[i].on_raft = settings.adhesion.adhesion_type == AdhesionType::raft;
    if (out[i].on_raft) out[i].floor = -settings.raft.raft_airgap;
    out[i].bounded = settings.support.support_outside == SupportOutside::route;
    if (!out[i].bounded) continue;
    out[i].room = surface_for(settings, objects[i], half_bead);
    const Regions barred = barred_for(settings, objects, i, half_bead);
    if (!barred.empty()) out[i].room = geometry::subtract(out[i].room, barred);
  }
  return out;
}

void support_object(const Running& job, const Scopes& all, const ObjectScopes& scopes, const Object& object,
                    const SupportFrom& from, SupportOf& out) {
  const ScopeId on_first_layer = scopes.front().of_mix.front();
  const ScopeId above = all.above_first_layer(on_first_layer);
  const Settings& settings = all[above];
  if (!supports(settings, object)) {
    if (has_marks(object))
      job.report.warnings.push_back(
          {"support_marks_unused", fmt::format("{}: support that is painted or marked with volumes "
                                               "has no effect: support_enable is off",
                                               object.name)});
    return;
  }
  const Settings own_settings = of_support(all[0], settings);
  const auto read = [&] {
    const auto& reads = row_of<Stage::support>().reads;
    return reads.bytes_of(settings) + reads.bytes_of(own_settings);
  };
  auto made = run_stage<Stage::support>(
      job, [&] { return support_key(read(), from.sliced_by(), object, out); },
      [&] { return make_supports(settings, own_settings, object, from, out); });
  tell_marks(settings, object, from.cuts, out, job.report.warnings);
  tell(settings, object, (*made).figures, job.report);
  job.report.support.layers += (*made).layers.size();
  for (const auto mark : (*made).idle_enforcers)
    job.report.warnings.push_back(
        {"support_enforcer_idle",
         fmt::format("{}: meets no downward face, so it asks for nothing",
                     object.marks[mark].name.empty() ? object.name : object.marks[mark].name)});
  Supports own = std::move(made).take();
  out.layers = std::move(own.layers), out.held = std::move(own.held);
  for (std::size_t k = 0; k < out.layers.size(); ++k)
    for (auto& bead : out.layers[k].beads) bead.scope = k == 0 && !out.on_raft ? on_first_layer : above;
}

void tell_missing_support(const Running& job, const Scopes& all, const ObjectScopes& scopes, const Object& object,
                          const std::vector<slice::Cut>& cuts, const std::vector<WallLayer>& walls) {
  const Settings& settings = all[all.above_first_layer(scopes.front().of_mix.front())];
  if (supports(settings, object)) return;
  const Stopwatch stopwatch(job.report.timings_ms[Stage::support]);
  auto outlines = outlines_of(settings, cuts);
  std::vector<SlicedLayer> without_specks;
  leave_out_specks(settings, outlines, without_specks);
  std::vector<const Regions*> over_air;
  if (job.sample.all())
    for (const auto& layer : walls) over_air.push_back(&layer.over_air);
  over_air = known_over_air(over_air, without_specks);
  outlines.object.over_air = over_air;
  const auto islands = support::islands(outlines.object);
  if (islands.empty()) return;
  const Point at = islands.front().at + object.copies.front();
  const auto& layer = cuts[islands.front().layer].layer;
  job.report.warnings.push_back(
      {"support_missing",
       fmt::format("{}: {} place{} begin{} in the air, the first at ({:.3f}, {:.3f}, {:.3f}); turn the model, or set "
                   "support_enable = true",
                   object.name, islands.size(), islands.size() == 1 ? "" : "s", islands.size() == 1 ? "s" : "",
                   to_mm(at.x), to_mm(at.y), to_mm(layer.z - layer.height))});
}

/// Marks skin most of which lies on support.
void mark_supported(const Regions& held, Beads& beads) {
  if (held.empty()) return;
  const geometry::SegmentIndex index(held);
  for (Bead& bead : beads) {
    if (bead.role != Role::solid_infill) continue;
    double on = 0, all = 0;
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Point a = bead.path[i - 1].at, b = bead.path[i].at;
      const double length = distance(a, b);
      all += length;
      if (index.region_at(lerp(a, b, 0.5))) on += length;
    }
    bead.on_support = on > all / 2;
  }
}

}  // namespace weft::pipeline
