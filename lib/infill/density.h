// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "field/grid.h"
#include "infill/direction.h"
#include "infill/shells.h"
#include "infill/sparse.h"
#include "model/bead.h"
#include "settings/pattern_list.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace weft::infill {

/// A density that differs from place to place, as settings ask for it.
class Density {
 public:
  /// Does the density differ at all?
  static bool varies(const InfillSettings& infill);

  /// @param areas of all layers: gradual steps are counted below what is above the infill
  /// Distances are known on a grid of half a millimetre, coarser for what is larger than four million cells.
  /// Cost: O(cells).
  /// @param on_bed what is added to the object's places to have those on the bed, where pictures and grids lie
  /// @throws Error{settings} for a file that is not there or cannot be used, Error{file} for one that cannot be read
  Density(const InfillSettings& infill, const ShellObject& object, const std::vector<LayerAreas>& areas, Point on_bed);

  /// What the files that the settings name hold, hashed; empty when they name none.
  static std::string files_of(const InfillSettings& infill);

  /// 0 … 1, at a height over the bed.
  double at(Point p, double z_um) const;

  /// Is there one pattern for all of it, which may go by the density from place to place, not by levels?
  bool goes_on() const {
    return patterns_.empty() && infill_.infill_density_dither == DensityDither::none &&
           infill_.infill_multiplier == 1 && infill_.infill_wall_line_count == 0;
  }

  /// A part of a region whose density is within a factor of √2 of `level`, or is `level` on average when it was
  /// dithered.
  struct Part {
    Region region;
    double level = 0;
    InfillPattern pattern = InfillPattern::grid;
    bool dithered = false;
  };
  /// Levels are doubled from each to the next, so that the coarse lines of a pattern are some of the fine ones. Where
  /// patterns go by the density, parts also end where the pattern does.
  /// @param layer  its number
  std::vector<Part> parts(const Region& region, double z_um, std::size_t layer) const;

  /// Widths of beads that were laid at a level, from `from` on, follow the density along them.
  void follow(double level, double z_um, std::size_t from, Beads& beads) const;
  /// The same of beads that run through levels. Pre: as fill_levels
  void follow(const std::vector<DenseLevel>& levels, double z_um, std::size_t from, Beads& beads) const;

  /// Makes beads wider or narrower, so that around each place they cover what the density asks for there, and in the
  /// region what it asks for altogether: what joins lines at borders of parts is taken from the lines beside it.
  /// @param alike  by the same share everywhere: of dithered parts, each has too much or too little
  void even(const Region& region, double z_um, bool alike, std::size_t from, Beads& beads) const;

 private:
  /// A number for each cell of a box.
  struct Volume {
    Point origin;
    double z0 = 0, cell = 1;  ///< µm; numbers stand in the middle of cells
    int columns = 0, rows = 0, slices = 0;
    std::vector<float> values;
    double at(Point p, double z_um) const;
  };
  static double value_of(const ValuesAt& curve, double at);
  Volume empty_volume(const ShellObject& object) const;
  void find_distance(const ShellObject& object);
  void find_depth(const ShellObject& object, const std::vector<LayerAreas>& areas);

  /// Of places a step apart over a box, log₂ of the density over the nominal one.
  struct Levels;
  Levels levels_of(const Box& box, double z_um) const;
  static Regions above(const Levels& levels, double end);
  double base() const { return std::max(infill_.infill_sparse_density, 1.0) / 100; }
  InfillPattern pattern_at(double density) const;
  std::vector<Part> by_isolines(const Region& region, double z_um) const;
  std::vector<Part> by_cells(const Region& region, double z_um, std::size_t layer) const;
  void read_files(const ShellObject& object);
  double transferred(double v) const;

  const InfillSettings infill_;
  const Um nozzle_;  ///< diameter
  std::vector<PatternFrom> patterns_;
  Point on_bed_;
  std::optional<field::Grid> picture_, grid_;
  Box picture_box_;  ///< on the bed
  Volume distance_;  ///< from the surface, µm
  Volume depth_;     ///< below what is above the infill, µm
};

/// The field that lines are to follow, or nothing. @throws as Density
std::optional<Direction> read_direction(const InfillSettings& infill, const ShellObject& object, Point on_bed);

}  // namespace weft::infill
