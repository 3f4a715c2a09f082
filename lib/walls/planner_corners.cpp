// How beads turn back in corners.
#include "core/stop.h"
#include "walls/planner.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {

void Planner::run_into_corners() {
  const auto nodes = static_cast<std::uint32_t>(any_.size());
  StopNowAndThen stop(256);
  for (std::uint32_t n = 0; n < nodes; ++n) {
    stop.step();
    std::uint32_t core = ~0U;
    for_each_leaving(any_[n], [&](std::uint32_t h) {
      if (core_[h / 2] && (core == ~0U || out_.spans[h / 2].pairs > out_.spans[core / 2].pairs)) core = h;
    });
    if (core == ~0U) continue;
    Span span = out_.spans[core / 2];
    const std::uint32_t at = core % 2 == 0 ? span.at_start : span.at_end;
    span.core = span.middle = false;
    span.at_start = span.at_end = at;
    descend_from(n, span);
  }
  for (const std::uint32_t n : peaks_) {
    stop.step();
    const double half = s_.nodes[n].clearance;
    Count count = count_for(w_, 2 * half, true);
    if (count.pairs > 0 && !count.middle && widest(count, 2 * half) > wide_bead()) count.middle = true;
    Span span;
    span.pairs = count.pairs;
    span.open = is_open(w_, count);
    span.at_start = span.at_end = bounds_at(count, {}, 0, half);
    descend_from(n, span);
    if (count.middle && !span.open) out_.dots.push_back(any_[n]);
  }
}

void Planner::descend_from(std::uint32_t n, const Span& span) {
  for_each_leaving(any_[n], [&](std::uint32_t h) {
    if (!core_[h / 2] && !climbs_mouth(h)) leave_.push_back({h, span});
  });
  while (!leave_.empty()) {
    const Descent d = leave_.back();
    leave_.pop_back();
    descend(d.half, d.span);
  }
}

double Planner::track(const Span& span, int i) const {
  const double* b = &out_.bounds[span.at_start];
  return (b[i] + b[i + 1]) / 2;
}

void Planner::descend(std::uint32_t h, Span span) {
  for (;;) {
    if (reached_.size() < core_.size()) reached_.resize(core_.size(), 0);
    if (reached_[h / 2]) return;
    const double from = s_.start(h).clearance, to = s_.end(h).clearance, low = std::min(from, to);
    while (span.open && out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)] > from + same_um)
      span.open = false;
    while (span.pairs > 0 && track(span, span.pairs - 1) > from + same_um) --span.pairs;
    double cut = -1;
    if (span.open && out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)] > low + same_um)
      cut = out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)];
    else if (span.pairs > 0 && track(span, span.pairs - 1) > low + same_um)
      cut = track(span, span.pairs - 1);
    std::uint32_t rest = h;
    if (cut >= 0 && from - to > same_um) {
      const double t = (from - cut) / (from - to);
      if (t > 1e-9) {
        const std::uint32_t e = h / 2, f = split(e, h % 2 == 0 ? t : 1 - t);
        reached_.push_back(0);
        if (h % 2 == 1) h = 2 * f + 1;
        rest = s_.halves[h].next;
      }
    }
    if (out_.spans.size() < core_.size()) out_.spans.resize(core_.size());
    if (rest == h && cut >= 0) {  // begins exactly where a bead ends
      if (span.open)
        span.open = false;
      else
        --span.pairs;
      continue;
    }
    out_.spans[h / 2] = span;
    out_.spans[h / 2].mouth = mouth_[h / 2] != 0;
    reached_[h / 2] = 1;
    if (rest != h) {
      if (span.open)
        span.open = false;
      else
        --span.pairs;
      h = rest;
      continue;
    }
    const std::uint32_t back = Skeleton::twin(h);
    bool at_core = false;
    for_each_leaving(back, [&](std::uint32_t g) { at_core = at_core || core_[g / 2]; });
    if (at_core) return;
    for_each_leaving(back, [&](std::uint32_t g) {
      if (g != back && !climbs_mouth(g)) leave_.push_back({g, span});
    });
    return;
  }
}

}  // namespace weft::walls
