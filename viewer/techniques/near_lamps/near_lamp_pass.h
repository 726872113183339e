#pragma once

#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"
#include "viewer/gl/capture.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/lights/lighting.h"
#include "viewer/programs/technique_pass.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

/// Shadows of lamps within the scene, from shells of distance: how much of a lamp's light arrives at each
/// vertex (host/techniques/near_lamps/lamp_shells.h), by a vertex shader whose results pictures read until a
/// lamp moves.
class NearLampPass final : public TechniquePass {
 public:
  static constexpr int lampsAStream = 4;  ///< the components of an attribute
  static constexpr int mostLamps = lampsAStream * int{lampVisibilityStreams};
  static constexpr int placesOfAnArea =
      8;  ///< that stand for an area light; techniques/near_lamps/near_lamps.vert

  /// The scene outlives it.
  NearLampPass(const NearLampTransfer& transfer, const CompiledScene& scene);

  /// Gives shadows to lamps that do not come through the transfer, where there are too many to those that
  /// send the most light to the scene. What they leave, up to a stream, is for samples of emissive surfaces:
  /// neighbours share one. Samples that lie far apart for the surface that they stand for have none.
  static void choose(std::span<ShadedLight> lights, const CompiledScene& scene);

  /// Gives other samples of the same surfaces the shadows of the nearest that were chosen.
  static void share(std::span<const ShadedLight> chosen, std::span<ShadedLight> samples);

  void shadow(const View&, std::vector<ShadedLight>& lights) override;
  void shadowSamples(std::span<const ShadedLight> lights, std::span<ShadedLight> samples) const override {
    share(lights, samples);
  }
  void sceneMoved() override { isStale_ = true; }
  void takeBake(const Bake& bake) override;
  void bind(const gl::Program& program) const override;

 private:
  /// Where the light of lamps leaves that share a shadow.
  struct Place {
    glm::vec4 position{0.0f};  ///< w: sides that it leaves to; 0: all around
    glm::vec3 normal{0.0f};

    bool operator==(const Place&) const = default;
  };
  using Shadows = std::vector<std::vector<Place>>;  ///< [shadow]

  static Shadows placesOf(std::span<const ShadedLight> lights);
  /// Makes the shadows of the lights that were chosen ready.
  void run(std::span<const ShadedLight> lights);
  void setUp();
  void setPlaces(std::span<const std::vector<Place>> shadows);

  const CompiledScene& scene_;
  int order_, shells_;
  double nearest_, farthest_;
  gl::Program program_;
  gl::Capture capture_;
  gl::VertexArray vertexArray_;
  gl::BufferTexture texels_;  ///< [vertex][shell][number / 4]
  VertexStream positions_, normals_;
  std::vector<VertexStream> visibility_;  ///< of four lamps each
  Shadows shadows_;                       ///< that those are of
  bool isStale_ = true;
};

}  // namespace prelight::viewer
