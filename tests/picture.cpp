// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace tests {
namespace {

std::vector<Stroke> shown;

struct Frame {
  double min_x = 1e18, min_y = 1e18, max_x = -1e18, max_y = -1e18;
  void add(std::pair<double, double> p) {
    min_x = std::min(min_x, p.first), max_x = std::max(max_x, p.first);
    min_y = std::min(min_y, p.second), max_y = std::max(max_y, p.second);
  }
};

/// A bead as it is laid: each segment at its mean width, its ends round. Where two beads lie over each other is darker.
void draw_bead(std::ostream& out, const Stroke& s) {
  out << "<g class='bead'>\n";
  const std::size_t segments = s.closed ? s.path.size() : s.path.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const std::size_t k = (i + 1) % s.path.size();
    const auto [x0, y0] = s.path[i];
    const auto [x1, y1] = s.path[k];
    out << "<line x1='" << x0 << "' y1='" << 0 - y0 << "' x2='" << x1 << "' y2='" << 0 - y1 << "' stroke-width='"
        << (s.widths[i] + s.widths[k]) / 2 << "'/>\n";
  }
  out << "</g>\n";
}

void draw_line(std::ostream& out, const Stroke& s, const char* kind) {
  out << "<path class='" << kind << "' d='M";
  for (const auto& [x, y] : s.path) out << ' ' << x << ',' << 0 - y;
  out << (s.closed ? " Z'/>\n" : "'/>\n");
}

}  // namespace

void new_picture() {
  shown.clear();
}

void add_to_picture(Stroke stroke) {
  if (!stroke.path.empty()) shown.push_back(std::move(stroke));
}

std::string picture_svg() {
  if (shown.empty()) return {};
  Frame frame;
  for (const Stroke& s : shown)
    for (const auto& p : s.path) frame.add(p);
  const double width = frame.max_x - frame.min_x, depth = frame.max_y - frame.min_y;
  const double margin = 0.05 * std::max({width, depth, 0.1});
  std::ostringstream out;
  out << std::setprecision(9) << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='" << frame.min_x - margin << ' '
      << -frame.max_y - margin << ' ' << width + 2 * margin << ' ' << depth + 2 * margin << "'>\n"
      << "<style>.bead{stroke:#4a90d9;stroke-linecap:round;opacity:.4}.centre,.outline{fill:none;stroke-width:"
      << margin / 40 << "}.centre{stroke:#123}.outline{stroke:#d33}</style>\n";
  for (const Stroke& s : shown)
    if (!s.widths.empty()) draw_bead(out, s);
  for (const Stroke& s : shown) draw_line(out, s, s.widths.empty() ? "outline" : "centre");
  out << "</svg>\n";
  return out.str();
}

std::filesystem::path leave_picture(const std::string& test, int number) {
  const std::string svg = picture_svg();
  if (svg.empty()) return {};
  std::string name = test.substr(0, 80);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  std::error_code error;
  std::filesystem::create_directories("failed", error);
  const auto path = std::filesystem::path("failed") / (name + "-" + std::to_string(number) + ".svg");
  std::ofstream out(path);
  out << svg;
  return out.flush() ? std::filesystem::absolute(path, error) : std::filesystem::path{};
}

}  // namespace tests
