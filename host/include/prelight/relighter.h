#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "prelight/shading.h"

/// Relighting on an OpenCL device, where transfer stays while lights change. All results are radiance before
/// the albedo of the receiver: its exit radiance is albedo x result, and its irradiance is pi x result.
/// Lights come from far away unless stated otherwise. docs/notes/relighting.md has layouts and speeds.
namespace prelight {

struct LoadedScene;

/// Returns the names of the techniques whose transfer a relighter can multiply:
///
///   animation          SH per vertex, blended between the keys of an animation (Bake::animation) without
///                      turning them with their nodes; spinning parts blur (docs/notes/animation.md)
///   sh, ch             SH per vertex, compressed or not, and CH
///   haar               Haar wavelets per vertex
///   vector_occluders   vector occluders per vertex; needs RelighterOptions::scene
///   texels             SH per texel of charts, [map][row][column] (Bake::chartTransfer)
///   volume             SH per cell, [z][y][x]; the result is the mean radiance over all directions
///   light_groups       the scene's own lights per vertex; also added to sh, ch and haar
std::vector<std::string> relitTechniques();

/// A round light far away with the same radiance everywhere, such as the sun. At vertices with
/// transfer in SH or CH, open receivers get it exactly where RelighterOptions::scene gives their normals.
/// Elsewhere such transfer knows it by its bands alone: an open receiver that faces it gets 0.75 of its
/// irradiance at order 2, 1.06 at orders 3 and 4, 0.97 at 5 and 6; one that it grazes 0.25, 0.09 and 0.06 in
/// place of 0.
struct DistantLight {
  glm::dvec3 towards{0.0, 1.0, 0.0};  ///< direction of its centre, of any length but 0
  glm::dvec3 irradiance{0.0};         ///< W/m2 on a surface that faces it
  /// Radians, 0 to below pi / 2; the sun has 0.00465. Below 1e-6 the light is one direction. Vector occluders
  /// take all lights as points.
  double halfAngle = 0.0;
};

/// Light of a relighter. The parts add up; all but `groups` are turned by `rotation`.
struct RelighterLight {
  const Environment* sky = nullptr;  ///< nullptr: black
  std::vector<DistantLight> lights = {};
  /// SH of further radiance, [channel][i] of any order; bands that the transfer lacks are ignored. Refused by
  /// wavelets and vector occluders.
  std::vector<double> coefficients = {};
  glm::dmat3 rotation{1.0};  ///< f'(w) = f(R^-1 w)
  /// [group of Bake::lightGroups], colours of the scene's own lights; empty: they are off. At vertices at
  /// rest only.
  std::vector<glm::vec3> groups = {};
};

/// Options of a Relighter.
struct RelighterOptions {
  std::string technique = {};  ///< one of relitTechniques(); empty: the preferred one that the bake holds
  /// haar: coefficients that a light keeps, with values fitted to the transfer; 0: all. Some hundreds suffice
  /// (docs/notes/wavelets.md).
  std::size_t wavelets = 0;
  int skyLights = defaultSkyLights;  ///< vector occluders: directional lights that represent a sky
  /// Scene of the bake, read by the constructor. Vector occluders need it; with SH and CH at vertices,
  /// distant lights become exact in the open, and light() reads the transfer once per light.
  const LoadedScene* scene = nullptr;
};

/// Colours in the memory of a device, [receiver][rgb] floats.
class DeviceColors {
 public:
  struct State;
  explicit DeviceColors(std::shared_ptr<State> state);

  std::size_t size() const;  ///< receivers

  /// Copies the colours, [receiver], once the work that writes them is done. Throws UsageError for a span of
  /// another size.
  void read(std::span<glm::vec3> colors) const;

  /// Returns OpenCL's buffer, a cl_mem, for kernels on openclHandles(device).queue. It lives as long as the
  /// relighter.
  void* openclBuffer() const;

 private:
  std::shared_ptr<State> state_;
};

/// Relights a bake on a device as often as its lights change.
class Relighter {
 public:
  /// Copies the transfer to the device. The device must outlive the relighter, the bake need not. Throws
  /// UsageError when options are contradictory, InputError when the bake lacks the transfer, and Error when
  /// the device fails.
  Relighter(const Bake& bake, const Device& device, const RelighterOptions& options = {});
  Relighter(Relighter&&) noexcept;
  Relighter& operator=(Relighter&&) noexcept;
  ~Relighter();

  const std::string& technique() const;
  /// Returns which technique was chosen, why, the form of its transfer on the device, and what else the bake
  /// holds.
  const std::string& reason() const;
  std::size_t receiverCount() const;
  /// Returns the bytes that one relighting under the present light reads and writes.
  std::size_t bytesMoved() const;

  /// Sets the light. Before the first call it is black. Throws UsageError for light that the transfer cannot
  /// take and for numbers that are not finite.
  void light(const RelighterLight& light);

  /// Sets the moment of the animation, s, for transfer of keys; before the first and after the last key
  /// these count. Throws UsageError for other transfer.
  void setTime(double seconds);

  /// Computes the radiance of all receivers and returns it on the device, in colours that the next call
  /// replaces. Does not wait.
  const DeviceColors& relight();

  /// Computes the radiance of all receivers into `radiance`, [receiver]. Throws UsageError for a span of
  /// another size.
  void relight(std::span<glm::vec3> radiance);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Projects equirectangular skies of one size on a device, for skies that change every frame. Tables are made
/// once; sums have a fixed order.
class SkyProjector {
 public:
  /// The device must outlive the projector. `order` is 1 to 32. The sky is black before the first setSky().
  /// Throws UsageError for other orders and sizes below 1.
  SkyProjector(const Device& device, int width, int height, int order);
  SkyProjector(SkyProjector&&) noexcept;
  SkyProjector& operator=(SkyProjector&&) noexcept;
  ~SkyProjector();

  /// Copies a sky to the device. Throws UsageError for another size, and InputError for radiance that is
  /// negative or not finite, or not of width x height texels.
  void setSky(const Environment& sky);

  /// Turns the sky: f'(w) = f(R^-1 w). Throws UsageError for a matrix that is not orthonormal.
  void setRotation(const glm::dmat3& rotation);

  /// Returns the SH coefficients of the turned sky's radiance, [channel][i], as projectSky() does: exact for
  /// texels of constant radiance, up to rounding to floats.
  std::vector<double> projectSh();

  /// Returns the wavelets of the turned sky on a cube map, [channel][i], as haarForward() of cubeOfSky()
  /// does, but from samples x samples points per texel, 1 to 64. The face size is a power of two, 1 to 1024.
  std::vector<float> projectWavelets(int faceSize, int samples = 8);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace prelight
