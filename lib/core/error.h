// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <stdexcept>
#include <string>

namespace weft {

/// Something the user can mend. Caught once, in main, which turns the kind into the exit status.
/// what(): "WHERE: WHAT; HINT" without the parts that are empty.
class Error : public std::runtime_error {
 public:
  enum class Kind { usage, settings, model, audit, file, interrupted };

  /// @param what  one clause, no full stop, in the user's words
  /// @param where a path as the user typed it, with ":line" where there is one; or an option
  /// @param hint  what to try; may be empty
  Error(Kind kind, std::string what, std::string where = {}, std::string hint = {});

  Kind kind() const { return kind_; }
  const std::string& problem() const { return problem_; }
  const std::string& where() const { return where_; }
  const std::string& hint() const { return hint_; }

 private:
  Kind kind_;
  std::string problem_, where_, hint_;
};

/// The exit status of each kind, as the command line promises it.
constexpr int exit_status(Error::Kind kind) {
  switch (kind) {
    case Error::Kind::usage:
      return 2;
    case Error::Kind::settings:
      return 3;
    case Error::Kind::model:
      return 4;
    case Error::Kind::audit:
      return 5;
    case Error::Kind::file:
      return 6;
    case Error::Kind::interrupted:
      return 130;
  }
  return 1;
}

}  // namespace weft
