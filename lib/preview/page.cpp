// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/page.h"

#include "core/base64.h"
#include "core/escape.h"
#include "core/json_text.h"
#include "preview/colours.h"
#include "preview/pack.h"
#include "preview/rounded.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

// Made of the files in page/ by cmake/embed.cmake.
extern const std::string_view embedded_page_html, embedded_page_css, embedded_unpack_js, embedded_colours_js,
    embedded_camera_js, embedded_beads_js, embedded_flat_js, embedded_plots_js, embedded_panel_js, embedded_viewer_js;

namespace weft::preview {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Ring& ring) {
  Json out = Json::array();
  for (const Point p : ring) out.push_back({to_mm(p.x), to_mm(p.y)});
  return out;
}

Json json_of(const std::optional<Overlay>& overlay) {
  if (!overlay) return nullptr;
  Json areas = Json::array();
  for (const Ring& ring : overlay->no_go) areas.push_back(json_of(ring));
  return {{"bed", json_of(overlay->bed)}, {"reach", json_of(overlay->reach)}, {"noGo", std::move(areas)}};
}

Json json_of(const Histogram& histogram) {
  Json amounts = Json::array();
  for (const double v : histogram.amount) amounts.push_back(rounded(v));
  return {{"step", histogram.step}, {"amount", std::move(amounts)}};
}

Json features_json(const Toolpaths& paths, const Figures& figures) {
  Json out = Json::array();
  for (std::size_t i = 0; i < paths.features.size(); ++i) {
    const auto& key = paths.features[i];
    std::string name = key.empty() ? "other" : key;
    std::replace(name.begin(), name.end(), '_', ' ');
    const Share& share = figures.features[i];
    out.push_back({{"key", key},
                   {"name", std::move(name)},
                   {"colour", css(colour_of(key))},
                   {"mm", rounded(share.mm)},
                   {"mm3", rounded(share.mm3)},
                   {"seconds", rounded(share.seconds)}});
  }
  return out;
}

Json figures_json(const Figures& f) {
  return {{"seconds", rounded(f.seconds)},
          {"mm3", rounded(f.mm3)},
          {"filamentMm", rounded(f.mm2 > 0 ? f.mm3 / f.mm2 : 0)},
          {"moves", f.moves},
          {"beads", f.beads},
          {"travels", f.travels},
          {"travelMm", rounded(f.travel.mm)},
          {"travelSeconds", rounded(f.travel.seconds)},
          {"retractions", f.retractions},
          {"toolChanges", f.tool_changes},
          {"pauses", f.pauses}};
}

/// The stroke of a line, counted over all layers; −1: none.
std::int64_t stroke_of(const Toolpaths& paths, std::uint32_t line) {
  std::int64_t begin = 0;
  for (const auto& layer : paths.layers) {
    if (!layer.strokes.empty() && layer.strokes.front().line <= line && layer.strokes.back().line >= line) {
      const auto at = std::lower_bound(layer.strokes.begin(), layer.strokes.end(), line,
                                       [](const Stroke& s, std::uint32_t l) { return s.line < l; });
      if (at != layer.strokes.end() && at->line == line) return begin + (at - layer.strokes.begin());
    }
    begin += static_cast<std::int64_t>(layer.strokes.size());
  }
  return -1;
}

Json json_of(const PagePrint& print) {
  const Figures figures = figures_of(print.paths);
  Json layers = Json::array(), findings = Json::array();
  for (const auto& layer : figures.layers)
    layers.push_back({layer.z_mm, layer.height_mm, rounded(layer.seconds), rounded(layer.mm3)});
  for (const auto& mark : print.findings)
    findings.push_back({{"text", mark.text},
                        {"move", stroke_of(print.paths, mark.line)},
                        {"at", {to_mm(mark.at.x), to_mm(mark.at.y), to_mm(mark.at.z)}}});
  return {{"name", print.name},
          {"features", features_json(print.paths, figures)},
          {"layers", std::move(layers)},
          {"figures", figures_json(figures)},
          {"histograms",
           {{"flow", json_of(figures.flow)}, {"speed", json_of(figures.speed)}, {"width", json_of(figures.width)}}},
          {"findings", std::move(findings)}};
}

Json colours_json() {
  constexpr Rgb seams{255, 255, 255}, first{230, 120, 30}, second{40, 120, 220};
  return {{"custom", css(colour_of("custom"))},
          {"travel", css(travel_colour)},
          {"retractions", "#b030d0"},
          {"seams", css(seams)},
          {"outside", css(offending_colour)},
          {"noGo", css(no_go_colour)},
          {"bed", css(bed_colour)},
          {"reach", css(reach_colour)},
          {"a", css(first)},
          {"b", css(second)}};
}

std::string facts_of(const Page& page) {
  Json ramps = Json::array(), tools = Json::array(), prints = Json::array();
  for (int i = 0; i <= 32; ++i) ramps.push_back(css(ramp(i / 32.0)));
  for (const Rgb tool : tool_colours) tools.push_back(css(tool));
  for (const auto& print : page.prints) prints.push_back(json_of(print));
  Json facts{{"title", page.title},
             {"grain", page_grain / 1000.0},
             {"colour", name_of(page.view.colour)},
             {"layer", page.view.layer ? Json(*page.view.layer) : Json()},
             {"travels", page.view.travels},
             {"ramp", std::move(ramps)},
             {"tools", std::move(tools)},
             {"colours", colours_json()},
             {"overlay", json_of(page.overlay)},
             {"audited", page.overlay.has_value()},
             {"prints", std::move(prints)},
             {"comparison", Json::parse(page.comparison)}};
  return escape::script(json_text(std::move(facts)));
}

std::string block(std::string_view kind, std::size_t index, const std::string& bytes) {
  return fmt::format("<script type=\"application/octet-stream\" id=\"{}-{}\">{}</script>\n", kind, index,
                     base64(bytes));
}

}  // namespace

std::string page(const Page& page) {
  std::string blocks;
  for (std::size_t i = 0; i < page.prints.size(); ++i) {
    blocks += block("pack", i, packed(page.prints[i].paths));
    if (!page.prints[i].model.empty()) blocks += block("model", i, page.prints[i].model);
  }
  const std::string facts = facts_of(page);
  constexpr auto scripts =
      std::array{&embedded_unpack_js, &embedded_colours_js, &embedded_camera_js, &embedded_beads_js,
                 &embedded_flat_js,   &embedded_plots_js,   &embedded_panel_js,  &embedded_viewer_js};
  std::string script;
  for (const auto* part : scripts) script += *part;
  // Cut at the places first: what is put in is not searched.
  const std::array<std::pair<std::string_view, std::string_view>, 4> places{
      {{"@STYLE@", embedded_page_css}, {"@FACTS@", facts}, {"@BLOCKS@", blocks}, {"@SCRIPT@", script}}};
  std::string out;
  std::string_view rest = embedded_page_html;
  for (const auto& [place, text] : places) {
    const auto at = rest.find(place);
    out.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + place.size());
  }
  return out.append(rest);
}

std::string html(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay) {
  return page({view.title, view, overlay, {{paths, view.title, overlay ? overlay->marks : std::vector<Mark>{}}}});
}

}  // namespace weft::preview
