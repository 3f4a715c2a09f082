// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/job_list.h"
#include "pipeline/field_files.h"
#include "pipeline/transform_words.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace weft::jobs {
namespace {

using Values = std::vector<std::string>;

double number(const std::string& text, double least, double most) {
  double v = 0;
  value::parse(text, Unit::none, v);
  if (!(v >= least && v <= most)) throw std::invalid_argument(fmt::format("{} is outside {} … {}", text, least, most));
  return v;
}

bool flag(const std::string& text) {
  bool v = false;
  value::parse(text, Unit::none, v);
  return v;
}

Point point(const Values& values) {
  std::string text = values.size() == 2 ? values[0] + "x" + values[1] : values.empty() ? std::string() : values[0];
  std::replace(text.begin(), text.end(), ',', 'x');
  Ring out;
  value::parse(text, Unit::none, out);
  if (out.size() != 1) throw std::invalid_argument(fmt::format("'{}' is not X,Y in mm", text));
  return out.front();
}

audit::Mode mode(const std::string& text) {
  if (text == "reject") return audit::Mode::reject;
  if (text == "annotate") return audit::Mode::annotate;
  throw std::invalid_argument(fmt::format("'{}' is not one of reject, annotate", text));
}

/// A model: a file, or several between `+`, each in the folder.
std::string placed_model(const std::string& typed, const std::filesystem::path& folder) {
  auto whole = path_in(folder, typed);
  std::error_code unknown;
  if (typed.find('+') == std::string::npos || std::filesystem::exists(whole, unknown)) return whole;
  std::string out;
  for (std::size_t begin = 0; begin <= typed.size();) {
    const auto end = std::min(typed.find('+', begin), typed.size());
    out += (begin == 0 ? "" : "+") + path_in(folder, typed.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

struct Field {
  std::string_view name;
  bool list;
  void (*set)(JobLine&, const Values&, const std::filesystem::path&);
};
using Folder = const std::filesystem::path&;
void add_models(JobLine& j, const Values& v, Folder folder) {
  for (const auto& typed : v) j.models.push_back(placed_model(typed, folder));
}
void add_profiles(JobLine& j, const Values& v, Folder folder) {
  j.folder = folder;
  for (const auto& path : v) j.profiles.emplace_back(path);
}
template <mesh::MarkKind kind>
void add_marks(JobLine& j, const Values& v, Folder folder) {
  for (const auto& source : v)
    j.marks.push_back({0, kind, source.starts_with("box:") ? source : path_in(folder, source)});
}
constexpr std::array fields{
    Field{"id", false, [](JobLine& j, const Values& v, Folder) { j.id = v[0]; }},
    Field{"models", true, add_models},
    Field{"model", false, add_models},
    Field{"profiles", true, add_profiles},
    Field{"profile", false, add_profiles},
    Field{"output", false, [](JobLine& j, const Values& v, Folder) { j.output = v[0]; }},
    Field{"center", true, [](JobLine& j, const Values& v, Folder) { j.placement.centre = point(v); }},
    Field{"keep_position", false, [](JobLine& j, const Values& v, Folder) { j.placement.keep_position = flag(v[0]); }},
    Field{"drop", false, [](JobLine& j, const Values& v, Folder) { j.placement.drop = flag(v[0]); }},
    Field{"rotate", false,
          [](JobLine& j, const Values& v, Folder) { j.placement.rotate_deg = number(v[0], -36000, 36000); }},
    Field{"support_enforcer", true, add_marks<mesh::MarkKind::support_enforcer>},
    Field{"support_blocker", true, add_marks<mesh::MarkKind::support_blocker>},
    Field{"support_mesh", true, add_marks<mesh::MarkKind::support>},
    Field{"negative", true, add_marks<mesh::MarkKind::negative>},
    Field{"arrange", false, [](JobLine& j, const Values& v, Folder) { j.placement.arrange = flag(v[0]); }},
    Field{"fill", false, [](JobLine& j, const Values& v, Folder) { j.placement.fill = flag(v[0]); }},
    Field{"plates", false, [](JobLine& j, const Values& v, Folder) { j.placement.plates = flag(v[0]); }},
    Field{"turn", false, [](JobLine& j, const Values& v, Folder) { j.placement.turn_deg = number(v[0], 0, 180); }},
    Field{"plate", false,
          [](JobLine& j, const Values& v, Folder) { j.placement.plate = static_cast<int>(number(v[0], 1, 10000)); }},
    Field{"copies", false,
          [](JobLine& j, const Values& v, Folder) {
            const double n = number(v[0], 1, 10000);
            if (n != std::floor(n)) throw std::invalid_argument(fmt::format("'{}' is not a whole number", v[0]));
            j.placement.copies = static_cast<int>(n);
          }},
    Field{"spacing", false,
          [](JobLine& j, const Values& v, Folder) { j.placement.spacing = from_mm(number(v[0], 0, 1000)); }},
    Field{"audit", false, [](JobLine& j, const Values& v, Folder) { j.audit = mode(v[0]); }},
    Field{"timeout", false, [](JobLine& j, const Values& v, Folder) { j.timeout_s = number(v[0], 0.001, 1e9); }},
};

}  // namespace

void refuse_cut_off(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) throw std::invalid_argument("a text holds the character 0");
}

std::string path_in(const std::filesystem::path& folder, const std::string& path) {
  const std::filesystem::path p(path);
  return p.is_absolute() || folder.empty() ? path : (folder / p).string();
}

void place_field_files(JobLine& job, const std::filesystem::path& folder) {
  const auto place = [&](const std::string& key, std::string& text) {
    if (!text.empty() && pipeline::names_field_file(key)) text = path_in(folder, text);
  };
  for (auto& [key, text] : job.settings) place(key, text);
  for (auto& said : job.by_name.settings) place(said.key, said.text);
  for (auto& mark : job.marks)
    for (auto& [key, text] : mark.settings) place(key, text);
}

const std::vector<std::string_view>& field_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> out;
    for (const auto& field : fields) out.push_back(field.name);
    for (const auto& word : pipeline::transform_words()) out.push_back(word.key);
    return out;
  }();
  return names;
}

bool is_free_field(std::string_view name) {
  constexpr std::array<std::string_view, 3> known{"label", "priority", "due"};
  if (name.size() > 2 && name.starts_with("x-")) return true;
  return std::find(known.begin(), known.end(), name) != known.end();
}

bool set_field(JobLine& job, std::string_view name, const Values& values, const std::filesystem::path& folder) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  const auto* word = at == fields.end() ? pipeline::find_transform_word(name) : nullptr;
  if (at == fields.end() && !word) return false;
  if (word) {
    std::string text;  // [1, 1, 2] is 1,1,2
    for (const auto& v : values) text += (text.empty() ? "" : ",") + v;
    word->set(job.placement, text);
    return true;
  }
  if (!at->list && values.size() != 1) throw std::invalid_argument("takes one value, not a list");
  for (const auto& v : values)
    if (value::trimmed(v).empty()) throw std::invalid_argument("is empty");
  at->set(job, values, folder);
  return true;
}

}  // namespace weft::jobs
