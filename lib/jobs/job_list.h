// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/error.h"
#include "pipeline/pipeline.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Many jobs: lists of them, what each needs, and running them.
namespace weft::jobs {

/// A job as its line has it: nothing is read yet but the line.
struct JobLine {
  std::string where;                ///< "orders.jsonl:12", for messages
  std::string list;                 ///< name of the list among several that share a folder; may be empty
  std::string id;                   ///< unique in a list
  std::string output;               ///< path of the G-code, relative to the folder of the results; unique in a list
  std::vector<std::string> models;  ///< paths that can be opened from here
  std::vector<std::filesystem::path> profiles;                ///< as typed: paths from `folder`, or names
  std::filesystem::path folder;                               ///< of the list
  std::vector<std::pair<std::string, std::string>> settings;  ///< key and value, in the order given
  Placement placement;
  std::vector<ModelMark> marks{};  ///< where no model is named, of its first one
  ByName by_name{};
  audit::Mode audit = audit::Mode::reject;
  double timeout_s = 0;  ///< 0: that of the batch
  /// What the job is called or wanted for, by name: weft carries it to every report and reads none of it. Values are
  /// JSON: a text, a number, true or false.
  std::vector<std::pair<std::string, std::string>> free_fields;
};

/// A list, and everything that is wrong with it. It is used only when nothing is.
struct JobList {
  std::vector<JobLine> jobs;
  std::vector<Error> errors;  ///< each names its line
};

/// One JSON object a line: {"id": …, "models": […], "profiles": […], "set": {…}, "output": …}, and where they are
/// wanted "center": [x, y], "keep_position", "drop", "scale", "rotate", "copies", "spacing", "audit", "timeout" (s),
/// "plate", "arrange", "fill", "plates", "turn", and the free fields "label", "priority", "due" and "x-…". Blank lines
/// do not count. Models and profiles are relative to `folder`. A model may be an object: {"file": …} or {"parts":
/// [{"file": …, "tool": 1, "set": {…}}]}, "tool", "set", "copies", "place": [x, y, degrees], "modifiers": [{"file": …,
/// "set": {…}}], "negatives": […]. "fill" may be a list of models: they are put on as many plates as it takes, each a
/// job of its own once it is known how many (prepare.h).
JobList read_jsonl(std::string_view text, const std::string& path, const std::filesystem::path& folder);

/// A header line with the same names, of which models and profiles are lists separated by `;` (by `,` where
/// `;` separates the cells); every other column is a
/// setting. An empty cell says nothing. Quotes as RFC 4180 has them; a quoted cell may run over several lines.
JobList read_csv(std::string_view text, const std::string& path, const std::filesystem::path& folder);

/// A job for each model, in that order.
JobList jobs_of_models(const std::vector<std::string>& models);

/// What the user named, in that order: a list of jobs (told by content: JSONL begins with `{`), a model, a folder
/// (every model in it), or a pattern ("parts/*.stl"). "-" is a JSONL or CSV list on standard input.
/// @throws Error{file} for what cannot be read, Error{usage} for a folder or pattern without a model
/// @param name of the list, for JobLine::list
JobList read_jobs(const std::vector<std::string>& inputs, const std::string& name = {});

/// Fills in ids and outputs that were not given (from the output's name, else the first model's; outputs of a list with
/// a name lie in a folder of that name), and adds an error for each line that has no model, or an id or output that
/// another has, or an output that leaves the folder.
void complete(JobList& list);

/// Sets one of the fields above from text. Fields of lists take each text as an item.
/// @return false when there is no such field  @throws std::invalid_argument with one clause when the value is not one
bool set_field(JobLine& job, std::string_view name, const std::vector<std::string>& values,
               const std::filesystem::path& folder);

/// No path, name or setting holds the character 0, at which systems cut them off.
/// @throws std::invalid_argument with one clause
void refuse_cut_off(std::string_view text);

/// A path of a list as it can be opened from here.
std::string path_in(const std::filesystem::path& folder, const std::string& path);

/// The same for every setting of the job that names a file.
void place_field_files(JobLine& job, const std::filesystem::path& folder);

/// Whether it is the name of a field that is only carried: label, priority, due, or anything that begins with "x-".
bool is_free_field(std::string_view name);

/// The value of a free field as a cell or a variable has it: a text without its quotes.
std::string free_text(const std::string& json);

/// Names of the fields that set_field knows.
const std::vector<std::string_view>& field_names();

}  // namespace weft::jobs
