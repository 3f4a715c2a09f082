// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/scopes.h"

#include "core/error.h"
#include "settings/first_layer.h"

#include <limits>
#include <utility>

namespace weft {

Scopes::Scopes(Settings plate) {
  of(std::move(plate));
}

ScopeId Scopes::of(Settings settings) {
  auto bytes = exact::bytes_of(settings);
  return intern(std::move(settings), std::move(bytes), std::nullopt);
}

ScopeId Scopes::intern(Settings settings, std::string bytes, std::optional<ScopeId> above) {
  constexpr std::size_t most = std::numeric_limits<ScopeId>::max();
  const auto next = static_cast<ScopeId>(settings_.size());
  const auto [known, is_new] = by_bytes_.emplace(std::move(bytes), next);
  if (!is_new) return known->second;
  if (settings_.size() == most)
    throw Error{Error::Kind::settings,
                "more than 65,535 different sets of settings on a plate",
                {},
                "objects, height ranges and modifiers that are alike share theirs"};
  settings_.push_back(std::move(settings));
  above_.push_back(above.value_or(next));
  return next;
}

ScopeId Scopes::with(ScopeId below, std::span<const Overlay* const> overlays) {
  bool any = false;
  for (const auto* overlay : overlays) any = any || !overlay->empty();
  if (!any) return below;
  Settings settings = settings_[below];
  for (const auto* overlay : overlays) lay(settings, *overlay);
  return of(std::move(settings));
}

ScopeId Scopes::on_first_layer(ScopeId above) {
  return lowest(above, first_layer_of(settings_[above]));
}

ScopeId Scopes::on_raft(ScopeId above) {
  return lowest(above, first_layer_on_raft_of(settings_[above]));
}

ScopeId Scopes::lowest(ScopeId above, const Overlay& overlay) {
  auto settings = settings_[above];
  lay(settings, overlay);
  auto bytes = exact::bytes_of(settings);
  if (bytes == exact::bytes_of(settings_[above])) return above;
  exact::add(bytes, std::uint64_t{above});  // another scope of the same values is none of a first layer
  return intern(std::move(settings), std::move(bytes), above);
}

ScopeId Scopes::above_first_layer(ScopeId id) const {
  return above_[id];
}

}  // namespace weft
