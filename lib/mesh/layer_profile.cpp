// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/layer_profile.h"

#include "core/error.h"
#include "core/escape.h"
#include "core/parts.h"
#include "mesh/text.h"

#include <cmath>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

constexpr double least_mm = 0.02, most_mm = 2;  // of layers
constexpr double highest_mm = 16000;

class Line {
 public:
  Line(std::uint32_t object, const std::string& path) : object_(object), path_(path) {}

  std::vector<HeightAt> read(std::string_view text) const {
    std::vector<HeightAt> out;
    auto texts = parts(text, ';');
    while (!texts.empty() && texts.back().empty()) texts.pop_back();
    if (texts.size() % 2 != 0) refuse("they are pairs of z and height");
    double before = 0;
    for (std::size_t i = 0; i + 1 < texts.size(); i += 2) {
      const double z = number(texts[i]), height = number(texts[i + 1]);
      if (z < before) refuse(fmt::format("z {:g} mm after {:g} mm; they must ascend", z, before));
      if (!(z <= highest_mm)) refuse(fmt::format("z {:g} mm is beyond 16 m", z));
      if (!(height >= least_mm && height <= most_mm))
        refuse(fmt::format("{:g} mm at z {:g} mm is outside 0.02 … 2 mm", height, z));
      before = z;
      out.push_back({from_mm(z), from_mm(height)});
    }
    return out;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(Error::Kind::model, fmt::format("layer heights of object {}: {}", object_, what), path_,
                "export the project again");
  }
  double number(std::string_view text) const {
    const auto v = number_in(text);
    if (!v || !std::isfinite(*v)) refuse(fmt::format("{} is no number", escape::message(text)));
    return *v;
  }

  std::uint32_t object_;
  const std::string& path_;
};

}  // namespace

std::map<std::uint32_t, std::vector<HeightAt>> layer_profiles(std::string_view text, const std::string& path) {
  std::map<std::uint32_t, std::vector<HeightAt>> out;
  constexpr std::string_view begins = "object_id=";
  for (auto line : parts(text, '\n')) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const auto bar = line.find('|');
    if (!line.starts_with(begins) || bar == std::string_view::npos) continue;
    const auto object = number_in(line.substr(begins.size(), bar - begins.size()));
    if (!object || !(*object >= 1 && *object <= 1e9)) continue;
    const auto id = static_cast<std::uint32_t>(*object);
    out[id] = Line(id, path).read(line.substr(bar + 1));
  }
  return out;
}

}  // namespace weft::mesh
