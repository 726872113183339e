#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "gi/global_illumination.h"
#include "gi/update/live_light.h"
#include "viewer/debug/cell_drawing.h"
#include "viewer/debug/debug_colors.h"
#include "viewer/debug/debug_rows.h"
#include "viewer/debug/marks.h"

namespace prelight::viewer {
namespace {

std::vector<device::Photon> causticPhotonsOf(const RenderInputs& inputs) {
  if (inputs.caustics != nullptr) return {inputs.caustics->photons.begin(), inputs.caustics->photons.end()};
  if (inputs.live != nullptr) return inputs.live->caustics();
  return inputs.globalIllumination != nullptr ? inputs.globalIllumination->photons
                                              : std::vector<device::Photon>();
}

std::vector<device::Photon> diffusePhotonsOf(const RenderInputs& inputs) {
  const LivePhotons* photons = inputs.live != nullptr ? inputs.live->photons() : nullptr;
  return photons != nullptr ? photons->photons() : std::vector<device::Photon>();
}

DebugLack lackOfPhotons(const RenderInputs& inputs) {
  if (!diffusePhotonsOf(inputs).empty() || !causticPhotonsOf(inputs).empty()) return {};
  return {"no photons are stored",
          "add --shading full, or --caustics 100000 for a scene with mirrors or glass"};
}

DebugLack lackOfGroups(const RenderInputs& inputs) {
  if (!diffusePhotonsOf(inputs).empty()) return {};
  return {"no photons follow the scene in groups",
          "add --shading full, for a scene in which something shines"};
}

DebugLack lackOfCaustics(const RenderInputs& inputs) {
  if (!causticPhotonsOf(inputs).empty()) return {};
  return {"no caustic photons are stored",
          "add --caustics 100000, or --shading full, for a scene with mirrors or glass"};
}

glm::vec3 placeOfPhoton(const device::Photon& photon) {
  return {photon.position[0], photon.position[1], photon.position[2]};
}

/// The colour of a photon's power, its greatest channel 0.8.
glm::vec3 colorOfPhoton(const device::Photon& photon) {
  const glm::vec3 power(photon.power[0], photon.power[1], photon.power[2]);
  const float greatest = std::max({power.x, power.y, power.z});
  return greatest > 0.0f ? 0.8f / greatest * power : glm::vec3(0.0f);
}

std::unique_ptr<DebugDrawing> drawPhotons(const DebugInputs& of) {
  const std::vector<device::Photon> diffuse = diffusePhotonsOf(of.inputs),
                                    caustic = causticPhotonsOf(of.inputs);
  Marks marks;
  marks.pointSize = 2.0f;
  for (const auto* photons : {&diffuse, &caustic})
    for (const device::Photon& photon : *photons)
      marks.points.push_back({placeOfPhoton(photon), colorOfPhoton(photon)});
  marks.legend = std::to_string(diffuse.size()) + " photons of indirect light, " +
                 std::to_string(caustic.size()) + " of caustics";
  return drawMarks(std::move(marks), of.inputs.compiled);
}

std::unique_ptr<DebugDrawing> drawPhotonGroups(const DebugInputs& of) {
  const LivePhotons& live = *of.inputs.live->photons();
  const std::vector<device::Photon> photons = live.photons();
  const std::vector<std::uint32_t> groups = live.groupsOfPhotons();
  Marks marks;
  marks.pointSize = 2.5f;
  for (std::size_t i = 0; i < photons.size(); ++i)
    marks.points.push_back({placeOfPhoton(photons[i]),
                            groups[i] == LivePhotons::noGroup ? glm::vec3(0.2f) : distinctColor(groups[i])});
  marks.legend =
      std::to_string(photons.size()) + " photons in " + std::to_string(live.groupCount()) + " groups";
  return drawMarks(std::move(marks), of.inputs.compiled);
}

std::unique_ptr<DebugDrawing> drawCausticCells(const DebugInputs& of) {
  return drawCells(causticPhotonsOf(of.inputs), of);
}

constexpr std::array<DebugRow, 3> photonTable = {{
    {DebugView::Photons, lackOfPhotons, drawPhotons},
    {DebugView::PhotonGroups, lackOfGroups, drawPhotonGroups},
    {DebugView::CausticCells, lackOfCaustics, drawCausticCells},
}};

}  // namespace

std::span<const DebugRow> photonRows() { return photonTable; }

}  // namespace prelight::viewer
