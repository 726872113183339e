#include "bake/make_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "occluders/occluder_vectors.h"
#include "plan/shadow_sets.h"
#include "projectors/lightmap/light_map_plan.h"
#include "radiosity/radiosity_plan.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

constexpr std::uint64_t bvhBytesPerTriangle = 100;  // nodes and blocks, measured 70 to 95 on built-in scenes
constexpr std::uint64_t senderBytes = 8;
constexpr std::uint64_t texelCodeBytes = 4;
constexpr std::uint64_t seenBytes = 72;  // what a vertex keeps of an occluder until its record is made
constexpr std::uint64_t wayBytes = 56;   // the same of what is mirrored or comes through it
constexpr std::uint64_t blockBytes = std::uint64_t{16} << 20;

PlannedPass planTranslucent(const CompiledScene& scene, bool bounces) {
  if (!scene.hasDiffuseTransmission())
    return {Pass::TranslucentSenders, false, "no material transmits light diffusely"};
  if (!bounces)
    return {Pass::TranslucentSenders, false, "light comes through surfaces by way of bounces alone"};
  return {Pass::TranslucentSenders, true,
          "both sides of what transmits are cast where one is seen; a ray takes the side that it samples"};
}

std::size_t countMaterials(const Scene& scene, bool (*test)(const Material&)) {
  return static_cast<std::size_t>(std::count_if(scene.materials.begin(), scene.materials.end(), test));
}

PlannedPass planBounces(const CompiledScene& scene, const BakeRequest& request) {
  if (!request.carriesLight()) return {Pass::Bounces, false, "no technique that is asked for carries light"};
  if (request.bounces == 0) return {Pass::Bounces, false, "none are asked for"};
  if (!scattersDiffusely(scene))
    return {Pass::Bounces, false,
            "no surface has a diffuse albedo above 0 or lets light through, so nothing is reflected"};
  return {Pass::Bounces, true, fmt::format("{} from stored transport, without new rays", request.bounces)};
}

std::string channelsText(bool bounces) {
  return bounces ? "3 channels" : "1 channel because nothing colours the light";
}

PlannedPass planHarmonics(Pass name, int order, bool bounces, const std::string& how) {
  if (order == 0) return {name, false, "not asked for"};
  return {name, true,
          fmt::format("order {}, {} coefficients, {}{}", order, order * order, channelsText(bounces), how)};
}

PlannedPass planHaar(const BakeRequest& request, bool bounces) {
  if (request.haarSize == 0) return {Pass::HaarTransfer, false, "not asked for"};
  return {Pass::HaarTransfer, true,
      fmt::format("cube map of 6 x {0} x {0}, {1}, from the rays of the same cast{2}", request.haarSize,
                  channelsText(bounces),
                  bounces ? fmt::format("; bounces through SH of order {}", transferOrder(request)) : "")};
}

PlannedPass planGlossy(const BakeRequest& request, bool bounces) {
  if (request.glossyOrder == 0) return {Pass::GlossyTransfer, false, "not asked for"};
  return {Pass::GlossyTransfer, true,
          fmt::format("order {}, {} entries a matrix, {}; from SH transfer of order {}", request.glossyOrder,
                      request.glossyOrder * request.glossyOrder * request.glossyOrder * request.glossyOrder,
                      channelsText(bounces), 2 * request.glossyOrder - 1)};
}

PlannedPass planLightGroups(const BakeRequest& request) {
  if (!request.lightGroups) return {Pass::LightGroups, false, "not asked for"};
  return {Pass::LightGroups, true, "shadow rays from every receiver to every light"};
}

PlannedPass planOccluders(const BakeRequest& request) {
  if (!request.occluders) return {Pass::VectorOccluders, false, "not asked for"};
  return {Pass::VectorOccluders, true,
          "position, occlusion, diffuse normal and diffuse colour, from the rays of the same cast"};
}

/// Vectors that only some scenes need.
PlannedPass planVectors(const BakeRequest& request, Pass name, bool needed, const std::string& reason,
                        const std::string& lack) {
  if (!request.occluders) return {name, false, "vector occluders are not asked for"};
  return {name, needed, needed ? reason : lack};
}

/// Values a voxel of a volume.
std::uint64_t volumeValues(const BakeRequest& request, bool bounces) {
  return static_cast<std::uint64_t>(request.shOrder * request.shOrder) * (bounces ? 4 : 1);
}

PlannedPass planVolume(const BakeRequest& request, bool bounces) {
  if (request.volumeSize == 0) return {Pass::Volume, false, "not asked for"};
  if (request.shOrder == 0) return {Pass::Volume, false, "no SH transfer is asked for, whose order it has"};
  return {Pass::Volume, true,
      fmt::format("{} voxels along the longest side, order {}, {}{}, {} bytes a voxel; moving objects are "
                  "not in it, and everything in the scene shadows it",
                  request.volumeSize, request.shOrder, channelsText(bounces),
                  bounces ? " and one without bounces" : "", 4 * volumeValues(request, bounces))};
}

