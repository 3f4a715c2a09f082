// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/job_list.h"

#include "core/file_bytes.h"
#include "pipeline/model_parts.h"
#include "pipeline/transform_words.h"
#include "settings/value.h"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <glob.h>

namespace weft::jobs {
namespace fs = std::filesystem;
namespace {

bool named_like_a_model(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".stl" || extension == ".obj" || extension == ".3mf";
}

std::string bytes_of(const std::string& path) {
  if (path == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;
  std::error_code unknown;
  if (const auto bytes = fs::file_size(path, unknown); !unknown && bytes > most_bytes)
    throw Error{Error::Kind::file, fmt::format("of {} MB is no list of jobs", bytes >> 20), path, "check the path"};
  return std::string(FileBytes(path).view());
}

std::vector<std::string> models_in(const fs::path& folder) {
  std::vector<std::string> out;
  std::error_code error, unknown;  // of an entry that leads to itself, or is gone
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator(); at.increment(error))
    if (named_like_a_model(at->path()) && at->is_regular_file(unknown)) out.push_back(at->path().string());
  if (error)
    throw Error{Error::Kind::file, "cannot be read: " + error.message(), folder.string(), "check its permissions"};
  std::sort(out.begin(), out.end());
  if (out.empty()) throw Error{Error::Kind::usage, "no .stl, .obj or .3mf is in this folder", folder.string()};
  return out;
}

/// Patterns that the braces of one make, at most: as if each were within all others.
double alternatives_in(const std::string& pattern) {
  double out = 1;
  std::vector<int> open;
  for (const char c : pattern) {
    if (c == '{') open.push_back(1);
    if (c == ',' && !open.empty()) ++open.back();
    if (c == '}' && !open.empty()) out *= open.back(), open.pop_back();
  }
  return out;
}

std::vector<std::string> matches_of(const std::string& pattern) {
  constexpr double most = 10'000;
  if (alternatives_in(pattern) > most)
    throw Error{Error::Kind::usage, fmt::format("its braces make more than {} patterns", most), pattern,
                "name a list of jobs"};
  glob_t found{};
  const int status = ::glob(pattern.c_str(), GLOB_BRACE | GLOB_TILDE, nullptr, &found);
  std::vector<std::string> out;
  for (std::size_t i = 0; status == 0 && i < found.gl_pathc; ++i) out.emplace_back(found.gl_pathv[i]);
  ::globfree(&found);
  if (out.empty()) throw Error{Error::Kind::usage, "nothing matches", pattern};
  return out;
}

JobList read_list(const std::string& path) {
  const auto text = bytes_of(path);
  const auto folder = path == "-" ? fs::path() : fs::path(path).parent_path();
  const auto name = path == "-" ? std::string("standard input") : path;
  std::string_view seen = text;
  if (seen.starts_with("\xEF\xBB\xBF")) seen.remove_prefix(3);
  seen = value::trimmed(seen);
  auto list = !seen.empty() && seen.front() == '{' ? read_jsonl(text, name, folder) : read_csv(text, name, folder);
  if (list.jobs.empty() && list.errors.empty()) throw Error{Error::Kind::usage, "holds no job", name};
  return list;
}

void append(JobList& to, JobList from) {
  std::move(from.jobs.begin(), from.jobs.end(), std::back_inserter(to.jobs));
  std::move(from.errors.begin(), from.errors.end(), std::back_inserter(to.errors));
}

/// What a run that is killed leaves of a file, and the next one removes: its name, then .weft- and six letters.
bool named_like_debris(const std::string& output) {
  constexpr std::string_view tail = ".weft-abcdef";
  const auto name = fs::path(output).filename().string();
  return name.size() > tail.size() && name.substr(name.size() - tail.size()).starts_with(".weft-");
}

bool leaves_its_folder(const std::string& output) {
  const fs::path path = fs::path(output).lexically_normal();
  return path.is_absolute() || path.empty() || *path.begin() == ".." || path == "." || !path.has_filename() ||
         *path.begin() == ".weft";
}

/// What a run writes beside the G-code: report.jsonl, summary.csv, junit.xml (-2-of-3 for a share) and index.html. Nor
/// is it a folder.
bool is_a_report(const std::string& output) {
  const auto name = fs::path(output).lexically_normal().begin()->string();
  constexpr std::pair<std::string_view, std::string_view> reports[] = {
      {"report", ".jsonl"}, {"summary", ".csv"}, {"junit", ".xml"}, {"index", ".html"}};
  return std::any_of(std::begin(reports), std::end(reports),
                     [&](const auto& r) { return name.starts_with(r.first) && name.ends_with(r.second); });
}

}  // namespace

JobList jobs_of_models(const std::vector<std::string>& models) {
  JobList list;
  for (const auto& model : models) {
    JobLine job;
    job.where = model;
    job.models = {model};
    list.jobs.push_back(std::move(job));
  }
  return list;
}

JobList read_jobs(const std::vector<std::string>& inputs, const std::string& name) {
  JobList list;
  for (const auto& input : inputs) {
    std::error_code ignored;
    if (fs::is_directory(input, ignored))
      append(list, jobs_of_models(models_in(input)));
    else if (input != "-" && !fs::exists(input, ignored) && input.find_first_of("*?[{") != std::string::npos)
      append(list, jobs_of_models(matches_of(input)));
    else if (named_like_a_model(pipeline::parts_of(input).front().file))
      append(list, jobs_of_models({input}));
    else
      append(list, read_list(input));
  }
  for (auto& job : list.jobs) job.list = name;
  complete(list);
  return list;
}

void complete(JobList& list) {
  std::map<std::string, std::string> ids, outputs;
  const auto refuse = [&](const JobLine& job, std::string what, std::string hint) {
    list.errors.emplace_back(Error::Kind::usage, std::move(what), job.where, std::move(hint));
  };
  for (auto& job : list.jobs) {
    if (job.models.empty()) {
      refuse(job, "names no model", R"(as in "models": ["part.stl"])");
      continue;
    }
    if (job.id.empty())
      job.id = job.output.empty() ? fs::path(pipeline::parts_of(job.models.front()).front().file).stem().string()
                                  : fs::path(job.output).replace_extension().string();
    if (job.output.empty()) {
      job.output = job.id + ".gcode";
      std::replace(job.output.begin(), job.output.end(), '/', '_');
      if (!job.list.empty()) job.output = job.list + "/" + job.output;
    }
    if (job.placement.keep_position && job.placement.centre)
      refuse(job, "keep_position contradicts center", "give one of the two");
    if (job.placement.keep_position && job.placement.copies > 1)
      refuse(job, "keep_position contradicts copies", "copies are arranged on the bed");
    if (job.placement.keep_position && job.placement.by_outlines())
      refuse(job, "keep_position contradicts arrange, fill and plates", "give one of them");
    if (job.placement.fill && job.placement.plates)
      refuse(job, "fill contradicts plates", "fill prints one full plate, plates all of them");
    try {
      pipeline::check_transform(job.placement);
    } catch (const std::invalid_argument& problem) {
      refuse(job, problem.what(), "");
    }
    if (const auto [at, is_new] = ids.emplace(job.id, job.where); !is_new)
      refuse(job, fmt::format("the id '{}' is that of {}", job.id, at->second), "give each job an id of its own");
    if (leaves_its_folder(job.output))
      refuse(job, fmt::format("output '{}' is not a file in the folder of the results", job.output),
             "give a path relative to -o");
    else if (is_a_report(job.output))
      refuse(job, fmt::format("output '{}' is the name of a report", job.output), "as in part.gcode");
    else if (named_like_debris(job.output))
      refuse(job, fmt::format("output '{}' is named like a file that is not whole", job.output), "as in part.gcode");
    else if (const auto [at, is_new] = outputs.emplace(fs::path(job.output).lexically_normal().string(), job.where);
             !is_new)
      refuse(job, fmt::format("output '{}' is that of {}", job.output, at->second),
             "give each job an output of its own");
  }
}

}  // namespace weft::jobs
