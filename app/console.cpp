#include "console.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace weft::app {

Console::Console(ConsoleOptions options) : options_(options) {
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  shows_progress_ =
      options.verbosity != Verbosity::quiet &&
      (options.progress == ProgressMode::always || (options.progress == ProgressMode::automatic && terminal));
}

Console::~Console() {
  wipe_progress();
}

void Console::log(std::string_view level, std::string_view message, std::string_view code) {
  wipe_progress();
  if (options_.format == LogFormat::json) {
    nlohmann::ordered_json line{{"level", level}};
    if (!code.empty()) line["code"] = code;
    line["message"] = message;
    fmt::print(stderr, "{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  } else if (level == "info" || level == "debug") {
    fmt::print(stderr, "weft: {}\n", message);
  } else {
    fmt::print(stderr, "weft: {}: {}\n", level, message);
  }
}

void Console::error(const Error& error) {
  log("error", error.what());
}
void Console::internal_error(std::string_view what) {
  log("error", fmt::format("internal error: {}; this is a bug, please report it", what));
}
void Console::warning(const Notice& notice) {
  if (options_.verbosity != Verbosity::quiet) log("warning", notice.message, notice.code);
}
void Console::info(std::string_view message) {
  if (options_.verbosity != Verbosity::quiet) log("info", message);
}
void Console::detail(std::string_view message) {
  if (options_.verbosity == Verbosity::detail) log("debug", message);
}

void Console::progress(std::string_view stage, double share) {
  if (!shows_progress_ || share <= shown_share_) return;
  const auto now = std::chrono::steady_clock::now();
  if (share < 1.0 && now - last_shown_ < std::chrono::milliseconds(100)) return;
  last_shown_ = now;
  shown_share_ = share;
  if (options_.format == LogFormat::json) {
    fmt::print(stderr, "{}\n",
               nlohmann::ordered_json{{"level", "progress"}, {"stage", stage}, {"share", share}}.dump());
    return;
  }
  draw_bar(share, stage);
}

void Console::progress_of(double share, std::string_view words, std::string_view facts) {
  const bool json = options_.format == LogFormat::json;
  const bool wanted =
      json ? options_.progress != ProgressMode::never && options_.verbosity != Verbosity::quiet : shows_progress_;
  const auto now = std::chrono::steady_clock::now();
  if (!wanted || now - last_shown_ < std::chrono::milliseconds(json ? 1000 : 100)) return;
  last_shown_ = now;
  if (!json) return draw_bar(share, words);
  auto line = nlohmann::ordered_json{{"level", "progress"}};
  line.update(nlohmann::ordered_json::parse(facts));
  fmt::print(stderr, "{}\n", line.dump());
}

void Console::draw_bar(double share, std::string_view words) {
  constexpr int cells = 30;
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * cells);
  fmt::print(stderr, "\r[{:#>{}}{:.>{}}] {:3.0f} % {:<12}", "", full, "", cells - full, share * 100, words);
  if (words.size() < last_words_)
    fmt::print(stderr, "{:{}}", "", last_words_ - words.size());  // nothing of the longer line stays
  last_words_ = words.size();
  std::fflush(stderr);
  progress_on_screen_ = true;
}

void Console::wipe_progress() {
  if (!progress_on_screen_) return;
  fmt::print(stderr, "\r{:{}}\r", "", 60 + last_words_);
  progress_on_screen_ = false;
}

}  // namespace weft::app
