#include "viewer/core/shading.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight::viewer {
namespace {

constexpr int defaultOrder = 3;
constexpr int defaultHaarSize = 32;
constexpr int defaultGlossyOrder = 4;
constexpr int defaultSectors = 8;

constexpr int orDefault(int asked, int otherwise) { return asked > 0 ? asked : otherwise; }

constexpr std::array<ShadingInfo, shadingCount> shadingTable = {{
    {Shading::Phong, "direct light without shadows", "", [](const Bake&) { return true; },
     [](const BakeRequest&) { return false; }, [](BakeRequest&, const BakeRequest&) {}},
    {Shading::Ao, "direct light without shadows, with the sky's light occluded", "--ao",
     [](const Bake& bake) { return !bake.ao.empty() && !bake.bentNormals.empty(); },
     [](const BakeRequest& request) { return request.ao; },
     [](BakeRequest& request, const BakeRequest&) { request.ao = true; }},
    {Shading::Sh, "light through spherical-harmonic transfer", "--sh 3",
     [](const Bake& bake) { return bake.sh.has_value() || bake.compressedSh.has_value(); },
     [](const BakeRequest& request) { return request.sh.order > 0; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.sh.order = orDefault(asked.sh.order, defaultOrder);
     }},
    {Shading::Ch, "light through cpherical-harmonic transfer", "--ch 3",
     [](const Bake& bake) { return bake.ch.has_value(); },
     [](const BakeRequest& request) { return request.ch.order > 0; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.ch.order = orDefault(asked.ch.order, defaultOrder);
     }},
    {Shading::Haar, "light through wavelet transfer", "--haar 32",
     [](const Bake& bake) { return bake.haar.has_value(); },
     [](const BakeRequest& request) { return request.haar.size > 0; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.haar.size = orDefault(asked.haar.size, defaultHaarSize);
     }},
    {Shading::Glossy, "diffuse and glossy reflection through transfer matrices", "--glossy 4",
     [](const Bake& bake) { return bake.glossy.has_value(); },
     [](const BakeRequest& request) { return request.glossy.order > 0; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.glossy.order = orDefault(asked.glossy.order, defaultGlossyOrder);
     }},
    {Shading::Lights, "the scene's own lights, with shadows", "--light-groups",
     [](const Bake& bake) { return bake.lightGroups.has_value(); },
     [](const BakeRequest& request) { return request.lightGroups.wanted; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.lightGroups.wanted = true;
       request.lightGroups.named = asked.lightGroups.named;
     }},
    {Shading::Vo, "lights anywhere, with the shadows and colours of vector occluders", "--vo",
     [](const Bake& bake) { return bake.occluders.has_value(); },
     [](const BakeRequest& request) { return request.occluders.wanted; },
     [](BakeRequest& request, const BakeRequest&) { request.occluders.wanted = true; }},
    {Shading::Radiosity, "the scene's own lights as baked, with shadows and all diffuse bounces",
     "--radiosity", [](const Bake& bake) { return bake.irradiance.has_value(); },
     [](const BakeRequest& request) { return request.radiosity.wanted; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.radiosity = asked.radiosity;
       request.radiosity.wanted = true;
     }},
    {Shading::LightMap, "the scene's own lights as baked in a light map", "--lightmap",
     [](const Bake& bake) { return bake.lightMap.has_value(); },
     [](const BakeRequest& request) { return request.lightMap.wanted; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.lightMap.wanted = true;
       request.lightMap.texelSize = asked.lightMap.texelSize;
       request.encodedLight = asked.encodedLight;
     }},
    {Shading::Cones, "sky, lights and reflections through the cone that is open above a surface", "--cones",
     [](const Bake& bake) {
       return !bake.ao.empty() && !bake.bentNormals.empty() && !bake.apertures.empty();
     },
     [](const BakeRequest& request) { return request.cones; },
     [](BakeRequest& request, const BakeRequest&) { request.ao = request.cones = true; }},
    {Shading::GlobalIllumination, "all light, with caustics, mirrors and glass", "",
     [](const Bake&) { return false; }, [](const BakeRequest&) { return false; },
     [](BakeRequest&, const BakeRequest&) {}},
    {Shading::Screen, "like ao, with occlusion found in the picture itself", "",
     [](const Bake&) { return true; }, [](const BakeRequest&) { return false; },
     [](BakeRequest&, const BakeRequest&) {}},
    {Shading::Horizons, "sky, lights and reflections above the horizons around a surface", "--horizons 8",
     [](const Bake& bake) { return bake.horizons.has_value(); },
     [](const BakeRequest& request) { return request.horizons.sectors > 0; },
     [](BakeRequest& request, const BakeRequest& asked) {
       request.horizons.sectors = orDefault(asked.horizons.sectors, defaultSectors);
     }},
    {Shading::Instant, "all light, that of surfaces from virtual lights with shadow maps", "",
     [](const Bake&) { return false; }, [](const BakeRequest&) { return false; },
     [](BakeRequest&, const BakeRequest&) {}},
}};

static_assert(followsOrder(shadingTable, &ShadingInfo::shading));

/// Place in the order in which shadings are preferred: those that show most come first.
constexpr int placeOf(Shading shading) {
  switch (shading) {
    case Shading::Sh:
      return 0;
    case Shading::Ch:
      return 1;
    case Shading::Glossy:
      return 2;
    case Shading::Haar:
      return 3;
    case Shading::Lights:
      return 4;
    case Shading::LightMap:
      return 5;
    case Shading::Radiosity:
      return 6;
    case Shading::Vo:
      return 7;
    case Shading::Horizons:
      return 8;
    case Shading::Cones:
      return 9;
    case Shading::Ao:
      return 10;
    case Shading::Phong:
      return 11;
    case Shading::Screen:
      return 12;
    case Shading::GlobalIllumination:
      return 13;
    case Shading::Instant:
      return 14;
  }
  return shadingCount;
}

}  // namespace

std::span<const ShadingInfo> shadings() { return shadingTable; }

const ShadingInfo& infoOf(Shading shading) { return shadingTable[static_cast<std::size_t>(shading)]; }

std::string shadingNames() {
  std::string names;
  for (const ShadingInfo& info : shadingTable)
    names += (names.empty() ? "" : ", ") + std::string(info.name());
  return names;
}

Shading parseShading(std::string_view name) {
  std::vector<std::string> names;
  for (const ShadingInfo& info : shadingTable) {
    if (info.name() == name) return info.shading;
    names.emplace_back(info.name());
  }
  throw UsageError("--shading " + std::string(name), "unknown shading",
                   didYouMean(name, names) + "one of: " + shadingNames());
}

Shading carriedShading(const Bake& bake) {
  Shading best = Shading::Phong;
  for (const ShadingInfo& info : shadingTable)
    if (info.carriedBy(bake) && placeOf(info.shading) < placeOf(best)) best = info.shading;
  return best;
}

}  // namespace prelight::viewer
