// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/compare.h"

#include "preview/coverage.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace weft::preview {
namespace {

/// The layers of each height: objects that are printed one after the other have several.
using Heights = std::map<Um, std::vector<std::size_t>>;

Heights heights_of(const Toolpaths& paths) {
  Heights out;
  for (std::size_t i = 0; i < paths.layers.size(); ++i)
    if (!box_of_beads(paths.layers[i], paths).empty()) out[paths.layers[i].z].push_back(i);
  return out;
}

/// Layers of both that are compared with each other; one of them may have none.
struct Pair {
  Um z;
  const std::vector<std::size_t>*a = nullptr, *b = nullptr;
};

std::vector<Pair> pairs_of(const Heights& a, const Heights& b, Um apart) {
  std::vector<Pair> out;
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    const bool have_a = i != a.end(), have_b = j != b.end();
    if (have_a && have_b && std::abs(i->first - j->first) <= apart) {
      out.push_back({i->first, &i->second, &j->second});
      ++i, ++j;
    } else if (have_a && (!have_b || i->first < j->first)) {
      out.push_back({i->first, &i->second, nullptr});
      ++i;
    } else {
      out.push_back({j->first, nullptr, &j->second});
      ++j;
    }
  }
  return out;
}

/// Half of the least height of a layer.
Um half_height(const Toolpaths& paths) {
  Um least = max_coord;
  for (const auto& layer : paths.layers)
    if (layer.height > 1) least = std::min(least, layer.height);
  return least / 2;
}

LayerDifference difference_of(const Pair& pair, const Toolpaths& a, const Toolpaths& b) {
  Box window;
  const auto each = [](const std::vector<std::size_t>* layers, const auto& act) {
    if (layers)
      for (const auto i : *layers) act(i);
  };
  each(pair.a, [&](std::size_t i) { window.add(box_of_beads(a.layers[i], a)); });
  each(pair.b, [&](std::size_t i) { window.add(box_of_beads(b.layers[i], b)); });
  Coverage in_a(window), in_b(window);
  each(pair.a, [&](std::size_t i) { in_a.add(a.layers[i], a); });
  each(pair.b, [&](std::size_t i) { in_b.add(b.layers[i], b); });
  const auto shared = Coverage::shared(in_a, in_b);
  const auto area = [&](std::uint64_t cells) { return static_cast<double>(cells) * in_a.cell_mm2(); };
  return {to_mm(pair.z), area(shared.only_a), area(shared.only_b), area(shared.both)};
}

bool same(const Stroke& s, const Toolpaths& a, const Stroke& t, const Toolpaths& b) {
  return s.from == t.from && s.to == t.to && s.z == t.z && s.width == t.width && s.height == t.height &&
         s.speed_mm_s == t.speed_mm_s && s.tool == t.tool && a.features[s.feature] == b.features[t.feature];
}

bool same_moves(const Toolpaths& a, const Toolpaths& b) {
  const auto same_layer = [&](const PathLayer& m, const PathLayer& n) {
    return m.events.size() == n.events.size() &&
           std::equal(m.strokes.begin(), m.strokes.end(), n.strokes.begin(), n.strokes.end(),
                      [&](const Stroke& s, const Stroke& t) { return same(s, a, t, b); });
  };
  return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), same_layer);
}

class Figuring {
 public:
  void add(std::string name, std::string unit, double a, double b, double of) {
    out_.push_back({std::move(name), std::move(unit), a, b, of > 0 ? 100 * std::abs(a - b) / of : 0});
  }
  void add(std::string name, std::string unit, double a, double b) {
    add(std::move(name), std::move(unit), a, b, std::max(a, b));
  }
  void add(FigureDifference figure) { out_.push_back(std::move(figure)); }
  std::vector<FigureDifference> take() { return std::move(out_); }

 private:
  std::vector<FigureDifference> out_;
};

Share share_of(const Toolpaths& paths, const Figures& figures, const std::string& feature) {
  for (std::size_t i = 0; i < paths.features.size(); ++i)
    if (paths.features[i] == feature) return figures.features[i];
  return {};
}

void add_features(Figuring& out, const Toolpaths& a, const Figures& in_a, const Toolpaths& b, const Figures& in_b) {
  std::set<std::string> names;
  for (const auto* paths : {&a, &b}) names.insert(paths->features.begin(), paths->features.end());
  const double seconds = std::max(in_a.seconds, in_b.seconds), cm3 = std::max(in_a.mm3, in_b.mm3) / 1000;
  for (const auto& name : names) {
    const Share x = share_of(a, in_a, name), y = share_of(b, in_b, name);
    if (x.mm == 0 && y.mm == 0) continue;
    const std::string shown = name.empty() ? "other" : name;
    out.add(shown + ", time", "s", x.seconds, y.seconds, seconds);
    out.add(shown + ", plastic", "cm3", x.mm3 / 1000, y.mm3 / 1000, cm3);
  }
}

