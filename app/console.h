// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/error.h"
#include "core/notice.h"

#include <chrono>
#include <string>
#include <string_view>

namespace weft::app {

/// How much the program says on standard error.
enum class Verbosity { quiet, normal, detail };
enum class LogFormat { text, json };
enum class ProgressMode { automatic, always, never };

struct ConsoleOptions {
  Verbosity verbosity = Verbosity::normal;
  LogFormat format = LogFormat::text;
  ProgressMode progress = ProgressMode::automatic;
};

/// The only code that writes to standard error. What cannot be told there is lost, and changes nothing. Standard output
/// belongs to G-code, reports and what was asked for.
class Console {
 public:
  explicit Console(ConsoleOptions options);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void error(const Error& error) noexcept;
  void internal_error(std::string_view what) noexcept;
  void warning(const Notice& notice) noexcept;
  /// A part of the work that failed: told with -q, too.
  void failure(const Notice& notice) noexcept;
  void info(std::string_view message) noexcept;
  void detail(std::string_view message) noexcept;

  /// Shows `share` (0 … 1, never falling) of the work as done; at most ten times a second.
  void progress(std::string_view stage, double share) noexcept;
  /// The same with words of one's own behind the bar, or with facts (a JSON object) for --log-format json, where it is
  /// told once a second and whatever --progress says unless it is never.
  void progress_of(double share, std::string_view words, std::string_view facts) noexcept;

 private:
  void log(std::string_view level, std::string_view message, std::string_view code = {});
  void wipe_progress();
  void draw_bar(double share, std::string_view words);

  ConsoleOptions options_;
  bool shows_progress_ = false;
  bool progress_on_screen_ = false;
  double shown_share_ = -1;
  std::size_t last_words_ = 0;
  std::chrono::steady_clock::time_point last_shown_{};
};

}  // namespace weft::app
