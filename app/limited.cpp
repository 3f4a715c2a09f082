#include "limited.h"

#include "core/stop.h"
#include "limits.h"

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {
namespace {

double limit_of(const po::variables_map& options, const std::string& name) {
  const double value = options[name].as<double>();
  if (!(value >= 0 && value <= 1e9))
    throw Error{Error::Kind::usage, fmt::format("{:g} is outside 0 … 1e9", value), "--" + name, "0 is no limit"};
  return value;
}

}  // namespace

void add_limit_options(po::options_description& to) {
  to.add_options()("timeout", po::value<double>()->value_name("S")->default_value(0, "none"),
                   "stop after so many seconds, with status 130")(
      "max-memory", po::value<double>()->value_name("MB")->default_value(0, "none"),
      "stop above so much resident memory, in the same way");
}

void within_limits(const Command& command, const std::function<void()>& work) {
  const Limits limits(limit_of(command.options, "timeout"), limit_of(command.options, "max-memory"));
  Watchdog watchdog(limits, [&](const Error& error, const Report&) { Console(command.console).error(error); });
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
