// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/hook.h"

#include "core/error.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace weft::jobs {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int cannot_start = 127, too_long = 124;  // as shells and timeout(1) say it

/// Closed with it.
class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// A file in memory with these bytes, read from its begin.
bool fill(const File& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(file.descriptor(), bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::lseek(file.descriptor(), 0, SEEK_SET) == 0;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (auto& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

/// This process's environment, with the given names in place of its own.
std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& more) {
  std::vector<std::string> out;
  for (char** at = ::environ; at && *at; ++at) {
    const std::string_view line = *at;
    const auto name = line.substr(0, line.find('='));
    if (std::none_of(more.begin(), more.end(), [&](const auto& m) { return m.first == name; })) out.emplace_back(line);
  }
  for (const auto& [name, text] : more) out.push_back(name + "=" + text);
  return out;
}

/// What a program of its own begins with: input from the file, output on standard error, no other open file, signals
/// as they are by default, a process group of its own.
struct Start {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  explicit Start(const File& input) {
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_adddup2(&files, input.descriptor(), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
    ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    ::posix_spawnattr_init(&attributes);
    sigset_t usual;
    ::sigemptyset(&usual);
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGXFSZ}) ::sigaddset(&usual, signal);
    ::posix_spawnattr_setsigdefault(&attributes, &usual);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~Start() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;
};

int status_of(int wait_status) {
  return WIFSIGNALED(wait_status) ? 128 + WTERMSIG(wait_status) : WEXITSTATUS(wait_status);
}

/// Waits for its end; tells it to end when it is late or nobody wants it any more, and after two seconds makes it.
int wait_for(pid_t process, double timeout_s, const std::function<bool()>& cancelled) {
  const auto begin = Clock::now();
  std::optional<Clock::time_point> told;
  bool late = false;
  for (auto pause = 1ms;; pause = std::min(2 * pause, 50ms)) {
    int status = 0;
    const auto ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process) return late ? too_long : status_of(status);
    if (ended < 0 && errno != EINTR) return cannot_start;
    late = late || std::chrono::duration<double>(Clock::now() - begin).count() > timeout_s;
    if (!told && (late || cancelled())) told = Clock::now(), ::kill(-process, SIGTERM);
    if (told && Clock::now() - *told > 2s) ::kill(-process, SIGKILL);
    std::this_thread::sleep_for(pause);
  }
}

int run_once(const Hook& hook, const std::vector<std::pair<std::string, std::string>>& environment,
             std::string_view input, const std::function<bool()>& cancelled) {
  const File file(::memfd_create("report", MFD_CLOEXEC));
  if (file.descriptor() < 0 || !fill(file, input)) return cannot_start;
  auto words = hook.words, variables = environment_with(environment);
  const Start start(file);
  pid_t process = 0;
  if (::posix_spawnp(&process, words.front().c_str(), &start.files, &start.attributes, pointers_to(words).data(),
                     pointers_to(variables).data()) != 0)
    return cannot_start;
  return wait_for(process, hook.timeout_s, cancelled);
}

void pause(std::chrono::milliseconds how_long, const std::function<bool()>& cancelled) {
  for (const auto end = Clock::now() + how_long; Clock::now() < end && !cancelled();) std::this_thread::sleep_for(20ms);
}

}  // namespace

std::vector<std::string> hook_words(const std::string& command) {
  std::vector<std::string> out;
  bool within = false;
  char quote = 0;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      within = false;
      continue;
    }
    if (!within) out.emplace_back(), within = true;
    if (quote == 0 && (c == '\'' || c == '"'))
      quote = c;
    else if (c == quote)
      quote = 0;
    else if (c == '\\' && quote != '\'' && i + 1 < command.size())
      out.back() += command[++i];
    else
      out.back() += c;
  }
  if (quote != 0) throw Error{Error::Kind::usage, fmt::format("the quote {} is not closed", quote), "--exec"};
  if (out.empty() || out.front().empty())
    throw Error{Error::Kind::usage, "names no program", "--exec", "as in --exec 'bash upload.sh printer-7'"};
  return out;
}

HookResult run_hook(const Hook& hook, const std::vector<std::pair<std::string, std::string>>& environment,
                    std::string_view input, const std::function<bool()>& cancelled) {
  HookResult out;
  for (std::chrono::milliseconds wait = 1s; out.attempts <= hook.retries && !cancelled();) {
    ++out.attempts;
    out.status = run_once(hook, environment, input, cancelled);
    if (out.status == 0 || out.attempts > hook.retries) break;
    pause(wait, cancelled);
    wait = std::min<std::chrono::milliseconds>(2 * wait, 30s);
  }
  return out;
}

}  // namespace weft::jobs
