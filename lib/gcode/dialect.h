#pragma once
#include "gcode/text.h"
#include "model/plan.h"
#include "settings/gcode.h"
#include "settings/machine.h"

namespace weft::gcode {

/// What firmwares write differently. One function a command.
struct Dialect {
  Firmware firmware = Firmware::marlin;
  ObjectLabels labels = ObjectLabels::firmware;

  /// @param share 0 … 1
  void fan(Text& out, double share) const;

  /// Is the acceleration of travels a value of its own, which stays while printing?
  bool separate_travel_acceleration() const { return firmware != Firmware::klipper; }
  void print_acceleration(Text& out, std::int64_t mm_s2) const;
  void travel_acceleration(Text& out, std::int64_t mm_s2) const;

  /// Names of the objects, before the first of them is printed.
  void define_objects(Text& out, const std::vector<ObjectLabel>& objects, const std::vector<std::string>& names) const;
  void object_start(Text& out, std::uint32_t object, const std::vector<std::string>& names) const;
  void object_end(Text& out, std::uint32_t object, const std::vector<std::string>& names) const;
};

/// Names that every firmware takes as one word, and no two of them alike: letters, digits, '_' and what is not ASCII,
/// at most 60 bytes.
std::vector<std::string> label_names(const std::vector<ObjectLabel>& objects);

}  // namespace weft::gcode
