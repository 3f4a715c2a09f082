// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::mesh {

/// Which triangles hang together, and which of them to turn round so that all of a shell agree: a union-find that also
/// holds the way of each triangle. Trees are rooted at their first triangle, so that nothing depends on the order of
/// unions. Source: Anderson & Woll 1991, "Wait-free parallel algorithms for the union-find problem".
class ShellForest {
 public:
  /// Pre: fewer than 2^28 triangles.
  explicit ShellForest(std::size_t triangles);

  /// They hang together; `agree`: neither or both are to be turned.
  /// Returns whether that can be, with what is known already. If not it is forgotten: the shell has no orientation.
  /// Thread: any number at once.
  bool unite(std::uint32_t a, std::uint32_t b, bool agree);

  /// Numbers the shells in the order of their first triangles. Returns how many.
  /// Pre: all are united. Post: `shell` and `turned` may be asked; `unite` no more.
  std::size_t number_shells();

  std::uint32_t shell(std::size_t triangle) const { return word(triangle) >> 1; }
  /// Whether to turn it to agree with the first of its shell. Of a shell without orientation it says nothing.
  bool turned(std::size_t triangle) const { return word(triangle) & 1; }

 private:
  struct Place {
    std::uint32_t root;
    std::uint32_t turned;  ///< against the root: 0 or 1
  };
  Place find(std::uint32_t triangle);
  std::uint32_t word(std::size_t triangle) const { return words_[triangle].load(std::memory_order_relaxed); }

  /// Of each triangle: 2 * one nearer to the root + whether they disagree. Once numbered: 2 * shell + whether it is
  /// turned.
  std::vector<std::atomic<std::uint32_t>> words_;
};

}  // namespace weft::mesh
