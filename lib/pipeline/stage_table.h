// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/take.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

/// The table of stages: a stage is its folder, a row here, and its place in the composition (print_object.cpp,
/// pipeline.cpp). Names, cache keys, what it is handed of the settings, bytes on disk, memory, times and progress
/// follow from the row.
namespace weft {

struct WallLayer;
namespace mesh {
struct Loaded;
}
namespace slice {
struct Cut;
}

namespace pipeline {

struct FilledLayer;
struct Supports;

enum class Stage : std::uint8_t { read, slice, support, walls, infill, travel, gcode, audit };

/// Of a stage whose result no cache keeps.
struct NotKept {};

/// One row. T is what the stage makes; where a cache keeps it, its bytes and its memory are those of its fields
/// (core/fields.h).
template <class T, class Reads>
struct StageRow {
  using Result = T;
  Stage stage;
  std::string_view name;  ///< in keys, in caches, and in timings_ms of the report
  std::string_view says;  ///< what is said when it begins; empty: nothing
  double share;           ///< of the job, that is done then
  int version;  ///< of its key. A change of what it makes of the same input needs no new one: keys hold the build
  Reads reads;  ///< of the settings; its other inputs go into its key where it is called
};
template <class T, class... Reads>
constexpr StageRow<T, Take<Reads...>> stage(Stage stage, std::string_view name, std::string_view says, double share,
                                            int version, Reads... reads) {
  return {stage, name, says, share, version, Take(reads...)};
}

inline constexpr std::tuple stage_table{
    stage<mesh::Loaded>(Stage::read, "read", "", 0, 1),
    stage<std::vector<slice::Cut>>(Stage::slice, "slice", "slicing", 0.05, 2,
                                   WholeGroup{&Settings::layers, layer_schema},
                                   OneValue{&Settings::machine, &MachineSettings::nozzle_diameter}),
    stage<Supports>(Stage::support, "support", "", 0.1, 1, WholeGroup{&Settings::support, support_schema},
                    WholeGroup{&Settings::layers, layer_schema},
                    OneValue{&Settings::machine, &MachineSettings::nozzle_diameter},
                    WholeGroup{&Settings::walls, wall_schema}),
    stage<std::vector<WallLayer>>(Stage::walls, "walls", "walls", 0.15, 2, WholeGroup{&Settings::walls, wall_schema},
                                  OneValue{&Settings::machine, &MachineSettings::nozzle_diameter}),
    stage<std::vector<FilledLayer>>(
        Stage::infill, "infill", "infill", 0.5, 2, WholeGroup{&Settings::shells, shell_schema},
        WholeGroup{&Settings::infill, infill_schema}, OneValue{&Settings::machine, &MachineSettings::nozzle_diameter},
        OneValue{&Settings::walls, &WallSettings::wall_line_width_x},
        OneValue{&Settings::walls, &WallSettings::overlap_factor}),
    stage<NotKept>(Stage::travel, "travel", "travel", 0.65, 1),
    stage<NotKept>(Stage::gcode, "gcode", "G-code", 0.85, 1),
    stage<NotKept>(Stage::audit, "audit", "audit", 0.95, 1),
};
inline constexpr std::size_t stage_count = std::tuple_size_v<decltype(stage_table)>;

template <Stage stage>
constexpr const auto& row_of() {
  constexpr auto index = static_cast<std::size_t>(stage);
  static_assert(std::get<index>(stage_table).stage == stage, "row i of stage_table is stage i");
  return std::get<index>(stage_table);
}
template <Stage stage>
using RowOf = std::tuple_element_t<static_cast<std::size_t>(stage), std::remove_const_t<decltype(stage_table)>>;
template <Stage stage>
using ResultOf = typename RowOf<stage>::Result;

/// f(row) for each stage, in the order of a job.
template <class F>
constexpr void for_each_stage(F&& f) {
  std::apply([&](const auto&... row) { (f(row), ...); }, stage_table);
}

}  // namespace pipeline
}  // namespace weft
