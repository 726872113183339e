#pragma once

#include <map>
#include <string>
#include <utility>

#include "viewer/gl/program.h"
#include "viewer/programs/shader_variant.h"

namespace prelight {
struct Encoding;
}

namespace prelight::viewer {

/// The programs that a scene's pictures are drawn with, each compiled for what it is needed for when that is
/// first drawn.
class SurfacePrograms {
 public:
  /// `encoding`: of light that is drawn in one; nullptr: none is. It outlives the programs.
  explicit SurfacePrograms(const Encoding* encoding) : encoding_(encoding) {}

  /// The program of surfaces with a fragment shader.
  const gl::Program& of(const std::string& fragmentFile, const ShaderVariant& variant) {
    return of("surface.vert", fragmentFile, variant);
  }

  /// The program of the sky behind the scene.
  const gl::Program& background(const ShaderVariant& variant) {
    return of("fullscreen.vert", "background.frag", variant);
  }

  /// The program that draws the depth of surfaces without holes.
  const gl::Program& depth() { return of("surface.vert", "depth.frag", {}); }

  std::size_t size() const { return programs_.size(); }

 private:
  const gl::Program& of(const std::string& vertexFile, const std::string& fragmentFile,
                        const ShaderVariant& variant);

  const Encoding* encoding_;
  std::map<std::pair<std::string, ShaderVariant>, gl::Program> programs_;  ///< by fragment file
};

}  // namespace prelight::viewer
