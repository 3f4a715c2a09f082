// SPDX-License-Identifier: GPL-3.0-or-later
#include "limits.h"

#include "jobs/memory.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

namespace weft::app {
namespace {

enum class Reached { nothing, signal, timeout, memory };
std::atomic<Reached> reached_first = Reached::nothing;
static_assert(std::atomic<Reached>::is_always_lock_free);

void note(Reached what) {
  auto expected = Reached::nothing;
  reached_first.compare_exchange_strong(expected, what);
}
extern "C" void note_signal(int) {
  note(Reached::signal);
}

}  // namespace

Limits::Limits(double timeout_s, double max_memory_mb) : timeout_s_(timeout_s), max_memory_mb_(max_memory_mb) {
  reached_first = Reached::nothing;
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

Limits::~Limits() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Limits::reached() const {
  if (reached_first != Reached::nothing) return true;
  if (timeout_s_ <= 0 && max_memory_mb_ <= 0) return false;  // then the clock need not be read
  const auto now = Clock::now();
  if (timeout_s_ > 0 && std::chrono::duration<double>(now - begin_).count() > timeout_s_) note(Reached::timeout);
  if (max_memory_mb_ > 0) {
    constexpr auto often = std::chrono::duration_cast<Clock::duration>(std::chrono::milliseconds(10)).count();
    const auto at = now.time_since_epoch().count();
    auto due = next_look_.load();
    if (at >= due && next_look_.compare_exchange_strong(due, at + often) &&
        static_cast<double>(jobs::resident_bytes()) > 1e6 * max_memory_mb_)
      note(Reached::memory);
  }
  return reached_first != Reached::nothing;
}

Error Limits::error() const {
  switch (reached_first.load()) {
    case Reached::timeout:
      return {Error::Kind::interrupted, fmt::format("stopped after {:g} s; nothing was written", timeout_s_),
              "--timeout", "give it more time, or a coarser layer_height"};
    case Reached::memory:
      return {Error::Kind::interrupted, fmt::format("stopped above {:g} MB; nothing was written", max_memory_mb_),
              "--max-memory", "give it more memory, or a coarser mesh or layer_height"};
    default:
      return {Error::Kind::interrupted, "interrupted", {}, "nothing was written"};
  }
}

Watchdog::Watchdog(const Limits& limits, std::function<void(const Error&, Report)> last_words)
    : limits_(limits), last_words_(std::move(last_words)) {
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (const std::system_error&) {  // no thread to be had: then only the work itself looks at the limits
  }
}

Watchdog::~Watchdog() {
  dismiss();
  if (thread_.joinable()) thread_.join();
}

void Watchdog::remember(const Report& report) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (now - remembered_ < 100ms) return;
  const std::lock_guard lock(mutex_);
  remembered_ = now;
  known_ = report;
}

void Watchdog::dismiss() {
  const std::lock_guard lock(mutex_);
  dismissed_ = true;
  changed_.notify_one();
}

void Watchdog::watch() {
  using namespace std::chrono_literals;
  constexpr std::chrono::milliseconds often = 50ms, patience = 1s;
  std::unique_lock lock(mutex_);
  while (!limits_.reached())
    if (changed_.wait_for(lock, often, [&] { return dismissed_; })) return;
  if (changed_.wait_for(lock, patience, [&] { return dismissed_; })) return;
  last_words_(limits_.error(), known_);  // the lock is kept: who comes to write now waits for the end
  std::_Exit(exit_status(Error::Kind::interrupted));
}

void explain_termination() {
  std::set_terminate([] {
    // What the thread library throws away is no longer there to be asked; a limit on memory makes it the likely cause.
    rlimit limit{};
    const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    const std::string_view text = limited ? "weft: error: the memory that the system grants is used up; nothing was "
                                            "written; raise the limit, or use fewer threads with -j\n"
                                          : "weft: internal error: terminated; this is a bug, please report it\n";
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) std::_Exit(1);
    std::_Exit(limited ? exit_status(Error::Kind::interrupted) : 1);
  });
}

void hold_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that becomes too large is an error of writing, too
  // Opened the wrong way round, so that using it is the error that it would have been.
  for (const auto& [stream, mode] :
       {std::pair(STDIN_FILENO, O_WRONLY), {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_RDONLY}})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      if (const int opened = ::open("/dev/null", mode); opened >= 0 && opened != stream) {
        ::dup2(opened, stream);
        ::close(opened);
      }
}

}  // namespace weft::app
