// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/catalogue.h"
#include "source.h"

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

/// Labels by key, as the catalogue of a language has them; a label that stands there twice is in `twice`.
struct Catalogue {
  std::map<std::string, std::string, std::less<>> labels;
  std::vector<std::string> twice;
};

Catalogue read_labels(const std::string& language) {
  std::ifstream in(tests::source / "app/po" / (language + ".po"));
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string po = text.str();
  Catalogue out;
  const std::regex entry("msgctxt \"label\"\nmsgid \"(.+)\"\nmsgstr \"(.*)\"\n");
  for (std::sregex_iterator at(po.begin(), po.end(), entry), end; at != end; ++at)
    if (!out.labels.emplace((*at)[1], (*at)[2]).second) out.twice.push_back((*at)[1]);
  return out;
}

}  // namespace

TEST_CASE("settings: every key has a label of its own in every language", "[settings]") {
  for (const std::string language : {"en", "fr", "ja", "zh_CN", "zh_TW"}) {
    INFO(language);
    const auto found = read_labels(language);
    CHECK(found.twice.empty());
    std::map<std::string_view, std::string_view> key_of;
    for (const auto& entry : catalogue()) {
      INFO(entry.key);
      const auto at = found.labels.find(entry.key);
      CHECK(at != found.labels.end());
      if (at == found.labels.end()) continue;
      CHECK_FALSE(at->second.empty());
      const auto [other, is_new] = key_of.emplace(at->second, entry.key);
      INFO("labelled like " << other->second);
      CHECK(is_new);
    }
    for (const auto& [key, label] : found.labels) {
      INFO(key);
      CHECK(find_setting(key));
    }
  }
}

TEST_CASE("settings: the offset of combing is called what the field calls it", "[settings]") {
  CHECK(read_labels("zh_CN").labels["retraction_combing_offset"] == "避障边界偏移");
  CHECK(read_labels("zh_TW").labels["retraction_combing_offset"] == "避障邊界偏移");
  CHECK(read_labels("ja").labels["retraction_combing_offset"] == "コーミング境界オフセット");
}
