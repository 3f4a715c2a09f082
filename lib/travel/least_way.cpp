// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "travel/tour.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::travel {
namespace {

/// Stops, and the places where the way begins and ends, as nodes of one or two endpoints. In a tour every endpoint has
/// one hop, but for the first and the last where no place is given.
class Tree {
 public:
  Tree(std::span<const Stop> stops, const TourEnds& ends) {
    for (const Stop& s : stops) add(s.a), add(s.b), first_.push_back(points_.size() - 2);
    for (const auto& end : {ends.from, ends.to})
      if (end) add(*end), first_.push_back(points_.size() - 1);
    first_.push_back(points_.size());
    free_ends_ = (ends.from ? 0 : 1) + (ends.to ? 0 : 1);
    price_.assign(points_.size(), 0.0);
    degree_.assign(points_.size(), 0);
  }

  std::size_t nodes() const { return first_.size() - 1; }

  /// The least spanning tree at the prices of now: its bound. Prim's way, since every node is near every other in turn.
  double grow() {
    const std::size_t n = nodes();
    struct Reach {
      double cost = std::numeric_limits<double>::infinity();
      std::size_t own = 0, other = 0;  // endpoints
    };
    std::vector<Reach> reach(n);
    std::vector<char> in(n, 0);
    std::fill(degree_.begin(), degree_.end(), 0);
    double sum = 0;
    for (std::size_t now = 0, k = 0; k < n; ++k) {
      in[now] = 1;
      std::size_t next = n;
      for (std::size_t i = 0; i < n; ++i) {
        if (in[i]) continue;
        for (std::size_t e = first_[now]; e < first_[now + 1]; ++e)
          for (std::size_t f = first_[i]; f < first_[i + 1]; ++f)
            if (const double c = distance(points_[e], points_[f]) + price_[e] + price_[f]; c < reach[i].cost)
              reach[i] = {c, f, e};
        if (next == n || reach[i].cost < reach[next].cost) next = i;
      }
      if (next == n) break;
      sum += reach[next].cost;
      ++degree_[reach[next].own], ++degree_[reach[next].other];
      now = next;
    }
    double prices = 0, least = std::numeric_limits<double>::infinity();
    for (const double p : price_) prices += p, least = std::min(least, p);
    return sum - prices + free_ends_ * least;
  }

  /// Endpoints with more than one hop become dearer, those without one cheaper.
  void charge(double step) {
    for (std::size_t e = 0; e < price_.size(); ++e) price_[e] += step * (degree_[e] - 1);
  }

  double mean_hop(double bound) const { return bound / static_cast<double>(std::max<std::size_t>(1, nodes() - 1)); }

 private:
  void add(Point p) { points_.push_back(p); }

  std::vector<Point> points_;
  std::vector<std::size_t> first_;  // endpoint of each node, and one more
  std::vector<double> price_;
  std::vector<int> degree_;
  int free_ends_ = 0;
};

}  // namespace

double least_way(std::span<const Stop> stops, const TourEnds& ends) {
  constexpr int rounds = 60;
  constexpr double first_step = 0.5, cooling = 0.95;  // of the mean hop
  if (stops.empty()) return ends.from && ends.to ? distance(*ends.from, *ends.to) : 0;
  Tree tree(stops, ends);
  double best = tree.grow(), step = first_step * tree.mean_hop(best);
  StopNowAndThen stop(1);
  for (int round = 0; round < rounds && step > 0; ++round, step *= cooling) {
    stop.step();
    tree.charge(step);
    best = std::max(best, tree.grow());
  }
  return std::max(0.0, best);
}

}  // namespace weft::travel
