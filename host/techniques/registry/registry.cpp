#include <algorithm>
#include <array>

#include "techniques/ambient_occlusion/ambient_occlusion_planning.h"
#include "techniques/ambient_occlusion/ambient_occlusion_projector.h"
#include "techniques/ambient_occlusion/ambient_occlusion_technique.h"
#include "techniques/ch/ch_planning.h"
#include "techniques/ch/ch_projector.h"
#include "techniques/ch/ch_technique.h"
#include "techniques/chart_transfer/chart_transfer_planning.h"
#include "techniques/chart_transfer/chart_transfer_projector.h"
#include "techniques/chart_transfer/chart_transfer_technique.h"
#include "techniques/encoded_light/encoded_light_planning.h"
#include "techniques/encoded_light/encoded_light_projector.h"
#include "techniques/encoded_light/encoded_light_technique.h"
#include "techniques/glossy/glossy_planning.h"
#include "techniques/glossy/glossy_projector.h"
#include "techniques/glossy/glossy_technique.h"
#include "techniques/haar/haar_planning.h"
#include "techniques/haar/haar_projector.h"
#include "techniques/haar/haar_technique.h"
#include "techniques/horizons/horizons_planning.h"
#include "techniques/horizons/horizons_projector.h"
#include "techniques/horizons/horizons_technique.h"
#include "techniques/light_groups/light_groups_planning.h"
#include "techniques/light_groups/light_groups_projector.h"
#include "techniques/light_groups/light_groups_technique.h"
#include "techniques/light_map/light_map_planning.h"
#include "techniques/light_map/light_map_projector.h"
#include "techniques/light_map/light_map_technique.h"
#include "techniques/near_lamps/near_lamps_planning.h"
#include "techniques/near_lamps/near_lamps_projector.h"
#include "techniques/near_lamps/near_lamps_technique.h"
#include "techniques/occlusion_cones/occlusion_cones_planning.h"
#include "techniques/occlusion_cones/occlusion_cones_projector.h"
#include "techniques/occlusion_cones/occlusion_cones_technique.h"
#include "techniques/radiosity/radiosity_planning.h"
#include "techniques/radiosity/radiosity_projector.h"
#include "techniques/radiosity/radiosity_technique.h"
#include "techniques/registry/plannings.h"
#include "techniques/registry/projectors.h"
#include "techniques/registry/registry.h"
#include "techniques/sh/sh_planning.h"
#include "techniques/sh/sh_projector.h"
#include "techniques/sh/sh_technique.h"
#include "techniques/subsurface/subsurface_planning.h"
#include "techniques/subsurface/subsurface_projector.h"
#include "techniques/subsurface/subsurface_technique.h"
#include "techniques/vector_occluders/vector_occluders_planning.h"
#include "techniques/vector_occluders/vector_occluders_projector.h"
#include "techniques/vector_occluders/vector_occluders_technique.h"
#include "techniques/volume/volume_planning.h"
#include "techniques/volume/volume_projector.h"
#include "techniques/volume/volume_technique.h"

namespace prelight {

namespace {

/// A technique and its place in every order. A new one takes the next number in each column.
struct Row {
  Technique (*technique)();
  Planning (*planning)();  ///< nullptr: made of what another one has baked
  std::unique_ptr<Projector> (*projector)(const BakeContext&);  ///< nullptr where planning is
  std::array<int, 3> places;                                    ///< [Order]
  std::array<int, 3> planned;                                   ///< [PlanningOrder]
};

constexpr std::array<Row, 18> rows = {{
    // places: entry, root, summary; planned: plan, key, run
    {ambientOcclusionTechnique, ambientOcclusionPlanning, ambientOcclusionProjector, {0, 0, 0}, {0, 0, 0}},
    {shTechnique, shPlanning, shProjector, {1, 1, 2}, {1, 1, 2}},
    {compressedShTechnique, nullptr, nullptr, {2, 2, 3}, {}},
    {animationTechnique, nullptr, nullptr, {3, 4, 12}, {}},
    {chTechnique, chPlanning, chProjector, {4, 5, 4}, {2, 2, 3}},
    {haarTechnique, haarPlanning, haarProjector, {5, 6, 5}, {3, 3, 7}},
    {glossyTechnique, glossyPlanning, glossyProjector, {6, 7, 6}, {4, 6, 8}},
    {lightGroupsTechnique, lightGroupsPlanning, lightGroupsProjector, {7, 8, 7}, {5, 7, 4}},
    {vectorOccludersTechnique, vectorOccludersPlanning, vectorOccludersProjector, {9, 3, 8}, {6, 8, 1}},
    {volumeTechnique, volumePlanning, volumeProjector, {11, 9, 9}, {7, 4, 5}},
    {chartTransferTechnique, chartTransferPlanning, chartTransferProjector, {10, 10, 10}, {8, 5, 6}},
    {radiosityTechnique, radiosityPlanning, radiosityProjector, {8, 11, 1}, {9, 9, 9}},
    {lightMapTechnique, lightMapPlanning, lightMapProjector, {12, 12, 11}, {10, 10, 10}},
    {occlusionConesTechnique, occlusionConesPlanning, occlusionConesProjector, {13, 13, 13}, {11, 11, 11}},
    {encodedLightTechnique, encodedLightPlanning, encodedLightProjector, {14, 14, 14}, {12, 12, 12}},
    {nearLampsTechnique, nearLampsPlanning, nearLampsProjector, {15, 15, 15}, {13, 13, 13}},
    {horizonsTechnique, horizonsPlanning, horizonsProjector, {16, 16, 16}, {14, 14, 14}},
    {subsurfaceTechnique, subsurfacePlanning, subsurfaceProjector, {17, 17, 17}, {15, 15, 15}},
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

/// The rows in the order that one of the columns gives.
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

std::vector<std::unique_ptr<Projector>> makeProjectors(const BakeContext& context) {
  std::vector<std::unique_ptr<Projector>> made;
  for (const Row& row : sortedBy(&Row::planned, static_cast<std::size_t>(PlanningOrder::Run))) {
    if (row.projector == nullptr) continue;
    if (std::unique_ptr<Projector> projector = row.projector(context)) made.push_back(std::move(projector));
  }
  return made;
}

std::vector<Planning> plannings(PlanningOrder order) {
  std::vector<Planning> found;
  for (const Row& row : sortedBy(&Row::planned, static_cast<std::size_t>(order)))
    if (row.planning != nullptr) found.push_back(row.planning());
  return found;
}

std::vector<BakedSummary> summariesOf(const Bake& bake, std::size_t vertices) {
  std::vector<BakedSummary> summaries;
  for (const Technique& technique : techniques(Order::Summary))
    if (technique.summarize != nullptr) technique.summarize(bake, vertices, summaries);
  return summaries;
}

}  // namespace prelight
