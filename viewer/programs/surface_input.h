#pragma once

namespace prelight::viewer {

namespace gl {
class Program;
}
struct Batch;

/// Textures, uniforms and vertex attributes that surfaces are drawn with besides those of their materials.
class SurfaceInput {
 public:
  virtual ~SurfaceInput() = default;

  /// Called whenever another program is used: binds textures, sets the uniforms of the program in use and
  /// attaches attributes to the vertex array in use.
  virtual void bind(const gl::Program&) const {}

  /// Called for every batch: sets the uniforms of the program in use that differ between batches.
  virtual void set(const gl::Program&, const Batch&) const {}
};

}  // namespace prelight::viewer
