// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "travel/block_chain.h"
#include "travel/blocks.h"
#include "travel/seam_lines.h"

#include <algorithm>
#include <map>

namespace weft::travel {
namespace {

/// Whose a block is.
struct BlockOwner {
  ObjectId object = ~ObjectId{0};
  bool support = false;
};

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
    : settings_(settings),
      seams_(std::make_unique<SeamLines>(settings)),
      chain_(std::make_unique<BlockChain>(settings.path_order)) {}
Linker::~Linker() = default;

void Linker::add(const Prepared& layer) {
  seams_->add(layer);
  layers_.push_back(&layer);
}

std::vector<Linked> Linker::linked() {
  const auto seams = seams_->chosen();
  std::vector<Linked> linked(layers_.size());
  std::vector<std::vector<BlockOwner>> owners;  // of each layer, by block; or none
  for (std::size_t i = 0; i < linked.size(); ++i) {
    Linked& out = linked[i];
    owners.push_back(owners_of(*layers_[i]));
    out.seams = seams[i];
    out.places = places_of(*layers_[i], out.seams);
    const bool adhesion = starts_with_adhesion(*layers_[i]);
    BlockPlaces blocks;
    if (adhesion) blocks.before = out.places[0], out.block_order.push_back(0);
    blocks.places.assign(out.places.begin() + (adhesion ? 1 : 0), out.places.end());
    blocks.small = !owners.back().empty();
    chain_->add(std::move(blocks));
  }
  layers_.clear();
  const auto orders = chain_->orders();
  std::optional<Point> at;
  for (std::size_t i = 0; i < linked.size(); ++i) {
    Linked& out = linked[i];
    out.from = at;
    const auto skip = static_cast<std::uint32_t>(out.block_order.size());
    for (const std::uint32_t b : orders[i]) out.block_order.push_back(b + skip);
    put_support_first(owners[i], out.block_order);
    if (settings_.path_order == PathOrder::optimized) shorten_runs(owners[i], out, skip, out.block_order);
    if (out.block_order.empty()) continue;
    out.begin = out.places[out.block_order.front()];
    at = out.places[out.block_order.back()];
  }
  for (std::size_t i = linked.size(); i-- > 1;) linked[i - 1].next = linked[i].begin ? linked[i].begin : linked[i].next;
  return linked;
}

std::vector<Linked> link(const TravelSettings& settings, std::span<const Prepared> layers) {
  Linker linker(settings);
  for (const auto& layer : layers) linker.add(layer);
  return linker.linked();
}

}  // namespace weft::travel
