// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/progress.h"

#include <algorithm>
#include <cmath>

namespace weft::gcode {
namespace {

std::vector<double> begins(const std::vector<double>& layer_s, std::size_t layers) {
  std::vector<double> out{0};
  for (std::size_t i = 0; i < layers; ++i) out.push_back(out.back() + (i < layer_s.size() ? layer_s[i] : 0));
  return out;
}

Progress progress(const std::vector<double>& begins, std::size_t layer, double share_of_layer) {
  const double total_s = begins.back();
  const double elapsed_s =
      layer + 1 < begins.size() ? begins[layer] + share_of_layer * (begins[layer + 1] - begins[layer]) : begins[layer];
  const double share = total_s > 0 ? std::clamp(elapsed_s / total_s, 0.0, 1.0) : 0;
  return {static_cast<std::int64_t>(100 * share), std::llround((total_s - elapsed_s) / 60)};
}

}  // namespace

ProgressText::ProgressText(const Dialect& dialect, const Statistics& statistics, std::size_t layers)
    : dialect_(dialect), usual_(begins(statistics.layer_s, layers)) {
  if (!statistics.silent_layer_s.empty()) silent_ = begins(statistics.silent_layer_s, layers);
}

std::string ProgressText::at(std::size_t layer, double share) const {
  auto out = dialect_.progress(progress(usual_, layer, share));
  if (!silent_.empty()) out += dialect_.silent_progress(progress(silent_, layer, share));
  return out;
}

std::string ProgressText::done() const {
  return dialect_.progress({100, 0}) + (silent_.empty() ? std::string() : dialect_.silent_progress({100, 0}));
}

std::string ProgressText::before(std::size_t layer) const {
  auto now = at(layer);
  return layer > 0 && now != at(layer - 1) ? now : std::string();
}

std::vector<TimedLine> ProgressText::within(std::size_t layer) const {
  constexpr double long_s = 60, every_s = 30;
  std::vector<TimedLine> out;
  const double begin = usual_[layer], end = usual_[layer + 1];
  if (end - begin < long_s) return out;
  auto said = at(layer);
  for (double t = begin + every_s; t + every_s / 2 < end; t += every_s) {
    const double share = (t - begin) / (end - begin);
    auto now = at(layer, share);
    if (now != said) out.push_back({share, now});
    said = std::move(now);
  }
  return out;
}

}  // namespace weft::gcode
