#include "gpu/tracer.h"

#include <algorithm>
#include <cmath>

#include "bvh/builder.h"
#include "bvh/layouts.h"
#include "scene/compile/compile_parts.h"
#include "scene/compile/device_wrap.h"

namespace prelight {

namespace {

using device::DeviceMaterial;
using device::DeviceTriangle;
using device::Hit;
using device::Ray;

constexpr std::size_t groupSize = 64;                        // of the narrow tree: a ray a work-item
constexpr std::size_t raysPerLaunch = std::size_t{1} << 20;  // keeps a launch well below a second on a CPU

/// Few sizes, so that few variants of the kernels are built.
std::uint32_t stackBucket(std::uint32_t needed) {
  std::uint32_t size = 64;
  while (size < needed) size *= 2;
  return size;
}

template <typename T>
cl::Buffer upload(DeviceContext& device, const std::vector<T>& data) {
  const std::size_t bytes = std::max<std::size_t>(1, data.size()) * sizeof(T);
  cl::Buffer buffer = device.allocate(bytes, CL_MEM_READ_ONLY);
  if (!data.empty())
    device.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, data.size() * sizeof(T), data.data());
  return buffer;
}

glm::u16vec4 linearTexel(const std::uint8_t* srgb) {
  const glm::vec3 linear(linearFromSrgb(srgb[0]), linearFromSrgb(srgb[1]), linearFromSrgb(srgb[2]));
  return {glm::u16vec3(glm::round(65535.0f * linear)), static_cast<std::uint16_t>(257 * srgb[3])};
}

DeviceMaterial deviceMaterial(const CompiledMaterial& m, const std::vector<Image>& images,
                              const std::vector<std::uint32_t>& offsets) {
  DeviceMaterial d{};
  for (int c = 0; c < 3; ++c) d.albedo[c] = m.albedo[c];
  d.alphaCutoff = m.alphaCutoff;
  d.alphaFactor = m.alphaFactor;
  for (int c = 0; c < 3; ++c)
    d.transmission |=
        static_cast<std::uint32_t>(std::lround(1023.0f * std::clamp(m.diffuseTransmission[c], 0.0f, 1.0f)))
        << (10 * c);
  d.texelOffset = PRELIGHT_NO_TEXTURE;
  d.wrapS = deviceWrap(m.wrapS);
  d.wrapT = deviceWrap(m.wrapT);
  if (m.albedoImage >= 0) {
    const auto image = static_cast<std::size_t>(m.albedoImage);
    d.texelOffset = offsets[image];
    d.width = static_cast<std::uint32_t>(images[image].width);
    d.height = static_cast<std::uint32_t>(images[image].height);
  }
  return d;
}

}  // namespace

Tracer::Tracer(const CompiledScene& scene, const Device& device, BvhLayout layout, BuildQuality quality)
    : context_(&device.context()),
      layout_(layout != BvhLayout::Automatic          ? layout
              : device.info().kind == DeviceKind::Cpu ? BvhLayout::Wide
                                                      : BvhLayout::Narrow),
      alphaTest_(scene.hasAlphaMask()),
      vertexColors_(scene.hasVertexColors()) {
  uploadTree(scene, quality);
  uploadSurface(scene);
}

Tracer::Tracer(const Tracer& whole, const CompiledScene& scene, std::span<const std::uint32_t> triangles,
               BuildQuality quality)
    : context_(whole.context_),
      layout_(whole.layout_),
      alphaTest_(whole.alphaTest_),
      vertexColors_(whole.vertexColors_),
      treeless_(triangles.empty()),
      surfaceTriangles_(whole.surfaceTriangles_),
      materials_(whole.materials_),
      texCoords_(whole.texCoords_),
      colors_(whole.colors_),
      texels_(whole.texels_) {
  if (!treeless_) uploadTree(scene, quality, triangles);
}

void Tracer::separate(const CompiledScene& scene, std::span<const std::uint32_t> moving) {
  std::vector<std::uint8_t> moves(scene.triangleCount(), 0);
  for (const std::uint32_t t : moving) moves[t] = 1;
  std::vector<std::uint32_t> still;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (moves[t] == 0) still.push_back(t);
  treeless_ = still.empty();
  if (!treeless_) uploadTree(scene, BuildQuality::Balanced, still);
  closest_ = any_ = {};  // the stack may have another size
  separated_.reset();
  if (moving.empty()) return;
  separatedTriangles_.assign(moving.begin(), moving.end());
  separated_ = std::make_unique<Tracer>(*this, scene, moving, BuildQuality::Balanced);
  keepNearer_ = cl::Kernel(context_->program("bvh/nearer_kernels.cl", {}), "keepNearer");
}

void Tracer::follow(const CompiledScene& scene) {
  if (!separated_) return;
  const std::uint32_t before = stackBucket(separated_->stackSize_);
  separated_->uploadTree(scene, BuildQuality::Balanced, separatedTriangles_);
  if (stackBucket(separated_->stackSize_) != before) separated_->closest_ = separated_->any_ = {};
}

std::vector<Hit> Tracer::traceSeparated(std::span<const Ray> rays) {
  if (separated_) return separated_->traceClosest(rays);
  return std::vector<Hit>(rays.size(), Hit{0.0f, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f});
}

