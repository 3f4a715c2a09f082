// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "travel/block_chain.h"
#include "travel/blocks.h"

#include <algorithm>
#include <map>

namespace weft::travel {
namespace {

/// Seams of one layer, sorted by x, so that those near a wall are found without looking at all.
std::span<const Point> near(const std::vector<Point>& sorted, const Bead& bead) {
  constexpr Um reach = 6000;
  Um least = max_coord, most = -max_coord;
  for (const auto& j : bead.path) least = std::min(least, j.at.x), most = std::max(most, j.at.x);
  const auto first = std::lower_bound(sorted.begin(), sorted.end(), Point{least - reach, -max_coord});
  const auto last = std::upper_bound(first, sorted.end(), Point{most + reach, max_coord});
  return {first, last};
}

/// The stack that a seam of the layer belongs to.
std::uint32_t stack_of(const Prepared& layer, const SeamChoices& seam) {
  return layer.input.objects[layer.blocks[seam.block].object].stack;
}

/// A part stands where the seam of its first outer wall is, else where its first bead begins.
std::vector<Point> places_of(const Prepared& layer, const std::vector<Start>& seams) {
  std::vector<Point> places;
  for (const auto& block : layer.blocks) {
    const std::uint32_t first = block.walls.empty() ? block.fills.front() : block.walls.front();
    places.push_back(beads_of(layer.input, block)[first].path.front().at);
  }
  for (std::size_t s = seams.size(); s-- > 0;) places[layer.seams[s].block] = seams[s].at;
  return places;
}

bool starts_with_adhesion(const Prepared& layer) {
  return !layer.blocks.empty() && layer.blocks[0].object == Block::adhesion;
}

/// Whose a block is, of each block; none where the layer has no support.
std::vector<BlockOwner> owners_of(const Prepared& layer) {
  const auto& objects = layer.input.objects;
  if (std::none_of(objects.begin(), objects.end(), [](const ObjectLayer& o) { return o.support; })) return {};
  std::vector<BlockOwner> out;
  for (const auto& block : layer.blocks)
    out.push_back(block.object == Block::adhesion
                      ? BlockOwner{}
                      : BlockOwner{objects[block.object].object, objects[block.object].support});
  return out;
}

/// Support is printed before what stands on it, and all of an object's together: a branch that waits for its neighbours
/// on the other side of the plate cools and curls.
void put_support_first(const std::vector<BlockOwner>& owners, std::vector<std::uint32_t>& order) {
  if (owners.empty()) return;
  std::map<ObjectId, std::vector<std::uint32_t>> support;  // in their order
  for (const std::uint32_t block : order)
    if (owners[block].support) support[owners[block].object].push_back(block);
  std::vector<std::uint32_t> out;
  for (const std::uint32_t block : order) {
    if (const auto first = support.find(owners[block].object); first != support.end()) {
      out.insert(out.end(), first->second.begin(), first->second.end());
      support.erase(first);
    }
    if (!owners[block].support) out.push_back(block);
  }
  order = std::move(out);
}

/// What follows each other of support, or of parts, in the shortest order from what is before it to what comes after.
/// @param fixed  so many at the beginning stay where they are
void shorten_runs(const std::vector<BlockOwner>& owners, const Linked& layer, std::size_t fixed,
                  std::vector<std::uint32_t>& order) {
  if (owners.empty()) return;
  std::optional<Point> from = fixed > 0 ? layer.places[order[fixed - 1]] : layer.from;
  for (std::size_t begin = fixed, end = fixed; begin < order.size(); begin = end) {
    std::vector<Point> places;
    std::vector<std::uint32_t> run, as_it_is;
    for (; end < order.size() && owners[order[end]].support == owners[order[begin]].support; ++end) {
      as_it_is.push_back(static_cast<std::uint32_t>(run.size()));
      run.push_back(order[end]), places.push_back(layer.places[order[end]]);
    }
    const auto to = end < order.size() ? std::optional(layer.places[order[end]]) : std::nullopt;
    std::size_t k = begin;
    for (const auto i : shortened(places, as_it_is, {from, to})) order[k++] = run[i];
    from = layer.places[order[end - 1]];
  }
}

}  // namespace

Linker::Linker(const TravelSettings& settings)
    : settings_(settings), chain_(std::make_unique<BlockChain>(settings.path_order)) {}
Linker::~Linker() = default;

/// Seams of a layer, each beside those of its stack below. A layer without outer walls does not end the seam lines.
std::vector<Start> Linker::choose_seams(const Prepared& layer) {
  std::vector<Start> starts;
  std::vector<std::vector<Point>> chosen(below_.size());
  for (std::size_t s = 0; s < layer.seams.size(); ++s) {
    stop_if_asked();
    const auto& seam = layer.seams[s];
    const Bead& bead = beads_of(layer.input, layer.blocks[seam.block])[seam.bead];
    const std::uint64_t seed = (std::uint64_t{layer.input.time.index} << 32) + s;
    const auto stack = stack_of(layer, seam);
    const auto& below = below_[stack];
    starts.push_back(choose_seam(seams_of(settings_, layer.input, layer.blocks[seam.block]), bead, seam.corners,
                                 {near(below.seams, bead), below.layer ? &below.layer->outline : nullptr}, seed));
    chosen[stack].push_back(starts.back().at);
  }
  for (std::size_t stack = 0; stack < chosen.size(); ++stack) {
    if (chosen[stack].empty()) continue;
    std::sort(chosen[stack].begin(), chosen[stack].end());
    below_[stack].seams = std::move(chosen[stack]);
  }
  return starts;
}

void Linker::add(const Prepared& layer) {
  if (layer.input.time.comes_down) below_.clear();
  for (const auto& object : layer.input.objects)
    if (object.stack >= below_.size()) below_.resize(object.stack + std::size_t{1});
  owners_.push_back(owners_of(layer));
  Linked& out = linked_.emplace_back();
  out.seams = choose_seams(layer);
  for (const auto& object : layer.input.objects) below_[object.stack].layer = &layer;
  out.places = places_of(layer, out.seams);
  const bool adhesion = starts_with_adhesion(layer);
  BlockPlaces blocks;
  if (adhesion) blocks.before = out.places[0], out.block_order.push_back(0);
  blocks.places.assign(out.places.begin() + (adhesion ? 1 : 0), out.places.end());
  blocks.small = !owners_.back().empty();
  chain_->add(std::move(blocks));
}

std::vector<Linked> Linker::linked() {
  const auto orders = chain_->orders();
  std::optional<Point> at;
  for (std::size_t i = 0; i < linked_.size(); ++i) {
    Linked& out = linked_[i];
    out.from = at;
    const auto skip = static_cast<std::uint32_t>(out.block_order.size());
    for (const std::uint32_t b : orders[i]) out.block_order.push_back(b + skip);
    put_support_first(owners_[i], out.block_order);
    if (settings_.path_order == PathOrder::optimized) shorten_runs(owners_[i], out, skip, out.block_order);
    if (out.block_order.empty()) continue;
    out.begin = out.places[out.block_order.front()];
    at = out.places[out.block_order.back()];
  }
  for (std::size_t i = linked_.size(); i-- > 1;)
    linked_[i - 1].next = linked_[i].begin ? linked_[i].begin : linked_[i].next;
  owners_.clear();
  return std::move(linked_);
}

std::vector<Linked> link(const TravelSettings& settings, std::span<const Prepared> layers) {
  Linker linker(settings);
  for (const auto& layer : layers) linker.add(layer);
  return linker.linked();
}

}  // namespace weft::travel
