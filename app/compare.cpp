// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/compare.h"

#include "command.h"
#include "core/file_bytes.h"
#include "limited.h"
#include "page_file.h"
#include "preview/page.h"
#include "preview_file.h"
#include "settings/catalogue.h"
#include "tasks/tasks.h"
#include "verbs.h"

#include <filesystem>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {

po::options_description compare_options() {
  po::options_description out("Options of weft compare");
  out.add_options()("tolerance", po::value<double>()->value_name("PERCENT")->default_value(0, "0"),
                    "how far figures may differ before the status is 8: each as a share of the larger print's; 0: each "
                    "move must be the same");
  add_limit_options(out);
  return out;
}

namespace {

constexpr int differing = 8;  // exit status

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Settings that differ, or why they cannot be told apart.
void compare_settings(const std::optional<Settings>& a, const std::optional<Settings>& b,
                      preview::CompareReport& about) {
  if (!a || !b) {
    about.settings_note = fmt::format("{} says nothing of its settings that weft reads",
                                      !a && !b ? "neither file" : (!a ? about.file_a : about.file_b));
    return;
  }
  about.settings = preview::differences(as_text(*a), as_text(*b));
  if (about.settings.empty()) about.settings_note = "the settings are the same";
}

std::string page_of_two(const preview::Toolpaths& a, const preview::Toolpaths& b, const Command& command,
                        const std::string& comparison) {
  preview::Page page;
  const auto &first = command.inputs[0], &second = command.inputs[1];
  page.title = name_of(first) + " | " + name_of(second);
  page.prints.push_back({a, name_of(first)});
  page.prints.push_back({b, name_of(second)});
  page.comparison = comparison;
  return preview::page(page);
}

struct Compared {
  preview::Comparison comparison;
  preview::CompareReport about;
  std::string page;  ///< "" where none is asked for
};

/// @throws Error
Compared compared(const Command& command, double tolerance) {
  const tasks::ThreadLimit threads(command.threads);
  const auto &path_a = command.inputs[0], &path_b = command.inputs[1];
  const FileBytes file_a(path_a), file_b(path_b);
  const auto own_a = settings_in(path_a), own_b = settings_in(path_b);
  const Settings machine = settings_for(command, path_a);
  const auto read = [&](const FileBytes& file, const std::optional<Settings>& own, const std::string& path) {
    Settings settings = own.value_or(machine);  // what E means is its own, how fast it goes is the machine's
    settings.machine = machine.machine;
    return toolpaths_of(file.view(), settings, path);
  };
  const auto a = read(file_a, own_a, path_a), b = read(file_b, own_b, path_b);
  Compared out{preview::compare(a, b), {name_of(path_a), name_of(path_b), tolerance, {}, {}}, {}};
  compare_settings(own_a, own_b, out.about);
  if (command.output) out.page = page_of_two(a, b, command, preview::page_json_of(out.comparison, out.about));
  return out;
}

std::string help() {
  std::ostringstream out;
  out << "weft compare A.gcode B.gcode [-o OUT.html]    what differs between two prints, of whichever slicers\n\n"
         "Compares time and plastic by feature, per layer the area that only one covers, travel, retractions, widths,\n"
         "speeds, and settings where both files tell them. Both are timed by the same machine: the profile's, else "
         "that "
         "of A.\n"
         "-o writes a page that shows both, --report the figures as JSON. The status is 0 where they are alike and 8 "
         "where\nthey differ.\n\n"
      << compare_options() << "\n"
      << common_help();
  return out.str();
}

}  // namespace

int compare(const Words& words) {
  const auto command = parse_command(words, compare_options());
  if (command.help) return write_output("-", help()), 0;
  if (command.inputs.size() != 2)
    throw Error{Error::Kind::usage, fmt::format("takes two G-code files, not {}", command.inputs.size()),
                "weft compare", "as in weft compare before.gcode after.gcode -o page.html"};
  const double tolerance = command.options["tolerance"].as<double>();
  if (!(tolerance >= 0 && tolerance <= 100)) throw Error{Error::Kind::usage, "must be 0 … 100 %", "--tolerance"};
  if (command.output && preview_kind(*command.output) != preview::Kind::html)
    throw Error{Error::Kind::usage, "is no .html: a comparison is a page", *command.output, "--report writes JSON"};
  Console console(command.console);
  Compared made;
  within_limits(command, [&] { made = compared(command, tolerance); });
  if (command.output) write_output(*command.output, made.page);
  if (command.report) write_output(*command.report, preview::json_of(made.comparison, made.about));
  const auto& [comparison, about, page] = made;
  console.info(preview::verdict_of(comparison, tolerance));
  for (const auto& figure : comparison.figures)
    if (figure.percent > tolerance)
      console.info(fmt::format("  {}: {:.6g} and {:.6g} {}, {:.2f} %", figure.name, figure.a, figure.b, figure.unit,
                               figure.percent));
  for (const auto& s : about.settings) console.detail(fmt::format("  {}: {} and {}", s.key, s.a, s.b));
  return comparison.alike(tolerance) ? 0 : differing;
}

}  // namespace weft::app
