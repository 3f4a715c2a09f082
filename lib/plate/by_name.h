// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "plate/plate.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// What something is said of: an object or part of that name; a model, as it was typed or by its file's name with or
/// without its ending: all that is in it; or one by its place among the models of the job, and among its parts.
struct Named {
  std::string name{};
  std::optional<std::size_t> model{}, part{};  ///< where no name is given
  friend bool operator==(const Named&, const Named&) = default;
};

/// What is said of single objects of a job, over what their files say.
struct ByName {
  struct Setting {
    Named of;
    std::string key, text;
    std::string where;  ///< what to name in messages: "--for lid", "jobs.jsonl:12"
    friend bool operator==(const Setting&, const Setting&) = default;
  };
  struct Place {
    Named of;
    Point at;               ///< of the middle of its box, on the bed
    double rotate_deg = 0;  ///< besides the job's, counter-clockwise
    friend bool operator==(const Place&, const Place&) = default;
  };
  struct Copies {
    Named of;
    int count = 1;
    friend bool operator==(const Copies&, const Copies&) = default;
  };
  std::vector<Setting> settings{};
  std::vector<Place> places{};
  std::vector<Copies> copies{};
  bool empty() const { return settings.empty() && places.empty() && copies.empty(); }
  friend bool operator==(const ByName&, const ByName&) = default;
};

/// As one line of JSON, without what messages say. Law: by_name_of(text_of(x)) is x, but for `where`.
std::string text_of(const ByName& said);
/// @throws std::invalid_argument with one clause for what is none
ByName by_name_of(std::string_view text);

namespace plate {

/// How objects of a plate are found: what model each is from, and where in it.
struct Origins {
  std::vector<std::string> typed;  ///< beside the plate's objects: the model as it was typed
  std::vector<std::size_t> model;  ///< and its place among the models of the job
};

/// Is that meant? @param object index into the plate's objects
bool means(const Named& named, const Plate& plate, const Origins& origins, std::size_t object);

/// Lays what is said of objects and parts over them.
/// @throws Error{usage} for a name that nothing has, Error{settings} as Overlay::add
void lay_by_name(const ByName& said, Plate& plate, const Origins& origins);

}  // namespace plate
}  // namespace weft
