#include "projectors/occlusion_cones/occlusion_cones_projector.h"

#include "base/error.h"
#include "projectors/occlusion_cones/cone_aperture.h"

namespace prelight {

namespace {

class OcclusionConesProjector final : public Projector {
 public:
  explicit OcclusionConesProjector(const BakeContext& context) : context_(context) {
    if (!context.request.ao)
      throw UsageError("occlusion cones", "they are made of ambient occlusion, and none is asked for",
                       "ask for ambient occlusion, too");
  }

  std::string_view stage() const override { return "cones"; }

  void run(ReceiverCast* /*cast*/, Bake& bake, Progress& /*progress*/) override {
    bake.apertures.reserve(bake.ao.size());
    for (std::size_t v = 0; v < bake.ao.size(); ++v) {
      const glm::dvec3 normal = glm::normalize(glm::dvec3(context_.scene.normals[v]));
      const double cosine = glm::dot(normal, glm::dvec3(bake.bentNormals[v]));
      bake.apertures.push_back(static_cast<float>(coneAperture(bake.ao[v], cosine)));
    }
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
