// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/pack.h"

#include "core/stop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include <zlib.h>

namespace weft::preview {
namespace {

std::int64_t grains(Um um) {
  return std::lround(static_cast<double>(um) / page_grain);
}

/// A column of what rarely changes: how often, and by how much it then changes.
class Runs {
 public:
  void add(std::int64_t v) {
    if (v == last_ && count_ > 0) {
      ++count_;
      return;
    }
    end();
    numbers_.step(v - before_);
    before_ = last_ = v;
    count_ = 1;
  }
  std::string bytes() {
    end();
    count_ = 0;
    return numbers_.bytes();
  }

 private:
  void end() {
    if (count_ > 0) numbers_.add(count_);
  }
  Numbers numbers_;
  std::int64_t last_ = 0, before_ = 0;
  std::uint64_t count_ = 0;
};

/// What a column of runs holds, of each stroke.
struct Look {
  std::int64_t (*of)(const Stroke&);
};
constexpr std::array looks{
    Look{[](const Stroke& s) { return grains(s.z); }},
    Look{[](const Stroke& s) { return grains(s.height); }},
    Look{[](const Stroke& s) { return std::int64_t{std::lround(std::clamp(s.speed_mm_s, 0.F, 6000.F) * 10)}; }},
    Look{[](const Stroke& s) { return std::int64_t{s.feature} * 2 + s.compensated; }},
    Look{[](const Stroke& s) { return std::int64_t{s.tool}; }},
    Look{[](const Stroke& s) { return std::int64_t{s.fan_percent}; }},
    Look{[](const Stroke& s) { return std::int64_t{s.nozzle_c}; }},
    Look{[](const Stroke& s) { return std::int64_t{s.support_percent + 5} / 10; }},  // tenths: finer ones are noise
};

class Columns {
 public:
  void add(const Toolpaths& paths) {
    std::int64_t event_at = 0, begin = 0;
    StopNowAndThen stop(4096);
    for (const auto& layer : paths.layers) {
      counts_.add(layer.strokes.size());
      for (const auto& stroke : layer.strokes) {
        stop.step();
        add(stroke);
      }
      for (const auto& event : layer.events) {
        events_.add(static_cast<std::uint64_t>(event.kind));
        events_.step(begin + event.stroke - event_at);
        event_at = begin + event.stroke;
      }
      begin += static_cast<std::int64_t>(layer.strokes.size());
    }
  }

  std::string bytes() {
    Numbers out;
    std::string body;
    const auto column = [&](const std::string& bytes) {
      out.add(bytes.size());
      body += bytes;
    };
    column(x_.bytes()), column(y_.bytes()), column(width_.bytes());
    for (auto& runs : runs_) column(runs.bytes());
    column(lines_.bytes()), column(starts_.bytes()), column(counts_.bytes()), column(events_.bytes());
    return out.bytes() + body;
  }

 private:
  void add(const Stroke& stroke) {
    const std::int64_t from_x = grains(stroke.from.x), from_y = grains(stroke.from.y);
    if (from_x != at_x_ || from_y != at_y_ || index_ == 0) {  // where it was before is not known: a jump
      starts_.add(index_ - started_);
      started_ = index_;
      starts_.step(from_x - at_x_), starts_.step(from_y - at_y_);
      at_x_ = from_x, at_y_ = from_y;
    }
    ++index_;
    const std::int64_t to_x = grains(stroke.to.x), to_y = grains(stroke.to.y);
    x_.step(to_x - at_x_), y_.step(to_y - at_y_);
    at_x_ = to_x, at_y_ = to_y;
    const std::int64_t width = stroke.extrudes() ? std::max<std::int64_t>(1, grains(stroke.width)) : 0;
    if (width == 0) {
      width_.add(0);
    } else {  // folded, and one more: 0 is a travel, which leaves the width of the bead before it in force
      const std::int64_t step = width - bead_width_;
      width_.add(1 + static_cast<std::uint64_t>(step < 0 ? -2 * step - 1 : 2 * step));
      bead_width_ = width;
    }
    for (std::size_t i = 0; i < looks.size(); ++i)
      if (i != 1 || stroke.extrudes()) runs_[i].add(looks[i].of(stroke));
    lines_.add(static_cast<std::int64_t>(stroke.line) - line_);
    line_ = stroke.line;
  }

  Numbers x_, y_, width_, starts_, counts_, events_;
  std::array<Runs, looks.size()> runs_;
  Runs lines_;
  std::int64_t at_x_ = 0, at_y_ = 0, bead_width_ = 0, line_ = 0;
  std::uint64_t index_ = 0, started_ = 0;
};

}  // namespace

std::string deflated(const std::string& bytes) {
  constexpr int level = 9;
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), level);
  if (status != Z_OK) throw std::bad_alloc();  // nothing else can fail here
  out.resize(size);
  return out;
}

std::string packed(const Toolpaths& paths) {
  Columns columns;
  columns.add(paths);
  return deflated(columns.bytes());
}

}  // namespace weft::preview
