// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"
#include "audit/path.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Whose beads lie in whose: found in the bytes, by what the file labels.
namespace weft::audit {

/// A bead: a disc of constant width swept along a segment.
struct Stroke {
  Vec from, to;
  double half_width_mm = 0;
};

/// How deep two strokes lie in each other, mm, and where; not positive: they do not. The depth is how far they would
/// have to be apart.
struct Depth {
  double mm = 0;
  Vec at;
};
Depth depth_of(const Stroke& a, const Stroke& b);

/// Beads of several owners, as they come. What lies a bead's height below the last is let go of: memory does not grow
/// with the file. What is printed after the nozzle came down again is compared with nothing before: there the head
/// tells (heights.h).
class Owners {
 public:
  explicit Owners(double tolerance_mm) : tolerance_mm_(tolerance_mm) {}

  /// @param object its label; empty: it has none  @param feature weft's name of it
  void lay(std::string_view object, std::string_view feature, const Path& path, Vec offset, double half_width_mm,
           double z_mm, double height_mm, int layer);

  /// Every two owners of which beads overlap, by where that begins. After the last bead.
  std::vector<Conflict> conflicts();
  /// Did any bead of an object have a label?
  bool labelled() const { return labelled_; }

 private:
  enum class Kind : std::uint8_t { object, support, skirt, tower };
  struct Laid {
    Stroke stroke;
    double z_mm = 0, height_mm = 0;
    std::uint16_t feature = 0;
    Bounds box;
  };
  struct Owner {
    std::string name;  ///< of the object, or of what belongs to none
    Kind kind = Kind::object;
    std::vector<Laid> laid;
    Bounds box;             ///< of them
    std::size_t known = 0;  ///< of them, how many were compared with the others
  };
  struct Met {
    Conflict conflict;
    double z_mm = 0;
    int last_layer = -1;
  };
  std::size_t owner_of(std::string_view object, std::string_view feature);
  std::uint16_t feature_of(std::string_view name);
  void compare();
  void compare(const Owner& a, const Owner& b, std::size_t i, std::size_t k);
  void note(std::size_t i, std::size_t k, const Laid& a, const Laid& b, const Depth& depth);
  void let_go(double below_mm);

  double tolerance_mm_;
  double z_mm_ = -1e9, highest_bead_mm_ = 0;
  int layer_ = -1;
  bool labelled_ = false;
  std::size_t last_ = 0;  ///< owner of the last bead
  std::string last_object_, last_feature_;
  std::vector<Owner> owners_;
  std::vector<std::string> features_;
  std::map<std::pair<std::size_t, std::size_t>, Met> met_;
};

}  // namespace weft::audit
