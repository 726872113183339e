#pragma once

#include <array>
#include <compare>
#include <glm/glm.hpp>
#include <map>
#include <memory>

#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/screen/occlusion_options.h"

namespace prelight::viewer {

/// A picture for which occlusion is computed, in its samples.
struct OcclusionPicture {
  int width = 0, height = 0;
  int margin = 0;        ///< of what lies around it and may occlude
  glm::ivec2 origin{0};  ///< of its lower left corner in the whole picture, of which it may be a tile
  double radius = 0.0;   ///< m
};

/// How open the surfaces of a picture are, found in the picture itself and a band around it, or among the
/// elements of the scene.
class OcclusionPass {
 public:
  static constexpr int layerCount = 2;
  /// Samples around a picture of which the filter needs the accessibility.
  static constexpr int filterReach = 2;

  OcclusionPass();

  /// What opaque surfaces have to be drawn into by screen_surface.frag, cleared to 0, before draw(): the
  /// picture with its margin. The same objects while the size stays.
  const gl::Framebuffer& layer(int index, const OcclusionPicture& picture);

  static constexpr GLuint disksUnit = 3;   ///< where draw() looks for elements, if they are to occlude
  static constexpr GLuint fieldsUnit = 4;  ///< and the next one: for fields

  /// The Frame block in use is of the picture with its margin.
  void draw(const OcclusionPicture& picture, const ScreenOcclusionOptions& options);

  /// RGBA of every sample: mean open direction (of Gtao, else 0), scene coordinates; accessibility.
  const gl::Texture& openness() const { return targets_->filtered.color(); }

 private:
  /// What is drawn into; pictures of one size.
  struct Targets {
    explicit Targets(const OcclusionPicture& picture);
    std::array<gl::Framebuffer, layerCount> layers;
    gl::Framebuffer found, filtered;
  };

  /// What a program is compiled for.
  struct Variant {
    OcclusionMethod method;
    int layers;
    bool hasThickness;

    auto operator<=>(const Variant&) const = default;
  };

  const gl::Program& programOf(const Variant& variant);
  void setPicture(const gl::Program& program, const OcclusionPicture& picture, int around) const;
  void drawInto(const gl::Framebuffer& target) const;

  std::map<Variant, gl::Program> programs_;  ///< made when first needed
  gl::Program filterProgram_;
  gl::VertexArray noVertices_;
  std::unique_ptr<Targets> targets_;
};

}  // namespace prelight::viewer
