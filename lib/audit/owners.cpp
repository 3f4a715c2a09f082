// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/owners.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft::audit {
namespace {

/// What an owner is called that is no object.
constexpr std::string_view tower = "wipe_tower";

bool is_adhesion(std::string_view feature) {
  return feature == "skirt" || feature == "brim";
}
bool is_support(std::string_view feature) {
  return feature == "support" || feature == "support_interface";
}

/// Share of the segment that is nearest to p.
double share_of(const Stroke& s, Vec p) {
  const Vec d = s.to - s.from;
  const double length2 = dot(d, d);
  return length2 > 0 ? std::clamp(dot(p - s.from, d) / length2, 0.0, 1.0) : 0.0;
}
Vec along(const Stroke& s, double t) {
  return s.from + t * (s.to - s.from);
}

Bounds box_of(const Stroke& s) {
  Bounds out;
  const Vec r{s.half_width_mm, s.half_width_mm};
  for (const Vec p : {s.from, s.to}) out.add(p - r), out.add(p + r);
  return out;
}

void add(Bounds& to, const Bounds& box) {
  to.add(box.min), to.add(box.max);
}

}  // namespace

Depth depth_of(const Stroke& a, const Stroke& b) {
  const double together = a.half_width_mm + b.half_width_mm;
  const Vec u = a.to - a.from, v = b.to - b.from, w = b.from - a.from;
  if (const double d = cross(u, v); d != 0) {
    const double s = cross(w, v) / d, t = cross(w, u) / d;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return {together, along(a, s)};
  }
  double least = 1e300;
  Vec at;
  const auto offer = [&](Vec p, Vec q) {
    if (const double away = norm(p - q); away < least) least = away, at = 0.5 * (p + q);
  };
  for (const Vec p : {a.from, a.to}) offer(p, along(b, share_of(b, p)));
  for (const Vec p : {b.from, b.to}) offer(along(a, share_of(a, p)), p);
  return {together - least, at};
}

std::uint16_t Owners::feature_of(std::string_view name) {
  const auto at = std::find(features_.begin(), features_.end(), name);
  if (at != features_.end()) return static_cast<std::uint16_t>(at - features_.begin());
  features_.emplace_back(name);
  return static_cast<std::uint16_t>(features_.size() - 1);
}

std::size_t Owners::owner_of(std::string_view object, std::string_view feature) {
  if (!owners_.empty() && object == last_object_ && feature == last_feature_) return last_;
  last_object_ = object, last_feature_ = feature;
  const Kind kind = feature == tower       ? Kind::tower
                    : is_adhesion(feature) ? Kind::skirt
                    : is_support(feature)  ? Kind::support
                                           : Kind::object;
  const std::string name(kind == Kind::tower || kind == Kind::skirt ? feature : object);
  const auto at =
      std::find_if(owners_.begin(), owners_.end(), [&](const Owner& o) { return o.kind == kind && o.name == name; });
  last_ = static_cast<std::size_t>(at - owners_.begin());
  if (at == owners_.end()) owners_.push_back({name, kind, {}, {}, 0});
  return last_;
}

void Owners::lay(std::string_view object, std::string_view feature, const Path& path, Vec offset, double half_width_mm,
                 double z_mm, double height_mm, int layer) {
  const bool of_none = feature == tower || is_adhesion(feature);
  if (object.empty() && !of_none) return;  // whose it is nobody says
  labelled_ = labelled_ || !object.empty();
  if (z_mm != z_mm_) {
    compare();
    if (z_mm < z_mm_)
      let_go(1e9);
    else
      let_go(z_mm - std::max(highest_bead_mm_, height_mm));
    z_mm_ = z_mm;
  }
  layer_ = layer;
  highest_bead_mm_ = std::max(highest_bead_mm_, height_mm);
  auto& owner = owners_[owner_of(object, feature)];
  const auto number = feature_of(feature);
  constexpr double chord_mm = 0.5;
  const int pieces = path.arc ? std::max(1, static_cast<int>(std::min(1e4, std::ceil(length_mm(path) / chord_mm)))) : 1;
  Vec from = path.from + offset;
  for (int i = 1; i <= pieces; ++i) {
    const Vec to = (i == pieces ? path.to : at(path, static_cast<double>(i) / pieces)) + offset;
    const Stroke stroke{from, to, half_width_mm};
    owner.laid.push_back({stroke, z_mm, height_mm, number, box_of(stroke)});
    add(owner.box, owner.laid.back().box);
    from = to;
  }
}

