// SPDX-License-Identifier: GPL-3.0-or-later
/// Memory for small things: operator new and delete of the program.
///
/// A layer takes and frees some ten thousand pieces of up to 200 bytes: points of a clipper, vertices of a line. Here
/// they lie in pages of pieces of one size. A thread takes pieces from pages of its own, without a lock, and puts them
/// back there; what another thread gives back waits in a list of the page until its owner runs short. A page without
/// pieces in use is any thread's again, and goes to the system when many are idle. Pieces have no head, and small ones
/// that live long do not keep what lies around them, as they do in glibc's heap: it takes 5 % of the time of a slice
/// more.
///
/// All pages lie in one range of addresses, by which operator delete knows its own. What is larger, and everything
/// where the system grants no range, is malloc's. Source of the pages' lists: Leijen, Zorn & de Moura 2019, "Mimalloc:
/// free list sharding in action".
///
/// operator new is also where work is stopped that a library does in one go (core/stop_inside.h).
///
/// Where a sanitizer watches memory the operators are its own; `take` and `give` are there for tests that it sees.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WEFT_MEMORY_IS_WATCHED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define WEFT_MEMORY_IS_WATCHED
#endif
#endif

#include "small_memory.h"

#include "core/stop_inside.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include <sys/mman.h>
#include <sys/resource.h>

namespace {

constexpr std::size_t step = 16;          ///< bytes; sizes of pieces are multiples of it: they are aligned
constexpr std::size_t kinds = 16;         ///< of sizes: up to 256 bytes
constexpr std::size_t page_bytes = 4096;  ///< the least that the system takes back
constexpr std::size_t most_bytes = std::size_t{4} << 30;  ///< of addresses, which cost nothing
constexpr std::size_t head_bytes = 64;                    ///< of a page
constexpr std::size_t idle_pages = 256;                   ///< may be kept, 1 MiB, lest they go to and fro, and of those
                                                          ///< that were ever used this share:
constexpr std::size_t idle_share = 64;

struct Piece {
  Piece* next;
};

struct Heap;

/// The head of a page; its pieces follow.
struct Page {
  Heap* owner;
  Piece* free;                   ///< as far as its owner knows
  std::atomic<Piece*> returned;  ///< by other threads
  Page *next, *before;           ///< when `listed`: among those of its kind that have free pieces
  Page* next_returned;           ///< among those that other threads have returned pieces to
  std::uint16_t used;            ///< pieces that are not in `free`
  std::uint8_t kind;
  bool listed;
};
static_assert(sizeof(Page) <= head_bytes && head_bytes % step == 0);

constexpr std::size_t kind_of(std::size_t bytes) {
  return bytes == 0 ? 0 : (bytes - 1) / step;
}

Page* page_of(void* piece) {
  return reinterpret_cast<Page*>(reinterpret_cast<std::uintptr_t>(piece) & ~(page_bytes - 1));
}

/// All pages.
class Range {
 public:
  bool holds(const void* memory) const {
    const std::size_t bytes = bytes_.load(std::memory_order_acquire);
    return reinterpret_cast<std::uintptr_t>(memory) - base_.load(std::memory_order_relaxed) < bytes;
  }

  /// A page that is nobody's; nullptr where there is none.
  void* take() {
    const std::lock_guard lock(mutex_);
    if (!tried_) reserve();
    for (; first_ < words(); ++first_)
      if (idle_[first_] != 0) {  // the lowest, so that idle ones lie together
        const std::size_t page = first_ * 64 + static_cast<std::size_t>(std::countr_zero(idle_[first_]));
        const std::uint64_t bit = bit_of(page);
        idle_[first_] &= ~bit;
        if ((dirty_[first_] & bit) != 0) --dirty_count_;
        dirty_[first_] &= ~bit;
        return at(page);
      }
    return used_ever_ == bytes_.load(std::memory_order_relaxed) / page_bytes ? nullptr : at(used_ever_++);
  }

  void give(Page* memory) {
    const std::lock_guard lock(mutex_);
    const std::size_t page =
        (reinterpret_cast<std::uintptr_t>(memory) - base_.load(std::memory_order_relaxed)) / page_bytes;
    idle_[page / 64] |= bit_of(page);
    dirty_[page / 64] |= bit_of(page);
    first_ = std::min(first_, page / 64);
    if (++dirty_count_ > idle_pages + used_ever_ / idle_share) give_back();
  }

