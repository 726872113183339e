#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "integrators/live_virtual_lights.h"
#include "viewer/gl/program.h"
#include "viewer/shadows/shadow_maps.h"

namespace prelight::viewer {

/// Virtual lights and what each sees, for techniques/instant/virtual_lights.glsl. Lights that stay where they
/// are keep their shadow maps, and what has moved among them is drawn into these a few a picture, the oldest
/// first.
class VirtualLightMaps {
 public:
  static constexpr std::size_t everything = static_cast<std::size_t>(-1);

  /// From now on these lights shine. Lights with one place and normal share a map.
  void set(const VirtualLightSet& set);

  /// All maps show what was there before.
  void sceneMoved();

  /// Draws the maps of new lights, and of those that sceneMoved() has left behind at most as many as
  /// `renewals` leaves. Changes what ShadowMaps::update() does.
  void update(const RenderScene& scene, const CompiledScene& compiled, std::size_t renewals);

  /// Some maps show what was there before.
  bool isBehind() const;

  /// Binds textures and sets the uniforms of the program in use.
  void bind(const gl::Program& program) const;

  std::size_t viewsDrawn() const { return maps_.viewsDrawn(); }  ///< by the last update
  std::size_t viewCount() const { return maps_.viewCount(); }
  std::size_t lightCount() const { return set_.lights.size(); }

 private:
  /// A light's place and normal.
  using Eye = std::array<float, 6>;

  /// Room for a light's map.
  struct Slot {
    ShadedLight eye;            ///< dark: it has never been used
    bool isUsed = false;        ///< by a light
    bool isBehind = false;      ///< it shows what was there before
    std::uint64_t drawnAt = 0;  ///< update
  };

  static Eye eyeOf(const device::VirtualLight& light);
  std::size_t takeSlot();
  void renewOldest(std::size_t most);
  void upload();

  VirtualLightSet set_;
  ShadowMaps maps_{ShadowMaps::Room::OfAll};
  std::vector<Slot> slots_;
  std::map<Eye, std::size_t> slotOf_;  ///< of the lights
  bool twoSided_ = false;              ///< some light has shone to both sides
  bool isStale_ = false;               ///< `texels_` are of other lights or places
  std::uint64_t updates_ = 0;
  gl::BufferTexture texels_;
};

}  // namespace prelight::viewer
