#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "device/buffer.h"
#include "prelight/relighter.h"

namespace prelight {

/// Transfer of a bake on a device, which takes the light of a relighter in whatever form it needs. A receiver
/// is a vertex, a texel or a cell of a volume.
class RelitPart {
 public:
  virtual ~RelitPart() = default;

  virtual std::size_t receiverCount() const = 0;

  /// Returns the bytes that one relighting under the present light reads and writes.
  virtual std::size_t bytesMoved() const = 0;

  /// Returns the number of RelighterLight::groups that the part takes.
  virtual std::size_t groupCount() const { return 0; }

  /// Sets the light, which checkRelighterLight() accepts. Throws UsageError for light that the transfer
  /// cannot take; it then stays as it was.
  virtual void light(const RelighterLight& light) = 0;

  /// See Relighter::setTime().
  virtual void setTime(double seconds);

  /// Writes radiance before albedo, [receiver][3]. Does not wait.
  virtual void relight(Buffer<float>& radiance) = 0;
};

/// Input from which a part is made. All but the device may go afterwards.
struct RelitSource {
  const Bake& bake;
  const RelighterOptions& options;
  DeviceContext& device;
};

/// How a technique's transfer is multiplied on a device: a part of its row in `techniques()`.
struct Relighting {
  /// Among the transfers that a bake holds, one with the greatest preference is chosen.
  int preference = 1;

  /// Returns the form of the bake's transfer on the device, in words; empty if the bake has none.
  std::string (*form)(const Bake&) = nullptr;

  std::unique_ptr<RelitPart> (*make)(const RelitSource&) = nullptr;

  /// Receivers are vertices at rest, to which `makeAdded` of others may add their light.
  bool atVertices = false;

  /// Makes a part that adds its light, RelighterLight::groups, to colours of vertices. nullptr: it adds none.
  std::unique_ptr<RelitPart> (*makeAdded)(const RelitSource&) = nullptr;
};

/// Preferences: what moves before what rests, distant light at vertices before that at other places on
/// surfaces and in the air, and the scene's own lights last.
constexpr int preferMoving = 4, preferVertices = 3, preferSurfaces = 2, preferAir = 1, preferOwnLights = 0;

}  // namespace prelight
