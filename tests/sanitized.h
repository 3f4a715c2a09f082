// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Whether a sanitizer watches this program: it reserves and keeps memory of its own, so limits on memory tell nothing.
/// (In no namespace: tests of the command line have a function `weft`.)
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)  // clang's word for it
inline constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif
