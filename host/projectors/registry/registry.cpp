#include "projectors/registry/registry.h"

#include <algorithm>
#include <array>

#include "projectors/ambient_occlusion/ambient_occlusion_technique.h"
#include "projectors/ch/ch_technique.h"
#include "projectors/glossy/glossy_technique.h"
#include "projectors/haar/haar_technique.h"
#include "projectors/light_groups/light_groups_technique.h"
#include "projectors/lightmap/lightmap_technique.h"
#include "projectors/radiosity/radiosity_technique.h"
#include "projectors/sh/sh_technique.h"
#include "projectors/texels/texels_technique.h"
#include "projectors/vector_occluders/vector_occluders_technique.h"
#include "projectors/volume/volume_technique.h"

namespace prelight {

namespace {

/// A technique and its place in every order. A new one takes the next number in each column.
struct Row {
  Technique (*technique)();
  std::array<int, 3> places;  ///< [Order]
};

constexpr std::array<Row, 13> rows = {{
    // technique                entry root summary
    {ambientOcclusionTechnique, {0, 0, 0}},
    {shTechnique, {1, 1, 2}},
    {compressedShTechnique, {2, 2, 3}},
    {animationTechnique, {3, 4, 12}},
    {chTechnique, {4, 5, 4}},
    {haarTechnique, {5, 6, 5}},
    {glossyTechnique, {6, 7, 6}},
    {lightGroupsTechnique, {7, 8, 7}},
    {vectorOccludersTechnique, {9, 3, 8}},
    {volumeTechnique, {11, 9, 9}},
    {texelsTechnique, {10, 10, 10}},
    {radiosityTechnique, {8, 11, 1}},
    {lightMapTechnique, {12, 12, 11}},
}};

}  // namespace

std::vector<Technique> techniques(Order order) {
  std::array<Row, rows.size()> sorted = rows;
  const auto column = static_cast<std::size_t>(order);
  std::sort(sorted.begin(), sorted.end(),
            [&](const Row& a, const Row& b) { return a.places[column] < b.places[column]; });
  std::vector<Technique> found;
  for (const Row& row : sorted) found.push_back(row.technique());
  return found;
}

}  // namespace prelight
