#include "techniques/radiosity/radiosity_projector.h"

#include <optional>

#include "radiosity/radiosity_bake.h"

namespace prelight {

namespace {

class RadiosityProjector final : public Projector {
 public:
  explicit RadiosityProjector(const BakeContext& context) : context_(context) {
    if (context.plan.runs(Pass::Radiosity))
      radiosity_.emplace(context.scene, context.request, context.tracer);
  }

  std::string_view stage() const override { return {}; }

  /// Without light that the plan could solve for, all is dark.
  void run(ReceiverCast* /*cast*/, Bake& bake, Progress& progress) override {
    if (radiosity_)
      bake.irradiance = radiosity_->run(context_.mesh, progress, context_.report);
    else
      bake.irradiance.emplace(context_.scene.vertexCount(), glm::vec3(0.0f));
  }

 private:
  const BakeContext& context_;
  std::optional<RadiosityBake> radiosity_;
};

}  // namespace

std::unique_ptr<Projector> radiosityProjector(const BakeContext& context) {
  if (!context.request.radiosity) return nullptr;
  return std::make_unique<RadiosityProjector>(context);
}

}  // namespace prelight
