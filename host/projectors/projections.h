#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plan/shadow_sets.h"

namespace prelight {

/// What the rays of one side of the surface are turned into.
struct Projections {
  int shOrder = 0;             ///< 0: none
  bool bentNormal = false;     ///< fitted for fronts only
  std::uint32_t groups = 0;    ///< of lights
  std::size_t texelRows = 0;   ///< receivers whose rays are kept texel by texel, fronts only
  std::size_t texelCount = 0;  ///< of the cube map that they are kept on
  std::size_t shells = 0;      ///< of distance that hits are told apart by, fronts only
  int shellOrder = 0;          ///< bands of SH of each
  std::uint32_t sectors = 0;   ///< of azimuth whose openness is fitted, fronts only
  bool backs = true;           ///< cast from backs that rays meet, where rows are stored
  std::vector<std::uint8_t> wantedBacks =
      {};                            ///< [triangle], 1: cast from its back whatever rays meet; or empty
  int specularOrder = 0;             ///< bands of SH of what comes by mirrors and glass; 0: none does
  bool receivers = false;            ///< keep the receivers of stored rows, fronts only
  bool occluders = false;            ///< means of what is seen of each, fronts only
  std::uint32_t occluderCount = 0;   ///< where they are told apart
  std::uint64_t recordBytes = 0;     ///< of records that are kept in memory, of both sides together
  bool parks = false;                ///< sums that wait lie in a file
  const ShadowSets* sets = nullptr;  ///< of occluders; nullptr: all see everything
};

}  // namespace prelight
