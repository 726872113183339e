#include <algorithm>
#include <array>

#include "projectors/ambient_occlusion/ambient_occlusion_planning.h"
#include "projectors/ambient_occlusion/ambient_occlusion_technique.h"
#include "projectors/ch/ch_planning.h"
#include "projectors/ch/ch_technique.h"
#include "projectors/encoded_light/encoded_light_planning.h"
#include "projectors/encoded_light/encoded_light_technique.h"
#include "projectors/glossy/glossy_planning.h"
#include "projectors/glossy/glossy_technique.h"
#include "projectors/haar/haar_planning.h"
#include "projectors/haar/haar_technique.h"
#include "projectors/light_groups/light_groups_planning.h"
#include "projectors/light_groups/light_groups_technique.h"
#include "projectors/lightmap/lightmap_planning.h"
#include "projectors/lightmap/lightmap_technique.h"
#include "projectors/radiosity/radiosity_planning.h"
#include "projectors/radiosity/radiosity_technique.h"
#include "projectors/registry/plannings.h"
#include "projectors/registry/registry.h"
#include "projectors/sh/sh_planning.h"
#include "projectors/sh/sh_technique.h"
#include "projectors/texels/texels_planning.h"
#include "projectors/texels/texels_technique.h"
#include "projectors/vector_occluders/vector_occluders_planning.h"
#include "projectors/vector_occluders/vector_occluders_technique.h"
#include "projectors/volume/volume_planning.h"
#include "projectors/volume/volume_technique.h"

namespace prelight {

namespace {

/// A technique and its place in every order. A new one takes the next number in each column.
struct Row {
  Technique (*technique)();
  Planning (*planning)();      ///< nullptr: made of what another one has baked
  std::array<int, 3> places;   ///< [Order]
  std::array<int, 2> planned;  ///< [PlanningOrder]
};

constexpr std::array<Row, 14> rows = {{
    //                                                     entry root summary, plan key
    {ambientOcclusionTechnique, ambientOcclusionPlanning, {0, 0, 0}, {0, 0}},
    {shTechnique, shPlanning, {1, 1, 2}, {1, 1}},
    {compressedShTechnique, nullptr, {2, 2, 3}, {}},
    {animationTechnique, nullptr, {3, 4, 12}, {}},
    {chTechnique, chPlanning, {4, 5, 4}, {2, 2}},
    {haarTechnique, haarPlanning, {5, 6, 5}, {3, 3}},
    {glossyTechnique, glossyPlanning, {6, 7, 6}, {4, 6}},
    {lightGroupsTechnique, lightGroupsPlanning, {7, 8, 7}, {5, 7}},
    {vectorOccludersTechnique, vectorOccludersPlanning, {9, 3, 8}, {6, 8}},
    {volumeTechnique, volumePlanning, {11, 9, 9}, {7, 4}},
    {texelsTechnique, texelsPlanning, {10, 10, 10}, {8, 5}},
    {radiosityTechnique, radiosityPlanning, {8, 11, 1}, {9, 9}},
    {lightMapTechnique, lightMapPlanning, {12, 12, 11}, {10, 10}},
    {encodedLightTechnique, encodedLightPlanning, {13, 13, 13}, {11, 11}},
}};

template <std::size_t columns>
constexpr bool differ(const std::array<int, columns>& a, const std::array<int, columns>& b) {
  for (std::size_t column = 0; column < columns; ++column)
    if (a[column] == b[column]) return false;
  return true;
}

/// Two rows in one place would come in any order.
constexpr bool placesDiffer() {
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const bool planned = rows[a].planning != nullptr && rows[b].planning != nullptr;
      if (!differ(rows[a].places, rows[b].places) || (planned && !differ(rows[a].planned, rows[b].planned)))
        return false;
    }
  return true;
}
static_assert(placesDiffer());

/// By one of the columns.
template <std::size_t columns>
std::vector<Row> sortedBy(std::array<int, columns> Row::*places, std::size_t column) {
  std::vector<Row> sorted(rows.begin(), rows.end());
  std::sort(sorted.begin(), sorted.end(),
            [&](const Row& a, const Row& b) { return (a.*places)[column] < (b.*places)[column]; });
  return sorted;
}

}  // namespace

std::vector<Technique> techniques(Order order) {
  std::vector<Technique> found;
  for (const Row& row : sortedBy(&Row::places, static_cast<std::size_t>(order)))
    found.push_back(row.technique());
  return found;
}

std::vector<Planning> plannings(PlanningOrder order) {
  std::vector<Planning> found;
  for (const Row& row : sortedBy(&Row::planned, static_cast<std::size_t>(order)))
    if (row.planning != nullptr) found.push_back(row.planning());
  return found;
}

}  // namespace prelight
