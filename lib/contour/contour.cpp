// SPDX-License-Identifier: GPL-3.0-or-later
#include "contour/contour.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft::contour {
namespace {

constexpr double step_um = 400;    // between looks: about a bead's width
constexpr Um worth_um = 10;        // what a bead moves by at least somewhere, or it stays
constexpr double straight_um = 4;  // junctions that a ramp between others stands for

bool may_follow(Role role) {
  // Belts of a slope that no skin lies on are seen, too.
  return role == Role::outer_wall || role == Role::inner_wall || role == Role::top_skin || role == Role::gap_fill ||
         role == Role::solid_infill || role == Role::ironing;
}

/// How the layer lies to the surface.
class Look {
 public:
  Look(const Standing& object, const Rules& rules, Um z, Um height)
      : object_(object), height_(height), middle_(z - object.lift - height / 2.0) {
    steepest_ = height / (2.0 * std::max(rules.flat_radius, 1));
    least_ = std::max<double>(-height / 2.0, rules.least_height - static_cast<double>(height));
  }

  /// How far the surface lies above the layer there; nothing: it is covered, or too steep.
  std::optional<double> above(Point at) const {
    const auto found = object_.surface->between(at - object_.by, middle_ - 1, middle_ + height_);
    if (!found || found->slope > steepest_) return std::nullopt;
    return std::max(found->z_um - (middle_ + height_ / 2.0), least_);
  }

  /// The same of a bead there, `side` beside whose middle its edge is.
  double of_bead(Point at, Point side) const {
    const auto off = above(at);
    if (!off) return 0;
    if (*off > 0 && (!above(at + side) || !above(at - side))) return std::min(*off, height_ / 4.0);
    return *off;
  }

 private:
  const Standing& object_;
  Um height_;
  double middle_, steepest_ = 0, least_ = 0;
};

/// A junction, and how far above the layer's z it belongs.
struct Raised {
  Junction at;
  double off = 0;
  bool own = false;  ///< of the bead as it was
};

std::vector<Raised> looked_at(const Extrude& bead, const Look& look) {
  std::vector<Raised> out;
  for (std::size_t i = 0; i + 1 < bead.path.size(); ++i) {
    const Junction &a = bead.path[i], &b = bead.path[i + 1];
    const double length = distance(a.at, b.at);
    if (length == 0) {
      out.push_back({a, out.empty() ? 0 : out.back().off, true});
      continue;
    }
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / step_um)));
    const auto place = [&](double t) {
      const Um width = rounded(a.width + t * (b.width - a.width));
      const Point side{rounded(-(b.at.y - a.at.y) / length * width / 2),
                       rounded((b.at.x - a.at.x) / length * width / 2)};
      const Junction j{lerp(a.at, b.at, t), width,
                       static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))};
      return Raised{j, look.of_bead(j.at, side), t == 0 || t == 1};
    };
    for (int k = 0; k < pieces; ++k) out.push_back(place(static_cast<double>(k) / pieces));
    if (i + 2 == bead.path.size()) out.push_back(place(1));
  }
  return out;
}

/// Leaves out junctions between two that say the same of way, width and height.
std::vector<Raised> thinned(const std::vector<Raised>& all) {
  std::vector<Raised> out{all.front()};
  std::size_t from = 0;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const double whole = distance(all[from].at.at, all[i + 1].at.at);
    bool straight = whole > 0 && !all[i].own;
    for (std::size_t k = from + 1; k <= i && straight; ++k) {
      const double t = distance(all[from].at.at, all[k].at.at) / whole;
      straight = std::abs(all[from].off + t * (all[i + 1].off - all[from].off) - all[k].off) <= straight_um;
    }
    if (straight) continue;
    out.push_back(all[i]);
    from = i;
  }
  out.push_back(all.back());
  return out;
}

/// @return how far it rises above the layer's z at most
Um raise(const Look& look, Extrude& bead) {
  const auto all = looked_at(bead, look);
  const auto [low, high] =
      std::minmax_element(all.begin(), all.end(), [](const Raised& a, const Raised& b) { return a.off < b.off; });
  if (std::max(-low->off, high->off) < worth_um) return 0;
  const Um most = rounded(std::max(high->off, 0.0));
  const auto kept = thinned(all);
  bead.path.clear();
  for (const Raised& each : kept) {
    Junction j = each.at;
    j.flow *= static_cast<float>((bead.height + each.off) / bead.height);
    bead.path.push_back(j);
    bead.below.push_back(rounded(-each.off));
  }
  bead.follows_surface = true;
  return most;
}

/// Ways go up to where they scrape nothing before they go anywhere.
void lift(Um z, LayerPlan& layer) {
  std::optional<Point3> at;
  for (Step& step : layer.steps) {
    if (const auto* bead = std::get_if<Extrude>(&step)) at = place_of(*bead, bead->path.size() - 1, layer.z);
    if (const auto* retract = std::get_if<Retract>(&step); retract != nullptr && !retract->wipe.empty() && at)
      at = Point3{retract->wipe.back().x, retract->wipe.back().y, at->z};
    auto* travel = std::get_if<Travel>(&step);
    if (travel == nullptr || travel->path.empty()) continue;
    if (at && flat(*at) != flat(travel->path.front()) && at->z < z)
      travel->path.insert(travel->path.begin(), {at->x, at->y, z});
    for (Point3& p : travel->path) p.z = std::max(p.z, z);
    at = travel->path.back();
  }
}

}  // namespace

void follow(std::span<const Rules> rules, std::span<const Standing> objects, LayerPlan& layer) {
  if (layer.time.first() || std::none_of(rules.begin(), rules.end(), [](const Rules& r) { return r.follows; })) return;
  const Standing* object = nullptr;
  Um most = 0;
  StopNowAndThen stop(16);
  for (Step& step : layer.steps) {
    stop.step();
    if (const auto* begin = std::get_if<ObjectStart>(&step))
      object = begin->object < objects.size() ? &objects[begin->object] : nullptr;
    auto* bead = std::get_if<Extrude>(&step);
    if (bead == nullptr || object == nullptr || object->surface == nullptr || bead->path.size() < 2) continue;
    const Rules& own = rules[bead->scope < rules.size() ? bead->scope : 0];
    if (own.follows && may_follow(bead->role) && bead->below.empty())
      most = std::max(most, raise(Look(*object, own, layer.z, bead->height), *bead));
  }
  if (most > 0) lift(layer.z + most, layer);
}

}  // namespace weft::contour
