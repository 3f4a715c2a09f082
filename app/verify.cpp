// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "core/stop.h"
#include "core/version.h"
#include "limited.h"
#include "pipeline/field_files.h"
#include "pipeline/infill_files.h"
#include "pipeline/provenance.h"
#include "verbs.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {
namespace {

/// The model of that name and content: among those the user names, else beside the G-code, else in the folder at hand.
std::string find_model(const Provenance::File& wanted, const std::vector<std::string>& named,
                       const std::filesystem::path& gcode) {
  auto candidates = named;
  if (candidates.empty()) candidates = {(gcode.parent_path() / wanted.name).string(), wanted.name};
  std::string other;
  for (const auto& path : candidates) {
    if (std::error_code error; !std::filesystem::is_regular_file(path, error)) continue;
    if (sha256(FileBytes(path).view()) == wanted.sha256) return path;
    if (std::filesystem::path(path).filename() == wanted.name) other = path;
  }
  if (!other.empty())
    throw Error{Error::Kind::model,
                fmt::format("is not the file that {} was made of: its sha256 is another", gcode.string()), other,
                "it was changed since"};
  throw Error{Error::Kind::file, fmt::format("the model {} was not found", wanted.name), gcode.string(),
              "name it behind the G-code: weft verify FILE.gcode MODEL..."};
}

/// The files that settings name must be there and hold what they held.
void check_infill_files(const Provenance& made_of, const std::string& gcode) {
  const auto now = pipeline::infill_files(made_of.settings.infill);
  for (std::size_t i = 0; i < std::min(now.size(), made_of.infill_files.size()); ++i)
    if (now[i].sha256 != made_of.infill_files[i].sha256)
      throw Error{Error::Kind::settings,
                  fmt::format("is not the {} that {} was made of: its sha256 is another", now[i].key, gcode),
                  now[i].file, "it was changed since"};
}

/// The first line in which they differ, counted from 1, and what stands there.
std::string first_difference(std::string_view made, std::string_view found) {
  const auto [a, b] = std::mismatch(made.begin(), made.end(), found.begin(), found.end());
  const auto line_at = [](std::string_view text, std::size_t at) {
    const auto begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    return text.substr(begin, std::min<std::size_t>(text.find('\n', at) - begin, 80));
  };
  const auto at = static_cast<std::size_t>(a - made.begin());
  const auto number = 1 + std::count(made.begin(), a, '\n');
  return fmt::format("line {}: it says '{}' where weft makes '{}'", number,
                     b == found.end() ? "" : line_at(found, std::min(at, found.size() - 1)),
                     a == made.end() ? "" : line_at(made, std::min(at, made.size() - 1)));
}

/// Slices again and compares. @throws Error
void compare(const Command& command, Console& console) {
  const auto& path = command.inputs.front();
  const FileBytes file(path);
  auto made_of = provenance_of(file.view(), path);
  if (made_of.version != version)
    throw Error{Error::Kind::file, fmt::format("was made by weft {}, and this is {}", made_of.version, version), path,
                "another version may lay other paths: verify it with its own"};

  check_infill_files(made_of, path);

  Job job;
  const std::vector<std::string> named(command.inputs.begin() + 1, command.inputs.end());
  const auto typed = [&](const Provenance::File& of) {
    return find_model(of, named, path) + (of.tool ? fmt::format("@T{}", *of.tool) : std::string());
  };
  for (const auto& model : made_of.models) {
    job.models.push_back(typed(model));
    for (const auto& part : model.further) job.models.back() += "+" + typed(part);
  }
  for (const auto& mark : made_of.marks)
    job.marks.push_back({mark.model, mark.kind,
                         mark.sha256.empty() ? mark.name : find_model({mark.sha256, mark.name}, named, path),
                         mark.settings});
  job.settings = std::move(made_of.settings);
  job.placement = made_of.placement;
  job.by_name = std::move(made_of.by_name);
  job.audit = made_of.audit;
  job.threads = command.threads;
  Report report;
  Watch watch;
  watch.progress = [&](std::string_view stage, double share) { console.progress(stage, share); };
  watch.cancelled = *StopWhen::current();
  const auto again = run(job, watch, report);
  if (!again) throw Error{Error::Kind::audit, report.error, path};
  if (again->gcode() != file.view()) {
    std::string fields;  // what they held the file does not say
    for (const auto& field : pipeline::field_files(job)) fields += (fields.empty() ? ", or " : " or ") + field;
    throw Error{Error::Kind::file,
                "is not what weft makes of its model and settings; " + first_difference(again->gcode(), file.view()),
                path, fmt::format("it{} was changed after it was made", fields)};
  }
  console.info(fmt::format("{}: byte for byte what weft {} makes of {}", path, version, job.models.front()));
}

}  // namespace

po::options_description verify_options() {
  po::options_description out("Options of weft verify");
  add_limit_options(out);
  return out;
}

int verify(const Words& words) {
  const auto options = verify_options();
  const auto command = parse_command(words, options);
  std::ostringstream help;
  help << options;
  if (command.help)
    return write_output("-",
                        "weft verify FILE.gcode [MODEL...]\n\nSlices again from the settings, the placement and the "
                        "model that the file names, and compares every byte.\n\n" +
                            help.str() + "\n" + common_help()),
           0;
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "no G-code was given", "weft verify", "as in weft verify part.gcode part.stl"};
  Console console(command.console);
  within_limits(command, [&] { compare(command, console); });
  return 0;
}

}  // namespace weft::app
