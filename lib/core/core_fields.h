// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/fields.h"
#include "core/notice.h"
#include "core/polygon.h"

/// The fields of core's plain types.
namespace weft {

template <>
inline constexpr auto fields<Point> = listed(&Point::x, &Point::y);
template <>
inline constexpr auto fields<Point3> = listed(&Point3::x, &Point3::y, &Point3::z);
template <>
inline constexpr auto fields<Region> = listed(&Region::outer, &Region::holes);
template <>
inline constexpr auto fields<Notice> = listed(&Notice::code, &Notice::message);

}  // namespace weft
