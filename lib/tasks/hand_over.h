// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef WEFT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace weft::tasks {

/// What TBB promises, told to the thread sanitizer: what was done before a baton was passed is seen by who takes it
/// after.
///
/// Debian's libtbb is not built with the sanitizer, and half of TBB is in its headers. Therefore only tasks.cpp and
/// crew.cpp include them, these two are not built with it either (lib/CMakeLists.txt), and say here what it cannot see.
/// Nothing is said between two tasks that run side by side, so that a race between them is still found.
class Baton {
 public:
  Baton() = default;
  Baton(const Baton&) = delete;
  Baton& operator=(const Baton&) = delete;
#ifdef WEFT_THREAD_SANITIZER
  void pass() {
    __tsan_release(&address_);
  }
  void take() {
    __tsan_acquire(&address_);
  }

 private:
  char address_ = 0;  // is all that matters of it
#else
  void pass() {}
  void take() {}
#endif
};

/// From who begins tasks to each of them, and from each to who has waited for all.
class HandOver {
 public:
  void begin() { to_tasks_.pass(); }
  void end() { from_tasks_.take(); }

  /// What a task has around its work.
  class Task {
   public:
    explicit Task(HandOver& of) : of_(of) { of_.to_tasks_.take(); }
    ~Task() { of_.from_tasks_.pass(); }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

   private:
    HandOver& of_;
  };
  /// What has been waited for when it goes, also by an error.
  class Wait {
   public:
    explicit Wait(HandOver& of) : of_(of) {}
    ~Wait() { of_.end(); }
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;

   private:
    HandOver& of_;
  };

 private:
  Baton to_tasks_, from_tasks_;
};

}  // namespace weft::tasks
