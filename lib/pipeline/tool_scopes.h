// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "plate/plate.h"
#include "settings/scopes.h"

#include <functional>
#include <map>
#include <utility>
#include <vector>

/// Which tool prints what, and with which settings. With one tool there is nothing to say: beads keep any_tool and
/// their area's scope.
namespace weft::pipeline {

/// The tool of a bead of that kind. @param inset of walls: 0 is the outermost
ToolId tool_of(const ToolSettings& settings, Role role, std::uint16_t inset);

class ToolScopes {
 public:
  /// @throws Error{settings} for tools that are not what they are said to be
  explicit ToolScopes(const Settings& plate);

  std::size_t count() const { return tools_.size(); }
  bool several() const { return tools_.size() > 1; }
  /// Those that areas are printed with, as far as areas were asked for; ascending.
  std::vector<ToolId> used() const;
  /// The plate's settings of each tool.
  const std::vector<Settings>& tools() const { return tools_; }

  /// The scope of an area that such overlays are laid over: as its walls are printed, which is what its stages take.
  /// What its other tools have is remembered. @throws Error{settings} for a tool that there is not
  ScopeId area(const Object& object, const std::vector<const Overlay*>& overlays, Scopes& scopes);
  /// The same on the first layer, of one that `area` gave. @param lowest what any scope is there
  ScopeId lowest(ScopeId area, const std::function<ScopeId(ScopeId)>& lowest);

  /// An area's settings as that tool has them; itself where it is not known to print there.
  ScopeId of(ScopeId area, ToolId tool) const;
  /// The scope of an area's infill.
  ScopeId infill_of(ScopeId area, const Scopes& scopes) const;

  /// For what is no area's: the tool's own laid over a scope.
  ScopeId laid_over(ScopeId scope, ToolId tool, Scopes& scopes);

  /// Gives each bead its tool, and the scope that it has with it. @param areas scopes of the beads
  void tell(Beads& beads, const Scopes& scopes) const;

 private:
  std::vector<Overlay> overlays_;
  std::vector<Settings> tools_;
  std::map<std::pair<ScopeId, ToolId>, ScopeId> by_tool_;
  std::map<std::pair<ScopeId, ToolId>, ScopeId> laid_;
};

}  // namespace weft::pipeline
