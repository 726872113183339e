#include "techniques/ambient_occlusion/ambient_occlusion_projector.h"

#include <algorithm>
#include <optional>

#include "techniques/ambient_occlusion/bent_normal_column.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

/// [vertex], unit. The mean of directions above the surface is above it too, whatever the fit overshoots.
/// `fitted`: relative to normals, [slot][3].
std::vector<glm::vec3> bentNormals(const std::vector<float>& fitted, const FitMesh& mesh,
                                   const CompiledScene& scene) {
  std::vector<glm::vec3> normals;
  normals.reserve(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::size_t slot = mesh.slotOfVertex[v];
    const glm::dvec3 n = glm::normalize(glm::dvec3(scene.normals[v]));
    glm::dvec3 bent = n + glm::dvec3(fitted[3 * slot], fitted[3 * slot + 1], fitted[3 * slot + 2]);
    bent -= std::min(0.0, glm::dot(bent, n)) * n;
    const double length = glm::length(bent);
    // Where nothing is open there is no mean direction; the normal is as good as any.
    normals.push_back(length > 1e-5 ? glm::vec3(bent / length) : glm::vec3(n));
  }
  return normals;
}

class AmbientOcclusionProjector final : public Projector {
 public:
  explicit AmbientOcclusionProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "fit"; }
  void addColumns(const HemisphereColumn& hemisphere, std::vector<Column*>& columns) override {
    columns.push_back(&bentNormals_.emplace(context_.scene, hemisphere));
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    bake.bentNormals =
        bentNormals(bentNormals_->solve(cast->front(), progress), context_.mesh, context_.scene);
    for (std::uint32_t v = 0; v < context_.scene.vertexCount(); ++v)
      bake.ao.push_back(finiteOr(cast->accessibility()[context_.mesh.slotOfVertex[v]], 1.0f));
  }

 private:
  const BakeContext& context_;
  std::optional<BentNormalColumn> bentNormals_;
};

}  // namespace

std::unique_ptr<Projector> ambientOcclusionProjector(const BakeContext& context) {
  if (!context.request.ao) return nullptr;
  return std::make_unique<AmbientOcclusionProjector>(context);
}

}  // namespace prelight
