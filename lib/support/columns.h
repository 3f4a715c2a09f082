// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"

#include <vector>

namespace weft::support {

/// Where columns stand on each level for the contacts of each level.
/// @param contacts  by level: what is to be held from there
/// @param given     by level: what stands there in any case
/// Post: every area lies outside of what is kept out and in the object's room, and rests.
std::vector<Regions> columns(const SupportSettings& settings, const Object& object, const Stack& stack,
                             const std::vector<KeepOut>& keep_out, const std::vector<Regions>& contacts,
                             const std::vector<Regions>& given);

/// Contacts by level that stand on towers (support_use_towers), and the others.
struct TowersAndOthers {
  std::vector<Regions> towers, others;
};
TowersAndOthers for_towers(const SupportSettings& settings, const std::vector<Regions>& contacts);

/// Takes away, from the bottom up, what of a level rests neither on the one below nor on the part.
void let_rest(const SupportSettings& settings, const Object& object, const Stack& stack, std::vector<Regions>& levels);

/// The same for one level on what is below it.
void rest_on(const SupportSettings& settings, const Object& object, const Stack::Level& level, const Regions& below,
             Regions& here);

/// Strips thinner than two lines of what is `fresh`, made as wide as that.
void thicken(Regions& area, const Regions& fresh, Um line);

/// What of an area is not kept out of its level: beside contacts the smaller distance holds.
Regions free_part(const Regions& area, const KeepOut& keep_out, const Regions& contacts, const Object& object);

}  // namespace weft::support
