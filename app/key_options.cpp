// SPDX-License-Identifier: GPL-3.0-or-later
#include "key_options.h"

#include "command.h"
#include "prusaslicer/keys.h"
#include "settings/catalogue.h"

#include <algorithm>

namespace po = boost::program_options;

namespace weft::app {

std::string dashed(std::string_view key) {
  std::string out(key);
  std::replace(out.begin(), out.end(), '_', '-');
  return out;
}

std::string underscored(std::string key) {
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

std::set<std::string> keys_typed(const std::vector<std::string>& words) {
  std::set<std::string> out;
  for (const auto& word : words) {
    if (!word.starts_with("--")) continue;
    const auto key = underscored(word.substr(2, word.find('=') - 2));
    out.insert(key);
    if (key.starts_with("no_")) out.insert(key.substr(3));
  }
  return out;
}

po::options_description setting_options(const std::set<std::string>& keys) {
  po::options_description out;
  for (const auto& key : keys) {
    const auto* entry = find_setting(key);
    if (entry == nullptr) continue;
    auto* value = po::value<std::vector<std::string>>();
    if (entry->type == "flag") value->implicit_value({"true"}, "true");
    out.add_options()(dashed(key).c_str(), value);
  }
  return out;
}

po::options_description prusaslicer_options(const std::set<std::string>& keys) {
  po::options_description out;
  const auto common = common_options();
  for (const auto& key : keys) {
    const auto* row = prusaslicer::find_key(key);
    if (row == nullptr || find_setting(key) != nullptr || common.find_nothrow(dashed(key), false) != nullptr) continue;
    auto* value = po::value<std::vector<std::string>>();
    if (row->written == prusaslicer::Written::flag) value->implicit_value({"1"}, "1");
    out.add_options()(dashed(key).c_str(), value);
  }
  return out;
}

}  // namespace weft::app
