// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/seam_lines.h"

#include "core/stop.h"
#include "travel/blocks.h"
#include "travel/box_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft::travel {
namespace {

/// What hides a seam is worth that far a step aside for each micron of its height, where it is to line up …
constexpr double aligned_worth = 1;
/// … and where hiding comes first: there a corner a fifth better is worth a new line in a layer or two.
constexpr double sharpest_worth = 30;
/// Towards the back, or a point, it is worth that much way, µm.
constexpr double worth_of_way_um = 3000;
/// A line that breaks off costs as much as one that steps that far aside, µm: how far it leaps makes no difference.
constexpr double break_um = 6000;
/// z_seam_overhang_weight of a place whose outer half is all over air counts as much against it as z_seam_corner_weight
/// of so many of the sharpest corners counts for one: what begins there would be dragged along, so that a line steps
/// millimetres aside for it, and stays there as long as it must.
constexpr double air_worth = 60;
/// So many places of a wall are looked at; there are rarely more that a line could pass.
constexpr std::size_t most_places = 24;
/// A seam this near to a junction begins at it, µm.
constexpr Um snap_um = 50;

double area_um2(const Box& box) {
  return box.empty() ? 0 : (static_cast<double>(box.size().x) + 1) * (static_cast<double>(box.size().y) + 1);
}

double common_um2(const Box& a, const Box& b) {
  return area_um2({{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
                   {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}});
}

/// How much of what two boxes cover both do, 0 … 1.
double share_of(const Box& a, const Box& b) {
  const double both = common_um2(a, b);
  return both / (area_um2(a) + area_um2(b) - both);
}

/// How far a line steps aside between two places, µm.
float step_um(Point a, Point b) {
  return static_cast<float>(std::min(distance(a, b), break_um));
}

/// None where there are no places.
std::optional<Start> nearest_of(const std::vector<Start>& places, Point p) {
  const auto found = std::min_element(places.begin(), places.end(), [&](const Start& a, const Start& b) {
    return distance2(a.at, p) < distance2(b.at, p);
  });
  return found != places.end() ? std::optional(*found) : std::nullopt;
}

bool lines_up(SeamType type) {
  return type == SeamType::aligned || type == SeamType::sharpest_corner;
}

}  // namespace

Start SeamLines::random_place(const Wall& wall, std::uint64_t seed) {
  const Start start = random_start(*wall.bead, seed);
  if (!wall.bearing || hang_of(*wall.bead, start, *wall.bearing) <= most_hang) return start;
  return nearest_of(borne_places(*wall.bead, *wall.bearing), start.at).value_or(start);
}

/// Which of the places of a wall a line from that point on the wall below goes to at the least cost, and at which.
std::pair<std::uint32_t, float> SeamLines::onward(const Wall& wall, Point from) const {
  std::pair<std::uint32_t, float> best{none, 0};
  for (std::uint32_t k = wall.begin; k < wall.end; ++k)
    if (const float cost = step_um(places_[k].start.at, from) + places_[k].cost_um;
        best.first == none || cost < best.second)
      best = {k, cost};
  return best;
}

/// The places of a wall where a line may well pass, the cheapest first: corners, and where the lines below lead
/// straight up. One that a line at another place could step to at no more cost is left out.
void SeamLines::add_places(const Wall& wall, const Question& ask) {
  const Bead& bead = *wall.bead;
  const TravelSettings& settings = ask.settings;
  const auto type = settings.z_seam_type;
  const bool line = lines_up(type);
  const Wall* below = line && wall.below != none ? &walls_[wall.below] : nullptr;
  const Point goal{settings.z_seam_x, settings.z_seam_y};
  const double worth_um =
      !line ? worth_of_way_um
            : (type == SeamType::aligned ? aligned_worth : sharpest_worth) * static_cast<double>(ask.height);
  std::vector<Place> found;
  const auto add_place = [&](const Start& start, double seen, double hang) {
    const Point p = start.at;
    // Of two places of a line that are alike the one at the back.
    const double way = type == SeamType::user   ? distance(p, goal)
                       : type == SeamType::back ? -1.0 * p.y
                       : line && !below         ? -1e-3 * p.y
                                                : 0.0;
    const auto cost = static_cast<float>(worth_um * (seen + air_worth * settings.z_seam_overhang_weight * hang) + way);
    found.push_back({start, cost, below ? cost + onward(*below, p).second : cost});
  };
  std::optional<std::vector<Start>> borne;
  const auto add = [&](const Start& start, double strength, double exposure) {
    const double hang = wall.bearing ? hang_of(bead, start, *wall.bearing) : 0;
    add_place(start, settings.z_seam_visibility_weight * exposure - settings.z_seam_corner_weight * strength, hang);
    if (hang <= most_hang) return;
    if (!borne) borne = borne_places(bead, *wall.bearing);  // of these the nearest, which hides nothing
    if (const auto at = nearest_of(*borne, start.at)) add_place(*at, 0, hang_of(bead, *at, *wall.bearing));
  };
  if (!below) add(type == SeamType::user ? nearest_start(bead, goal, snap_um) : rearmost_start(bead), 0, 0);
  for (const Corner& c : ask.corners)
    add({c.junction, bead.path[c.junction].at}, static_cast<double>(c.strength), static_cast<double>(c.exposure));
  const auto needless = [](auto begin, auto end, const Place& place) {
    return std::any_of(
        begin, end, [&](const Place& p) { return p.cost_um + step_um(p.start.at, place.start.at) <= place.cost_um; });
  };
  // A line that would better have stepped to a corner does so no later than here.
  for (std::uint32_t k = below ? below->begin : 0; below && k < below->end; ++k)
    if (const Place& place = places_[k]; !needless(found.begin(), found.end(), place))
      add(nearest_start(bead, place.start.at, snap_um), 0, 0);
  std::stable_sort(found.begin(), found.end(), [](const Place& a, const Place& b) { return a.cost_um < b.cost_um; });
  const std::size_t most = line ? most_places : 1;
  for (const Place& place : found)
    if (places_.size() - wall.begin < most && !needless(places_.begin() + wall.begin, places_.end(), place))
      places_.push_back(place);
}

void SeamLines::add(const Prepared& layer) {
  if (layer.input.time.comes_down) tops_.clear();
  for (const auto& object : layer.input.objects)
    if (object.stack >= tops_.size()) tops_.resize(object.stack + std::size_t{1});
  layers_.push_back(&layer);
  std::vector<Top> now(tops_.size());
  std::vector<BoxTree> trees;
  for (const Top& top : tops_) {
    trees.emplace_back(top.boxes);
    for (std::uint32_t i = 0; i < top.boxes.size(); ++i) trees.back().set(i, top.boxes[i]);
  }
  for (std::size_t s = 0; s < layer.seams.size(); ++s) {
    stop_if_asked();
    const auto& seam = layer.seams[s];
    const Block& block = layer.blocks[seam.block];
    const auto stack = layer.input.objects[block.object].stack;
    const auto& settings = seams_of(settings_, layer.input, block);
    const Top& top = tops_[stack];
    Wall wall{.bead = &beads_of(layer.input, block)[seam.bead],
              .bearing = settings.z_seam_overhang_weight > 0 && top.layer ? &top.layer->outline : nullptr};
    const Box box = box_of(*wall.bead);
    double best = 0;
    trees[stack].search(
        1, [&](const Box& b, double) { return 1 - common_um2(b, box) / area_um2(box); },
        [&](std::uint32_t i) {
          if (const double share = share_of(top.boxes[i], box); share > best) best = share, wall.below = top.walls[i];
          return 1 - best;
        });
    wall.begin = static_cast<std::uint32_t>(places_.size());
    if (settings.z_seam_type == SeamType::random)
      places_.push_back({random_place(wall, (std::uint64_t{layer.input.time.index} << 32) + s), 0, 0});
    else
      add_places(wall, {settings, seam.corners, height_of(layer.input, block)});
    wall.end = static_cast<std::uint32_t>(places_.size());
    walls_.push_back(wall);
    now[stack].walls.push_back(static_cast<std::uint32_t>(walls_.size() - 1)), now[stack].boxes.push_back(box);
  }
  // A layer without outer walls does not end the lines.
  for (std::size_t stack = 0; stack < now.size(); ++stack)
    if (!now[stack].walls.empty()) tops_[stack] = std::move(now[stack]);
  for (const auto& object : layer.input.objects) tops_[object.stack].layer = &layer;
}

std::vector<std::vector<Start>> SeamLines::chosen() {
  // What a place costs with all that stands on it, from the top down; then what is cheapest, from the bottom up.
  for (Place& place : places_) place.cost_um = place.own_um;
  for (std::size_t w = walls_.size(); w-- > 0;)
    if (const auto below = walls_[w].below; below != none)
      for (std::uint32_t k = walls_[below].begin; k < walls_[below].end; ++k)
        places_[k].cost_um += onward(walls_[w], places_[k].start.at).second;
  std::vector<std::uint32_t> at;
  for (const Wall& wall : walls_) {
    const auto cheapest = std::min_element(places_.begin() + wall.begin, places_.begin() + wall.end,
                                           [](const Place& a, const Place& b) { return a.cost_um < b.cost_um; });
    at.push_back(wall.below == none ? static_cast<std::uint32_t>(cheapest - places_.begin())
                                    : onward(wall, places_[at[wall.below]].start.at).first);
  }
  std::vector<std::vector<Start>> out;
  std::size_t w = 0;
  for (const Prepared* layer : layers_) {
    auto& starts = out.emplace_back();
    for (std::size_t s = 0; s < layer->seams.size(); ++s, ++w) starts.push_back(places_[at[w]].start);
  }
  walls_.clear(), places_.clear(), layers_.clear(), tops_.clear();
  return out;
}

}  // namespace weft::travel
