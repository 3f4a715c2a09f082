// SPDX-License-Identifier: GPL-3.0-or-later
#include "labels.h"

#include "catalogues.h"
#include "core/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

namespace weft::app {
namespace {

/// A catalogue as msgfmt writes it, little-endian. Source: GNU gettext manual, "The Format of GNU MO Files".
class MoFile {
 public:
  explicit MoFile(std::string_view bytes)
      : bytes_(bytes), count_(number(8)), originals_(number(12)), translations_(number(16)) {}

  std::optional<std::string_view> find(std::string_view id) const {
    std::uint32_t low = 0, high = count_;
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      const auto at = text(originals_, middle);
      if (at == id) return text(translations_, middle);
      (at < id ? low : high) = at < id ? middle + 1 : middle;
    }
    return std::nullopt;
  }

 private:
  std::uint32_t number(std::size_t at) const {
    std::uint32_t v = 0;
    for (std::size_t i = 4; i-- > 0;) v = v << 8 | static_cast<unsigned char>(bytes_[at + i]);
    return v;
  }
  std::string_view text(std::uint32_t table, std::uint32_t row) const {
    const std::size_t entry = table + std::size_t{8} * row;
    return bytes_.substr(number(entry + 4), number(entry));
  }

  std::string_view bytes_;
  std::uint32_t count_, originals_, translations_;
};

std::optional<std::string> label_in(std::string_view catalogue, std::string_view key) {
  const auto found = MoFile(catalogue).find(fmt::format("label\4{}", key));  // gettext joins context and id so
  return found ? std::optional(std::string(*found)) : std::nullopt;
}

std::string_view catalogue_of(std::string_view name) {
  for (const auto& c : catalogues)
    if (c.language == name) return c.bytes;
  return {};
}

/// The catalogue's name for a language: without encoding, with Chinese told apart by script or country.
std::string canonical(std::string_view language) {
  std::string name(language.substr(0, language.find_first_of(".@")));
  std::replace(name.begin(), name.end(), '-', '_');
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::string plain = name.substr(0, name.find('_'));
  if (plain != "zh") return plain;
  const bool traditional = name.find("hant") != std::string::npos || name.find("tw") != std::string::npos ||
                           name.find("hk") != std::string::npos || name.find("mo") != std::string::npos;
  return traditional ? "zh_TW" : "zh_CN";
}

}  // namespace

Labels::Labels(std::string_view language) : catalogue_(catalogue_of(language.empty() ? "en" : canonical(language))) {
  if (!catalogue_.empty()) return;
  std::string known;
  for (const auto& c : catalogues) known += (known.empty() ? "" : ", ") + std::string(c.language);
  throw Error{Error::Kind::usage, fmt::format("there are no labels in '{}'", language), "--lang", "one of " + known};
}

std::string Labels::of(std::string_view key) const {
  if (auto label = label_in(catalogue_, key)) return *label;
  if (auto label = label_in(catalogue_of("en"), key)) return *label;
  std::string words(key);
  std::replace(words.begin(), words.end(), '_', ' ');
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

}  // namespace weft::app
