// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/tree.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/trimmed.h"
#include "support/branch_areas.h"
#include "support/field.h"
#include "support/lengths.h"
#include "support/plastic.h"
#include "support/roofs.h"
#include "support/tips.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::support {
namespace {

constexpr Um farthest = 12_mm;  // no branch goes to meet another that is further away

/// Of patches: how many tips of each a branch holds.
using Shares = std::vector<std::pair<std::size_t, double>>;

void add(Shares& to, const Shares& more) {
  for (const auto& [patch, tips] : more) {
    const auto found = std::find_if(to.begin(), to.end(), [p = patch](const auto& share) { return share.first == p; });
    if (found != to.end())
      found->second += tips;
    else
      to.push_back({patch, tips});
  }
}

struct Node {
  Point at;
  double radius = 0;
  Um tip_z = 0;       ///< of the highest tip above it
  Um from_z = 0;      ///< where it is now
  bool plate = true;  ///< it gets down to the plate
  bool gone = false;
  Shares shares{};     ///< whose it is
  double outside = 1;  ///< of its rim, the share that lies in no other branch
};

class Grower {
 public:
  Grower(const Room& room, const Stack& stack, const Field& field, const std::vector<Regions>& contacts,
         const Patches* patches = nullptr)
      : room_(room),
        s_(room.settings()),
        o_(room.object()),
        stack_(stack),
        field_(field),
        contacts_(contacts),
        patches_(patches),
        slope_(std::tan(s_.support_tree_angle * std::numbers::pi / 180)),
        slow_(std::tan(s_.support_tree_angle_slow.value_or(s_.support_tree_angle) * std::numbers::pi / 180)),
        style_(branch_style(s_)),
        tip_(style_.tip / 2.0),
        discs_(stack.levels.size()),
        mm3_(patches != nullptr ? patches->all().size() : 0, 0.0) {}

  Tree tree() && {
    Roofs roofs(room_, stack_, contacts_, Roofs::Use::laid);
    grow(roofs);
    tree_.areas = branch_areas(room_, stack_, contacts_, discs_);
    auto laid = std::move(roofs).laid(tree_.areas);
    tree_.roofs = std::move(laid.areas), tree_.joists = std::move(laid.joists);
    return std::move(tree_);
  }
  std::vector<double> plastic_mm3(std::span<const double> enough) && {
    Roofs roofs(room_, stack_, contacts_, Roofs::Use::reckoned);
    grow(roofs, enough);
    return std::move(mm3_);
  }

 private:
  /// From the top down, or until each patch takes that much.
  void grow(Roofs& roofs, std::span<const double> enough = {}) {
    for (std::size_t slab = field_.slabs(); slab-- > 0;) {
      stop_if_asked();
      if (!enough.empty() && std::equal(enough.begin(), enough.end(), mm3_.begin(), std::less_equal<>())) return;
      begin_tips(slab, roofs);
      step(slab);
    }
  }
  Um top_of(std::size_t slab) const { return stack_.levels[field_.first_level(slab + 1) - 1].z; }
  Um bottom_of(std::size_t slab) const { return stack_.levels[field_.first_level(slab)].bottom(); }
  Um way(std::size_t slab, const Node& node, Point p) const {
    return node.plate ? field_.to_plate(slab, p) : field_.to_anything(slab, p);
  }

