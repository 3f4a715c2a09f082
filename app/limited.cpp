// SPDX-License-Identifier: GPL-3.0-or-later
#include "limited.h"

#include "core/stop.h"
#include "limits.h"
#include "slice_job.h"
#include "tasks/tasks.h"

namespace po = boost::program_options;

namespace weft::app {
void add_limit_options(po::options_description& to) {
  to.add_options()("timeout", po::value<double>()->value_name("S")->default_value(0, "none"),
                   "stop after so many seconds, with status 130")(
      "max-memory", po::value<double>()->value_name("MB")->default_value(0, "none"),
      "stop above so much resident memory, in the same way");
}

void within_limits(const Command& command, const std::function<void()>& work) {
  const Limits limits(limit_of(command.options, "timeout"), limit_of(command.options, "max-memory"));
  Watchdog watchdog(limits, [&](const Error& error, const Report&) { Console(command.console).error(error); });
  const tasks::ThreadLimit threads(command.threads);
  const std::function<bool()> whether = [&] { return limits.reached(); };
  const StopWhen stop_when(&whether);
  try {
    work();
    watchdog.dismiss();
  } catch (const Stopped&) {
    watchdog.dismiss();
    throw limits.error();
  } catch (const Error& error) {
    watchdog.dismiss();
    if (error.kind() != Error::Kind::interrupted) throw;
    throw limits.error();
  }
}

}  // namespace weft::app
