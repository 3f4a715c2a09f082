// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/exact.h"
#include "settings/settings.h"

#include <string>
#include <tuple>

/// What a stage reads of the settings, said once: it is handed that, and the key of its result is made of it.
namespace weft {

/// A group of settings that a stage reads, whole.
template <class Group, class Schema>
struct WholeGroup {
  Group Settings::*group;
  const Schema& rows;
  const Group& of(const Settings& s) const { return s.*group; }
  void add(std::string& bytes, const Settings& s) const { exact::add_group(bytes, s.*group, rows); }
};
template <class Group, class Schema>
WholeGroup(Group Settings::*, const Schema&) -> WholeGroup<Group, Schema>;

/// One value of a group that a stage reads.
template <class Group, class T>
struct OneValue {
  Group Settings::*group;
  T Group::*field;
  const T& of(const Settings& s) const { return s.*group.*field; }
  void add(std::string& bytes, const Settings& s) const { exact::add(bytes, s.*group.*field); }
};
template <class Group, class T>
OneValue(Group Settings::*, T Group::*) -> OneValue<Group, T>;

/// What a stage is handed of the settings. It gets this and nothing else, and the key that its result is kept under is
/// made of the same: a stage cannot read a setting that its key does not hold.
template <class... Read>
class Take {
 public:
  constexpr explicit Take(Read... reads) : reads_(reads...) {}

  /// References to what is read, in order.
  auto of(const Settings& s) const {
    return std::apply([&](const auto&... read) { return std::tie(read.of(s)...); }, reads_);
  }
  std::string bytes_of(const Settings& s) const {
    std::string bytes;
    std::apply([&](const auto&... read) { (read.add(bytes, s), ...); }, reads_);
    return bytes;
  }

 private:
  std::tuple<Read...> reads_;
};

}  // namespace weft
