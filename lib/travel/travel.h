// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/plan.h"
#include "settings/groups/retraction.h"
#include "settings/groups/travel.h"
#include "travel/comb.h"
#include "travel/seam.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// From the beads of a layer to the steps that print them: order, seams, and the ways between.
///
///   prepare  each layer on its own       seam candidates, comb boundary
///   link     one layer after the other   seams that line up, the order of the parts
///   order    each layer on its own       the order of the beads
///   route    each layer on its own       combed ways, retractions
///
/// Every function is pure; only `link` is sequential, and it is cheap.
namespace weft::travel {

class BlockChain;
class SeamLines;

/// One copy of one object on one layer, in plate coordinates.
struct ObjectLayer {
  ObjectId object = 0;
  std::uint32_t stack = 0;                ///< its seams line up with those of the same stack (model/sequence.h)
  Um height = 0;                          ///< of its layer; 0: as high as the others
  Beads beads;                            ///< walls first, of each part in the order they are to be printed; then fills
  Regions outline;                        ///< of the slice; index = Bead::part
  Regions skin;                           ///< all solid fill: what combing = noskin keeps off
  Regions top;                            ///< what will be seen from above: what combing = no_outer_surfaces keeps off
  Regions sparse;                         ///< sparse infill: what combing = infill keeps to
  Regions over_air;                       ///< where nothing lies below
  bool support = false;                   ///< it stands under the object of that number, and is printed before it
  const TravelSettings* seams = nullptr;  ///< what it has of its own for its seams; null: as everything has it
};

/// Which areas of an ObjectLayer are read with these settings; the others may be left empty.
struct AreasRead {
  bool skin = false, top = false, sparse = false;
};
AreasRead areas_read(const TravelSettings& settings);

/// Where the nozzle may go on a layer.
struct Room {
  Ring reach;               ///< empty: anywhere
  std::vector<Ring> no_go;  ///< of this height
  Um z_max = max_coord;     ///< of lifts
};

/// Everything that is printed at one height.
struct LayerInput {
  Moment time;
  ScopeId scope = 0;  ///< of the layer as a whole
  Um z = 0, height = 0;
  Beads adhesion;  ///< skirt and brim: printed first
  std::vector<ObjectLayer> objects;
  Room room;
  Regions support;                   ///< what stands up to here, or nearly, and is not of this layer
  double filament_area_mm2 = 2.405;  ///< cross-section of the filament: 1.75 mm round
  Um nozzle = 400;                   ///< diameter
};

/// The beads of one part of one object, or the adhesion: printed before the next block begins.
struct Block {
  static constexpr std::uint32_t adhesion = 0xFFFFFFFF;
  static constexpr std::uint32_t no_seam = 0xFFFFFFFF;
  std::uint32_t object = adhesion;          ///< index into LayerInput::objects, not of the plate
  std::vector<std::uint32_t> walls, fills;  ///< indices into the beads of that object: closed walls, and the rest
  std::vector<std::uint32_t> seams;         ///< beside walls: index into Prepared::seams, or no_seam
};

struct Prepared {
  LayerInput input;
  std::vector<Block> blocks;
  std::vector<SeamChoices> seams;  ///< one an outer wall that is closed
  Comb comb;                       ///< where travels may go unretracted
  Comb narrows;                    ///< where they may where that has no way; empty: nowhere
  Comb outline;                    ///< what a travel may not leave unretracted
  Comb free;                       ///< where the nozzle may go at all; empty: wherever a straight way may lead
};

/// What the seams of a block go by.
inline const TravelSettings& seams_of(const TravelSettings& all, const LayerInput& layer, const Block& block) {
  const bool own = block.object != Block::adhesion && layer.objects[block.object].seams != nullptr;
  return own ? *layer.objects[block.object].seams : all;
}

/// What the layers have agreed on.
struct Linked {
  std::vector<Start> seams;                ///< beside Prepared::seams
  std::vector<std::uint32_t> block_order;  ///< the adhesion is always first
  std::vector<Point> places;               ///< of each block: about where its walls begin
  std::optional<Point> begin;              ///< about where the layer begins; absent when nothing is printed
  std::optional<Point> next;               ///< about where the layer above begins
  std::optional<Point> from;               ///< about where the layer below ends
};

/// A bead on its turn.
struct Turn {
  std::uint32_t block = 0;  ///< index into Prepared::blocks
  std::uint32_t bead = 0;   ///< index into the beads of its object
  Start start;              ///< of closed beads
  bool reversed = false;    ///< of open beads
};

struct Ordered {
  std::vector<Turn> turns;
  std::optional<Point> begin, end;  ///< where the first bead begins and the last one ends; absent without turns
};

/// Where a layer could not be travelled as asked, each with the first place.
struct Departures {
  struct Kind {
    int count = 0;
    Point3 first;
    void add(Point3 at) {
      if (count++ == 0) first = at;
    }
  };
  Kind sloped;       ///< circles of a lift that became slopes, to stay in the room
  Kind vertical;     ///< slopes and circles that became vertical
  Kind lowered;      ///< lifts cut at the top of the room
  Kind outside;      ///< travels that leave the room
  Kind unretracted;  ///< travels that cross a wall unretracted because of retraction_count_max
};

struct Routed {
  LayerPlan plan;
  Departures departures;
};

/// One notice a kind for the whole print.
Notices notices_of(std::span<const Routed> layers);

/// What of the settings cannot have the effect the user may expect.
Notices check(const TravelSettings& settings, const RetractionSettings& retraction);

/// Blocks and seam candidates: what `link` and `order` read. Cost: about 1 µs a vertex.
Prepared prepare_order(const TravelSettings& settings, LayerInput input);

/// The boundaries of combing: what only `route` reads, and as large as the beads.
void prepare_ways(const TravelSettings& settings, Prepared& layer);

/// Both.
Prepared prepare(const TravelSettings& settings, LayerInput input);

/// Chooses seams from layer to layer, and the order of the parts of all layers together. Sequential, and layers can be
/// prepared meanwhile; cost: linear in the vertices of outer walls, and a few tours of the parts a layer.
class Linker {
 public:
  explicit Linker(const TravelSettings& settings);
  ~Linker();
  Linker(const Linker&) = delete;
  Linker& operator=(const Linker&) = delete;

