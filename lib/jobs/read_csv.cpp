// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/escape.h"
#include "core/join.h"
#include "core/json_text.h"
#include "jobs/job_list.h"
#include "profile/profile.h"
#include "settings/catalogue.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft::jobs {
namespace {

struct Row {
  int line = 0;  ///< where it begins
  std::vector<std::string> cells;
};

/// What separates cells: `;` where spreadsheets write that, as they do where the comma is the decimal sign.
char separator_of(std::string_view text) {
  const auto header = text.substr(0, text.find('\n'));
  return header.find(',') == std::string_view::npos && header.find(';') != std::string_view::npos ? ';' : ',';
}

/// Rows of a CSV text (RFC 4180), blank ones left out. @throws Error{usage} for a quote that is not closed
std::vector<Row> rows_of(std::string_view text, char separator, const std::string& path) {
  std::vector<Row> rows;
  Row row{1, {}};
  std::string cell;
  bool quoted = false, was_quoted = false;
  int line = 1, opened = 1;
  const auto end_cell = [&] {
    row.cells.push_back(was_quoted ? cell : std::string(value::trimmed(cell)));
    cell.clear();
    was_quoted = false;
  };
  const auto end_row = [&] {
    end_cell();
    if (row.cells.size() > 1 || !row.cells[0].empty()) rows.push_back(row);
    row = {line, {}};
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    line += c == '\n';
    if (quoted) {
      if (c != '"')
        cell += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        cell += text[++i];
      else
        quoted = false;
    } else if (c == '"' && value::trimmed(cell).empty()) {
      quoted = was_quoted = true;
      opened = line;
      cell.clear();
    } else if (c == separator) {
      end_cell();
    } else if (c == '\n') {
      end_row();
    } else if (c != '\r' && !was_quoted) {
      cell += c;
    }
  }
  if (quoted) throw Error{Error::Kind::usage, "a quote is opened and not closed", fmt::format("{}:{}", path, opened)};
  if (!cell.empty() || !row.cells.empty()) end_row();
  return rows;
}

std::vector<std::string> items_of(const std::string& name, const std::string& cell, char between) {
  if (name != "models" && name != "profiles") return {cell};
  std::vector<std::string> out;
  for (std::size_t from = 0; from <= cell.size();) {
    const auto end = std::min(cell.find(between, from), cell.size());
    out.emplace_back(value::trimmed(std::string_view(cell).substr(from, end - from)));
    from = end + 1;
  }
  return out;
}

void check_header(const Row& header, const std::string& path) {
  std::set<std::string> seen;
  const auto where = fmt::format("{}:{}", path, header.line);
  for (const auto& name : header.cells) {
    const auto& fields = field_names();
    if (std::find(fields.begin(), fields.end(), name) == fields.end() && !is_free_field(name) && !find_setting(name)) {
      const auto near = nearest_key(name);
      throw Error{Error::Kind::usage,
                  fmt::format("column {} is neither a field of a job nor a setting", escape::message(name)), where,
                  near.empty() ? "fields: " + joined(fields) : fmt::format("did you mean '{}'?", near)};
    }
    if (!seen.insert(name).second)
      throw Error{Error::Kind::usage, fmt::format("column {} is given twice", escape::message(name)), where};
  }
}

}  // namespace

JobList read_csv(std::string_view text, const std::string& path, const std::filesystem::path& folder) {
  JobList list;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const char separator = separator_of(text), between = separator == ';' ? ',' : ';';
  const auto rows = rows_of(text, separator, path);
  if (rows.empty()) return list;
  const auto& header = rows.front();
  check_header(header, path);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const auto& row = rows[r];
    JobLine job;
    job.where = fmt::format("{}:{}", path, row.line);
    try {
      if (row.cells.size() != header.cells.size())
        throw std::invalid_argument(
            fmt::format("{} cells, and the header has {}", row.cells.size(), header.cells.size()));
      for (std::size_t i = 0; i < row.cells.size(); ++i) {
        const auto& name = header.cells[i];
        const auto& cell = row.cells[i];
        if (cell.empty()) continue;
        refuse_cut_off(cell);
        if (is_free_field(name)) {
          job.free_fields.emplace_back(name, json_text(nlohmann::json(cell)));
          continue;
        }
        try {
          if (!set_field(job, name, items_of(name, cell, between), folder)) job.settings.emplace_back(name, cell);
        } catch (const std::invalid_argument& problem) {
          throw std::invalid_argument(fmt::format("{}: {}", name, problem.what()));
        }
      }
      place_field_files(job, folder);
      list.jobs.push_back(std::move(job));
    } catch (const std::invalid_argument& problem) {
      list.errors.emplace_back(Error::Kind::usage, problem.what(), job.where, "");
    }
  }
  return list;
}

}  // namespace weft::jobs
