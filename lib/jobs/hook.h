// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::jobs {

/// A program that is run when a job has ended: to upload its file, to print a label, to close a ticket.
struct Hook {
  std::vector<std::string> words;  ///< the program, looked for in PATH, and its arguments; empty: none is run
  unsigned retries = 2;            ///< how often more it is run when it fails
  double timeout_s = 600;          ///< of one run
};

struct HookResult {
  int status = 0;  ///< of its last run; 127: could not be started, 128 + n: ended by signal n, 124: took too long
  unsigned attempts = 0;  ///< how often it was run
  bool ok() const { return attempts > 0 && status == 0; }
};

/// The words of a command line as a shell would take them apart, with quotes and backslashes; nothing is expanded.
/// @throws Error{usage} when a quote is not closed or there is no word
std::vector<std::string> hook_words(const std::string& command);

/// Runs it, again after 1, 2, 4 … s when it fails, and waits for its end. No shell is in between; its standard output
/// goes to standard error.
/// @param environment is added to that of this process
/// @param input       is on its standard input
/// @param cancelled   asked often: ends it, and what waits
HookResult run_hook(const Hook& hook, const std::vector<std::pair<std::string, std::string>>& environment,
                    std::string_view input, const std::function<bool()>& cancelled);

}  // namespace weft::jobs
