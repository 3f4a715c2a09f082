// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/job_list.h"
#include "jobs/summary.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// One model, many settings: which combinations to try, and what to make of the results.
namespace weft::jobs {

/// A setting that is varied.
struct Axis {
  std::string key;
  std::vector<std::string> values;  ///< as text; not empty unless it is a range without steps
  double from = 0, to = 0;          ///< of a range without steps
  int decimals = 0;                 ///< that values of such a range are rounded to
  bool continuous() const { return values.empty(); }
};

/// `KEY=V1,V2,...`, `KEY=FROM:TO:STEP` (both ends included when the steps meet them), or `KEY=FROM:TO`, which only
/// sampling can use. Steps are counted, not added up: 0.1:0.3:0.1 has three values.
/// @throws Error{usage}; Error{settings} for an unknown setting
Axis parse_axis(const std::string& text);

enum class Combine : std::uint8_t {
  grid,    ///< every combination, the last axis fastest
  zip,     ///< the i-th value of each: all have equally many
  sample,  ///< a Latin hypercube: each axis is cut into as many strata as there are samples, each stratum is met once
};

struct SweepOptions {
  Combine combine = Combine::grid;
  std::size_t samples = 0;
  std::uint64_t seed = 1;
};

/// The combinations, each a value for each axis. The same seed gives the same samples everywhere.
/// Source: McKay, Beckman, Conover 1979. @throws Error{usage}
std::vector<std::vector<std::string>> combinations(const std::vector<Axis>& axes, const SweepOptions& options);

/// A job for each combination.
JobList sweep_jobs(const std::vector<std::string>& models, const std::vector<Axis>& axes, const SweepOptions& options);

/// What the results of a sweep are held against each other by.
struct Trial {
  std::string id, output, error;
  bool ok = false;
  bool best = false;  ///< no other is better in one of time, material, strength without being worse in another
  std::vector<std::string> values;  ///< one an axis
  double time_s = 0, material_g = 0, strength = 0;
  std::size_t layers = 0;
  std::optional<double> cost;  ///< when there are prices
  std::string currency;
  std::string picture;  ///< PNG of a layer; may be empty
  std::string viewer;   ///< name of the page that shows its toolpaths, beside the table's; may be empty
};

/// How strong a part is, 0 … 100, against a solid one of the same outline: its plastic, sparse infill counted by what a
/// cellular solid of its density bears (bending-dominated patterns ρ^1.5, triangles ρ). It knows neither layer bonding
/// nor load: for comparing trials of one sweep, and for nothing else. Source: Gibson & Ashby 1997, "Cellular Solids",
/// chapter 5.
double strength_estimate(const Record& record, const Settings& settings);

/// Marks the trials that no other beats.
void mark_best(std::vector<Trial>& trials);

/// The page: a table, a scatter of any two figures, parallel coordinates, pictures. Needs no network.
std::string sweep_page(const std::string& title, const std::vector<std::string>& axes,
                       const std::vector<Trial>& trials);

}  // namespace weft::jobs
