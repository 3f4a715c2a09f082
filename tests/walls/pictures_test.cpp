// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of lib/walls/README.md, drawn by the steps they show. WEFT_PICTURES=write test_walls "walls: the
// pictures*" draws them anew.
#include "geometry/medial_axis.h"
#include "source.h"
#include "walls/part.h"
#include "walls/trace.h"
#include "walls/walls.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace weft;
using namespace weft::walls;

namespace {

constexpr std::array counts_colours = {"#999999", "#8e44ad", "#2471a3", "#148f77", "#b7950b", "#ca6f1e", "#c0392b"};

/// A picture in mm, y upwards.
class Svg {
 public:
  explicit Svg(const Region& region) : box_(box_of(region.outer)) {
    std::string d = ring(region.outer);
    for (const Ring& hole : region.holes) d += ring(hole);
    add(R"(<path d="{}" fill="#f4ecd8" stroke="#555" stroke-width=".03" fill-rule="evenodd"/>)", d);
  }
  template <class... Args>
  void add(const char* format, Args&&... args) {
    body_ += fmt::format(fmt::runtime(format), args...) + "\n";
  }
  void line(Place a, Place b, const char* colour, double width) {
    add(R"(<path d="{}L{}" stroke="{}" stroke-width="{}"/>)", "M" + at(a), at(b), colour, width);
  }
  void dot(Place p, const char* colour, double radius) {
    const Place q = in_mm(p);
    add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="{:.2f}" fill="{}"/>)", q.x, q.y, radius, colour);
  }
  void circle(Place p, double radius_um) {
    const Place q = in_mm(p);
    add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="{:.2f}" fill="none" stroke="#2471a3" stroke-width=".03"/>)", q.x, q.y,
        radius_um / 1000);
  }
  /// A line of changing width: a path for each run of one width.
  template <class Path>
  void bead(const Path& path, bool closed, const char* colour) {
    const std::size_t n = path.size(), pieces = n - (closed ? 0 : 1);
    const auto width_of = [&](std::size_t i) {
      return fmt::format("{:.2f}", (path[i].second + path[(i + 1) % n].second) / 2000);
    };
    for (std::size_t i = 0; i < pieces;) {
      std::string d = "M" + at(path[i].first);
      const std::string width = width_of(i);
      for (; i < pieces && width_of(i) == width; ++i) d += "L" + at(path[(i + 1) % n].first);
      add(R"(<path d="{}" stroke="{}" stroke-width="{}" stroke-linecap="round"/>)", d, colour, width);
    }
  }
  void area(const Regions& regions, const char* colour) {
    for (const Region& region : regions) {
      std::string d = ring(region.outer);
      for (const Ring& hole : region.holes) d += ring(hole);
      add(R"(<path d="{}" fill="{}" fill-rule="evenodd"/>)", d, colour);
    }
  }
  std::string text() const {
    constexpr double edge = 0.3;
    const double width = to_mm(box_.max.x - box_.min.x) + 2 * edge, height = to_mm(box_.max.y - box_.min.y) + 2 * edge;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\" width=\"960\" "
        "fill=\"none\">\n"
        "<rect x=\"-99\" y=\"-99\" width=\"299\" height=\"299\" fill=\"#fff\"/>\n{}</svg>\n",
        to_mm(box_.min.x) - edge, -to_mm(box_.max.y) - edge, width, height, body_);
  }
  Place origin;  ///< of places, µm

 private:
  Place in_mm(Place p) const { return {(p.x + origin.x) / 1000, -(p.y + origin.y) / 1000}; }
  std::string at(Place p) const {
    const Place q = in_mm(p);
    return fmt::format("{:.3f} {:.3f}", q.x, q.y);
  }
  static std::string ring(const Ring& ring) {
    std::string d;
    for (const Point p : ring) d += fmt::format("{}{:.3f} {:.3f}", d.empty() ? "M" : "L", to_mm(p.x), -to_mm(p.y));
    return d + "Z";
  }
  Box box_;
  std::string body_;
};

/// A block with a hole, and an arm that tapers from five beads to one.
Region example() {
  Region region;
  region.outer = {{0, 0}, {6_mm, 0}, {6_mm, 1800}, {15_mm, 2900}, {15_mm, 3250}, {6_mm, 4200}, {6_mm, 6_mm}, {0, 6_mm}};
  Ring hole;
  for (int i = 0; i < 36; ++i) {
    const double angle = -2 * std::numbers::pi * i / 36;
    hole.push_back({rounded(2700 + 1000 * std::cos(angle)), rounded(3000 + 1000 * std::sin(angle))});
  }
  region.holes.push_back(std::move(hole));
  return region;
}

std::vector<std::pair<Place, double>> of_bead(const Bead& bead) {
  std::vector<std::pair<Place, double>> path;
  for (const auto& junction : bead.path)
    path.push_back({{static_cast<double>(junction.at.x), static_cast<double>(junction.at.y)},
                    static_cast<double>(junction.width)});
  return path;
}

std::vector<std::pair<Place, double>> of_line(const Line& line) {
  std::vector<std::pair<Place, double>> path;
  for (const auto& vertex : line.path) path.push_back({vertex.at, vertex.width});
  return path;
}