PlannedPass planTexels(const Scene& scene, const BakeRequest& request, bool bounces) {
  if (request.texelSize == 0) return {Pass::Texels, false, "not asked for"};
  if (request.shOrder == 0)
    return {Pass::Texels, false, "no SH transfer is asked for, whose order they have"};
  const std::size_t mapped =
      countMaterials(scene, [](const Material& m) { return m.normalTexture.image >= 0; });
  return {Pass::Texels, true,
          fmt::format("light maps of at most {0} x {0}, order {1}, {2}, with {3}", request.texelSize,
                      request.shOrder, channelsText(bounces),
                      mapped > 0 ? fmt::format("the normals of {} normal-mapped materials", mapped)
                                 : "shading normals, as no material has a normal map")};
}

PlannedPass planShadowSets(const ShadowSets& sets, const BakeRequest& request) {
  if (request.shadowSets.empty()) return {Pass::ShadowSets, false, "not asked for: everything shadows all"};
  if (sets.empty()) return {Pass::ShadowSets, false, "every node sees every other all the same"};
  std::uint64_t receivers = 0;
  for (const ShadowSets::Occluders& set : sets.sets) receivers += set.receivers;
  std::string text = fmt::format("{} nodes see a part of the scene; trees of", receivers);
  const std::size_t shown = std::min<std::size_t>(sets.sets.size(), 8);
  for (std::size_t s = 0; s < shown; ++s)
    text += fmt::format("{} {} triangles ({} nodes)", s > 0 ? "," : "", sets.sets[s].triangles.size(),
                        sets.sets[s].nodes);
  if (shown < sets.sets.size()) text += fmt::format(" and {} more", sets.sets.size() - shown);
  return {Pass::ShadowSets, true,
          text + fmt::format(", about {} kB besides the whole scene's",
                             (sets.treeTriangles() * bvhBytesPerTriangle + 999) / 1000)};
}

std::uint64_t castRays(const CompiledScene& scene, const BakeRequest& request) {
  // With a target instead of a count the rows are bounded by memory alone.
  return request.error || request.seconds ? ~std::uint64_t{0} / senderBytes
                                          : request.rays * scene.vertexCount() * 5 / 4 + 65536;
}

/// Of vector occluders, while they are aggregated: objects that a vertex sees, or parts of them (measured, 3
/// to 8 and 30 to 60).
std::uint64_t occluderBytes(const CompiledScene& scene, const BakeRequest& request) {
  if (!request.occluders) return 0;
  const std::uint64_t seen = request.occluderKind == OccluderKind::Auto ? 48 : 8;
  const bool ways = hasGlass(scene) || hasShine(scene);
  return std::uint64_t{scene.vertexCount()} * seen * (seenBytes + (ways ? wayBytes : 0));
}

void estimateMemory(const CompiledScene& scene, const BakeRequest& request, bool bounces, Plan& plan) {
  const std::uint64_t vertices = scene.vertexCount(), triangles = scene.triangleCount();
  const auto order = static_cast<std::uint64_t>(castOrder(request));
  const std::uint64_t coefficients = order * order;
  const auto glossy = static_cast<std::uint64_t>(request.glossyOrder);
  std::uint64_t texels = 0;
  for (const Image& image : scene.albedoImages) texels += 2 * image.rgba.size();
  plan.transportBytes = bounces ? std::min(castRays(scene, request) * senderBytes, request.maxMemory / 2) : 0;
  if (request.haarSize > 0)
    plan.texelBytes = std::min(castRays(scene, request) * texelCodeBytes, request.maxMemory / 4);
  plan.deviceBytes = triangles * (bvhBytesPerTriangle + 29) + vertices * 24 + texels + blockBytes +
                     plan.transportBytes + (bounces ? vertices * 2 * 3 * coefficients * 4 : 0);
  const std::uint64_t fitColumns = std::max<std::uint64_t>(4 + coefficients, bounces ? 3 * coefficients : 0);
  plan.hostBytes = triangles * (48 + 16 + 120) + vertices * (60 + fitColumns * 8 * 8) +
                   std::min<std::uint64_t>(castRays(scene, request) / 64, std::uint64_t{1} << 24) * 24 +
                   occluderBytes(scene, request) + plan.texelBytes +
                   vertices * glossy * glossy * glossy * glossy * 4 * (bounces ? 6 : 2);
}

}  // namespace

