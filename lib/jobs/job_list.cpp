// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/job_list.h"

#include "settings/value.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>

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
  std::ifstream in(path, std::ios::binary);
  std::string out{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw Error{Error::Kind::file, "cannot be read", path, "check the path and its permissions"};
  return out;
}

std::vector<std::string> models_in(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && named_like_a_model(entry.path())) out.push_back(entry.path().string());
  std::sort(out.begin(), out.end());
  if (out.empty()) throw Error{Error::Kind::usage, "no .stl, .obj or .3mf is in this folder", folder.string()};
  return out;
}

std::vector<std::string> matches_of(const std::string& pattern) {
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

bool leaves_its_folder(const std::string& output) {
  const fs::path path = fs::path(output).lexically_normal();
  return path.is_absolute() || path.empty() || *path.begin() == ".." || path == "." || !path.has_filename() ||
         *path.begin() == ".weft";
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
    else if (named_like_a_model(input))
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
      job.id = job.output.empty() ? fs::path(job.models.front()).stem().string()
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
    if (const auto [at, is_new] = ids.emplace(job.id, job.where); !is_new)
      refuse(job, fmt::format("the id '{}' is that of {}", job.id, at->second), "give each job an id of its own");
    if (leaves_its_folder(job.output))
      refuse(job, fmt::format("output '{}' is not a file in the folder of the results", job.output),
             "give a path relative to -o");
    else if (const auto [at, is_new] = outputs.emplace(fs::path(job.output).lexically_normal().string(), job.where);
             !is_new)
      refuse(job, fmt::format("output '{}' is that of {}", job.output, at->second),
             "give each job an output of its own");
  }
}

}  // namespace weft::jobs
