// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/rgb.h"
#include "mesh/three_mf.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The colours of a 3MF's objects and facets.
/// Sources: 3MF Core Specification 1.3, "Base Materials"; Materials and Properties Extension 1.2.1, "Color Groups".
namespace weft::mesh {

/// The key of a setting that says which colour something has, `#RRGGBB`, in whoever's words the others are.
inline constexpr std::string_view colour_key = "3mf:colour";

/// `#RRGGBB`, and with two digits more, how much shines through, which are not looked at; nothing for other texts.
std::optional<Rgb> colour_of(std::string_view text);
std::string text_of(Rgb colour);

/// Groups of properties that objects and triangles name by number: of the model part that they stand in.
class PropertyGroups {
 public:
  /// <basematerials>, <m:colorgroup> or another group begins; what follows is in it.
  void begin(std::uint32_t id) { group_ = &groups_[id]; }
  /// Its next property. @param colour nothing: it has none
  void add(std::optional<Rgb> colour) {
    if (group_) group_->push_back(colour);
  }
  void end() { group_ = nullptr; }

  std::optional<Rgb> find(std::uint32_t group, std::uint32_t index) const;

 private:
  std::map<std::uint32_t, std::vector<std::optional<Rgb>>> groups_;
  std::vector<std::optional<Rgb>>* group_ = nullptr;
};

/// What triangles say of themselves becomes the object's where all say the same; what says no more than the object is
/// left out. Of very many colours (a scan has thousands) those that are alike become one.
void settle_colours(Resource& resource);

/// Objects of a file in which no slicer says otherwise get a setting `colour_key`, and so does each component of one
/// that has parts of several colours.
void tell_colours(ThreeMf& document);

}  // namespace weft::mesh
