#include "techniques/occlusion_cones/occlusion_cones_projector.h"

#include "base/parallel.h"
#include "prelight/error.h"
#include "techniques/occlusion_cones/cone_aperture.h"

namespace prelight {

namespace {

constexpr std::size_t grain = 4096;  // vertices that a thread takes at once

class OcclusionConesProjector final : public Projector {
 public:
  explicit OcclusionConesProjector(const BakeContext& context) : context_(context) {
    if (!context.request.ao)
      throw UsageError("occlusion cones", "they are computed from ambient occlusion, which is not asked for",
                       "ask for ambient occlusion, too");
  }

  std::string_view stage() const override { return "cones"; }

  void run(ReceiverCast* /*cast*/, Bake& bake, Progress& /*progress*/) override {
    bake.apertures.resize(bake.ao.size());
    parallelRanges(bake.ao.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(context_.scene.normals[v]));
        const double cosine = glm::dot(normal, glm::dvec3(bake.bentNormals[v]));
        bake.apertures[v] = static_cast<float>(coneAperture(bake.ao[v], cosine));
      }
    });
  }

 private:
  const BakeContext& context_;
};

}  // namespace

std::unique_ptr<Projector> occlusionConesProjector(const BakeContext& context) {
  if (!context.request.cones) return nullptr;
  return std::make_unique<OcclusionConesProjector>(context);
}

}  // namespace prelight
