// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/job_list.h"
#include "settings/catalogue.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft::jobs {
namespace {

using Json = nlohmann::ordered_json;

/// A number, text or flag as profiles write it. @throws std::invalid_argument
std::string text_of(const Json& v) {
  if (v.is_string()) {
    refuse_cut_off(v.get_ref<const std::string&>());
    return v.get<std::string>();
  }
  if (v.is_number() || v.is_boolean()) return v.dump();
  throw std::invalid_argument(fmt::format("{} is neither text, number nor true or false", v.dump()));
}

constexpr int deepest = 64;  // levels of a line; it needs three

/// The object of a line. A name given twice would be lost silently by the parser: it is refused.
Json parse_line(std::string_view line) {
  std::vector<std::set<std::string>> seen;
  const auto refuse_twins = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > deepest) throw std::invalid_argument(fmt::format("is more than {} levels deep", deepest));
    if (event == Json::parse_event_t::object_start) seen.emplace_back();
    if (event == Json::parse_event_t::object_end) seen.pop_back();
    if (event == Json::parse_event_t::key && !seen.back().insert(parsed.get<std::string>()).second)
      throw std::invalid_argument(fmt::format("'{}' is given twice", parsed.get<std::string>()));
    return true;
  };
  try {
    auto out = Json::parse(line, refuse_twins);
    if (!out.is_object()) throw std::invalid_argument("is not a JSON object");
    return out;
  } catch (const Json::parse_error& problem) {
    throw std::invalid_argument(fmt::format("is not JSON: column {}", problem.byte));
  } catch (const Json::out_of_range&) {
    throw std::invalid_argument("holds a number that is too large");
  }
}

void read_set(const Json& set, const std::function<void(std::string key, std::string text)>& take) {
  if (!set.is_object()) throw std::invalid_argument("set: is not an object of settings");
  for (const auto& [key, item] : set.items()) take(key, text_of(item));
}

/// One model of a line, with what is said of it.
class ModelReader {
 public:
  ModelReader(JobLine& job, const std::filesystem::path& folder) : job_(job), folder_(folder) {}

  void read(const Json& json) {
    if (!json.is_object()) {
      job_.models.push_back(path_in(folder_, text_of(json)));
      return;
    }
    const Named model{{}, job_.models.size(), {}};
    job_.models.emplace_back();
    for (const auto& [name, v] : json.items()) {
      if (name == "file" || name == "tool") continue;
      if (name == "parts")
        parts(v, model);
      else if (name == "set")
        set(v, model);
      else if (name == "copies")
        job_.by_name.copies.push_back({model, static_cast<int>(number(v, 1, 10000, "copies"))});
      else if (name == "place")
        place(v, model);
      else if (name == "modifiers" || name == "negatives")
        marks(name, v);
      else
        throw std::invalid_argument(fmt::format("models: unknown name '{}'", name));
    }
    if (json.contains("file")) job_.models.back() = file_of(json);
    if (job_.models.back().empty()) throw std::invalid_argument(R"(models: names neither "file" nor "parts")");
  }

