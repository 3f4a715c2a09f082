// SPDX-License-Identifier: GPL-3.0-or-later
#include "console.h"

#include "core/json_text.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace weft::app {
namespace {

/// A message on one line that does nothing to a terminal: control characters, of ASCII and of C1, are written as \xNN.
std::string one_line(std::string_view message) {
  std::string out;
  out.reserve(message.size());
  for (std::size_t i = 0; i < message.size(); ++i) {
    const auto c = static_cast<unsigned char>(message[i]);
    const auto next = i + 1 < message.size() ? static_cast<unsigned char>(message[i + 1]) : 0;
    if (c < 0x20 || c == 0x7F)
      out += fmt::format("\\x{:02x}", c);
    else if (c == 0xC2 && next >= 0x80 && next < 0xA0)
      out += fmt::format("\\x{:02x}", next), ++i;
    else
      out += message[i];
  }
  return out;
}

/// To standard error, in one go. A message that cannot be told, because whoever listened has gone or the disk is full,
/// is lost: it changes nothing of the work, nor of what it ends with.
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  const auto text = fmt::format(format, std::forward<Args>(args)...);
  for (std::string_view rest = text; !rest.empty();) {
    const auto written = ::write(STDERR_FILENO, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Nor does memory that is not there for one.
template <class Tell>
void quietly(const Tell& tell) noexcept {
  try {
    tell();
  } catch (const std::exception&) {  // there is no one to tell
  }
}

}  // namespace

Console::Console(ConsoleOptions options) : options_(options) {
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  shows_progress_ =
      options.verbosity != Verbosity::quiet &&
      (options.progress == ProgressMode::always || (options.progress == ProgressMode::automatic && terminal));
}

Console::~Console() {
  quietly([&] { wipe_progress(); });
}

void Console::log(std::string_view level, std::string_view message, std::string_view code) {
  wipe_progress();
  if (options_.format == LogFormat::json) {
    nlohmann::ordered_json line{{"level", level}};
    if (!code.empty()) line["code"] = code;
    line["message"] = message;
    say("{}\n", json_text(std::move(line)));
  } else if (level == "info" || level == "debug") {
    say("weft: {}\n", one_line(message));
  } else {
    say("weft: {}: {}\n", level, one_line(message));
  }
}

void Console::error(const Error& error) noexcept {
  quietly([&] { log("error", error.what()); });
}
void Console::internal_error(std::string_view what) noexcept {
  quietly([&] { log("error", fmt::format("internal error: {}; this is a bug, please report it", what)); });
}
void Console::warning(const Notice& notice) noexcept {
  if (options_.verbosity != Verbosity::quiet) quietly([&] { log("warning", notice.message, notice.code); });
}
void Console::failure(const Notice& notice) noexcept {
  quietly([&] { log(options_.verbosity == Verbosity::quiet ? "error" : "warning", notice.message, notice.code); });
}
void Console::info(std::string_view message) noexcept {
  if (options_.verbosity != Verbosity::quiet) quietly([&] { log("info", message); });
}
void Console::detail(std::string_view message) noexcept {
  if (options_.verbosity == Verbosity::detail) quietly([&] { log("debug", message); });
}

void Console::progress(std::string_view stage, double share) noexcept {
  if (!shows_progress_ || share <= shown_share_) return;
  const auto now = std::chrono::steady_clock::now();
  if (share < 1.0 && now - last_shown_ < std::chrono::milliseconds(100)) return;
  last_shown_ = now;
  shown_share_ = share;
  quietly([&] {
    if (options_.format == LogFormat::json)
      say("{}\n", nlohmann::ordered_json{{"level", "progress"}, {"stage", stage}, {"share", share}}.dump());
    else
      draw_bar(share, stage);
  });
}

void Console::progress_of(double share, std::string_view words, std::string_view facts) noexcept {
  const bool json = options_.format == LogFormat::json;
  const bool wanted =
      json ? options_.progress != ProgressMode::never && options_.verbosity != Verbosity::quiet : shows_progress_;
  const auto now = std::chrono::steady_clock::now();
  if (!wanted || now - last_shown_ < std::chrono::milliseconds(json ? 1000 : 100)) return;
  last_shown_ = now;
  quietly([&] {
    if (!json) return draw_bar(share, words);
    auto line = nlohmann::ordered_json{{"level", "progress"}};
    line.update(nlohmann::ordered_json::parse(facts));
    say("{}\n", line.dump());
  });
}

void Console::draw_bar(double share, std::string_view words) {
  constexpr int cells = 30;
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * cells);
  const auto over = words.size() < last_words_ ? last_words_ - words.size() : 0;  // nothing of the longer line stays
  say("\r[{:#>{}}{:.>{}}] {:3.0f} % {:<12}{:{}}", "", full, "", cells - full, share * 100, one_line(words), "", over);
  last_words_ = words.size();
  progress_on_screen_ = true;
}

void Console::wipe_progress() {
  if (!progress_on_screen_) return;
  say("\r{:{}}\r", "", 60 + last_words_);
  progress_on_screen_ = false;
}

}  // namespace weft::app
