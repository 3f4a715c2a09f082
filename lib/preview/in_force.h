// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string_view>

namespace weft::preview {

/// What commands that move nothing have put in force: part-cooling fan, heat of the nozzle, acceleration. In the words
/// of Marlin, Klipper and RepRapFirmware.
class InForce {
 public:
  /// Reads one line without its line feed. Anything else is passed over. Cost: a look at the first letter of most.
  void line(std::string_view text);

  std::uint8_t fan_percent() const { return fan_percent_; }
  std::int16_t nozzle_c() const { return nozzle_c_; }  ///< 0: not told, or off
  /// mm/s², 0: not told. @param extrudes printing moves may have another one than travels
  std::uint16_t acceleration_mm_s2(bool extrudes) const { return extrudes ? printing_ : travelling_; }
  std::uint32_t pauses() const { return pauses_; }  ///< M0, M1, M25, M226, M600, M601, PAUSE so far

 private:
  void numbered(int number, std::string_view words);
  void named(std::string_view text);

  std::uint8_t fan_percent_ = 0;
  std::int16_t nozzle_c_ = 0;
  std::uint16_t printing_ = 0, travelling_ = 0;
  std::uint32_t pauses_ = 0;
};

}  // namespace weft::preview