  void begin_tips(std::size_t slab, Roofs& roofs) {
    static const Regions nothing;
    const Um covers = tip_covers(s_, style_);
    for (std::size_t k = field_.first_level(slab + 1); k-- > field_.first_level(slab);) {
      begin_under(slab, k, roofs.bare(k), nothing, {covers, covers});
      const Regions& roof = roofs.begins_above(k);
      if (roof.empty()) continue;
      // Strands of a roof cross from branch to branch, but hang free at its rim.
      const Um spans = roof_covers(style_, o_.nozzle);
      begin_under(slab, k, roof, roofs.around(k), {spans, std::min(spans, covers)});
      if (patches_ == nullptr) roofs.rest(k, standing_at(stack_.levels[k].z), {spans + o_.nozzle, spans});
    }
  }
  /// Those that end at that height, and those that come from above.
  Roofs::Branches standing_at(Um z) const {
    Roofs::Branches out;
    for (const Node& node : nodes_) (node.from_z == z ? out.tips : out.passing).push_back(node.at);
    return out;
  }
  std::vector<Point> standing() const {
    std::vector<Point> out;
    for (const Node& node : nodes_) out.push_back(node.at);
    return out;
  }
  void begin_under(std::size_t slab, std::size_t k, const Regions& contact, const Regions& around, TipSpacing spacing) {
    if (contact.empty()) return;
    const Um z = stack_.levels[k].z;
    const auto before = standing();
    const TipShape shape{rounded(tip_), line_width(s_, o_.nozzle)};
    for (const Point p : tips_under(contact, around, before, spacing, field_, slab, shape)) {
      Node node{p, tip_, z, z};
      if (slab > 0 && !finds_way(slab, node)) {
        node.plate = false;
        if (s_.support_type == SupportType::buildplate || !finds_way(slab, node)) {
          if (patches_ != nullptr) leave(k, contact, p, spacing.inside);
          continue;
        }
      }
      if (patches_ != nullptr)
        if (const auto patch = patches_->at(p)) node.shares = {{*patch, 1.0}};
      nodes_.push_back(std::move(node));
      tree_.tips_at.push_back({p.x, p.y, z});
    }
  }
  /// What a tip should have held, and no other branch does, is reckoned to stand on columns of its own.
  void leave(std::size_t k, const Regions& contact, Point p, Um covers) {
    const Regions round{{circle_around({p, static_cast<double>(covers)}), {}}};
    Regions left = geometry::intersect(geometry::trimmed(contact, box_of(round).grown(1)), round);
    std::vector<Ring> held;
    for (const Node& node : nodes_)
      if (distance(node.at, p) < covers + 2 * reached) held.push_back(circle_around({node.at, node.radius + reached}));
    if (!held.empty()) left = geometry::subtract(left, geometry::regions_from_rings(held));
    if (const auto patch = patches_->at(p))
      mm3_[*patch] += area_mm2(left) * to_mm(stack_.levels[k].z - o_.floor) * s_.support_infill_rate / 100;
  }
  bool finds_way(std::size_t slab, const Node& node) const {
    return !node.plate && field_.stands_on_part(slab, node.at)
               ? true
               : best_place(slab, node, node.at, node.radius).has_value();
  }

  /// How far it may go aside on its way to the bottom of the slab.
  Um reach(std::size_t slab, const Node& node) const {
    return std::max<Um>(rounded((node.from_z - bottom_of(slab)) * slope_), 0);
  }

  /// How far it goes where it may choose.
  Um likes(std::size_t slab, const Node& node) const {
    return std::max<Um>(rounded((node.from_z - bottom_of(slab)) * slow_), 0);
  }

  /// The place at the bottom of the slab nearest to `goal` from which a branch of that radius gets down.
  std::optional<Point> best_place(std::size_t slab, const Node& node, Point goal, double radius) const {
    const Um within = reach(slab, node);
    const auto fits = [&](Point p) { return way(slab - 1, node, p) >= radius; };
    if (distance(goal, node.at) <= within && fits(goal)) return goal;
    const Point middle = field_.snapped(node.at);
    const Um cell = field_.cell(), cells = within / cell + 1;
    std::optional<Point> best;
    std::int64_t least = 0;
    for (Um r = -cells; r <= cells; ++r)
      for (Um c = -cells; c <= cells; ++c) {
        const Point p{middle.x + c * cell, middle.y + r * cell};
        if (distance2(p, node.at) > std::int64_t{within} * within || !fits(p)) continue;
        const auto d = distance2(p, goal);
        if (!best || d < least) best = p, least = d;
      }
    return best;
  }

