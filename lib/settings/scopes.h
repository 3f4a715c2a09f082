// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/scope_id.h"
#include "settings/exact.h"
#include "settings/overlay.h"
#include "settings/settings.h"
#include "settings/take.h"

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The settings of a plate, as many as there are different ones: areas name theirs by two bytes.
namespace weft {

/// Every different set of settings once.
class Scopes {
 public:
  explicit Scopes(Settings plate);

  /// The scope of these settings: the one that has equal values, or a new one.
  /// @throws Error{settings} when a plate has more than 65,535 of them
  ScopeId of(Settings settings);

  /// The scope with overlays laid over it, the narrowest last.
  ScopeId with(ScopeId below, std::span<const Overlay* const> overlays);

  /// Above the first layer it is itself.
  ScopeId on_first_layer(ScopeId above);
  /// The same for what lies on a raft.
  ScopeId on_raft(ScopeId above);
  /// What a scope is above the first layer.
  ScopeId above_first_layer(ScopeId id) const;

  const Settings& operator[](ScopeId id) const { return settings_[id]; }
  std::size_t size() const { return settings_.size(); }

 private:
  ScopeId lowest(ScopeId above, const Overlay& overlay);
  ScopeId intern(Settings settings, std::string bytes, std::optional<ScopeId> above);

  std::deque<Settings> settings_;  // references stay
  std::vector<ScopeId> above_;     // of each, what it is above the first layer
  std::map<std::string, ScopeId> by_bytes_;
};

/// The scopes of a plate as one stage sees them.
template <class T>
class Handed {
 public:
  Handed(const T& take, const Scopes& scopes) : take_(take), scopes_(scopes) {
    std::map<std::string, ScopeId> seen;
    for (std::size_t i = 0; i < scopes.size(); ++i) {
      const auto id = static_cast<ScopeId>(i);
      alike_.push_back(seen.emplace(take.bytes_of(scopes[id]), id).first->second);
    }
  }
  auto operator[](ScopeId id) const { return take_.of(scopes_[id]); }

  /// Equal for scopes that this stage cannot tell apart.
  ScopeId alike(ScopeId id) const { return alike_[id]; }
  std::string bytes_of(ScopeId id) const { return take_.bytes_of(scopes_[id]); }

 private:
  const T& take_;
  const Scopes& scopes_;
  std::vector<ScopeId> alike_;
};

}  // namespace weft
