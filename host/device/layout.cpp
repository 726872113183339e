#include "device/layout.h"

#include <cstddef>
#include <type_traits>

#include "device/buffer.h"
#include "shared/bvh_types.h"
#include "shared/cast_types.h"
#include "shared/density_types.h"
#include "shared/gather_types.h"
#include "shared/occluder_light_types.h"
#include "shared/occluder_types.h"
#include "shared/photon_path_types.h"
#include "shared/photon_types.h"
#include "shared/radiosity_types.h"
#include "shared/ray_types.h"
#include "shared/reference_types.h"
#include "shared/scene_types.h"

namespace prelight {

namespace {

using namespace device;

template <typename T, std::size_t size>
constexpr bool isShared = std::is_trivially_copyable_v<T>&& std::is_standard_layout_v<T> && sizeof(T) == size;

static_assert(isShared<Ray, 32> && offsetof(Ray, tMax) == 28);
static_assert(isShared<Hit, 16>);
static_assert(isShared<WideNode, 224> && offsetof(WideNode, child) == 192);
static_assert(isShared<TriangleBlock, 320> && offsetof(TriangleBlock, triangle) == 288);
static_assert(isShared<NarrowNode, 64>);
static_assert(isShared<NarrowTriangle, 40>);
static_assert(isShared<DeviceMaterial, 48>);
static_assert(isShared<DeviceTriangle, 16>);
static_assert(isShared<Receiver, 48>);
static_assert(isShared<CastParameters, 32>);
static_assert(isShared<Sender, 8>);
static_assert(isShared<ReferenceParameters, 128> && offsetof(ReferenceParameters, lights) == 92);
static_assert(isShared<ShadeMaterial, 64>);
static_assert(isShared<PunctualLight, 64>);
static_assert(isShared<PathState, 48>);
static_assert(isShared<ShadowItem, 16>);
static_assert(isShared<VirtualLight, 64>);
static_assert(isShared<ElementPoint, 16>);
static_assert(isShared<RadiosityEmitter, 32>);
static_assert(isShared<OccluderVertex, 16>);
static_assert(isShared<OccluderSums, 64>);
static_assert(isShared<OccluderLight, 64>);
static_assert(isShared<OccluderReceiverPoint, 48>);
static_assert(isShared<LitVertex, 48>);
static_assert(isShared<OccluderTerms, 80>);
static_assert(isShared<OccluderWay, 32>);
static_assert(isShared<OccluderWaySums, 32>);
static_assert(isShared<GlassPath, 20>);
static_assert(isShared<Photon, 32>);
static_assert(isShared<LeafTree, 16>);
static_assert(isShared<PhotonBlock, 256>);
static_assert(isShared<AreaNode, 64>);
static_assert(isShared<AreaTriangle, 48>);
static_assert(isShared<SurfacePlace, 12>);
static_assert(isShared<DensityParameters, 16>);
static_assert(isShared<DensityQuery, 32>);
static_assert(isShared<GatherParameters, 64>);
static_assert(isShared<GatherPath, 28>);
static_assert(isShared<PhotonSource, 40>);
static_assert(isShared<PhotonParameters, 116>);
static_assert(isShared<PhotonPath, 28>);
static_assert(isShared<PhotonGrid, 32>);

template <typename T>
StructLayout layoutOf(const char* name, std::size_t offset) {
  return {name, static_cast<std::uint32_t>(sizeof(T)), static_cast<std::uint32_t>(offset)};
}

}  // namespace

std::vector<StructLayout> hostLayouts() {
  return {layoutOf<Ray>("Ray", offsetof(Ray, tMax)),
          layoutOf<Hit>("Hit", offsetof(Hit, v)),
          layoutOf<WideNode>("WideNode", offsetof(WideNode, child)),
          layoutOf<TriangleBlock>("TriangleBlock", offsetof(TriangleBlock, triangle)),
          layoutOf<NarrowNode>("NarrowNode", offsetof(NarrowNode, child)),
          layoutOf<NarrowTriangle>("NarrowTriangle", offsetof(NarrowTriangle, triangle)),
          layoutOf<DeviceMaterial>("DeviceMaterial", offsetof(DeviceMaterial, wrapT)),
          layoutOf<DeviceTriangle>("DeviceTriangle", offsetof(DeviceTriangle, material)),
          layoutOf<Receiver>("Receiver", offsetof(Receiver, firstSample)),
          layoutOf<CastParameters>("CastParameters", offsetof(CastParameters, firstStored)),
          layoutOf<Sender>("Sender", offsetof(Sender, albedo)),
          layoutOf<ReferenceParameters>("ReferenceParameters", offsetof(ReferenceParameters, lights)),
          layoutOf<ShadeMaterial>("ShadeMaterial", offsetof(ShadeMaterial, flags)),
          layoutOf<PunctualLight>("PunctualLight", offsetof(PunctualLight, coneOffset)),
          layoutOf<PathState>("PathState", offsetof(PathState, diffuseBounces)),
          layoutOf<ShadowItem>("ShadowItem", offsetof(ShadowItem, path)),
          layoutOf<OccluderVertex>("OccluderVertex", offsetof(OccluderVertex, accessibility)),
          layoutOf<OccluderSums>("OccluderSums", offsetof(OccluderSums, group)),
          layoutOf<OccluderWay>("OccluderWay", offsetof(OccluderWay, slot)),
          layoutOf<OccluderWaySums>("OccluderWaySums", offsetof(OccluderWaySums, pad)),
          layoutOf<GlassPath>("GlassPath", offsetof(GlassPath, medium)),
          layoutOf<OccluderLight>("OccluderLight", offsetof(OccluderLight, twoSided)),
          layoutOf<OccluderReceiverPoint>("OccluderReceiverPoint", offsetof(OccluderReceiverPoint, pad1)),
          layoutOf<LitVertex>("LitVertex", offsetof(LitVertex, pad1)),
          layoutOf<OccluderTerms>("OccluderTerms", offsetof(OccluderTerms, eyeZ)),
          layoutOf<Photon>("Photon", offsetof(Photon, direction)),
          layoutOf<LeafTree>("LeafTree", offsetof(LeafTree, count)),
          layoutOf<PhotonBlock>("PhotonBlock", offsetof(PhotonBlock, direction)),
          layoutOf<AreaNode>("AreaNode", offsetof(AreaNode, triangleCount)),
          layoutOf<AreaTriangle>("AreaTriangle", offsetof(AreaTriangle, normal)),
          layoutOf<DensityParameters>("DensityParameters", offsetof(DensityParameters, queryCount)),
          layoutOf<DensityQuery>("DensityQuery", offsetof(DensityQuery, radius)),
          layoutOf<PhotonSource>("PhotonSource", offsetof(PhotonSource, tangent)),
          layoutOf<PhotonParameters>("PhotonParameters", offsetof(PhotonParameters, lights)),
          layoutOf<PhotonPath>("PhotonPath", offsetof(PhotonPath, mirrored)),
          layoutOf<GatherParameters>("GatherParameters", offsetof(GatherParameters, lights)),
          layoutOf<GatherPath>("GatherPath", offsetof(GatherPath, widened)),
          layoutOf<PhotonGrid>("PhotonGrid", offsetof(PhotonGrid, firstCell))};
}

std::vector<StructLayout> deviceLayouts(DeviceContext& device) {
  std::vector<StructLayout> layouts = hostLayouts();
  Buffer<cl_uint> out(device, 2 * layouts.size());
  cl::Kernel kernel(device.program("core/layout_probe_kernels.cl", {}), "probeLayout");
  setArguments(kernel, out.get());
  device.launch(kernel, 1, 1);
  const auto values = out.read();
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    layouts[i].size = values[2 * i];
    layouts[i].offset = values[2 * i + 1];
  }
  return layouts;
}

}  // namespace prelight