/// The ten pictures, in the README's order.
std::vector<std::pair<std::string, std::string>> pictures() {
  const Region region = example();
  WallSettings settings;
  settings.wall_line_count = 2;
  settings.wall_line_width_0 = settings.wall_line_width_x = 450;
  const Um nozzle = 0.4_mm;
  const Widths widths = widths_of(settings, nozzle, 0.2_mm, 1);
  const auto axis = geometry::medial_axis(region);
  Skeleton skeleton = skeleton_of(axis, 4, reach_of(widths));
  LayingOptions options;
  options.ramp = settings.wall_transition_length.of(nozzle);
  options.filter = settings.wall_transition_filter_distance;
  options.corner_width = 1;
  std::vector<std::pair<std::string, std::string>> all;
  const auto picture = [&](const std::string& name, auto draw) {
    Svg svg(region);
    svg.origin = {static_cast<double>(axis.origin.x), static_cast<double>(axis.origin.y)};
    draw(svg);
    all.emplace_back(name, svg.text());
  };
  const auto draw_axis = [](Svg& svg, const Skeleton& s, const char* colour, double width) {
    for (std::uint32_t e = 0; e < s.edge_count(); ++e) svg.line(s.start(2 * e).at, s.end(2 * e).at, colour, width);
  };

  picture("1-outline", [](Svg&) {});
  picture("2-medial-axis", [&](Svg& svg) {
    draw_axis(svg, skeleton, "#c0392b", 0.05);
    for (std::size_t i = 0; i < skeleton.nodes.size(); i += 9)
      svg.circle(skeleton.nodes[i].at, skeleton.nodes[i].clearance);
  });
  picture("3-ribs", [&](Svg& svg) {
    for (std::uint32_t h = 0; h < skeleton.halves.size(); ++h)
      svg.line(skeleton.start(h).at, skeleton.halves[h].foot, "#7fb3d5", 0.02);
    draw_axis(svg, skeleton, "#c0392b", 0.05);
  });
  const Laying laying = lay(skeleton, widths, options);
  picture("4-central-edges", [&](Svg& svg) {
    for (std::uint32_t e = 0; e < skeleton.edge_count(); ++e) {
      const Span& span = laying.spans[e];
      svg.line(skeleton.start(2 * e).at, skeleton.end(2 * e).at,
               span.core    ? "#c0392b"
               : span.mouth ? "#ca6f1e"
                            : "#2471a3",
               span.core ? 0.09 : 0.05);
    }
  });
  picture("5-counts", [&](Svg& svg) {
    for (std::uint32_t e = 0; e < skeleton.edge_count(); ++e) {
      const Span& span = laying.spans[e];
      if (!span.core) continue;
      const std::size_t beads = static_cast<std::size_t>(2 * span.pairs) + (span.middle && !span.open ? 1U : 0U);
      svg.line(skeleton.start(2 * e).at, skeleton.end(2 * e).at,
               counts_colours[std::min(beads, counts_colours.size() - 1)], 0.14);
    }
  });
  picture("6-beadings", [&](Svg& svg) {
    for (std::uint32_t h = 0; h < skeleton.halves.size(); h += 1) {
      const Span& span = laying.spans[Skeleton::edge_of(h)];
      const double* bounds = laying.start(h);
      for (int i = 0; i < span.pairs; ++i)
        svg.line(skeleton.on_start_rib(h, bounds[i]), skeleton.on_start_rib(h, bounds[i + 1]),
                 i % 2 == 0 ? "#148f77" : "#b7950b", 0.03);
    }
    draw_axis(svg, skeleton, "#c0392b", 0.02);
  });
  picture("7-junctions", [&](Svg& svg) {
    for (std::uint32_t h = 0; h < skeleton.halves.size(); ++h) {
      const Span& span = laying.spans[Skeleton::edge_of(h)];
      const double* bounds = laying.start(h);
      for (int i = 0; i < span.pairs; ++i)
        svg.dot(skeleton.on_start_rib(h, (bounds[i] + bounds[i + 1]) / 2), "#148f77", 0.035);
    }
  });
  const auto pairs = trace_pairs(skeleton, laying), middles = trace_middles(skeleton, laying);
  picture("8-lines", [&](Svg& svg) {
    for (const auto* lines : {&pairs, &middles})
      for (const Line& line : *lines) svg.bead(of_line(line), line.closed, lines == &pairs ? "#148f77" : "#c0392b");
    for (const auto* lines : {&pairs, &middles})
      for (const Line& line : *lines) {
        auto thin = of_line(line);
        for (auto& [place, width] : thin) width = 40;
        svg.bead(thin, line.closed, "#fff");
      }
  });
  const Part part = part_of(settings, widths, region, nozzle, 0);
  picture("9-beads", [&](Svg& svg) {
    svg.origin = {};
    for (const Bead& bead : part.beads)
      svg.bead(of_bead(bead), bead.closed, bead.role == Role::outer_wall ? "#ca6f1e" : "#148f77");
    for (const Bead& bead : part.beads) {
      auto thin = of_bead(bead);
      for (auto& [place, width] : thin) width = 40;
      svg.bead(thin, bead.closed, "#fff");
    }
  });
  picture("10-rest", [&](Svg& svg) {
    svg.origin = {};
    for (const Bead& bead : part.beads) svg.bead(of_bead(bead), bead.closed, "#d5d8dc");
    svg.area(part.inside, "#c0392b");
  });
  return all;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("walls: the pictures of their page are drawn, and each is on it") {
  const auto folder = tests::source / "lib/walls";
  const std::string page = text_of(folder / "README.md");
  const char* const mode = std::getenv("WEFT_PICTURES");
  const auto all = pictures();
  CHECK(all.size() == 10);
  std::size_t plain = 0;
  for (const auto& [name, svg] : all) {
    CAPTURE(name);
    if (mode != nullptr && std::string(mode) == "write") std::ofstream(folder / "pictures" / (name + ".svg")) << svg;
    CHECK(page.find("(pictures/" + name + ".svg)") != std::string::npos);
    CHECK(text_of(folder / "pictures" / (name + ".svg")).starts_with("<svg"));
    if (plain == 0) plain = svg.size();
    CHECK((name == "1-outline" || svg.size() > 2 * plain));
  }
}
