// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

namespace weft {
using namespace weft::literals;

/// The boundary audit. It has no switch.
struct AuditSettings {
  Um audit_tolerance = 0.01_mm;
  int audit_max_findings = 100;
};

inline constexpr Rows audit_schema{
    setting("audit_tolerance", Scope::plate, &AuditSettings::audit_tolerance, Unit::mm, 0_mm, 1_mm,
            "How far outside still counts as inside."),
    setting("audit_max_findings", Scope::plate, &AuditSettings::audit_max_findings, Unit::none, 1, 1000000,
            "How many findings a report lists; all are counted."),
};
static_assert(complete<AuditSettings>(audit_schema));

}  // namespace weft
