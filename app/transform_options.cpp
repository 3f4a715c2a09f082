// SPDX-License-Identifier: GPL-3.0-or-later
#include "transform_options.h"

#include "core/error.h"
#include "pipeline/transform_words.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {
namespace {

std::string dashed(std::string_view key) {
  std::string out(key);
  std::replace(out.begin(), out.end(), '_', '-');
  return out;
}

}  // namespace

void add_transform_options(po::options_description& to) {
  for (const auto& word : pipeline::transform_words()) {
    const std::string name = dashed(word.key), help(word.help);
    if (word.value.empty())
      to.add_options()(name.c_str(), po::bool_switch(), help.c_str());
    else
      to.add_options()(name.c_str(), po::value<std::string>()->value_name(std::string(word.value)), help.c_str());
  }
}

void take_transforms(const po::variables_map& options, Placement& placement) {
  for (const auto& word : pipeline::transform_words()) {
    const auto name = dashed(word.key);
    if (!options.count(name)) continue;
    const auto text =
        word.value.empty() ? std::string(options[name].as<bool>() ? "true" : "false") : options[name].as<std::string>();
    try {
      word.set(placement, text);
    } catch (const std::invalid_argument& problem) {
      throw Error{Error::Kind::usage, problem.what(), "--" + name,
                  word.example.empty() ? std::string() : fmt::format("as in --{} {}", name, word.example)};
    }
  }
  try {
    pipeline::check_transform(placement);
  } catch (const std::invalid_argument& problem) {
    const std::string said = problem.what();
    const auto colon = std::min(said.find(": "), said.size());
    throw Error{Error::Kind::usage, said.substr(std::min(colon + 2, said.size())),
                "--" + dashed(said.substr(0, colon))};
  }
}

std::vector<std::string> transform_arguments(const Placement& placement) {
  std::vector<std::string> out;
  for (const auto& word : pipeline::transform_words())
    if (const auto text = word.text(placement); !text.empty())
      out.push_back("--" + dashed(word.key) + (word.value.empty() ? "" : "=" + text));
  return out;
}

}  // namespace weft::app
