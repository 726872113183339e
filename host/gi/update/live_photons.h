#pragma once

#include <cstdint>
#include <vector>

#include "gi/update/live_scene.h"
#include "gi/update/photon_groups.h"
#include "gi/update/photon_thinning.h"
#include "photon/photon_tracer.h"
#include "prelight/progress.h"

namespace prelight {

/// How photons whose way has changed are found.
enum class ChangeDetection : std::uint8_t {
  Flights,  ///< by stored flights: those that met what has moved, and those that it now stands in the way of.
            ///< Finds every one at once and traces no other; needs to be told what moves
  Probes,   ///< one photon of each group a frame, in turn (Larsen 2004, 9.1): one that flies elsewhere on its
            ///< first flight has its whole group sent again. Finds every change after a round of the groups
};

struct LivePhotonOptions {
  PhotonRequest request;
  ChangeDetection detection = ChangeDetection::Flights;
  std::uint32_t groupSize = 40;       ///< photons of a group; 0: none are made, and there are no probes
  std::uint32_t photonsPerFrame = 0;  ///< sent again at most, besides probes; 0: all that are found
  std::uint32_t frames = 0;  ///< in which any photon that waits is sent again; 0: photonsPerFrame says
  PhotonThinning thinning;   ///< of lamps that are far
};

/// Photons that a frame took away and those that it put in their places.
struct PhotonDelta {
  std::vector<device::Photon> removed;
  std::vector<device::Photon> added;
};

struct PhotonFrame {
  std::uint64_t changed = 0;  ///< photons that fly elsewhere than before, as found so far
  std::uint64_t traced = 0;   ///< photons sent again, with probes
  std::uint64_t probes = 0;
  std::uint64_t groups = 0;  ///< that had photons sent again, but for probes that found nothing
  std::uint64_t rays = 0;
};

/// Photons that are kept up to date while the scene changes. Their ways are stored; only those that changes
/// concern are traced again, and every photon is the one that a tracing of all would yield.
class LivePhotons {
 public:
  /// Traces all photons. The scenes outlive it.
  LivePhotons(const LiveScene& scene, TransportScene& transport, const LivePhotonOptions& options,
              Progress& progress);

  /// Takes note of a change that the transport scene has followed. What has changed is sent again by the
  /// next frames.
  void changed(const SceneChange& change);

  /// Lamps have the photons that an eye there asks for: each a step of an octave a frame, which adds as many
  /// photons as it has, or takes half of them away, and leaves its power as it was.
  void look(const glm::dvec3& eye) { options_.thinning.eye = eye; }

  PhotonFrame advance(PhotonDelta& delta, Progress& progress);

  /// No photon waits, and no change is looked for.
  bool settled() const;

  /// All that are stored, in an order of their numbers.
  std::vector<device::Photon> photons() const;
  std::uint64_t pathCount() const;
  std::uint64_t groupCount() const;

 private:
  struct Path {
    std::vector<PhotonFlight> flights;
    std::vector<device::Photon> photons;
  };
  struct Source {
    PhotonGroups groups;
    std::vector<std::uint32_t> groupOf;  ///< [photon]
    std::vector<Path> paths;             ///< [photon]; more than the source has while they are replaced
    std::vector<std::uint8_t> waits;     ///< [path]
    std::vector<std::uint64_t> sentAt;   ///< [path], the frame, or that in which it came to be
    std::optional<Box> place;            ///< that it shines from
    std::uint32_t octaves = 0;           ///< by which it is thinned
  };

  PhotonSources makeSources() const;
  void restart();
  void adoptSources(PhotonSources sources);
  void makeGroups(std::size_t source);
  bool isThinned() const;
  std::uint32_t wantedOctaves(std::size_t source) const;
  void thin(PhotonDelta& delta, PhotonFrame& frame, Progress& progress);
  void setCount(std::size_t source, std::uint32_t count, PhotonDelta& delta);
  bool sameSource(const PhotonSources& other, std::size_t index) const;
  bool concerns(const device::PhotonSource& source, const SceneChange& change) const;
  void markFlights(const SceneChange& change);
  std::vector<std::uint64_t> shareBudget() const;
  std::vector<std::uint32_t> takeWaiting(std::size_t source, std::uint64_t budget);
  void probe(PhotonDelta& delta, PhotonFrame& frame, Progress& progress);
  std::vector<std::uint32_t> send(std::size_t source, std::span<const std::uint32_t> photons,
                                  PhotonDelta& delta, PhotonFrame& frame, Progress& progress);
  static bool replace(Path& old, Path path, PhotonDelta& delta);

  const LiveScene& scene_;
  TransportScene& transport_;
  LivePhotonOptions options_;
  PhotonTracer tracer_;
  PhotonSources sources_;
  std::vector<std::uint32_t> shining_;  ///< lights of the scene, by their places in the light tables
  std::vector<Source> stored_;          ///< [source]
  std::vector<device::Photon> gone_;    ///< of sources that are no more
  std::uint64_t frame_ = 0;             ///< of those that had something to do
  std::uint32_t turn_ = 0;              ///< member of each group that probes next
  std::uint32_t quiet_ = 0;             ///< rounds of probes that found nothing, in frames
};

}  // namespace prelight
