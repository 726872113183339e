#pragma once

#include <memory>

#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {

/// A technique's transfer of fronts, and the same of what arrives on the other side of surfaces that let
/// light through, as attribute Through.
class ThroughLighting : public DrawnTransfer {
 public:
  ThroughLighting(std::unique_ptr<DrawnTransfer> fronts, std::unique_ptr<DrawnTransfer> through);

  void light(const Illumination& light) override;
  bool verticesMoved() override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

 private:
  std::unique_ptr<DrawnTransfer> fronts_, through_;
};

}  // namespace prelight::viewer