  /// The nearest other branch of the same kind, where going there pays.
  std::vector<std::size_t> nearest_of(std::size_t slab) const {
    const double left = bottom_of(slab) - o_.floor;
    const double most = std::min<double>(farthest, 1.4 * left * slow_);
    std::vector<std::size_t> order(nodes_.size()), out(nodes_.size(), nodes_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(nodes_[a].at, a) < std::pair(nodes_[b].at, b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Node& a = nodes_[order[i]];
      double least = most;
      const auto look = [&](std::size_t j) {
        const Node& b = nodes_[order[j]];
        if (std::abs(double(b.at.x) - a.at.x) > least) return false;
        const double d = distance(a.at, b.at);
        if (a.plate == b.plate && (d < least || (d == least && order[j] < out[order[i]])))
          least = d, out[order[i]] = order[j];
        return true;
      };
      for (std::size_t j = i; j-- > 0;)
        if (!look(j)) break;
      for (std::size_t j = i + 1; j < order.size(); ++j)
        if (!look(j)) break;
    }
    return out;
  }

  /// How thick a branch is that far below its tip.
  double thickness(double was, Um below_tip) const {
    const double branch = style_.branch / 2.0;
    constexpr double flare = 0.35;  // a tip is a branch within three times the difference; thinner ones, each with a
                                    // loop of its own, take more
    const double angle = std::tan(style_.angle * std::numbers::pi / 180);
    const double ramp = tip_ + below_tip * flare;
    const double wanted = ramp < branch ? ramp : branch + (below_tip - (branch - tip_) / flare) * angle;
    return std::max(was, std::min(wanted, s_.support_tree_max_diameter / 2.0));
  }

  void step(std::size_t slab) {
    if (nodes_.empty()) return;
    const auto stand = [&](const Node& node, Um z) {
      ++tree_.trunks;
      tree_.slenderest = std::max(tree_.slenderest, (node.tip_z - z) / (2 * node.radius));
    };
    if (slab == 0) {
      for (Node& node : nodes_) end(0, node), stand(node, o_.floor);
      nodes_.clear();
      return;
    }
    const auto nearest = nearest_of(slab);
    if (patches_ != nullptr) find_outside(nearest);
    std::vector<Node> next;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      Node& node = nodes_[i];
      if (node.gone) continue;
      if (!node.plate && field_.stands_on_part(slab, node.at)) {
        end(slab, node), end(slab - 1, node), stand(node, node.from_z);
        continue;
      }
      const std::size_t j = nearest[i];
      if (j < nodes_.size() && j > i && nearest[j] == i && !nodes_[j].gone && meet(slab, node, nodes_[j], next))
        continue;
      Point goal = node.at;
      if (j < nodes_.size()) {
        const double d = distance(node.at, nodes_[j].at);
        goal = lerp(node.at, nodes_[j].at, d > 0 ? std::min(0.5, 0.99 * likes(slab, node) / d) : 0);
      }
      const auto place = best_place(slab, node, goal, node.radius);
      move(slab, node, place.value_or(node.at), node.radius, next);
    }
    nodes_ = std::move(next);
  }

  /// Two branches become one at the bottom of the slab, where they can.
  bool meet(std::size_t slab, Node& a, Node& b, std::vector<Node>& next) {
    const double weight = b.radius * b.radius / (a.radius * a.radius + b.radius * b.radius);
    const Point at = lerp(a.at, b.at, weight);
    if (distance(a.at, at) > likes(slab, a) || distance(b.at, at) > likes(slab, b)) return false;
    const double joined = std::cbrt(std::pow(a.radius, 3) + std::pow(b.radius, 3));
    const double room = way(slab - 1, a, at);
    if (room < std::max(a.radius, b.radius)) return false;
    const double radius = std::min(joined, room);
    std::vector<Node> both;
    move(slab, a, at, radius, both);
    move(slab, b, at, radius, both);
    both[0].radius = std::max(both[0].radius, both[1].radius);
    both[0].tip_z = std::max(a.tip_z, b.tip_z);
    add(both[0].shares, both[1].shares);
    next.push_back(both[0]);
    b.gone = true;
    return true;
  }

