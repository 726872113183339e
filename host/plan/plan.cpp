#include "prelight/plan.h"

#include <algorithm>
#include <array>

#include "base/text.h"

namespace prelight {

namespace {

struct NamedPass {
  Pass pass = Pass::Cast;
  std::string_view name;
};

constexpr std::array<NamedPass, static_cast<std::size_t>(Pass::Count)> passes = {{
    {Pass::Cast, "cast"},
    {Pass::ShadowSets, "shadow sets"},
    {Pass::AmbientOcclusion, "ambient occlusion"},
    {Pass::ShTransfer, "sh transfer"},
    {Pass::ChTransfer, "ch transfer"},
    {Pass::HaarTransfer, "haar transfer"},
    {Pass::GlossyTransfer, "glossy transfer"},
    {Pass::LightGroups, "light groups"},
    {Pass::VectorOccluders, "vector occluders"},
    {Pass::CausticVectors, "caustic vectors"},
    {Pass::SpecularVectors, "specular vectors"},
    {Pass::Volume, "volume"},
    {Pass::ChartTransfer, "texels"},
    {Pass::Bounces, "bounces"},
    {Pass::Radiosity, "radiosity"},
    {Pass::FormFactors, "form factors"},
    {Pass::LightMap, "light map"},
    {Pass::TexelSizes, "texel sizes"},
    {Pass::DirectLightOfTheMap, "direct light of the map"},
    {Pass::SkyLightOfTheMap, "sky light of the map"},
    {Pass::IndirectLightOfTheMap, "indirect light of the map"},
    {Pass::CausticsOfTheMap, "caustics of the map"},
    {Pass::DirectionsOfTheMap, "directions of the map"},
    {Pass::EncodedLight, "encoded light"},
    {Pass::BackFaces, "back faces"},
    {Pass::TranslucentSenders, "translucent senders"},
    {Pass::AlphaTest, "alpha test"},
    {Pass::AlbedoTextures, "albedo textures"},
    {Pass::SpecularTransport, "specular transport"},
    {Pass::IndirectLight, "indirect light"},
    {Pass::CausticPhotons, "caustic photons"},
    {Pass::RaysToLargeEmitters, "rays to large emitters"},
    {Pass::BacksOfOneSidedSurfaces, "backs of one-sided surfaces"},
    {Pass::DirectLight, "direct light"},
    {Pass::FurtherVertices, "further vertices"},
    {Pass::VirtualLights, "virtual lights"},
    {Pass::PunctualLights, "punctual lights"},
    {Pass::Emitters, "emitters"},
    {Pass::Sky, "sky"},
    {Pass::Mirrors, "mirrors"},
    {Pass::GlossyLobes, "glossy lobes"},
    {Pass::Glass, "glass"},
    {Pass::LightThroughSurfaces, "light through surfaces"},
    {Pass::Absorption, "absorption"},
    {Pass::Textures, "textures"},
    {Pass::ShadowMaps, "shadow maps"},
    {Pass::EnvironmentMaps, "environment maps"},
    {Pass::OcclusionCones, "occlusion cones"},
    {Pass::Instances, "instances"},
    {Pass::NearLamps, "near lamps"},
    {Pass::Horizons, "horizons"},
    {Pass::SubsurfaceTransport, "subsurface transport"},
    {Pass::ObjectCubes, "object cubes"},
}};
static_assert(followsOrder(passes, &NamedPass::pass));

}  // namespace

std::string_view nameOf(Pass pass) { return passes[static_cast<std::size_t>(pass)].name; }

std::optional<Pass> passNamed(std::string_view name) {
  const auto found =
      std::find_if(passes.begin(), passes.end(), [&](const NamedPass& pass) { return pass.name == name; });
  if (found == passes.end()) return std::nullopt;
  return found->pass;
}

bool Plan::runs(Pass pass) const {
  return std::any_of(passes.begin(), passes.end(),
                     [&](const PlannedPass& p) { return p.pass == pass && p.runs; });
}

}  // namespace prelight
