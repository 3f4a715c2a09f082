#define CATCH_CONFIG_MAIN
#include "source.h"

#include <catch2/catch.hpp>

const std::filesystem::path tests::source = WEFT_SOURCE_DIR;
