// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/scope_id.h"
#include "infill/prepared.h"

#include <map>
#include <vector>

namespace weft::pipeline {

/// What the infill of an object knows of all its layers, by scope.
class PreparedInfill {
 public:
  /// @param handed  what the stage is handed of a scope: shells, infill, nozzle and what more there is
  /// @param asked   the scopes of the object, as its shells ask for them
  /// @param object  its layers, whatever the nozzle  @param parts  what fills them
  /// @param origin  where patterns are anchored  @param on_bed  where the object's first copy stands
  /// @throws as infill::prepare
  template <class Handed>
  PreparedInfill(const Handed& handed, const std::vector<ScopeId>& asked, infill::ShellObject object,
                 const std::vector<infill::LayerAreas>& parts, Point origin, Point on_bed) {
    for (const ScopeId id : asked) {
      const auto& [shells, infill, nozzle, width, overlap] = handed[id];
      object.nozzle = nozzle;
      by_scope_.emplace(id, infill::prepare(infill, object, parts, origin, on_bed));
    }
  }

  /// That of a scope; of one that infill has alike with another object's, the object's own. Null without scopes.
  const infill::Prepared* of(ScopeId scope) const {
    const auto found = by_scope_.find(scope);
    if (found != by_scope_.end()) return &found->second;
    return by_scope_.empty() ? nullptr : &by_scope_.begin()->second;
  }

 private:
  std::map<ScopeId, infill::Prepared> by_scope_;
};

}  // namespace weft::pipeline
