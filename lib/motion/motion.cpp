#include "motion/motion.h"

namespace weft::motion {

Rules rules_of(const Settings& s) {
  return {s.machine, s.material, s.layers, s.walls, s.retraction, s.speeds, s.cooling};
}

}  // namespace weft::motion
