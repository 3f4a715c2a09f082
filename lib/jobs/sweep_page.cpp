// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base64.h"
#include "core/escape.h"
#include "core/json_text.h"
#include "jobs/sweep.h"

#include <array>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

// Made of the files in page/ by cmake/embed.cmake.
extern const std::string_view embedded_sweep_html, embedded_sweep_css, embedded_sweep_js;

namespace weft::jobs {

using Json = nlohmann::ordered_json;

std::string sweep_page(const std::string& title, const std::vector<std::string>& axes,
                       const std::vector<Trial>& trials) {
  Json rows = Json::array();
  for (const auto& t : trials)
    rows.push_back({{"id", t.id},
                    {"output", t.output},
                    {"ok", t.ok},
                    {"best", t.best},
                    {"error", t.error},
                    {"values", t.values},
                    {"time_s", t.time_s},
                    {"material_g", t.material_g},
                    {"strength", t.strength},
                    {"layers", t.layers},
                    {"cost", t.cost ? Json(*t.cost) : Json()},
                    {"currency", t.currency},
                    {"viewer", t.viewer},
                    {"picture", base64(t.picture)}});
  Json data{{"title", title}, {"axes", axes}, {"trials", std::move(rows)}};
  const std::string facts = escape::script(json_text(std::move(data)));
  const std::array<std::pair<std::string_view, std::string_view>, 3> places{
      {{"@STYLE@", embedded_sweep_css}, {"@FACTS@", facts}, {"@SCRIPT@", embedded_sweep_js}}};
  std::string out;
  std::string_view rest = embedded_sweep_html;
  for (const auto& [place, text] : places) {  // cut first: what is put in is not searched
    const auto at = rest.find(place);
    out.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + place.size());
  }
  return out.append(rest);
}

}  // namespace weft::jobs