 private:
  static std::uint64_t bit_of(std::size_t page) { return std::uint64_t{1} << (page % 64); }
  std::size_t words() const { return (used_ever_ + 63) / 64; }
  void* at(std::size_t page) const {
    return reinterpret_cast<void*>(base_.load(std::memory_order_relaxed) + page * page_bytes);
  }

  /// Where addresses are limited, most are left to what is larger.
  void reserve() {
    tried_ = true;
    std::size_t bytes = most_bytes;
    if (rlimit limit{}; ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      bytes = std::min<std::size_t>(bytes, limit.rlim_cur / 16);
    const std::size_t pages = bytes / page_bytes / 64 * 64;
    const std::size_t map_bytes = (pages / 8 + page_bytes - 1) / page_bytes * page_bytes;
    void* const all = ::mmap(nullptr, 2 * map_bytes + pages * page_bytes, PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (all == MAP_FAILED) return;
    idle_ = static_cast<std::uint64_t*>(all);
    dirty_ = idle_ + map_bytes / sizeof(std::uint64_t);
    base_.store(reinterpret_cast<std::uintptr_t>(all) + 2 * map_bytes, std::memory_order_relaxed);
    bytes_.store(pages * page_bytes, std::memory_order_release);
  }

  /// The memory of idle pages; those that lie together in one call.
  void give_back() {
    std::size_t from = 0, count = 0;
    const auto give_run = [&] {
      if (count > 0) ::madvise(at(from), count * page_bytes, MADV_DONTNEED);
    };
    for (std::size_t word = 0; word < words(); ++word) {
      for (std::uint64_t rest = dirty_[word]; rest != 0; rest &= rest - 1) {
        const std::size_t page = word * 64 + static_cast<std::size_t>(std::countr_zero(rest));
        if (page != from + count) give_run(), from = page, count = 0;
        ++count;
      }
      dirty_[word] = 0;
    }
    give_run();
    dirty_count_ = 0;
  }

  std::mutex mutex_;
  std::atomic<std::uintptr_t> base_ = 0;
  std::atomic<std::size_t> bytes_ = 0;
  std::uint64_t *idle_ = nullptr, *dirty_ = nullptr;  ///< a bit a page; dirty: idle, with memory
  std::size_t used_ever_ = 0;
  std::size_t first_ = 0;  ///< word of `idle_`; none before it has a bit
  std::size_t dirty_count_ = 0;
  bool tried_ = false;
};
constinit Range range;

/// The pages of one thread.
struct Heap {
  std::array<Page*, kinds> first;  ///< with free pieces, of each kind
  std::atomic<Page*> returned;     ///< that other threads have returned pieces to
  Heap* next_idle;

  void* take(std::size_t kind) {
    if (first[kind] == nullptr) [[unlikely]] {
      if (!find_page(kind)) return nullptr;
    }
    Page* const page = first[kind];
    Piece* const piece = page->free;
    page->free = piece->next;
    ++page->used;
    if (page->free == nullptr) [[unlikely]]
      unlist(page);
    return piece;
  }

  void give(Page* page, void* memory) {
    page->free = new (memory) Piece{page->free};
    --page->used;
    if (!page->listed || page->used == 0) [[unlikely]]
      has_room(page);
  }

 private:
  void list(Page* page) {
    Page*& head = first[page->kind];
    page->next = head, page->before = nullptr, page->listed = true;
    if (head != nullptr) head->before = page;
    head = page;
  }
  void unlist(Page* page) {
    (page->before != nullptr ? page->before->next : first[page->kind]) = page->next;
    if (page->next != nullptr) page->next->before = page->before;
    page->listed = false;
  }

  // What is rare stays out of the way of what is not: a function of its own, or all registers were saved each time.
  [[gnu::noinline]] bool find_page(std::size_t kind) {
    collect();
    return first[kind] != nullptr || add_page(kind);
  }

  /// To be called when pieces of a page have become free. The last of its kind is kept: it would be asked for soon.
  [[gnu::noinline]] void has_room(Page* page) {
    if (!page->listed) list(page);
    if (page->used > 0 || (page->next == nullptr && page->before == nullptr)) return;
    unlist(page);
    range.give(page);
  }

  /// Takes over what other threads have returned. A page cannot go while they may still reach it: a piece that they
  /// hold is in use.
  void collect() {
    for (Page* page = returned.exchange(nullptr, std::memory_order_acquire); page != nullptr;) {
      Page* const next = page->next_returned;  // from the exchange on the page may be put into the list anew
      for (Piece* piece = page->returned.exchange(nullptr, std::memory_order_acq_rel); piece != nullptr;) {
        Piece* const after = piece->next;
        piece->next = page->free, page->free = piece;
        --page->used;
        piece = after;
      }
      has_room(page);
      page = next;
    }
  }

  bool add_page(std::size_t kind) {
    void* const memory = range.take();
    if (memory == nullptr) return false;
    Page* const page =
        new (memory) Page{this, nullptr, nullptr, nullptr, nullptr, nullptr, 0, static_cast<std::uint8_t>(kind), false};
    const std::size_t bytes = (kind + 1) * step;
    for (std::size_t at = head_bytes + (page_bytes - head_bytes) / bytes * bytes; at > head_bytes;) {
      at -= bytes;
      page->free = new (static_cast<std::byte*>(memory) + at) Piece{page->free};
    }
    list(page);
    return true;
  }
};

/// Heaps of threads that have ended: others still hold pieces of them. The next thread takes one up.
constinit std::mutex idle_mutex;
constinit Heap* idle_heaps = nullptr;

constinit thread_local Heap* mine = nullptr;
constinit thread_local bool ended = false;

struct AtEnd {
  ~AtEnd() {
    const std::lock_guard lock(idle_mutex);
    mine->next_idle = idle_heaps, idle_heaps = mine;
    mine = nullptr, ended = true;
  }
};

/// The thread's heap; nullptr where there is none to be had, or the thread is about to end.
[[gnu::noinline]] Heap* find_heap() {
  if (ended) return nullptr;
  {
    const std::lock_guard lock(idle_mutex);
    mine = idle_heaps;
    if (mine != nullptr) idle_heaps = mine->next_idle;
  }
  if (mine == nullptr) {
    void* const memory = std::malloc(sizeof(Heap));
    if (memory == nullptr) return nullptr;
    mine = new (memory) Heap{};
  }
  static thread_local const AtEnd at_end;
  static_cast<void>(at_end);
  return mine;
}

/// Of a piece of another thread's page. Who returns the first piece puts the page on its owner's list.
[[gnu::noinline]] void return_to_owner(Page* page, void* memory) {
  Piece* const piece = new (memory) Piece{page->returned.load(std::memory_order_relaxed)};
  Heap* const owner =
      page->owner;  // until the piece is returned the page cannot go, and after that only its owner may look
  Piece* before = piece->next;
  while (!page->returned.compare_exchange_weak(before, piece, std::memory_order_acq_rel, std::memory_order_relaxed))
    piece->next = before;
  if (before != nullptr) return;
  page->next_returned = owner->returned.load(std::memory_order_relaxed);
  while (!owner->returned.compare_exchange_weak(page->next_returned, page, std::memory_order_release,
                                                std::memory_order_relaxed)) {
  }
}

}  // namespace
#endif

namespace weft::small_memory {
namespace {

[[gnu::noinline]] void* from_malloc(std::size_t bytes) {
  for (;;) {
    if (void* const memory = std::malloc(std::max<std::size_t>(bytes, 1))) return memory;
    const auto handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

#if defined(__linux__)
void* take(std::size_t bytes) {
  if (const std::size_t kind = kind_of(bytes); kind < kinds)
    if (Heap* const heap = mine != nullptr ? mine : find_heap())
      if (void* const piece = heap->take(kind)) return piece;
  return from_malloc(bytes);
}

void give(void* memory) noexcept {
  if (!range.holds(memory)) return std::free(memory);
  Page* const page = page_of(memory);
  if (page->owner == mine)
    mine->give(page, memory);
  else
    return_to_owner(page, memory);
}
#else
void* take(std::size_t bytes) {
  return from_malloc(bytes);
}

void give(void* memory) noexcept {
  std::free(memory);
}
#endif

}  // namespace weft::small_memory

#if defined(__linux__) && !defined(WEFT_MEMORY_IS_WATCHED)
void* operator new(std::size_t bytes) {
  weft::StopInside::step();
  return weft::small_memory::take(bytes);
}

void operator delete(void* memory) noexcept {
  weft::StopInside::gave_back();
  weft::small_memory::give(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  weft::StopInside::gave_back();
  weft::small_memory::give(memory);
}
#endif
