// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/core_fields.h"
#include "model/layer.h"
#include "model/plan.h"

/// The fields of the words that stages exchange.
namespace weft {

template <>
inline constexpr auto fields<Junction> = listed(&Junction::at, &Junction::width, &Junction::flow);
template <>
inline constexpr auto fields<Bead> = listed(&Bead::path, &Bead::role, &Bead::closed, &Bead::inset, &Bead::part,
                                            &Bead::sequence, &Bead::tool, &Bead::scope, &Bead::on_support);
template <>
inline constexpr auto fields<SlicedLayer> = listed(&SlicedLayer::z, &SlicedLayer::height, &SlicedLayer::regions);
template <>
inline constexpr auto fields<PlacedNotice> = listed(&PlacedNotice::code, &PlacedNotice::message, &PlacedNotice::at);
template <>
inline constexpr auto fields<WallLayer> = listed(&WallLayer::beads, &WallLayer::inside, &WallLayer::over_air,
                                                 &WallLayer::notices);
template <>
inline constexpr auto fields<FillLayer> = listed(&FillLayer::beads, &FillLayer::notices);

template <>
inline constexpr auto fields<Arc> = listed(&Arc::first, &Arc::last, &Arc::centre, &Arc::ccw);
template <>
inline constexpr auto fields<Extrude> = listed(&Extrude::path, &Extrude::role, &Extrude::tool, &Extrude::scope,
                                               &Extrude::height, &Extrude::speed_mm_s, &Extrude::segment_speed_mm_s,
                                               &Extrude::acceleration_mm_s2, &Extrude::below, &Extrude::follows_surface,
                                               &Extrude::air_quarters, &Extrude::loop_length, &Extrude::on_support,
                                               &Extrude::arcs);
template <>
inline constexpr auto fields<Travel> = listed(&Travel::path, &Travel::speed_mm_s, &Travel::crosses_wall,
                                              &Travel::z_speed_mm_s, &Travel::acceleration_mm_s2);
template <>
inline constexpr auto fields<Retract> = listed(&Retract::wipe, &Retract::wipe_speed_mm_s, &Retract::before_wipe,
                                               &Retract::to_change);
template <>
inline constexpr auto fields<Prime> = listed(&Prime::extra_mm3);
template <>
inline constexpr auto fields<SetFan> = listed(&SetFan::share);
template <>
inline constexpr auto fields<SetPressureAdvance> = listed(&SetPressureAdvance::seconds);
template <>
inline constexpr auto fields<ObjectStart> = listed(&ObjectStart::object);
template <>
inline constexpr auto fields<ObjectEnd> = listed(&ObjectEnd::object);
template <>
inline constexpr auto fields<ToolChange> = listed(&ToolChange::tool);
template <>
inline constexpr auto fields<SetTemperature> = listed(&SetTemperature::heater, &SetTemperature::tool,
                                                      &SetTemperature::celsius, &SetTemperature::wait);
template <>
inline constexpr auto fields<Feed> = listed(&Feed::mm, &Feed::seconds, &Feed::moves, &Feed::to, &Feed::width);
template <>
inline constexpr auto fields<Pause> = listed(&Pause::text, &Pause::swaps_filament);
template <>
inline constexpr auto fields<Moment> = listed(&Moment::index, &Moment::pass, &Moment::number, &Moment::comes_down);
template <>
inline constexpr auto fields<LayerPlan> = listed(&LayerPlan::z, &LayerPlan::height, &LayerPlan::time, &LayerPlan::scope,
                                                 &LayerPlan::steps);

}  // namespace weft