 private:
  static double number(const Json& v, double least, double most, const char* name) {
    if (!v.is_number() || !(v.get<double>() >= least && v.get<double>() <= most))
      throw std::invalid_argument(fmt::format("models: {}: {} is no number of {} … {}", name, v.dump(), least, most));
    return v.get<double>();
  }
  std::string file_of(const Json& json) const {
    if (!json.is_object() || !json.contains("file")) throw std::invalid_argument(R"(models: a part names no "file")");
    auto out = path_in(folder_, text_of(json["file"]));
    if (json.contains("tool")) out += fmt::format("@T{:.0f}", number(json["tool"], 0, 31, "tool"));
    return out;
  }
  void set(const Json& v, const Named& of) {
    read_set(v, [&](std::string key, std::string text) {
      job_.by_name.settings.push_back({of, std::move(key), std::move(text), job_.where});
    });
  }
  void parts(const Json& list, const Named& model) {
    if (!list.is_array() || list.empty()) throw std::invalid_argument("models: parts: is not a list");
    std::string typed;
    for (std::size_t i = 0; i < list.size(); ++i) {
      typed += (i == 0 ? "" : "+") + file_of(list[i]);
      for (const auto& [name, v] : list[i].items())
        if (name == "set")
          set(v, {{}, model.model, i});
        else if (name != "file" && name != "tool")
          throw std::invalid_argument(fmt::format("models: parts: unknown name '{}'", name));
    }
    job_.models.back() = typed;
  }
  void place(const Json& v, const Named& of) {
    if (!v.is_array() || v.size() < 2 || v.size() > 3)
      throw std::invalid_argument("models: place: is not [x, y, degrees]");
    const auto at = [&](std::size_t i) { return number(v[i], -16000, 16000, "place"); };
    job_.by_name.places.push_back({of, {from_mm(at(0)), from_mm(at(1))}, v.size() > 2 ? at(2) : 0.0});
  }
  void marks(const std::string& name, const Json& list) {
    if (!list.is_array()) throw std::invalid_argument(fmt::format("models: {}: is not a list", name));
    const bool modify = name == "modifiers";
    for (const auto& item : list) {
      const auto source = text_of(item.is_object() && item.contains("file") ? item["file"] : item);
      ModelMark mark{job_.models.size() - 1, modify ? mesh::MarkKind::modifier : mesh::MarkKind::negative,
                     source.starts_with("box:") ? source : path_in(folder_, source)};
      if (item.is_object() && item.contains("set"))
        read_set(item["set"], [&](std::string key, std::string text) {
          mark.settings.emplace_back(std::move(key), std::move(text));
        });
      if (modify && mark.settings.empty()) throw std::invalid_argument(R"(models: a modifier has no "set")");
      job_.marks.push_back(std::move(mark));
    }
  }

  JobLine& job_;
  const std::filesystem::path& folder_;
};

void set_all(JobLine& job, const Json& object, const std::filesystem::path& folder) {
  for (const auto& [name, v] : object.items()) {
    if (name == "set") {
      read_set(v,
               [&](std::string key, std::string text) { job.settings.emplace_back(std::move(key), std::move(text)); });
      continue;
    }
    if (name == "models" && v.is_array() &&
        std::any_of(v.begin(), v.end(), [](const Json& model) { return model.is_object(); })) {
      for (const auto& model : v) ModelReader(job, folder).read(model);
      continue;
    }
    if (name == "fill" && v.is_array()) {  // a queue of parts, on as many plates as it takes
      for (const auto& model : v) ModelReader(job, folder).read(model);
      job.placement.plates = true;
      continue;
    }
    if (is_free_field(name)) {
      if (!v.is_primitive() || v.is_null())
        throw std::invalid_argument(name + ": is not a text, a number, true or false");
      if (v.is_string()) refuse_cut_off(v.get_ref<const std::string&>());
      job.free_fields.emplace_back(name, v.dump());
      continue;
    }
    std::vector<std::string> values;
    try {
      if (v.is_array())
        for (const auto& item : v) values.push_back(text_of(item));
      else
        values.push_back(text_of(v));
      if (set_field(job, name, values, folder)) continue;
    } catch (const std::invalid_argument& problem) {
      throw std::invalid_argument(fmt::format("{}: {}", name, problem.what()));
    }
    throw std::invalid_argument(
        fmt::format("unknown name '{}'{}", name, find_setting(name) ? "; settings belong in \"set\"" : ""));
  }
}

}  // namespace

std::string free_text(const std::string& json) {
  const auto value = Json::parse(json, nullptr, false);
  return value.is_string() ? value.get<std::string>() : json;
}

JobList read_jsonl(std::string_view text, const std::string& path, const std::filesystem::path& folder) {
  JobList list;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = value::trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    JobLine job;
    job.where = fmt::format("{}:{}", path, number);
    try {
      set_all(job, parse_line(line), folder);
      place_field_files(job, folder);
      list.jobs.push_back(std::move(job));
    } catch (const std::invalid_argument& problem) {
      list.errors.emplace_back(
          Error::Kind::usage, problem.what(), job.where,
          R"(a line is {"id": "a", "models": ["a.stl"], "profiles": ["p.ini"], "set": {"layer_height": 0.2}, "output": "a.gcode"})");
    }
  }
  return list;
}

}  // namespace weft::jobs
