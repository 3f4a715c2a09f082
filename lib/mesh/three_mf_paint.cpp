// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/three_mf_paint.h"

namespace weft::mesh {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;
constexpr int most_states = 1000;
constexpr int deepest = 64;  // halved so often, a triangle is smaller than an atom

class PaintReader {
 public:
  explicit PaintReader(std::string_view text) : text_(text) {}

  bool read(const Corners& at, int depth, std::vector<TintedFacet>& out) {
    const int digit = next();
    if (digit < 0 || depth > deepest) return false;
    const int sides = digit & 3, high = digit >> 2;
    if (sides == 0) {
      int state = high;
      if (high == 3)  // states from 3 on follow: 15 for each F, and one more digit
        for (int more = 15; more == 15; state += more)
          if (more = next(); more < 0 || state > most_states) return false;
      if (state > 0) out.push_back({state, at});
      return true;
    }
    const auto v = static_cast<std::size_t>(high % 3);
    const auto &a = at[v], &b = at[(v + 1) % 3], &c = at[(v + 2) % 3];
    const auto pieces = split(sides, a, b, c);
    for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece)
      if (!read(*piece, depth + 1, out)) return false;
    return true;
  }
  bool done() const { return text_.empty(); }

 private:
  static std::vector<Corners> split(int sides, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
    const Eigen::Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    if (sides == 1) return {{a, b, bc}, {bc, c, a}};
    if (sides == 2) return {{a, ab, ca}, {ab, b, ca}, {b, c, ca}};
    return {{a, ab, ca}, {ab, b, bc}, {bc, c, ca}, {ab, bc, ca}};
  }
  int next() {
    if (text_.empty()) return -1;
    const char c = text_.back();
    text_.remove_suffix(1);
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
  }

  std::string_view text_;
};

}  // namespace

std::optional<std::vector<TintedFacet>> tinted_facets(std::string_view text, const Corners& corners) {
  std::vector<TintedFacet> out;
  PaintReader reader(text);
  if (!reader.read(corners, 0, out) || !reader.done()) return std::nullopt;
  return out;
}

std::optional<std::vector<PaintedFacet>> painted_facets(std::string_view text, const Corners& corners) {
  const auto all = tinted_facets(text, corners);
  if (!all) return std::nullopt;
  std::vector<PaintedFacet> out;
  for (const auto& facet : *all)
    if (facet.state == 1 || facet.state == 2) out.push_back({static_cast<Paint>(facet.state), facet.corners});
  return out;
}

}  // namespace weft::mesh