Plan makePlan(const Scene& scene, const CompiledScene& compiled, const BakeRequest& request) {
  Plan plan;
  const bool anything = compiled.triangleCount() > 0 && request.anything();
  const std::string nothing =
      compiled.triangleCount() == 0 ? "the scene has no triangles" : "no technique is asked for";
  const PlannedPass bounces =
      anything ? planBounces(compiled, request) : PlannedPass{Pass::Bounces, false, nothing};
  const auto add = [&](const PlannedPass& pass) {
    plan.passes.push_back(anything || !pass.runs ? pass : PlannedPass{pass.pass, false, nothing});
  };
  add({Pass::Cast, request.castsReceivers(),
       !request.castsReceivers()  ? "no technique that is asked for looks from receivers"
       : bounces.runs             ? "closest hits, because bounces need to know what was hit"
       : request.occluders        ? "closest hits, because occluders are told apart by what was hit"
       : request.obscurance > 0.0 ? "closest hits, because obscurance fades with the distance"
       : request.lightGroups      ? "closest hits where a group has emitters"
                                  : "any hit is enough, because nothing bounces"});
  const ShadowSets sets = anything ? makeShadowSets(compiled, request.shadowSets) : ShadowSets{};
  add(planShadowSets(sets, request));
  add({Pass::AmbientOcclusion, request.ao,
       request.ao ? "with bent normal, from the same cast" : "not asked for"});
  add(planHarmonics(Pass::ShTransfer, request.shOrder, bounces.runs, ""));
  add(planHarmonics(Pass::ChTransfer, request.chOrder, bounces.runs,
                    request.chNaive ? ", naive inner products" : ", an exact map of the SH transfer"));
  add(planHaar(request, bounces.runs));
  add(planGlossy(request, bounces.runs));
  add(planLightGroups(request));
  add(planOccluders(request));
  const double reach = freeReach(compiled);
  const std::string free =
      std::isinf(reach) ? "nothing is in the way, because light comes from outside"
                        : fmt::format("nothing is in the way for {:.3g} m, because lights lie inside", reach);
  add(planVectors(request, Pass::CausticVectors, hasGlass(compiled),
                  "rays that meet glass are refracted until " + free,
                  "no material lets light through by refraction"));
  add(planVectors(request, Pass::SpecularVectors, hasShine(compiled),
                  "rays go the mirrored way from what is shiny, and count where " + free,
                  "no material mirrors light or is glossy"));
  add(planVolume(request, bounces.runs));
  add(planTexels(scene, request, bounces.runs));
  add(bounces);
  for (const PlannedPass& pass : planRadiosity(compiled, request)) add(pass);
  for (const PlannedPass& pass : planLightMap(scene, compiled, request)) add(pass);
  add({Pass::BackFaces, bounces.runs,
       bounces.runs ? "cast only where the first rays meet a back" : "backs matter to bounces alone"});
  add(planTranslucent(compiled, bounces.runs));
  add({Pass::AlphaTest, compiled.hasAlphaMask(),
       compiled.hasAlphaMask() ? "a material is alpha-masked" : "no material is alpha-masked"});
  const bool textured = !compiled.albedoImages.empty();
  add({Pass::AlbedoTextures, textured && bounces.runs,
       !textured      ? "no material has a base-colour texture"
       : bounces.runs ? "senders reflect their texture's colour"
                      : "albedo matters to bounces alone"});
  const std::size_t transmissive =
      countMaterials(scene, [](const Material& m) { return m.transmission > 0.0f; });
  const std::size_t mirrors =
      countMaterials(scene, [](const Material& m) { return m.metallic > 0.0f && m.roughness < 0.1f; });
  add({Pass::SpecularTransport, false,
       transmissive + mirrors == 0 ? "no material is transmissive or mirror-like"
                                   : fmt::format("{} transmissive and {} mirror-like materials count as "
                                                 "occluders: {} specular light",
                                                 transmissive, mirrors,
                                                 request.occluders ? "vector occluders alone carry"
                                                                   : "no technique asked for carries")});
  if (anything) estimateMemory(compiled, request, bounces.runs, plan);
  const auto side = static_cast<std::uint64_t>(request.volumeSize);
  plan.hostBytes += anything ? side * side * side * (4 * volumeValues(request, bounces.runs) + 1) : 0;
  plan.deviceBytes += sets.treeTriangles() * bvhBytesPerTriangle;
  if (plan.runs(Pass::LightMap))
    plan.hostBytes += lightMapBytes(compiled, request, lightMapCoefficients(plan));
  if (plan.runs(Pass::Radiosity)) {
    const std::uint64_t bytes = std::min(request.maxMemory, radiosityScale(compiled, request).bytes());
    plan.hostBytes += bytes;
    plan.deviceBytes += bytes / 3;
  }
  return plan;
}

}  // namespace prelight