cl::Kernel& Tracer::kernel(Query query) {
  cl::Kernel& kernel = query == Query::Any ? any_ : closest_;
  if (kernel() == nullptr) {
    const bool wide = layout_ == BvhLayout::Wide;
    const BuildOptions options =
        surfaceOptions()
            .defineIf(query == Query::Any, "PRELIGHT_ANY_HIT")
            .define("PRELIGHT_STACK_SIZE", static_cast<int>(stackBucket(stackSize_)));
    kernel = cl::Kernel(context_->program(wide ? "bvh/wide_kernels.cl" : "bvh/narrow_kernels.cl", options),
                        "traceRays");
  }
  return kernel;
}

BuildOptions Tracer::surfaceOptions() const {
  return BuildOptions()
      .defineIf(alphaTest_, "PRELIGHT_ALPHA_TEST")
      .defineIf(vertexColors_, "PRELIGHT_VERTEX_COLORS");
}

void Tracer::uploadTree(const CompiledScene& scene, BuildQuality quality,
                        std::span<const std::uint32_t> triangles) {
  const BvhTarget target = layout_ == BvhLayout::Wide ? BvhTarget::Wide : BvhTarget::Narrow;
  const BinaryBvh tree = buildBvh(scene, {.quality = quality, .target = target, .triangles = triangles});
  const auto keep = [this](const auto& bvh, const auto& leaves) {
    nodes_ = upload(*context_, bvh.nodes);
    triangles_ = upload(*context_, leaves);
    nodeBytes_ = bvh.nodes.size() * sizeof(bvh.nodes[0]);
    triangleBytes_ = leaves.size() * sizeof(leaves[0]);
    stackSize_ = bvh.stackSize;
  };
  if (layout_ == BvhLayout::Wide) {
    const WideBvh wide = makeWideBvh(tree, scene);
    keep(wide, wide.blocks);
  } else {
    const NarrowBvh narrow = makeNarrowBvh(tree, scene);
    keep(narrow, narrow.triangles);
  }
}

void Tracer::uploadSurface(const CompiledScene& scene) {
  std::vector<DeviceTriangle> triangles(scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    triangles[t] = {{scene.triangles[t].x, scene.triangles[t].y, scene.triangles[t].z},
                    scene.triangleMaterials[t]};
  surfaceTriangles_ = Buffer<DeviceTriangle>(*context_, triangles);

  std::vector<glm::u16vec4> texels;
  std::vector<std::uint32_t> offsets;
  for (const Image& image : scene.albedoImages) {
    offsets.push_back(static_cast<std::uint32_t>(texels.size()));
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) texels.push_back(linearTexel(&image.rgba[i]));
  }
  std::vector<DeviceMaterial> materials;
  for (const auto& material : scene.materials)
    materials.push_back(deviceMaterial(material, scene.albedoImages, offsets));
  materials_ = Buffer<DeviceMaterial>(*context_, materials);
  texels_ = Buffer<glm::u16vec4>(*context_, texels);
  texCoords_ = Buffer<glm::vec2>(*context_, texels.empty() ? std::vector<glm::vec2>() : scene.texCoords);
  colors_ = Buffer<glm::vec4>(*context_, scene.colors);
}

void Tracer::setSurfaceArguments(cl::Kernel& kernel, cl_uint index) const {
  kernel.setArg(index, surfaceTriangles_.get());
  kernel.setArg(index + 1, materials_.get());
  kernel.setArg(index + 2, texCoords_.get());
  kernel.setArg(index + 3, colors_.get());
  kernel.setArg(index + 4, texels_.get());
}

void Tracer::trace(Query query, const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count) {
  traceTree(query, rays, hits, count);
  if (!separated_ || count == 0) return;
  if (separatedHits_.size() < count) separatedHits_ = Buffer<Hit>(*context_, count);
  separated_->traceTree(query, rays, separatedHits_, count);
  setArguments(keepNearer_, static_cast<cl_uint>(count), separatedHits_.get(), hits.get());
  context_->launch(keepNearer_, count, groupSize);
}

void Tracer::traceTree(Query query, const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count) {
  if (treeless_) return hits.fill({0.0f, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f});
  cl::Kernel& kernel = this->kernel(query);
  kernel.setArg(0, nodes_);
  kernel.setArg(1, triangles_);
  setSurfaceArguments(kernel, 2);
  kernel.setArg(7, rays.get());
  kernel.setArg(8, hits.get());
  kernel.setArg(9, static_cast<cl_uint>(count));
  if (layout_ == BvhLayout::Wide)
    context_->launch(kernel, (count + PRELIGHT_BATCH - 1) / PRELIGHT_BATCH, 1);
  else
    context_->launch(kernel, count, groupSize);
}

void Tracer::traceClosest(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count) {
  trace(Query::Closest, rays, hits, count);
}

void Tracer::traceAny(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count) {
  trace(Query::Any, rays, hits, count);
}

std::vector<Hit> Tracer::traceFromHost(Query query, std::span<const Ray> rays) {
  std::vector<Hit> all(rays.size());
  const std::size_t block = std::min(rays.size(), raysPerLaunch);
  Buffer<Ray> rayBuffer(*context_, block);
  Buffer<Hit> hitBuffer(*context_, block);
  for (std::size_t first = 0; first < rays.size(); first += block) {
    const std::size_t count = std::min(block, rays.size() - first);
    rayBuffer.write(rays.subspan(first, count));
    trace(query, rayBuffer, hitBuffer, count);
    hitBuffer.read(std::span(all).subspan(first, count));
  }
  return all;
}

std::vector<Hit> Tracer::traceClosest(std::span<const Ray> rays) {
  return traceFromHost(Query::Closest, rays);
}
std::vector<Hit> Tracer::traceAny(std::span<const Ray> rays) { return traceFromHost(Query::Any, rays); }

}  // namespace prelight
