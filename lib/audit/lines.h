// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace weft::audit {

/// Cuts bytes that arrive in pieces into lines. Whole lines are handed on where they lie; only a line that spans two
/// pieces is copied, and of one that is longer than `longest` no more than its front is kept.
class Lines {
 public:
  static constexpr std::size_t longest = 1U << 20;

  /// Calls `on_line(line)` for each line that is complete.
  struct Line {
    const char *begin, *end;  ///< *end can be read and is a line feed
    std::int64_t offset;      ///< of its first byte
    bool cut;                 ///< longer than `longest`: this is its front
  };
  template <class OnLine>
  void feed(std::string_view bytes, OnLine on_line) {
    const char* p = bytes.data();
    const char* const first = p;
    const char* const stop = p + bytes.size();
    while (p < stop) {
      const void* const found = std::memchr(p, '\n', static_cast<std::size_t>(stop - p));
      const char* const end = found ? static_cast<const char*>(found) : stop;
      const std::int64_t offset = fed_ + (p - first);
      if (found && !carrying_ && end - p <= static_cast<std::ptrdiff_t>(longest)) {
        on_line(Line{p, end, offset, false});
      } else {
        keep({p, static_cast<std::size_t>(end - p)}, offset);
        if (found) end_line(on_line);
      }
      p = end + 1;
    }
    fed_ += static_cast<std::int64_t>(bytes.size());
  }

  /// The last line, when no line feed ends it.
  template <class OnLine>
  void finish(OnLine on_line) {
    if (carrying_) end_line(on_line);
  }

  std::int64_t bytes() const { return fed_; }

 private:
  void keep(std::string_view piece, std::int64_t offset) {
    if (!carrying_) carry_offset_ = offset;
    carrying_ = true;
    const std::size_t room = longest - carried_.size();
    if (piece.size() > room) cut_ = true;
    carried_.append(piece.substr(0, room));
  }
  template <class OnLine>
  void end_line(OnLine on_line) {
    carried_ += '\n';
    const char* const begin = carried_.data();
    on_line(Line{begin, begin + carried_.size() - 1, carry_offset_, cut_});
    carried_.clear();
    carrying_ = cut_ = false;
  }
  std::string carried_;
  std::int64_t fed_ = 0, carry_offset_ = 0;
  bool carrying_ = false, cut_ = false;
};

}  // namespace weft::audit
