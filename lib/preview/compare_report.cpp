// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/json_text.h"
#include "core/version.h"
#include "preview/compare.h"
#include "preview/rounded.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft::preview {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const FigureDifference& f) {
  return {
      {"name", f.name}, {"unit", f.unit}, {"a", rounded(f.a)}, {"b", rounded(f.b)}, {"percent", rounded(f.percent)}};
}

Json settings_json(const std::vector<SettingDifference>& settings) {
  Json out = Json::array();
  for (const auto& s : settings) out.push_back({{"key", s.key}, {"a", s.a}, {"b", s.b}});
  return out;
}

}  // namespace

std::string verdict_of(const Comparison& comparison, double tolerance_percent) {
  if (comparison.same_moves) return "alike: each move is the same";
  const FigureDifference* worst = nullptr;
  for (const auto& f : comparison.figures)
    if (!worst || f.percent > worst->percent) worst = &f;
  if (!worst || worst->percent == 0)
    return comparison.alike(tolerance_percent) ? "alike: moves differ, and no figure does"
                                               : "they differ: moves do, and no figure does";
  const auto most = fmt::format("most in {}, by {:.2f} %: {:.6g} and {:.6g} {}", worst->name, worst->percent, worst->a,
                                worst->b, worst->unit);
  return fmt::format("{}, {}", comparison.alike(tolerance_percent) ? "alike" : "they differ", most);
}

std::string json_of(const Comparison& comparison, const CompareReport& about) {
  Json figures = Json::array(), layers = Json::array();
  for (const auto& f : comparison.figures) figures.push_back(json_of(f));
  for (const auto& l : comparison.layers)
    layers.push_back({{"z_mm", l.z_mm},
                      {"only_a_mm2", rounded(l.only_a_mm2)},
                      {"only_b_mm2", rounded(l.only_b_mm2)},
                      {"both_mm2", rounded(l.both_mm2)}});
  return json_text(Json{{"weft", version},
                        {"a", about.file_a},
                        {"b", about.file_b},
                        {"tolerance_percent", about.tolerance_percent},
                        {"alike", comparison.alike(about.tolerance_percent)},
                        {"same_moves", comparison.same_moves},
                        {"worst_percent", rounded(comparison.worst_percent())},
                        {"figures", std::move(figures)},
                        {"layers", std::move(layers)},
                        {"settings", settings_json(about.settings)},
                        {"settings_note", about.settings_note}},
                   2) +
         "\n";
}

std::string page_json_of(const Comparison& comparison, const CompareReport& about) {
  Json figures = Json::array(), layers = Json::array();
  for (const auto& f : comparison.figures) {
    auto& row = figures.emplace_back(json_of(f));
    row["beyond"] = f.percent > about.tolerance_percent;
  }
  for (const auto& l : comparison.layers) layers.push_back({l.z_mm, rounded(l.only_a_mm2), rounded(l.only_b_mm2)});
  return json_text(Json{{"verdict", verdict_of(comparison, about.tolerance_percent)},
                        {"figures", std::move(figures)},
                        {"layers", std::move(layers)},
                        {"settings", settings_json(about.settings)},
                        {"settingsNote", about.settings_note}},
                   -1);
}

}  // namespace weft::preview
