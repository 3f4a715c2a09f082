// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base64.h"
#include "core/escape.h"
#include "preview/colours.h"
#include "preview/page.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace weft::preview {
namespace {

constexpr Um grain = 5;  // of the page's coordinates and widths, µm

/// Numbers as the page reads them: seven bits a byte, least first; signed ones folded (0, −1, 1, −2, …).
class Packed {
 public:
  void number(std::uint64_t v) {
    for (; v >= 128; v >>= 7) bytes_.push_back(static_cast<char>(v | 128));
    bytes_.push_back(static_cast<char>(v));
  }
  void step(std::int64_t v) { number(static_cast<std::uint64_t>(v < 0 ? -2 * v - 1 : 2 * v)); }
  void number(double v) { number(static_cast<std::uint64_t>(std::llround(std::max(v, 0.0)))); }

  std::string text() const { return base64(bytes_); }

 private:
  std::string bytes_;
};

Point grained(Point p) {
  auto round = [](Um v) { return static_cast<Um>(std::lround(static_cast<double>(v) / grain)); };
  return {round(p.x), round(p.y)};
}

/// What a run of strokes has in common on the page.
struct Look {
  std::uint64_t kind, width, speed, flow;  ///< kind: feature · 4 + compensated · 2 + offending
  friend bool operator==(const Look&, const Look&) = default;
};

Look look_of(const Stroke& stroke, bool offending) {
  return {stroke.feature * 4ULL + (stroke.compensated ? 2 : 0) + (offending ? 1 : 0),
          stroke.extrudes() ? std::max<std::uint64_t>(
                                  1, static_cast<std::uint64_t>(std::lround(static_cast<double>(stroke.width) / grain)))
                            : 0,
          static_cast<std::uint64_t>(std::lround(std::max(stroke.speed_mm_s, 0.F))),
          static_cast<std::uint64_t>(std::lround(std::max(stroke.flow_mm3_s, 0.F) * 100))};
}

/// Strokes that join and look alike become a run: look, number of steps, steps.
void pack(Packed& out, const PathLayer& layer, const std::vector<std::uint32_t>& offending, Point& at) {
  struct Run {
    Look look;
    Point from;
    std::vector<Point> to;
  };
  std::vector<Run> runs;
  for (const Stroke& stroke : layer.strokes) {
    const Point from = grained(stroke.from), to = grained(stroke.to);
    const Look look = look_of(stroke, std::binary_search(offending.begin(), offending.end(), stroke.line));
    // Flow follows from width and speed but for the rounding: it does not part a run.
    const bool goes_on = !runs.empty() && runs.back().to.back() == from && runs.back().look.kind == look.kind &&
                         runs.back().look.width == look.width && runs.back().look.speed == look.speed;
    if (!goes_on)
      runs.push_back({look, from, {to}});
    else if (from != to)
      runs.back().to.push_back(to);
  }
  out.number(std::uint64_t{runs.size()});
  auto move = [&](Point p) {
    out.step(p.x - at.x), out.step(p.y - at.y);
    at = p;
  };
  for (const Run& run : runs) {
    for (const std::uint64_t v :
         {run.look.kind, run.look.width, run.look.speed, run.look.flow, std::uint64_t{run.to.size()}})
      out.number(v);
    move(run.from);
    for (const Point p : run.to) move(p);
  }
}

std::string ring_json(const Ring& ring) {
  std::string out = "[";
  for (const Point p : ring)
    fmt::format_to(std::back_inserter(out), "{}[{},{}]", out.size() > 1 ? "," : "", to_mm(p.x), to_mm(p.y));
  out += ']';
  return out;
}

std::string overlay_json(const std::optional<Overlay>& overlay) {
  if (!overlay) return "null";
  std::string areas;
  for (const Ring& ring : overlay->no_go)
    fmt::format_to(std::back_inserter(areas), "{}{}", areas.empty() ? "" : ",", ring_json(ring));
  return fmt::format(R"({{"bed":{},"reach":{},"noGo":[{}]}})", ring_json(overlay->bed), ring_json(overlay->reach),
                     areas);
}

std::string_view name_of(Colour colour) {
  switch (colour) {
    case Colour::feature:
      return "feature";
    case Colour::width:
      return "width";
    case Colour::speed:
      return "speed";
    case Colour::flow:
      return "flow";
  }
  return "feature";
}

}  // namespace

std::string html(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay) {
  Packed packed;
  Point at;
  const std::vector<std::uint32_t> none;
  for (const PathLayer& layer : paths.layers) {
    packed.number(static_cast<std::uint64_t>(std::max(layer.z, 0)));
    packed.number(static_cast<std::uint64_t>(std::max(layer.height, 0)));
    pack(packed, layer, overlay ? overlay->lines : none, at);
  }
  std::string features, ramps;
  for (const auto& name : paths.features) {
    std::string shown = name.empty() ? "other" : name;
    std::replace(shown.begin(), shown.end(), '_', ' ');
    features += fmt::format("{}[{},\"{}\"]", features.empty() ? "" : ",", escape::json(shown), css(colour_of(name)));
  }
  for (int i = 0; i <= 32; ++i) ramps += fmt::format("{}\"{}\"", i ? "," : "", css(ramp(i / 32.0)));
  const std::size_t last = paths.layers.size() - 1;
  std::string out(page_head);
  fmt::format_to(
      std::back_inserter(out),
      "const page={{title:{},features:[{}],ramp:[{}],overlay:{},colour:\"{}\",travels:{},layer:{},layers:{},grain:{},\n"
      "colours:{{reduced:\"{}\",travel:\"{}\",outside:\"{}\",noGo:\"{}\",bed:\"{}\",reach:\"{}\"}},\ndata:\"",
      escape::json(view.title), features, ramps, overlay_json(overlay), name_of(view.colour), view.travels,
      std::min(view.layer.value_or(last), last), paths.layers.size(), grain / 1000.0, css(compensated_colour),
      css(travel_colour), css(offending_colour), css(no_go_colour), css(bed_colour), css(reach_colour));
  out += packed.text();
  out += "\"};\n";
  out += page_script;
  return out;
}

}  // namespace weft::preview
