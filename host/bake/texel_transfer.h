#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/fit_mesh.h"
#include "bake/side_cast.h"
#include "basis/cube_map.h"
#include "scene/compiled_scene.h"

namespace prelight {

/// Sums over the rays in a texel or a square of texels.
struct TexelSums {
  float weight = 0.0f;   ///< of all rays
  float blocked = 0.0f;  ///< of the blocked ones
  float shut = 0.0f;     ///< absolute weight of rays that are blocked at least in part
  float clear = 0.0f;    ///< of those that are open at least in part
  float square = 0.0f;   ///< of weights, for their effective number
};

/// Direct transfer of the fit's slots over the texels of a cube map, from the rays that a side's receivers
/// cast: T(texel) = (1/pi) integral of V max(n.w, 0) over it.
///
/// Rays are far fewer than texels. What is estimated is therefore the blocked fraction of the closed form,
/// square by square down a quadtree: a square whose rays all met the same is settled, and one with too few
/// rays takes the fraction of the square around it. Children share out what their parent has, so that coarse
/// sums are as exact as fine ones are sharp. Samples weigh as in the least-squares fit, through local rows of
/// its inverse.
class TexelTransfer {
 public:
  /// The side must outlive this; its rays were coded on a cube map of this face size.
  TexelTransfer(const CompiledScene& scene, const FitMesh& mesh, const SideCast& side, int faceSize);

  /// Memory that evaluate() works in, one a thread.
  struct Workspace {
    std::vector<TexelSums> sums;  ///< pyramid: [level], finest first, [face][row][column]
    std::vector<float> open;      ///< the same, of the closed form
  };
  Workspace workspace() const;

  /// Fills `texels`, 6 faceSize^2. False where no ray tells anything: `texels` are then the closed form.
  bool evaluate(std::uint32_t slot, Workspace& work, std::span<float> texels) const;

 private:
  struct PlainWeights {
    double open = 0.0;    ///< weight of receivers that saw nothing but sky
    double closed = 0.0;  ///< of those that saw none of it
  };

  bool addRays(std::uint32_t slot, Workspace& work, PlainWeights& plain) const;
  void addReceiver(std::size_t record, double weight, Workspace& work, PlainWeights& plain) const;
  void buildPyramid(Workspace& work) const;
  float wholeFraction(const PlainWeights& plain, const Workspace& work) const;
  void descend(int level, std::size_t square, float fraction, const PlainWeights& plain, Workspace& work,
               std::span<float> texels) const;
  void settle(int level, std::size_t square, float fraction, const Workspace& work,
              std::span<float> texels) const;
  bool mixed(int level, std::size_t square, const PlainWeights& plain, const Workspace& work,
             float& fraction) const;

  const CompiledScene& scene_;
  const FitMesh& mesh_;
  const SideCast& side_;
  CubeTexels texels_;
  int faceSize_;
  std::uint32_t farStep_ = 1;
  int levels_;                           ///< 1 + log2 of the face size
  std::vector<std::size_t> levelStart_;  ///< [level + 1], into the pyramid
  NormalEquations equations_;
  std::vector<std::uint32_t> recordStart_;    ///< [triangle + 1], into recordOrder_
  std::vector<std::uint32_t> recordOrder_;    ///< the side's records by triangle
  std::vector<std::uint32_t> triangleStart_;  ///< [slot + 1], into slotTriangles_
  std::vector<std::uint32_t> slotTriangles_;  ///< triangles around every slot
};

}  // namespace prelight
