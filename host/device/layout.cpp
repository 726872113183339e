#include "device/layout.h"

#include <cstddef>
#include <type_traits>

#include "device/kernel.h"
#include "shared/bvh_types.h"
#include "shared/cached_light_types.h"
#include "shared/cast_types.h"
#include "shared/density_types.h"
#include "shared/gather_types.h"
#include "shared/instance_types.h"
#include "shared/light_group_types.h"
#include "shared/occluder_light_types.h"
#include "shared/occluder_types.h"
#include "shared/photon_path_types.h"
#include "shared/photon_types.h"
#include "shared/queue_types.h"
#include "shared/radiosity_types.h"
#include "shared/ray_types.h"
#include "shared/reference_types.h"
#include "shared/scene_layout_types.h"
#include "shared/scene_types.h"
#include "shared/shade_types.h"
#include "shared/specular_types.h"
#include "shared/walk_types.h"
#include "shared/walled_square.h"

namespace prelight {

namespace {

using namespace device;

static_assert(offsetof(Ray, tMax) == 28);
static_assert(offsetof(WideNode, child) == 192);
static_assert(offsetof(TriangleBlock, triangle) == 288);
static_assert(offsetof(ReferenceParameters, scene) == 108);

template <typename T, std::size_t size>
StructLayout layoutOf(const char* name, std::size_t offset) {
  static_assert(std::is_trivially_copyable_v<T> && std::is_standard_layout_v<T> && sizeof(T) == size);
  return {name, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(offset)};
}

/// Returns the layouts of the structures for rays, scenes, casts and vector occluders.
std::vector<StructLayout> layoutsOfTracing() {
  return {layoutOf<Ray, 32>("Ray", offsetof(Ray, tMax)),
          layoutOf<Hit, 16>("Hit", offsetof(Hit, v)),
          layoutOf<WideNode, 224>("WideNode", offsetof(WideNode, child)),
          layoutOf<TriangleBlock, 320>("TriangleBlock", offsetof(TriangleBlock, triangle)),
          layoutOf<NarrowNode, 64>("NarrowNode", offsetof(NarrowNode, child)),
          layoutOf<NarrowTriangle, 40>("NarrowTriangle", offsetof(NarrowTriangle, triangle)),
          layoutOf<DeviceMaterial, 48>("DeviceMaterial", offsetof(DeviceMaterial, flags)),
          layoutOf<DeviceTriangle, 16>("DeviceTriangle", offsetof(DeviceTriangle, material)),
          layoutOf<SurfaceRange, 16>("SurfaceRange", offsetof(SurfaceRange, vertexShift)),
          layoutOf<Receiver, 48>("Receiver", offsetof(Receiver, firstSample)),
          layoutOf<CastParameters, 32>("CastParameters", offsetof(CastParameters, firstStored)),
          layoutOf<Sender, 8>("Sender", offsetof(Sender, albedo)),
          layoutOf<ReferenceParameters, 276>("ReferenceParameters", offsetof(ReferenceParameters, scene)),
          layoutOf<ShadeMaterial, 236>("ShadeMaterial", offsetof(ShadeMaterial, textures)),
          layoutOf<PunctualLight, 80>("PunctualLight", offsetof(PunctualLight, coneOffset)),
          layoutOf<PathState, 64>("PathState", offsetof(PathState, seesWalls)),
          layoutOf<OccluderVertex, 16>("OccluderVertex", offsetof(OccluderVertex, accessibility)),
          layoutOf<OccluderSums, 64>("OccluderSums", offsetof(OccluderSums, group)),
          layoutOf<OccluderWay, 32>("OccluderWay", offsetof(OccluderWay, ray)),
          layoutOf<OccluderWaySums, 32>("OccluderWaySums", offsetof(OccluderWaySums, pad)),
          layoutOf<GlassPath, 20>("GlassPath", offsetof(GlassPath, medium)),
          layoutOf<OccluderLight, 64>("OccluderLight", offsetof(OccluderLight, twoSided)),
          layoutOf<OccluderReceiverPoint, 48>("OccluderReceiverPoint", offsetof(OccluderReceiverPoint, pad1)),
          layoutOf<LitVertex, 48>("LitVertex", offsetof(LitVertex, pad1)),
          layoutOf<OccluderTerms, 84>("OccluderTerms", offsetof(OccluderTerms, eyeZ))};
}

/// Returns the layouts of the structures for photons, gathering, radiosity and scene buffers.
std::vector<StructLayout> layoutsOfLight() {
  return {layoutOf<Photon, 32>("Photon", offsetof(Photon, direction)),
          layoutOf<LeafTree, 16>("LeafTree", offsetof(LeafTree, count)),
          layoutOf<PhotonBlock, 256>("PhotonBlock", offsetof(PhotonBlock, direction)),
          layoutOf<AreaNode, 64>("AreaNode", offsetof(AreaNode, triangleCount)),
          layoutOf<AreaTriangle, 48>("AreaTriangle", offsetof(AreaTriangle, normal)),
          layoutOf<DensityParameters, 44>("DensityParameters", offsetof(DensityParameters, photonBlocks)),
          layoutOf<DensityQuery, 36>("DensityQuery", offsetof(DensityQuery, patch)),
          layoutOf<PhotonSource, 44>("PhotonSource", offsetof(PhotonSource, tangent)),
          layoutOf<PhotonParameters, 316>("PhotonParameters", offsetof(PhotonParameters, scene)),
          layoutOf<PhotonPath, 32>("PhotonPath", offsetof(PhotonPath, mirrored)),
          layoutOf<GatherParameters, 216>("GatherParameters", offsetof(GatherParameters, scene)),
          layoutOf<GatherPath, 36>("GatherPath", offsetof(GatherPath, behind)),
          layoutOf<PhotonGrid, 32>("PhotonGrid", offsetof(PhotonGrid, firstCell)),
          layoutOf<DeviceInstance, 64>("DeviceInstance", offsetof(DeviceInstance, triangleCount)),
          layoutOf<LightRay, 32>("LightRay", offsetof(LightRay, sampleCount)),
          layoutOf<GroupEmitter, 16>("GroupEmitter", offsetof(GroupEmitter, factor)),
          layoutOf<LightLayout, 36>("LightLayout", offsetof(LightLayout, skyTurn)),
          layoutOf<ElementPoint, 16>("ElementPoint", offsetof(ElementPoint, back)),
          layoutOf<EmitterRange, 12>("EmitterRange", offsetof(EmitterRange, table)),
          layoutOf<VirtualLight, 100>("VirtualLight", offsetof(VirtualLight, through)),
          layoutOf<SurfacePlace, 12>("SurfacePlace", offsetof(SurfacePlace, clearance)),
          layoutOf<SurfaceLine, 64>("SurfaceLine", offsetof(SurfaceLine, words)),
          layoutOf<ShadingLine, 64>("ShadingLine", offsetof(ShadingLine, words)),
          layoutOf<LightLine, 64>("LightLine", offsetof(LightLine, words)),
          layoutOf<OccluderLine, 64>("OccluderLine", offsetof(OccluderLine, words)),
          layoutOf<SceneLayout, 168>("SceneLayout", offsetof(SceneLayout, occluderVertices)),
          layoutOf<PathStep, 32>("PathStep", offsetof(PathStep, goesOn)),
          layoutOf<PhotonStep, 12>("PhotonStep", offsetof(PhotonStep, next)),
          layoutOf<IrradianceLine, 64>("IrradianceLine", offsetof(IrradianceLine, words)),
          layoutOf<IrradianceMapLayout, 32>("IrradianceMapLayout", offsetof(IrradianceMapLayout, walled)),
          layoutOf<GatherStep, 12>("GatherStep", offsetof(GatherStep, next)),
          layoutOf<DensityLine, 64>("DensityLine", offsetof(DensityLine, words)),
          layoutOf<CachedPathParameters, 360>("CachedPathParameters",
                                              offsetof(CachedPathParameters, causticSamples)),
          layoutOf<GlassStep, 12>("GlassStep", offsetof(GlassStep, reach)),
          layoutOf<DirectRays, 16>("DirectRays", offsetof(DirectRays, skySamples)),
          layoutOf<RelaxStep, 16>("RelaxStep", offsetof(RelaxStep, perSide)),
          layoutOf<LightGroupLine, 64>("LightGroupLine", offsetof(LightGroupLine, words)),
          layoutOf<LightGroupLayout, 24>("LightGroupLayout", offsetof(LightGroupLayout, emitters)),
          layoutOf<QueueMove, 32>("QueueMove", offsetof(QueueMove, to)),
          layoutOf<DeviceTexture, 48>("DeviceTexture", offsetof(DeviceTexture, wrapT)),
          layoutOf<GatherArrival, 16>("GatherArrival", offsetof(GatherArrival, ray)),
          layoutOf<SpecularStep, 12>("SpecularStep", offsetof(SpecularStep, next)),
          layoutOf<SpecularPath, 28>("SpecularPath", offsetof(SpecularPath, dispersed)),
          layoutOf<SpecularEnd, 40>("SpecularEnd", offsetof(SpecularEnd, v)),
          layoutOf<GatherRecord, 92>("GatherRecord", offsetof(GatherRecord, nearest)),
          layoutOf<MediumWalk, 32>("MediumWalk", offsetof(MediumWalk, steps)),
          layoutOf<SourceCell, 12>("SourceCell", offsetof(SourceCell, copy)),
          layoutOf<Eye, 64>("Eye", offsetof(Eye, forward)),
          layoutOf<ImportanceGrid, 20>("ImportanceGrid", offsetof(ImportanceGrid, side)),
          layoutOf<PathParts, 64>("PathParts", offsetof(PathParts, arriving)),
          layoutOf<WalledSquare, 16>("WalledSquare", offsetof(WalledSquare, right)),
          layoutOf<SquareWeights, 16>("SquareWeights", offsetof(SquareWeights, rightBottom))};
}

}  // namespace

std::vector<StructLayout> hostLayouts() {
  std::vector<StructLayout> layouts = layoutsOfTracing();
  const std::vector<StructLayout> more = layoutsOfLight();
  layouts.insert(layouts.end(), more.begin(), more.end());
  return layouts;
}

std::vector<StructLayout> deviceLayouts(DeviceContext& device) {
  std::vector<StructLayout> layouts = hostLayouts();
  Buffer<std::uint32_t> out(device, 2 * layouts.size());
  Kernel<Buffer<std::uint32_t>> kernel(device, "core/layout_probe_kernels.cl", {}, "probeLayout");
  kernel.launch({1, 1}, out);
  const auto values = out.read();
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    layouts[i].size = values[2 * i];
    layouts[i].offset = values[2 * i + 1];
  }
  return layouts;
}

}  // namespace prelight
