#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/cube_map.h"
#include "cast/side_sums.h"
#include "prelight/compiled_scene.h"
#include "techniques/haar/texel_column.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Sums over rays in a texel or a square of texels.
struct RaySums {
  float weight = 0.0f;
  float square = 0.0f;  ///< of weights: their effective number, and above 0 if there is any ray
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
  /// The side, which has rows of the column, must outlive this.
  TexelTransfer(const CompiledScene& scene, const FitMesh& mesh, const SideSums& side,
                const TexelColumn& column);

  /// Rays of a receiver.
  struct WeightedRow {
    std::uint32_t row;  ///< of TexelRows
    float weight;       ///< of all its rays
  };

  /// Memory that evaluate() works in, one a thread.
  struct Workspace {
    /// Pyramids: [level], finest first, [face][row][column]. Of rays that met the open, and of those that met
    /// a surface; one that is blocked in part counts for both.
    std::array<std::vector<RaySums>, 2> sums;
    std::vector<float> open;        ///< the same, of the closed form
    std::vector<WeightedRow> rows;  ///< around the slot
  };
  Workspace workspace() const;

  /// Fills `texels`, 6 faceSize^2. False where no ray tells anything: `texels` are then the closed form.
  bool evaluate(std::uint32_t slot, Workspace& work, std::span<float> texels) const;

 private:
  struct PlainWeights {
    double open = 0.0;    ///< weight of receivers that saw nothing but sky
    double closed = 0.0;  ///< of those that saw none of it
  };

  /// A receiver of the side.
  struct Receiver {
    std::array<float, 3> weights;  ///< what it weighs in the fit, times the barycentric weights of corners
    std::uint32_t row;             ///< of TexelRows, or what it says in place of one
  };

  bool weighReceivers(std::uint32_t slot, Workspace& work, PlainWeights& plain) const;
  void addRays(Workspace& work) const;
  static void addRow(std::span<const std::uint32_t> codes, float share, Workspace& work);
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
  const TexelRows& texelRows_;
  CubeTexels texels_;
  int faceSize_;
  std::uint32_t farStep_ = 1;
  int levels_;                           ///< 1 + log2 of the face size
  std::vector<std::size_t> levelStart_;  ///< [level + 1], into the pyramid
  NormalEquations equations_;
  std::vector<std::uint32_t> receiverStart_;  ///< [triangle + 1], into receivers_
  std::vector<Receiver> receivers_;           ///< by triangle
  std::vector<std::uint32_t> triangleStart_;  ///< [slot + 1], into slotTriangles_
  std::vector<std::uint32_t> slotTriangles_;  ///< triangles around every slot
};

}  // namespace prelight
