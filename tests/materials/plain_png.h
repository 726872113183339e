#pragma once

#include <cstdint>
#include <vector>

#include "prelight/picture.h"

namespace prelight::test {

/// An 8-bit RGBA PNG of a picture, not compressed.
std::vector<std::uint8_t> plainPng(const Image& image);

}  // namespace prelight::test
