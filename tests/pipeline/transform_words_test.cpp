// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/transform_words.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::pipeline;

TEST_CASE("transform words: what a word is set to it says again, and nothing where it is as usual") {
  struct Case {
    const char *key, *text, *said;
  };
  for (const auto& [key, text, said] : {Case{"unit", "inch", "inch"},
                                        {"unit", "mm", ""},
                                        {"scale", "2", "2"},
                                        {"scale", "50%", "0.5"},
                                        {"scale", "1,1,0.5", "1,1,0.5"},
                                        {"scale", "1", ""},
                                        {"mirror", "z,x", "x,z"},
                                        {"mirror", "x,x", ""},
                                        {"rotate_x", "-90", "-90"},
                                        {"rotate_y", "0", ""},
                                        {"orient", "auto", "auto"},
                                        {"orient", "face:0,1,-2.5", "face:0,1,-2.5"},
                                        {"scale_to_fit", "100,50,20", "100,50,20"},
                                        {"cut", "12.5", "12.5"},
                                        {"cut_keep", "upper", "upper"},
                                        {"cut_keep", "both", ""},
                                        {"split", "true", "true"},
                                        {"merge", "off", ""}}) {
    const auto* word = find_transform_word(key);
    INFO(key << " " << text);
    REQUIRE(word != nullptr);
    Placement p, again;
    word->set(p, text);
    CHECK(word->text(p) == said);
    if (!word->text(p).empty()) word->set(again, word->text(p));
    CHECK(again.transform == p.transform);
    CHECK(again.scale == p.scale);
  }
}

TEST_CASE("transform words: nonsense is refused in one clause") {
  struct Case {
    const char *key, *text, *problem;
  };
  for (const auto& [key, text, problem] : {Case{"unit", "yard", "'yard' is not one of mm, cm, m, inch, ft"},
                                           {"scale", "0", "'0' is not a factor above 0"},
                                           {"scale", "1,2", "'1,2' is not one factor or three"},
                                           {"mirror", "w", "'w' is not one of x, y, z"},
                                           {"orient", "up", "'up' is neither auto nor face:x,y,z"},
                                           {"orient", "face:0,0,0", "0,0,0 is no direction"},
                                           {"scale_to_fit", "10,10", "'10,10' is not three numbers"},
                                           {"cut", "0", "0 is outside 0.001 … 16000"},
                                           {"cut_keep", "left", "'left' is not one of both, lower, upper"}}) {
    Placement p;
    INFO(key << " " << text);
    std::string said;
    try {
      find_transform_word(key)->set(p, text);
    } catch (const std::invalid_argument& error) {
      said = error.what();
    }
    CHECK(said == problem);
  }
  Placement p;
  p.transform.keep = CutKeep::lower;
  CHECK_THROWS_AS(check_transform(p), std::invalid_argument);
  p.transform = {}, p.transform.split = p.transform.merge = true;
  CHECK_THROWS_AS(check_transform(p), std::invalid_argument);
  p.transform = {}, p.transform.cut = 1000, p.keep_position = true;
  CHECK_THROWS_AS(check_transform(p), std::invalid_argument);
}
