#include "pictures/volume_objects.h"

#include <fmt/format.h>

#include <algorithm>

#include "pictures/session/lost_techniques.h"
#include "scene/append_object.h"
#include "scene/builtin/mesh_shapes.h"

namespace prelight::pictures {

namespace {

constexpr std::uint64_t ownRays = 512;
constexpr int ownBounces = 2;         ///< within an object, if the scene has bounces
constexpr double probeRadius = 0.15;  ///< as a part of a cell's side
constexpr float probeAlbedo = 0.8f;
constexpr int probeSegments = 10, probeRings = 6;

/// Takes the volume out of a bake. Returns none if cube maps light the objects.
std::optional<VolumeTransfer> takeVolume(const ObjectOptions& options, const LoadedScene& loaded,
                                         Bake& bake) {
  const bool wanted = options.lighting == ObjectLighting::Volume || options.probes;
  if (options.lighting == ObjectLighting::Cube && options.probes)
    throw UsageError("ObjectOptions::probes ObjectOptions::lighting cube", "probes show what a volume holds",
                     "leave one of the two out");
  if (options.lighting == ObjectLighting::Cube) bake.volume.reset();
  if (!bake.volume && !wanted) return std::nullopt;
  if (!bake.volume)
    throw InputError(loaded.path.string(),
                     "it holds no volume that could light objects or be shown as probes",
                     "bake it with VolumeRequest::size 32 ShRequest::order 4 BakeRequest::bounces 4, and "
                     "BakeRequest::lightGroups for its own lights, or have cube maps light objects by "
                     "ObjectOptions::lighting cube");
  VolumeTransfer volume = std::move(*bake.volume);
  bake.volume.reset();
  return volume;
}

/// Returns the vertices and triangles of a node.
VertexRange rangeOf(const CompiledScene& scene, int node) {
  VertexRange range;
  bool begun = false;
  for (const PrimitiveRange& p : scene.primitives) {
    if (p.node != node) continue;
    if (!begun) range = {p.firstVertex, 0, p.firstTriangle, 0};
    begun = true;
    range.vertexCount += p.vertexCount;
    range.triangleCount += p.triangleCount;
  }
  return range;
}

std::vector<float> inThreeChannels(const std::vector<float>& values, std::size_t width) {
  std::vector<float> wide;
  for (std::size_t row = 0; row < values.size(); row += width)
    for (int c = 0; c < 3; ++c)
      wide.insert(wide.end(), values.begin() + static_cast<std::ptrdiff_t>(row),
                  values.begin() + static_cast<std::ptrdiff_t>(row + width));
  return wide;
}

/// Makes room for more vertices behind the baked ones.
template <typename Transfer>
void grow(Transfer& transfer, std::size_t width, std::size_t vertices) {
  if (transfer.channels == 1) transfer.coefficients = inThreeChannels(transfer.coefficients, width);
  transfer.channels = 3;
  transfer.coefficients.resize(vertices * 3 * width, 0.0f);
}

/// Returns the techniques of a bake that objects can have, too, with room for the objects' vertices.
Bake keptOf(DrawingSession& session, Bake&& bake, std::size_t baked, std::size_t vertices) {
  Bake kept;
  kept.info = bake.info;
  kept.sh = bake.sh;
  kept.lightGroups = bake.lightGroups;
  const std::string lost = lostTechniques(techniqueKeys(bake, baked), kept, baked);
  if (!lost.empty()) session.note(fmt::format("not shown, because objects and probes have none: {}", lost));
  if (kept.sh) grow(*kept.sh, static_cast<std::size_t>(kept.sh->order * kept.sh->order), vertices);
  if (kept.lightGroups) grow(*kept.lightGroups, kept.lightGroups->groups.size(), vertices);
  return kept;
}

/// Returns the indirect part of transfer in three channels, given its direct part in one channel.
std::vector<float> bouncesOf(const HarmonicTransfer& all, const HarmonicTransfer& direct) {
  std::vector<float> bounced = all.coefficients;
  const auto columns = static_cast<std::size_t>(all.order * all.order);
  for (std::size_t i = 0; i < bounced.size(); ++i)
    bounced[i] -= direct.coefficients[i / (3 * columns) * columns + i % columns];
  return bounced;
}

/// Returns the SH transfer of a scene's vertices without bounces, [vertex][i], from the bake or from an
/// additional one.
std::vector<float> directTransfer(DrawingSession& session, const LoadedScene& loaded,
                                  const HarmonicTransfer& sh, const DeviceOptions& device) {
  if (sh.bounces == 0 && sh.channels == 1) return sh.coefficients;
  BakeRequest request = BakeRequest().withoutTechniques();
  request.sh.order = sh.order;
  request.effort.rays = ownRays;
  return session.bake(loaded, request, device).bake.sh->coefficients;
}

/// Appends how open vertices are to an even light: their own transfer divided by that of an open vertex.
void addOpenness(const HarmonicTransfer& own, std::vector<glm::vec3>& openness) {
  constexpr float open = 0.28209479f;  // Y_00
  const auto columns = static_cast<std::size_t>(own.order * own.order);
  const auto channels = static_cast<std::size_t>(own.channels);
  for (std::size_t row = 0; row < own.coefficients.size(); row += channels * columns) {
    glm::vec3& value = openness.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      value[static_cast<int>(c)] = own.coefficients[row + (channels == 3 ? c : 0) * columns] / open;
  }
}

Primitive ballsIn(const VolumeGrid& grid, const std::vector<std::size_t>& voxels) {
  const auto radius = static_cast<float>(probeRadius * grid.cell());
  const MeshShape ball = makeSphere(radius, probeSegments, probeRings);
  MeshShape all;
  for (const std::size_t voxel : voxels) {
    MeshShape one = ball;
    const glm::vec3 foot(voxelCentre(grid, voxel) - glm::dvec3(0.0, radius, 0.0));
    for (glm::vec3& p : one.positions) p += foot;
    all.add(one);
  }
  Primitive primitive;
  primitive.positions = std::move(all.positions);
  primitive.normals = std::move(all.normals);
  primitive.triangles = std::move(all.triangles);
  primitive.material = 0;
  return primitive;
}

Material probeMaterial() {
  Material white;
  white.name = "Probes";
  white.baseColor = glm::vec4(glm::vec3(probeAlbedo), 1.0f);
  white.metallic = 0.0f;
  white.specular = 0.0f;
  return white;
}

}  // namespace

VolumeObjects::VolumeObjects(DrawingSession& session, const ObjectOptions& options,
                             const std::vector<LightGroupRequest>& named, const DeviceOptions& device,
                             LoadedScene& loaded, Bake& bake)
    : volume_(takeVolume(options, loaded, bake)),
      asked_(options.lighting),
      device_(session.openDevice(device)) {
  baked_ = {0, loaded.compiled.vertexCount(), 0, loaded.compiled.triangleCount()};
  const std::size_t ownMaterials = loaded.scene.materials.size();
  std::vector<float> direct;
  if (!bake.sh && bake.compressedSh) bake.sh = decompress(*bake.compressedSh);
  if (options.shadows == ObjectShadows::Neighbourhood && !options.objects.empty() && bake.sh)
    direct = directTransfer(session, loaded, *bake.sh, device);
  const std::vector<AddedObject> added = addObjects(session, options.objects, loaded.scene);
  if (options.probes) addProbes(loaded.scene);
  Warnings said;  // by the scene without them already
  loaded.compiled = compileScene(loaded.scene, said);
  if (probes_) probeRange_ = rangeOf(loaded.compiled, probes_->node);
  const SceneParts parts{baked_.triangleCount, loaded.compiled.triangleCount() - probeRange_.triangleCount};
  const bool hasNeighbourhoods = options.shadows == ObjectShadows::Neighbourhood;
  bakeOwn(session, added, loaded.compiled,
          volume_             ? VolumeReceiver::ownOrder(*volume_)
          : hasNeighbourhoods ? Neighbourhood::mostOrder
                              : ownLampOrder,
          device);
  if ((!volume_ || volume_->groups() > 0) && bake.lightGroups)
    groupLamps(loaded.compiled, ownMaterials, named, bake);
  bake = keptOf(session, std::move(bake), baked_.vertexCount, loaded.compiled.vertexCount());
  if (bake.lightGroups && !lamps_) bake.lightGroups.reset();
  const GroupedLights* lamps = lamps_ ? &*lamps_ : nullptr;
  if (volume_) {
    auto light = std::make_unique<ObjectLight>(loaded.compiled, parts, *volume_, lamps, *device_);
    light_ = light.get();
    among_ = std::move(light);
  } else {
    among_ = std::make_unique<ObjectScene>(loaded.compiled, parts, lamps, *device_);
  }
  makeShadows(options.shadows, loaded.compiled, std::move(direct));
  if (!objects_.empty() && (bake.sh || bake.lightGroups))
    shadowed_ = std::make_unique<ShadowedTransfer>(loaded.compiled, baked_, bake, *among_);
  lightObjects(loaded.compiled, bake);
  if (probes_) store(probeRange_, light_->transferOfProbes(loaded.compiled, probeRange_, probeVoxels_), bake);
}

void VolumeObjects::makeShadows(ObjectShadows shadows, const CompiledScene& scene,
                                std::vector<float> direct) {
  std::vector<VertexRange> ranges;
  for (const VolumeObject& object : objects_) ranges.push_back(object.range);
  if (shadows == ObjectShadows::Occluders || (shadows == ObjectShadows::Neighbourhood && direct.empty()))
    among_->shadeByOccluders(scene, ranges);
  else if (shadows == ObjectShadows::Neighbourhood)
    among_->shadeByNeighbourhoods(scene, objects_, std::move(direct));
}

void VolumeObjects::addProbes(Scene& scene) {
  for (std::size_t v = 0; v < volume_->grid.count(); ++v)
    if (volume_->air[v] != 0) probeVoxels_.push_back(v);
  Scene balls;
  balls.meshes.push_back({"Probes", {ballsIn(volume_->grid, probeVoxels_)}});
  balls.materials.push_back(probeMaterial());
  balls.nodes.emplace_back();
  MeshNode node;
  node.transforms.emplace_back(1.0);
  balls.meshNodes.push_back(node);
  const auto material = static_cast<std::uint32_t>(scene.materials.size());
  probes_ = viewer::DrawnProbes{appendObject(scene, balls, "Probes", glm::dmat4(1.0)), material};
}

/// Bakes how the objects transfer light that arrives from far away.
void VolumeObjects::bakeOwn(DrawingSession& session, const std::vector<AddedObject>& added,
                            const CompiledScene& scene, int order, const DeviceOptions& device) {
  for (const AddedObject& object : added) {
    if (firstNode_ < 0) firstNode_ = object.node;
    const VertexRange range = rangeOf(scene, object.node);
    if (!volume_) cubeLit_.push_back(range);
    BakeRequest request = BakeRequest().withoutTechniques();
    request.sh.order = order;
    request.bounces = !volume_ || volume_->bounces > 0 ? ownBounces : 0;
    request.effort.rays = ownRays;
    BakeRun run = session.bake(object.alone, request, device);
    VolumeObject& one = objects_.emplace_back(VolumeObject{range, std::move(*run.bake.sh)});
    if (!volume_) addOpenness(one.own, cubeOpenness_);
    if (request.bounces == 0) continue;
    request.bounces = 0;
    one.bounced = bouncesOf(one.own, *session.bake(object.alone, request, device).bake.sh);
  }
}

/// Groups the lamps that were baked; the emission of objects lights nothing.
void VolumeObjects::groupLamps(const CompiledScene& scene, std::size_t ownMaterials,
                               const std::vector<LightGroupRequest>& named, const Bake& bake) {
  CompiledScene lit = scene;
  for (CompiledMaterial& material : lit.materials)
    if (material.source >= static_cast<int>(ownMaterials)) material.emission = glm::vec3(0.0f);
  GroupedLights lamps = groupLights(lit, named);
  const std::vector<LightGroup>& groups = bake.lightGroups->groups;
  const bool same = (!volume_ || groups.size() == volume_->groups()) &&
                    std::equal(groups.begin(), groups.end(), lamps.groups.begin(), lamps.groups.end(),
                               [](const LightGroup& a, const LightGroup& b) { return a.name == b.name; });
  if (!same)
    throw InputError("light groups", "the scene's lights do not make the groups that it was baked with",
                     "give the same LightGroupRequest::name as for the bake, or bake the scene again");
  lamps_ = std::move(lamps);
}

void VolumeObjects::store(const VertexRange& range, const ObjectTransfer& transfer, Bake& bake) const {
  if (bake.sh && volume_) {
    const std::size_t to = static_cast<std::size_t>(bake.sh->order * bake.sh->order),
                      from = volume_->columns();
    for (std::size_t row = 0; row < std::size_t{range.vertexCount} * 3; ++row)
      std::copy_n(transfer.sh.begin() + static_cast<std::ptrdiff_t>(row * from), std::min(from, to),
                  bake.sh->coefficients.begin() +
                      static_cast<std::ptrdiff_t>((std::size_t{range.firstVertex} * 3 + row) * to));
  }
  if (bake.lightGroups)
    std::copy(transfer.lights.begin(), transfer.lights.end(),
              bake.lightGroups->coefficients.begin() +
                  static_cast<std::ptrdiff_t>(std::size_t{range.firstVertex} * 3 *
                                              bake.lightGroups->groups.size()));
}

ObjectTransfer VolumeObjects::transferOf(const CompiledScene& scene, const VolumeObject& object) {
  if (light_ != nullptr) return light_->transferOf(scene, object);
  ObjectTransfer transfer{{}, among_->lampsOn(scene, object.range, true)};
  among_->addOwnBounces(scene, object, transfer.lights);
  return transfer;
}

PlannedPass VolumeObjects::plan() const {
  const std::string objects = fmt::format("{} object{}", objects_.size(), objects_.size() == 1 ? "" : "s");
  if (volume_)
    return {
        Pass::ObjectCubes, false,
        fmt::format(
            "the bake has a volume, which lights {} (ObjectOptions::lighting cube uses cube maps instead)",
            objects)};
  return {Pass::ObjectCubes, true,
          fmt::format("{}: the lit scene is drawn around {}",
                      asked_ == ObjectLighting::Cube ? "asked for" : "the bake has no volume", objects)};
}

/// Lights the objects, and the scene in their shadows.
void VolumeObjects::lightObjects(const CompiledScene& scene, Bake& bake) {
  std::vector<VertexRange> ranges;
  for (const VolumeObject& object : objects_) {
    store(object.range, transferOf(scene, object), bake);
    ranges.push_back(object.range);
  }
  if (shadowed_) shadowed_->writeTo(scene, ranges, bake);
}

std::vector<VertexRange> VolumeObjects::update(const CompiledScene& scene, Bake& bake) {
  among_->follow(scene);
  lightObjects(scene, bake);
  std::vector<VertexRange> changed{baked_};
  for (const VolumeObject& object : objects_) changed.push_back(object.range);
  return changed;
}

}  // namespace prelight::pictures
