#pragma once
#include "infill/shells.h"
#include "mesh/read.h"
#include "model/layer.h"
#include "model/plan.h"
#include "pipeline/stages.h"
#include "slice/slice.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Results of stages as bytes, without loss: what a cache on disk holds, and what waits for a later stage, since packed
/// it takes a third of the memory. Whole numbers take as many bytes as they need, points are differences from the point
/// before. Of their own version: `codec_version` is part of every key.
namespace weft::pipeline {

inline constexpr int codec_version = 2;

/// What the stages from shells to infill make of a layer.
struct FilledLayer {
  Regions top, skin, sparse;
  Beads beads;
  Notices notices;
};

std::string encode(const mesh::Loaded& model);
std::string encode(const std::vector<slice::Cut>& cuts);
std::string encode(const std::vector<WallLayer>& walls);
std::string encode(const std::vector<FilledLayer>& fills);
std::string encode(const LayerPlan& layer);

/// The value that was encoded. @throws std::runtime_error for bytes that are none
void decode(std::string_view bytes, mesh::Loaded& out);
void decode(std::string_view bytes, std::vector<slice::Cut>& out);
void decode(std::string_view bytes, std::vector<WallLayer>& out);
void decode(std::string_view bytes, std::vector<FilledLayer>& out);
void decode(std::string_view bytes, LayerPlan& out);

/// Memory that a result holds, bytes, about.
std::size_t memory_of(const mesh::Loaded& model);
std::size_t memory_of(const std::vector<slice::Cut>& cuts);
std::size_t memory_of(const std::vector<WallLayer>& walls);
std::size_t memory_of(const std::vector<FilledLayer>& fills);

}  // namespace weft::pipeline
