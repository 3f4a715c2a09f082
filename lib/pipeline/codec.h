// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/shells.h"
#include "mesh/read.h"
#include "model/layer.h"
#include "model/plan.h"
#include "pipeline/stages.h"
#include "slice/slice.h"
#include "support/support.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Results of stages as bytes, without loss: what a cache on disk holds, and what waits for a later stage, since packed
/// it takes a third of the memory. Whole numbers take as many bytes as they need, points are differences from the point
/// before. Of their own version: `codec_version` is part of every key.
namespace weft::pipeline {

inline constexpr int codec_version = 3;

/// What the stages from shells to infill make of a layer.
struct FilledLayer {
  Regions top, skin, sparse;
  Beads beads;
  std::vector<std::uint32_t> inner_beads;  ///< how many of the last are of each inner area (model/area.h)
  Notices notices;
};

/// What stands under an object.
struct Supports {
  PrintedLayers layers;
  std::vector<Regions> held;  ///< of each layer of the object, what rests on it; empty: nothing does
  support::Figures figures;
  std::vector<std::uint32_t> idle_enforcers{};  ///< marks that ask for nothing, by number
};

// Of the types that codec.cpp lists at its end, each made of the fields that it lists (core/fields.h).

template <class T>
std::string encode(const T& v);

/// The value that was encoded. @throws std::runtime_error for bytes that are none
template <class T>
void decode(std::string_view bytes, T& out);

/// Memory that a result holds, bytes, about.
template <class T>
std::size_t memory_of(const T& v);

}  // namespace weft::pipeline
