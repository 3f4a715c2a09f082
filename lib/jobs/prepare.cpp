// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/prepare.h"

#include "gcode/writer.h"
#include "jobs/record.h"
#include "pipeline/arranged.h"
#include "pipeline/field_files.h"
#include "pipeline/made_at.h"
#include "pipeline/model_parts.h"
#include "pipeline/profile_file.h"
#include "pipeline/project.h"

#include <map>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace weft::jobs {
namespace {

/// "orders.jsonl:12: pla.ini:3": the line of the list, then the place in it that the error names.
Error at_line(const Error& error, const std::string& line) {
  const auto where = error.where().empty() || error.where() == line ? line : fmt::format("{}: {}", line, error.where());
  return {error.kind(), error.problem(), where, error.hint()};
}

void check_model(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw Error{Error::Kind::file, "is not there", path, "paths in a list are relative to the list"};
  if (S_ISDIR(status.st_mode)) throw Error{Error::Kind::file, "is a folder", path, "name a model in it"};
  if (::access(path.c_str(), R_OK) != 0)
    throw Error{Error::Kind::file, "cannot be read", path, "check its permissions"};
}

/// Profiles by the files they are laid from.
class ProfileShelf {
 public:
  const Profile& of(const std::vector<std::filesystem::path>& files, const ImportOptions& import) {
    const auto at = profiles_.find(files);
    if (at != profiles_.end()) return at->second;
    Profile profile;
    for (const auto& file : files) apply_profile(profile, file, import);
    return profiles_.emplace(files, std::move(profile)).first->second;
  }

 private:
  std::map<std::vector<std::filesystem::path>, Profile> profiles_;
};

/// The settings of a job whose profiles are laid.
/// @param refused is why its project cannot be printed: that is its model's fault, not the list's
Settings settings_of(Profile& profile, const JobLine& line, bool alone, const Common& common,
                     std::optional<Error>& refused) {
  bool said = true;  // unless it turns out that no project says anything
  try {
    said = apply_project(profile, line.models, alone, line.placement.plate, common.import);
  } catch (const Error& error) {
    refused = error;
  }
  for (const auto& [key, text] : common.settings) apply_value(profile, key, text, "--set " + key);
  for (const auto& [key, text] : line.settings) apply_value(profile, key, text, line.where);
  for (const auto& field : pipeline::field_files(profile.settings, line.by_name, line.marks))
    refuse_outside(field, common.import);
  try {
    check_consistency(profile);
    if (common.made_at) pipeline::tell_time(profile, *common.made_at);
    gcode::check_custom_code(profile.settings);
  } catch (const Error& error) {
    if (!said) throw;
    if (!refused) refused = error;
  }
  return profile.settings;
}

Prepared prepare_one(JobLine line, const Common& common, ProfileShelf& shelf) {
  if (!common.keep_going)
    for (const auto& model : line.models)
      for (const auto& part : pipeline::parts_of(model)) check_model(part.file);
  auto files = common.profiles;
  for (const auto& typed : line.profiles) files.push_back(profile_file(typed, line.folder, common.import.folders));
  Profile profile = shelf.of(files, common.import);
  Prepared out;
  const auto settings = settings_of(profile, line, files.empty(), common, out.refused);
  out.job = {.models = line.models,
             .settings = settings,
             .placement = line.placement,
             .marks = line.marks,
             .by_name = line.by_name,
             .audit = line.audit};
  out.notices = profile.notices;
  for (auto& input : inputs_of(out.job)) out.read.emplace_back(std::move(input));
  out.read.insert(out.read.end(), files.begin(), files.end());
  out.read.insert(out.read.end(), profile.parents.begin(), profile.parents.end());
  out.line = std::move(line);
  return out;
}

/// A job a plate. @throws Error as a job that is begun
void add_plates(Prepared job, std::vector<Prepared>& out) {
  std::size_t count = 1;
  try {
    count = plates_of(job.job);
  } catch (const Error&) {  // told when it is run, as of any job
  }
  for (std::size_t k = 1; k <= count; ++k) {
    auto& own = out.emplace_back(job);
    if (count == 1) return;
    own.job.placement.on_plate = own.line.placement.on_plate = static_cast<int>(k);
    own.line.id = fmt::format("{}_plate_{}", job.line.id, k);
    own.line.output = pipeline::name_of_plate(job.line.output, k);
  }
}

}  // namespace

std::vector<Prepared> prepare(std::vector<JobLine> jobs, const Common& common, std::vector<Error>& errors) {
  ProfileShelf shelf;
  std::vector<Prepared> out;
  out.reserve(jobs.size());
  for (auto& job : jobs) {
    const std::string where = job.where;
    try {
      auto one = prepare_one(std::move(job), common, shelf);
      if (one.job.placement.plates)
        add_plates(std::move(one), out);
      else
        out.push_back(std::move(one));
    } catch (const Error& error) {
      errors.push_back(at_line(error, where));
    }
  }
  return out;
}

}  // namespace weft::jobs
