// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/tree.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "support/branch_areas.h"
#include "support/field.h"
#include "support/lengths.h"
#include "support/roofs.h"
#include "support/tips.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::support {
namespace {

constexpr Um farthest = 12_mm;  // no branch goes to meet another that is further away

struct Node {
  Point at;
  double radius = 0;
  Um tip_z = 0;       ///< of the highest tip above it
  Um from_z = 0;      ///< where it is now
  bool plate = true;  ///< it gets down to the plate
  bool gone = false;
};

class Grower {
 public:
  Grower(const SupportSettings& s, const Object& o, const Stack& stack, const std::vector<KeepOut>& keep_out,
         const std::vector<Regions>& contacts)
      : s_(s),
        o_(o),
        stack_(stack),
        contacts_(contacts),
        field_(s, o, stack, keep_out),
        slope_(std::tan(s.support_tree_angle * std::numbers::pi / 180)),
        slow_(std::tan(s.support_tree_angle_slow.value_or(s.support_tree_angle) * std::numbers::pi / 180)),
        style_(branch_style(s)),
        tip_(style_.tip / 2.0),
        discs_(stack.levels.size()) {
    tree_.left.resize(stack.levels.size());
  }

  Tree grow(const std::vector<KeepOut>& keep_out) && {
    Roofs roofs(s_, o_, stack_, contacts_);
    for (std::size_t slab = field_.slabs(); slab-- > 0;) {
      stop_if_asked();
      begin_tips(slab, roofs);
      step(slab);
    }
    tree_.areas = branch_areas(s_, o_, stack_, keep_out, contacts_, discs_);
    auto laid = std::move(roofs).laid(keep_out, tree_.areas);
    tree_.roofs = std::move(laid.areas), tree_.joists = std::move(laid.joists);
    return std::move(tree_);
  }

 private:
  Um top_of(std::size_t slab) const { return stack_.levels[field_.first_level(slab + 1) - 1].z; }
  Um bottom_of(std::size_t slab) const { return stack_.levels[field_.first_level(slab)].bottom(); }
  Um way(std::size_t slab, const Node& node, Point p) const {
    return node.plate ? field_.to_plate(slab, p) : field_.to_anything(slab, p);
  }

  void begin_tips(std::size_t slab, Roofs& roofs) {
    const Um covers = tip_covers(s_, style_);
    for (std::size_t k = field_.first_level(slab + 1); k-- > field_.first_level(slab);) {
      begin_under(slab, k, roofs.bare(k), {covers, covers});
      const Regions& roof = roofs.begins_above(k);
      if (roof.empty()) continue;
      // Strands of a roof cross from branch to branch, but hang free at its rim.
      const Um spans = rounded(tip_) + roof_span(o_.nozzle) / 2;
      begin_under(slab, k, roof, {spans, std::min(spans, covers)});
      roofs.rest(k, standing_at(stack_.levels[k].z), {spans + o_.nozzle, spans});
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
  void begin_under(std::size_t slab, std::size_t k, const Regions& contact, TipSpacing spacing) {
    if (contact.empty()) return;
    const Um z = stack_.levels[k].z;
    for (const Point p : tips_under(contact, standing(), spacing, field_, slab, rounded(tip_))) {
      Node node{p, tip_, z, z, true, false};
      if (slab > 0 && !finds_way(slab, node)) {
        node.plate = false;
        if (s_.support_type == SupportType::buildplate || !finds_way(slab, node)) {
          leave(k, contact, p, spacing.inside);
          continue;
        }
      }
      nodes_.push_back(node);
      tree_.tips_at.push_back({p.x, p.y, z});
    }
  }
  /// What a tip should have held.
  void leave(std::size_t k, const Regions& contact, Point p, Um covers) {
    append(tree_.left[k], geometry::intersect(contact, {{circle_around({p, static_cast<double>(covers)}), {}}}));
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
    for (std::size_t k = field_.first_level(slab); k < field_.first_level(slab + 1); ++k) {
      const Um z = stack_.levels[k].z;
      if (z > from.from_z) break;
      const double t = from.from_z > to.from_z ? double(from.from_z - z) / (from.from_z - to.from_z) : 1;
      double radius = from.radius + t * (to.radius - from.radius);
      if (k == 0) radius = std::max({radius, s_.support_tree_bp_diameter / 2.0, (from.tip_z - o_.floor) / 16.0});
      discs_[k].push_back({lerp(from.at, to.at, t), radius});
    }
  }

  const SupportSettings& s_;
  const Object& o_;
  const Stack& stack_;
  const std::vector<Regions>& contacts_;
  Field field_;
  double slope_, slow_;  ///< how far branches lean: at most, and where nothing is in their way
  BranchStyle style_;
  double tip_;
  std::vector<std::vector<Disc>> discs_;
  std::vector<Node> nodes_;
  Tree tree_;
};

}  // namespace

Tree tree(const SupportSettings& settings, const Object& object, const Stack& stack,
          const std::vector<KeepOut>& keep_out, const std::vector<Regions>& contacts) {
  return Grower(settings, object, stack, keep_out, contacts).grow(keep_out);
}

}  // namespace weft::support
