// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/cached.h"
#include "pipeline/object_scopes.h"
#include "pipeline/stage_table.h"

#include <cstdint>
#include <type_traits>

/// What a stage is handed of the settings that hold somewhere on the plate.
namespace weft::pipeline {

template <Stage stage>
using HandedTo = Handed<std::remove_const_t<decltype(RowOf<stage>::reads)>>;

template <Stage stage>
HandedTo<stage> hand(const Scopes& scopes) {
  return {row_of<stage>().reads, scopes};
}

/// The key of a stage, with what it is handed for each height and mix of volumes, and which of them share their areas.
template <Stage stage>
StageKey key_of(const ObjectScopes& scopes, const HandedTo<stage>& handed) {
  StageKey key(row_of<stage>());
  key.with(std::uint64_t{scopes.size()});
  for (const auto& from : scopes) {
    key.with(from.bottom).with(std::uint64_t{from.of_mix.size()});
    for (const ScopeId id : from.of_mix) {
      std::uint64_t first = 0;
      while (from.of_mix[first] != id) ++first;
      key.with(first).with(handed.bytes_of(id));
    }
  }
  return key;
}

}  // namespace weft::pipeline
