#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "basis/ch.h"
#include "prelight/bake.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/series/transfer_pass.h"

namespace prelight::viewer {

/// B_lk of every |m|, [m][l][k]: what a function of SH is in moments of CH.
std::vector<float> chBasisTable(const ch::Basis& basis);

/// Stored transfer as buffer textures: rows of `count` numbers, [vertex][channel], each row padded with zeros
/// to whole texels of four.
struct TransferRows {
  gl::BufferTexture texels;
  int count = 0;
  int channels = 1;

  /// Floats (RGBA32F), halves (RGBA16F) or bytes (RGBA8).
  template <typename T>
  static TransferRows upload(std::span<const T> values, int count, int channels, const char* what);

  /// Replaces the rows of vertices from `firstVertex` on, where they are floats.
  void replace(std::size_t firstVertex, std::span<const float> values) const;
};

/// Transfer in SH or CH, of any order, in floats, halves or bytes with a range a band; a vertex shader sums
/// the products, once a light, and decodes what is compressed.
///
/// Lights are evaluated at every vertex, by the irradiance of an open surface with its normal and the share
/// that the transfer leaves of it (basis/lights/lamp_through_transfer.h), as large as they are. In CH, lights are
/// moments and the transfer is as it is stored: coefficients, or moments as well when it was baked naively,
/// which shows the error of that.
class HarmonicSeries : public DrawnTransfer {
 public:
  enum class Basis { Sh, Ch };

  /// The scene outlives it. `result`: Radiance, or Through for that of surfaces' other sides.
  HarmonicSeries(const HarmonicTransfer& transfer, Basis basis, const CompiledScene& scene,
                 Attribute result = Attribute::Radiance);
  /// Half or Band8.
  HarmonicSeries(const CompressedTransfer& transfer, const CompiledScene& scene);

  void light(const Illumination& light) override;
  bool verticesMoved() override { return pass_.verticesMoved(); }
  bool takeBake(const Bake& bake) override;
  bool replaceRows(std::size_t firstVertex, std::span<const float> rows) override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

 private:
  void upload(const HarmonicTransfer& transfer);
  std::vector<glm::dvec3> inBasis(std::vector<glm::dvec3> sky) const;
  std::vector<glm::vec4> lightTexels(const Illumination& light) const;

  int order_ = 0;
  bool naive_ = false;
  std::optional<ch::Basis> ch_;
  TransferRows rows_;
  gl::BufferTexture light_;
  std::optional<gl::BufferTexture> ranges_;   ///< [band][offset, scale] RGB, of bytes
  std::optional<gl::BufferTexture> chBasis_;  ///< [m][l][k], see techniques/sh/transfer.glsl
  std::optional<VertexStream> accessibility_;
  bool ofFronts_ = true;
  TransferPass pass_;
};

/// Transfer of light groups: the numbers are groups, the light is their colours.
class GroupSeries : public DrawnTransfer {
 public:
  /// `glow`: [vertex], the group that a vertex's emission belongs to; -1: none.
  /// The scene outlives it.
  GroupSeries(const LightGroupTransfer& transfer, std::vector<int> glow, const CompiledScene& scene);

  void light(const Illumination& light) override;
  bool replaceRows(std::size_t firstVertex, std::span<const float> rows) override {
    rows_.replace(firstVertex, rows);
    return true;
  }
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

 private:
  std::vector<LightGroup> groups_;
  TransferRows rows_;
  gl::BufferTexture light_;
  std::vector<int> groupOfGlow_;
  std::vector<glm::vec3> glow_;
  VertexStream glowStream_;
  TransferPass pass_;
};

/// The group that each vertex's emission belongs to: that of the node's name, as bakes name groups of single
/// lights; -1 where no group has it. [vertex]
std::vector<int> glowGroups(const LightGroupTransfer& transfer, const CompiledScene& scene);

}  // namespace prelight::viewer
