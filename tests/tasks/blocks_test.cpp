// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/blocks.h"

#include <catch2/catch.hpp>

using weft::tasks::Blocks;

TEST_CASE("tasks: blocks cover a row without a gap, in order, none empty and none twice as long as another",
          "[tasks][law]") {
  for (const std::size_t length : {0U, 1U, 2U, 7U, 99U, 100U, 101U, 5'000U})
    for (const std::size_t block_length : {1U, 10U, 100U})
      for (const std::size_t most : {1U, 3U, 64U}) {
        const Blocks blocks(length, block_length, most);
        CHECK(blocks.count() <= most);
        CHECK((blocks.count() == 0) == (length == 0));
        std::size_t at = 0;
        for (std::size_t i = 0; i < blocks.count(); ++i) {
          CHECK(blocks.begin(i) == at);
          const std::size_t size = blocks.end(i) - at;
          CHECK(size >= 1);
          CHECK((size - length / blocks.count()) <= 1);
          at = blocks.end(i);
        }
        CHECK(at == length);
      }
}
