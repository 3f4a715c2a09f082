#pragma once
#include <string>
#include <vector>

#include "model/plan.h"
#include "model/statistics.h"
#include "settings/settings.h"

namespace weft::gcode {

struct Thumbnail {
  int width = 0, height = 0;  ///< pixels
  std::string png;            ///< the file's bytes
};

/// Everything that goes into a file.
struct Job {
  const Settings& settings;
  const PrintPlan& plan;             ///< with speeds (motion)
  const Statistics& statistics;      ///< of the whole plan
  std::string version;               ///< of weft, "0.1.0"
  std::string input_name;            ///< file name of the first model without folder and extension; for placeholders
  std::vector<Thumbnail> thumbnails;
};

/// The file in pieces, which put together in order are the whole: head, each layer, tail.
/// Layers are independent of each other and may be written in any order and on any thread.
class Writer {
 public:
  /// Expands all custom G-code and what each layer needs to know of the one before. The job must outlive the writer.
  /// @throws Error{settings} naming the setting, line and column: an unknown placeholder, one without a value
  explicit Writer(const Job& job);

  std::string head() const;
  std::string layer(std::size_t index) const;
  std::string tail() const;

 private:
  struct Entry {  // what is in force when a layer begins
    Point3 at;
    bool at_known = false;
    double fan = -1;
    double print_acceleration = 0, travel_acceleration = 0;
    bool retracted = false;
  };
  const Job& job_;
  std::vector<Entry> entries_;
  std::vector<std::string> before_layer_, after_layer_;  // expanded; empty where there is nothing to say
  std::vector<double> elapsed_s_;                        // at the beginning of each layer
  std::vector<std::string> names_;                       // of the objects, as the firmware takes them
  std::string start_, end_;
  bool start_sets_nozzle_ = false, start_sets_bed_ = false;
  std::string extents_;
};

/// The whole file.
std::string write(const Job& job);

/// The header line that the audit replaces by its verdict.
inline constexpr std::string_view audit_pending = "; weft_audit = pending\n";

}  // namespace weft::gcode
