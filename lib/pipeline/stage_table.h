#pragma once
#include "settings/exact.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

/// The table of stages: a stage is its folder, a row here, and its place in the composition (print_object.cpp,
/// pipeline.cpp). Names, cache keys, bytes on disk, memory, times and progress follow from the row.
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

enum class Stage : std::uint8_t { read, slice, walls, infill, travel, gcode, audit };

/// Of a stage whose result no cache keeps.
struct NotKept {};

/// Adds to a key what a stage reads of the settings.
using Reads = void (*)(std::string& key, const Settings& settings);

/// One row. T is what the stage makes; where a cache keeps it, its bytes and its memory are those of its fields
/// (core/fields.h).
template <class T>
struct StageRow {
  using Result = T;
  Stage stage;
  std::string_view name;  ///< in keys, in caches, and in timings_ms of the report
  std::string_view says;  ///< what is said when it begins; empty: nothing
  double share = 0;       ///< of the job, that is done then
  int version = 1;  ///< of its key. A change of what it makes of the same input needs no new one: keys hold the build
  Reads reads = nullptr;  ///< of the settings; its other inputs go into its key where it is called
};

inline constexpr std::tuple stage_table{
    StageRow<mesh::Loaded>{Stage::read, "read", ""},
    StageRow<std::vector<slice::Cut>>{
        Stage::slice, "slice", "slicing", 0.05, 1,
        [](std::string& key, const Settings& s) { exact::add_group(key, s.layers, layer_schema); }},
    StageRow<std::vector<WallLayer>>{Stage::walls, "walls", "walls", 0.15, 1,
                                     [](std::string& key, const Settings& s) {
                                       exact::add_group(key, s.walls, wall_schema);
                                       exact::add(key, s.machine.nozzle_diameter);
                                     }},
    StageRow<std::vector<FilledLayer>>{Stage::infill, "infill", "infill", 0.5, 1,
                                       [](std::string& key, const Settings& s) {
                                         exact::add_group(key, s.shells, shell_schema);
                                         exact::add_group(key, s.infill, infill_schema);
                                         exact::add(key, s.machine.nozzle_diameter);
                                         exact::add(key, s.walls.wall_line_width_x);
                                       }},
    StageRow<NotKept>{Stage::travel, "travel", "travel", 0.65},
    StageRow<NotKept>{Stage::gcode, "gcode", "G-code", 0.85},
    StageRow<NotKept>{Stage::audit, "audit", "audit", 0.95},
};
inline constexpr std::size_t stage_count = std::tuple_size_v<decltype(stage_table)>;

template <Stage stage>
constexpr const auto& row_of() {
  constexpr auto index = static_cast<std::size_t>(stage);
  static_assert(std::get<index>(stage_table).stage == stage, "row i of stage_table is stage i");
  return std::get<index>(stage_table);
}
template <Stage stage>
using ResultOf = typename std::tuple_element_t<static_cast<std::size_t>(stage), decltype(stage_table)>::Result;

/// f(row) for each stage, in the order of a job.
template <class F>
constexpr void for_each_stage(F&& f) {
  std::apply([&](const auto&... row) { (f(row), ...); }, stage_table);
}

}  // namespace pipeline
}  // namespace weft