/// What lies below which half of the amount lies.
double middle_of(const Histogram& h) {
  double all = 0, sum = 0;
  for (const double v : h.amount) all += v;
  for (std::size_t i = 0; i < h.amount.size(); ++i)
    if ((sum += h.amount[i]) * 2 >= all && all > 0) return (static_cast<double>(i) + 0.5) * h.step;
  return 0;
}

void add_areas(Figuring& out, const std::vector<LayerDifference>& layers) {
  double only_a = 0, only_b = 0, all = 0, largest = 0;
  const LayerDifference* worst = nullptr;
  for (const auto& layer : layers) {
    const double covered = layer.only_a_mm2 + layer.only_b_mm2 + layer.both_mm2;
    only_a += layer.only_a_mm2, only_b += layer.only_b_mm2, all += covered;
    largest = std::max(largest, covered);
    if (!worst || layer.only_a_mm2 + layer.only_b_mm2 > worst->only_a_mm2 + worst->only_b_mm2) worst = &layer;
  }
  const auto percent = [](double part, double whole) { return whole > 0 ? 100 * part / whole : 0; };
  out.add({"area that only one covers, all layers", "mm2", only_a, only_b, percent(only_a + only_b, all)});
  if (worst)
    out.add({fmt::format("area that only one covers, worst layer (z {:.2f})", worst->z_mm), "mm2", worst->only_a_mm2,
             worst->only_b_mm2, percent(worst->only_a_mm2 + worst->only_b_mm2, largest)});
}

}  // namespace

double Comparison::worst_percent() const {
  double worst = 0;
  for (const auto& f : figures) worst = std::max(worst, f.percent);
  return worst;
}

bool Comparison::alike(double tolerance_percent) const {
  return same_moves || (tolerance_percent > 0 && worst_percent() <= tolerance_percent);
}

Comparison compare(const Toolpaths& a, const Toolpaths& b) {
  const Figures in_a = figures_of(a), in_b = figures_of(b);
  const Heights heights_a = heights_of(a), heights_b = heights_of(b);
  const auto pairs = pairs_of(heights_a, heights_b, std::min(half_height(a), half_height(b)));
  Comparison out;
  out.same_moves = same_moves(a, b);
  out.layers.resize(pairs.size());
  tasks::for_each_index(pairs.size(), [&](std::size_t i) { out.layers[i] = difference_of(pairs[i], a, b); });

  Figuring figures;
  figures.add("time", "s", in_a.seconds, in_b.seconds);
  figures.add("plastic", "cm3", in_a.mm3 / 1000, in_b.mm3 / 1000);
  figures.add("layers", "", static_cast<double>(a.layers.size()), static_cast<double>(b.layers.size()));
  add_areas(figures, out.layers);
  add_features(figures, a, in_a, b, in_b);
  figures.add("travel, time", "s", in_a.travel.seconds, in_b.travel.seconds, std::max(in_a.seconds, in_b.seconds));
  figures.add("travel, length", "mm", in_a.travel.mm, in_b.travel.mm);
  figures.add("travels", "", static_cast<double>(in_a.travels), static_cast<double>(in_b.travels));
  figures.add("retractions", "", static_cast<double>(in_a.retractions), static_cast<double>(in_b.retractions));
  figures.add("tool changes", "", static_cast<double>(in_a.tool_changes), static_cast<double>(in_b.tool_changes));
  figures.add("width, half of the length below", "mm", middle_of(in_a.width), middle_of(in_b.width));
  figures.add("speed, half of the length below", "mm/s", middle_of(in_a.speed), middle_of(in_b.speed));
  out.figures = figures.take();
  return out;
}

std::vector<SettingDifference> differences(std::string_view settings_a, std::string_view settings_b) {
  const auto lines = [](std::string_view text) {
    std::vector<std::pair<std::string, std::string>> out;
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      const auto line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (const auto at = line.find(" = "); at != std::string_view::npos)
        out.emplace_back(line.substr(0, at), line.substr(at + 3));
    }
    return out;
  };
  const auto in_a = lines(settings_a), in_b = lines(settings_b);
  const std::map<std::string, std::string> map_a(in_a.begin(), in_a.end()), map_b(in_b.begin(), in_b.end());
  std::vector<SettingDifference> out;
  for (const auto& [key, value] : in_a) {
    const auto other = map_b.find(key);
    if (other == map_b.end() || other->second != value)
      out.push_back({key, value, other == map_b.end() ? "" : other->second});
  }
  for (const auto& [key, value] : in_b)
    if (!map_a.contains(key)) out.push_back({key, "", value});
  return out;
}

}  // namespace weft::preview
