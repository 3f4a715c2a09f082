#pragma once
#include <string>

#include "preview/preview.h"

namespace weft::app {

/// The kind of preview that a destination's extension asks for. @throws Error{usage} for another extension
preview::Kind preview_kind(const std::string& destination);

}  // namespace weft::app