void Owners::let_go(double below_mm) {
  for (auto& owner : owners_) {
    if (owner.laid.empty()) continue;
    std::erase_if(owner.laid, [&](const Laid& laid) { return laid.z_mm <= below_mm + 1e-6; });
    owner.box = {};
    for (const auto& laid : owner.laid) add(owner.box, laid.box);
    owner.known = owner.laid.size();
  }
}

void Owners::note(std::size_t i, std::size_t k, const Laid& a, const Laid& b, const Depth& depth) {
  const auto [at, is_new] = met_.try_emplace({i, k});
  Met& met = at->second;
  Conflict& c = met.conflict;
  const double z = std::max(a.z_mm, b.z_mm);
  if (!is_new && z > met.z_mm) {
    c.layers += met.last_layer != layer_ ? 1 : 0;
    met.last_layer = layer_;
    return;
  }
  if (!is_new && depth.mm <= to_mm(c.depth)) return;
  met.z_mm = z;
  const auto um = [](double mm) { return static_cast<Um>(std::lround(mm * 1000)); };
  c.a = owners_[i].name, c.b = owners_[k].name;
  c.support_a = owners_[i].kind == Kind::support, c.support_b = owners_[k].kind == Kind::support;
  c.feature_a = features_[a.feature], c.feature_b = features_[b.feature];
  c.at = {um(depth.at.x), um(depth.at.y), um(z)};
  c.depth = um(depth.mm);
  c.layer = met.last_layer = layer_;
  c.layers = 1;
  const auto bears = [](Kind kind) { return kind == Kind::support || kind == Kind::skirt; };
  const bool adhesion = owners_[i].kind == Kind::skirt || owners_[k].kind == Kind::skirt;
  // A brim lies at its part, and a little in it; what is led across its lines does not.
  const bool cross = depth.mm >= a.stroke.half_width_mm + b.stroke.half_width_mm - 1e-6;
  c.blocks = !(bears(owners_[i].kind) && bears(owners_[k].kind)) && (!adhesion || cross);
}

void Owners::compare(const Owner& a, const Owner& b, std::size_t i, std::size_t k) {
  Bounds both;
  both.min = {std::max(a.box.min.x, b.box.min.x), std::max(a.box.min.y, b.box.min.y)};
  both.max = {std::min(a.box.max.x, b.box.max.x), std::min(a.box.max.y, b.box.max.y)};
  const auto within = [&](const Owner& owner) {
    std::vector<const Laid*> out;
    for (const auto& laid : owner.laid)
      if (laid.box.overlaps(both, 0)) out.push_back(&laid);
    std::sort(out.begin(), out.end(), [](const Laid* x, const Laid* y) { return x->box.min.x < y->box.min.x; });
    return out;
  };
  const auto mine = within(a), others = within(b);
  double longest = 0;
  for (const auto* other : others) longest = std::max(longest, other->box.max.x - other->box.min.x);
  const auto is_known = [](const Owner& owner, const Laid* laid) {
    return laid < owner.laid.data() + static_cast<std::ptrdiff_t>(owner.known);
  };
  for (const auto* one : mine) {
    auto at = std::lower_bound(others.begin(), others.end(), one->box.min.x - longest,
                               [](const Laid* other, double x) { return other->box.min.x < x; });
    for (; at != others.end() && (*at)->box.min.x <= one->box.max.x; ++at) {
      const Laid* other = *at;
      if (!other->box.overlaps(one->box, 0) || (is_known(a, one) && is_known(b, other))) continue;
      const double common =
          std::min(one->z_mm, other->z_mm) - std::max(one->z_mm - one->height_mm, other->z_mm - other->height_mm);
      if (common <= 1e-6) continue;
      if (const auto depth = depth_of(one->stroke, other->stroke); depth.mm > tolerance_mm_)
        note(i, k, *one, *other, depth);
    }
  }
}

void Owners::compare() {
  for (std::size_t i = 0; i < owners_.size(); ++i)
    for (std::size_t k = i + 1; k < owners_.size(); ++k) {
      const Owner &a = owners_[i], &b = owners_[k];
      const bool of_one = a.name == b.name && a.kind != Kind::tower && b.kind != Kind::tower;
      const bool nothing_new = a.known == a.laid.size() && b.known == b.laid.size();
      if (of_one || nothing_new || a.laid.empty() || b.laid.empty() || !a.box.overlaps(b.box, 0)) continue;
      compare(a, b, i, k);
    }
  for (auto& owner : owners_) owner.known = owner.laid.size();
}

std::vector<Conflict> Owners::conflicts() {
  compare();
  std::vector<Conflict> out;
  for (const auto& [owners, met] : met_) out.push_back(met.conflict);
  std::stable_sort(out.begin(), out.end(), [](const Conflict& a, const Conflict& b) { return a.at.z < b.at.z; });
  return out;
}

}  // namespace weft::audit
