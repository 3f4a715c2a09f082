#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

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

struct Verb {
  std::string_view name;
  int (*run)(const Words&);
  std::string_view usage, purpose;
};
inline constexpr std::array verbs{
    Verb{"slice", slice, "MODEL... -p PROFILE [-s KEY=VALUE]... -o OUT.gcode", "turn models into audited G-code"},
    Verb{"audit", audit_verb, "FILE.gcode... -p PROFILE", "check any slicer's G-code against a build volume"},
    Verb{"batch", batch, "JOBS -p PROFILE -o DIR", "many independent slice jobs: a list, a folder or a pattern"},
    Verb{"sweep", sweep, "MODEL -p PROFILE --vary KEY=V1,V2,... -o DIR",
         "one model with many settings, compared on a page"},
    Verb{"verify", verify, "FILE.gcode [MODEL...]", "slice again from what the file says of itself, and compare"},
    Verb{"preview", preview, "FILE.gcode -o OUT.(html|svg|png)", "look at toolpaths"},
    Verb{"inspect", inspect, "MODEL...", "mesh facts and what a repair would do"},
    Verb{"profile", profile, "check|import|show FILE...", "validate, translate from PrusaSlicer, print resolved"},
    Verb{"settings", settings, "[--format text|json|markdown] [KEY...]",
         "every setting: type, unit, default, range, meaning"},
};

}  // namespace weft::app
