// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/figures.h"
#include "preview/preview.h"

#include <string>
#include <vector>

/// The page that shows prints: page/*.js draw what page.cpp puts into it.
namespace weft::preview {

/// One of the prints on a page.
struct PagePrint {
  const Toolpaths& paths;  ///< with seconds and support (timing.h, coverage.h)
  std::string name;
  std::vector<Mark> findings = {};
  std::string model = {};  ///< packed (model_pack.h); empty: not at hand
};

struct Page {
  std::string title;
  View view;
  std::optional<Overlay> overlay;
  std::vector<PagePrint> prints;
  std::string comparison = "null";  ///< JSON of what differs between two (compare.h)
};

/// One file that needs no network. Whatever names and comments hold, it is text there. Pre: each print has a layer.
std::string page(const Page& page);

}  // namespace weft::preview