  /// The next layer. It stays where it is until all are linked.
  void add(const Prepared& layer);
  /// What all layers have agreed on. Post: there are none.
  std::vector<Linked> linked();

 private:
  const TravelSettings& settings_;
  std::unique_ptr<SeamLines> seams_;
  std::unique_ptr<BlockChain> chain_;
  std::vector<const Prepared*> layers_;
};

/// The same for layers that are all there.
std::vector<Linked> link(const TravelSettings& settings, std::span<const Prepared> layers);

/// The order of all beads of a layer.
/// Post: every bead has exactly one turn; beads of a part follow each other, its walls in their order where they touch,
///       then its fills, with open walls anywhere between; beads of equal non-zero sequence keep their order where it
///       shows: top skin, bridges and the first layer (all but top skin may have it turned around); support's are last.
Ordered order(const TravelSettings& settings, const Prepared& layer, const Linked& linked);

/// How long the ways between the beads of a layer are in that order, and what no order could go below, µm: straight,
/// from where the layer below ended. Cost: O(beads²), sixty times.
struct TourGap {
  double way_um = 0, least_um = 0;
};
TourGap gap_of(const Prepared& layer, const Ordered& ordered, std::optional<Point> from);

/// The steps of the layer.
/// Post: a travel that leaves the part is retracted, but for retraction_enable and retraction_count_max; otherwise it
///       stays inside the comb boundary, or is retracted. Travels stay in the room where their ends are in it and a way
///       is found; departures say where not.
/// @param from where the layer below ended; absent on the first layer
Routed route(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer,
             const Ordered& ordered, std::optional<Point> from);

/// All of it, one layer after the other: for tests and for who has no threads.
std::vector<LayerPlan> plan(const TravelSettings& settings, const RetractionSettings& retraction,
                            std::vector<LayerInput> layers);

}  // namespace weft::travel