  /// To a place at the bottom of the slab.
  void move(std::size_t slab, const Node& node, Point to, double least, std::vector<Node>& next) {
    Node below = node;
    below.at = to, below.from_z = bottom_of(slab);
    const double room = slab > 0 ? way(slab - 1, node, to) : node.radius;
    const double wanted = thickness(least, node.tip_z - below.from_z);
    below.radius = std::max(node.radius, std::min(wanted, std::max(room, least)));
    draw(slab, node, below);
    next.push_back(below);
  }
  /// Straight down to the bottom of the slab.
  void end(std::size_t slab, Node& node) {
    Node below = node;
    below.from_z = bottom_of(slab);
    draw(slab, node, below);
    node = below;
  }
  void draw(std::size_t slab, const Node& from, const Node& to) {
    if (patches_ != nullptr) return reckon(from, to);
    for (std::size_t k = field_.first_level(slab); k < field_.first_level(slab + 1); ++k) {
      const Um z = stack_.levels[k].z;
      if (z > from.from_z) break;
      const double t = from.from_z > to.from_z ? double(from.from_z - z) / (from.from_z - to.from_z) : 1;
      double radius = from.radius + t * (to.radius - from.radius);
      if (k == 0) radius = std::max(radius, foot_radius(from));
      discs_[k].push_back({lerp(from.at, to.at, t), radius});
    }
  }

  /// Branches that lean together meet long before they are one: what lies in the other has no loop.
  void find_outside(const std::vector<std::size_t>& nearest) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      nodes_[i].outside = 1;
      if (nearest[i] >= nodes_.size()) continue;
      const double apart = distance(nodes_[i].at, nodes_[nearest[i]].at),
                   both = nodes_[i].radius + nodes_[nearest[i]].radius;
      if (apart < both) nodes_[i].outside = 1 - std::acos(apart / both) / std::numbers::pi;
    }
  }
  /// What a branch takes on its way, for those whose it is.
  void reckon(const Node& from, const Node& to) {
    double tips = 0;
    for (const auto& share : from.shares) tips += share.second;
    if (tips <= 0) return;
    const double line = to_mm(usual_band(s_, o_.nozzle)), radius = (from.radius + to.radius) / 2000;
    const double thick = to_mm(s_.support_tree_branch_diameter_double_wall) / 2;
    const int loops = s_.support_wall_count.value_or(thick > 0 && radius > thick ? 2 : 1);
    const double round_mm2 = std::numbers::pi * radius * radius;
    double mm3 = std::min(round_mm2, loops * 2 * std::numbers::pi * std::max(radius - line / 2, 0.0) * line) *
                 to_mm(from.from_z - to.from_z) * from.outside;
    if (to.from_z == o_.floor) {
      const double foot = foot_radius(to) / 1000;
      mm3 +=
          std::numbers::pi * foot * foot * to_mm(stack_.levels.front().height) * s_.support_initial_layer_density / 100;
    }
    for (const auto& [patch, own] : from.shares) mm3_[patch] += mm3 * own / tips;
  }
  /// What is low tips over no more easily than what it stands on is wide: it needs no wide foot.
  double foot_radius(const Node& node) const {
    const double height = node.tip_z - o_.floor;
    const double foot = std::min(s_.support_tree_bp_diameter / 2.0, node.radius + height / 4);
    return std::max({node.radius, foot, height / 16});
  }

  const Room& room_;
  const SupportSettings& s_;
  const Object& o_;
  const Stack& stack_;
  const Field& field_;
  const std::vector<Regions>& contacts_;
  const Patches* patches_;  ///< given: what branches take is only reckoned
  double slope_, slow_;     ///< how far branches lean: at most, and where nothing is in their way
  BranchStyle style_;
  double tip_;
  std::vector<std::vector<Disc>> discs_;
  std::vector<Node> nodes_;
  Tree tree_;
  std::vector<double> mm3_;  ///< of each patch
};

}  // namespace

Tree tree(const Room& room, const Stack& stack, const Field& field, const std::vector<Regions>& contacts) {
  return Grower(room, stack, field, contacts).tree();
}

std::vector<double> branches_mm3(const Room& room, const Stack& stack, const Field& field,
                                 const std::vector<Regions>& contacts, const Patches& patches,
                                 std::span<const double> enough) {
  return Grower(room, stack, field, contacts, &patches).plastic_mm3(enough);
}

}  // namespace weft::support
