// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <boost/program_options/options_description.hpp>

/// The verbs of the command line, one file each. Each takes the words behind its name.
namespace weft::app {

using Words = std::vector<std::string>;

// A verb takes the words behind its name and returns the exit status; it throws Error for what the user can mend.
int slice(const Words& words);
int batch(const Words& words);
int sweep(const Words& words);
int preview(const Words& words);
int audit_verb(const Words& words);
int inspect(const Words& words);
int profile(const Words& words);
int settings(const Words& words);
int verify(const Words& words);
int compare(const Words& words);
int estimate_verb(const Words& words);
int completions(const Words& words);

/// The table of options that each of them understands beside the common ones.
using Options = boost::program_options::options_description;
Options slice_options();
Options batch_options();
Options sweep_options();
Options preview_options();
Options audit_options();
Options inspect_options();
Options profile_options();
Options settings_options();
Options verify_options();
Options compare_options();
Options estimate_options();
Options completions_options();

struct Verb {
  std::string_view name;
  int (*run)(const Words&);
  Options (*options)();
  std::string_view usage, purpose;
};
inline constexpr std::array verbs{
    Verb{"slice", slice, slice_options, "MODEL... -p PROFILE [-s KEY=VALUE]... -o OUT.gcode",
         "turn models into audited G-code"},
    Verb{"audit", audit_verb, audit_options, "FILE.gcode... -p PROFILE",
         "check any slicer's G-code against a build volume"},
    Verb{"batch", batch, batch_options, "JOBS -p PROFILE -o DIR",
         "many independent slice jobs: a list, a folder or a pattern"},
    Verb{"sweep", sweep, sweep_options, "MODEL -p PROFILE --vary KEY=V1,V2,... -o DIR",
         "one model with many settings, compared on a page"},
    Verb{"estimate", estimate_verb, estimate_options, "MODEL... -p PROFILE [-s KEY=VALUE]...",
         "time, filament and cost, without G-code"},
    Verb{"verify", verify, verify_options, "FILE.gcode [MODEL...]",
         "slice again from what the file says of itself, and compare"},
    Verb{"compare", compare, compare_options, "A.gcode B.gcode [-o OUT.html]",
         "what differs between two prints, of whichever slicers"},
    Verb{"preview", preview, preview_options, "FILE.gcode -o OUT.(html|svg|png)", "look at toolpaths"},
    Verb{"inspect", inspect, inspect_options, "MODEL...", "mesh facts and what a repair would do"},
    Verb{"profile", profile, profile_options, "check|import|show FILE...",
         "validate, translate from PrusaSlicer, print resolved"},
    Verb{"settings", settings, settings_options, "[--format text|json|markdown] [KEY...]",
         "every setting: type, unit, default, range, meaning"},
    Verb{"completions", completions, completions_options, "bash|zsh|fish", "what a shell completes weft's words with"},
};

}  // namespace weft::app
