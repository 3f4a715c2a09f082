// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace weft::app {

/// Labels of settings in one language, from the gettext catalogues of app/po.
class Labels {
 public:
  /// @param language a locale's or a browser's name for it: `fr`, `fr_CA.UTF-8`, `zh-Hant`; empty: English
  /// @throws Error{usage} when there is no catalogue for it
  explicit Labels(std::string_view language);

  /// In the language; else in English; else the key in words.
  std::string of(std::string_view key) const;

 private:
  std::string_view catalogue_;  ///< the bytes of a .mo file
};

}  // namespace weft::app
