// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/adhesion.h"
#include "settings/groups/audit.h"
#include "settings/groups/cooling.h"
#include "settings/groups/gcode.h"
#include "settings/groups/infill.h"
#include "settings/groups/layers.h"
#include "settings/groups/machine.h"
#include "settings/groups/material.h"
#include "settings/groups/plate.h"
#include "settings/groups/raft.h"
#include "settings/groups/retraction.h"
#include "settings/groups/shells.h"
#include "settings/groups/speeds.h"
#include "settings/groups/support.h"
#include "settings/groups/tools.h"
#include "settings/groups/travel.h"
#include "settings/groups/walls.h"

namespace weft {

/// Every setting of a job, resolved. A stage takes its own group only.
struct Settings {
  MachineSettings machine;
  MaterialSettings material;
  LayerSettings layers;
  WallSettings walls;
  ShellSettings shells;
  InfillSettings infill;
  AdhesionSettings adhesion;
  SupportSettings support;
  RaftSettings raft;
  TravelSettings travel;
  RetractionSettings retraction;
  SpeedSettings speeds;
  CoolingSettings cooling;
  ToolSettings tools;
  PlateSettings plate;
  GcodeSettings gcode;
  AuditSettings audit;
};

/// A group: its name (the section of an ini), where it lies, and its rows. The order is that of manuals and of the
/// block of settings in the G-code.
template <class Group, class Schema>
struct Section {
  std::string_view name;
  Group Settings::*group;
  const Schema& rows;
};
template <class Group, class Schema>
Section(std::string_view, Group Settings::*, const Schema&) -> Section<Group, Schema>;

inline constexpr Rows sections{
    Section{"machine", &Settings::machine, machine_schema},
    Section{"material", &Settings::material, material_schema},
    Section{"layers", &Settings::layers, layer_schema},
    Section{"walls", &Settings::walls, wall_schema},
    Section{"shells", &Settings::shells, shell_schema},
    Section{"infill", &Settings::infill, infill_schema},
    Section{"adhesion", &Settings::adhesion, adhesion_schema},
    Section{"support", &Settings::support, support_schema},
    Section{"raft", &Settings::raft, raft_schema},
    Section{"travel", &Settings::travel, travel_schema},
    Section{"retraction", &Settings::retraction, retraction_schema},
    Section{"speeds", &Settings::speeds, speed_schema},
    Section{"cooling", &Settings::cooling, cooling_schema},
    Section{"tools", &Settings::tools, tool_schema},
    Section{"plate", &Settings::plate, plate_schema},
    Section{"gcode", &Settings::gcode, gcode_schema},
    Section{"audit", &Settings::audit, audit_schema},
};
static_assert(complete<Settings>(sections), "a group has no section");

}  // namespace weft
