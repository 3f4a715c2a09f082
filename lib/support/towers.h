// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/support.h"

#include <vector>

namespace weft::support {

/// Contacts by level that stand on towers (support_use_towers), and the others.
struct TowersAndOthers {
  std::vector<Regions> towers, others;
};
TowersAndOthers for_towers(const SupportSettings& settings, const std::vector<Regions>& contacts);

/// Rounds under tiny contacts, as thick as a tower as soon as the slope of its top allows.
class Towers {
 public:
  explicit Towers(const SupportSettings& s) : s_(s) {}

  void begin(const Regions& contacts, Um z);
  /// Adds what towers are on a level with its top there. @return whether there is any
  bool add(Um z, Regions& falling);

 private:
  struct Tower {
    Box box;
    Um z;
  };
  const SupportSettings& s_;
  std::vector<Tower> growing_;
};

}  // namespace weft::support
