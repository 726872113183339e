#pragma once

#include <cstdint>
#include <vector>

#include "gi/update/live_scene.h"
#include "gi/update/photon_groups.h"
#include "gi/update/photon_thinning.h"
#include "photon/photon_tracer.h"
#include "prelight/progress.h"

namespace prelight {

/// How photons whose paths have changed are found.
enum class ChangeDetection : std::uint8_t {
  /// From stored flights: those that met moved objects, and those that these now obstruct. Finds all changes
  /// at once and traces no other photons; needs to know what moves.
  Flights,
  /// By tracing one photon per group and frame, in turn (Larsen 2004, 9.1): if its first flight has changed,
  /// the whole group is sent again. Finds every change after each photon of the groups had its turn.
  Probes,
};

/// Options of LivePhotons.
struct LivePhotonOptions {
  PhotonRequest request;
  ChangeDetection detection = ChangeDetection::Flights;
  std::uint32_t groupSize = 40;  ///< photons per group; 0: no groups and no probes
  /// Most photons sent again per frame, besides probes; 0: all that are found.
  std::uint32_t photonsPerFrame = 0;
  std::uint32_t frames = 0;  ///< most frames until a waiting photon is sent again; 0: photonsPerFrame decides
  PhotonThinning thinning;   ///< reduces the photons of distant lamps
};

/// Photons that a frame removed and those that replace them.
struct PhotonDelta {
  std::vector<device::Photon> removed;
  std::vector<device::Photon> added;
};

/// Work of one frame.
struct PhotonFrame {
  std::uint64_t changed = 0;  ///< photons found so far whose path differs from before
  std::uint64_t traced = 0;   ///< photons sent again, including probes
  std::uint64_t probes = 0;
  std::uint64_t groups = 0;  ///< groups with photons sent again, except for probes that found nothing
  std::uint64_t rays = 0;
};

/// Photons that are kept up to date while the scene changes. Their paths are stored, and only those that a
/// change affects are traced again; the result equals tracing all of them.
class LivePhotons {
 public:
  /// Traces all photons. The scenes must outlive the object.
  LivePhotons(const LiveScene& scene, TransportScene& transport, const LivePhotonOptions& options,
              Progress& progress);

  /// Registers a change that the transport scene has followed. The next frames send the affected photons
  /// again.
  void changed(const SceneChange& change);

  /// Adapts the photon numbers of lamps to the position of the eye, by one octave per lamp and frame: that
  /// doubles or halves a lamp's photons without changing its power.
  void look(const glm::dvec3& eye) { options_.thinning.eye = eye; }

  /// Sets the most photons that a frame sends again, besides probes; 0: all that wait.
  void limit(std::uint32_t photonsPerFrame) { options_.photonsPerFrame = photonsPerFrame; }

  /// Sends waiting photons again. `delta` receives what has changed.
  PhotonFrame advance(PhotonDelta& delta, Progress& progress);

  /// Returns whether no photon waits and no change is being searched for.
  bool settled() const;

  /// Returns all stored photons, in order of their numbers.
  std::vector<device::Photon> photons() const;
  /// Returns the group of each of photons(), or noGroup for paths of a former source.
  std::vector<std::uint32_t> groupsOfPhotons() const;
  static constexpr std::uint32_t noGroup = 0xffffffffu;
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
    std::vector<Path> paths;  ///< [photon]; has extra entries while paths of a former source are replaced
    std::vector<std::uint8_t> waits;    ///< [path]
    std::vector<std::uint64_t> sentAt;  ///< [path], frame of the last sending, or of creation
    std::optional<Box> place;           ///< bounds of the emitter
    std::uint32_t octaves = 0;          ///< number of halvings by thinning
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
  std::vector<std::uint32_t> shining_;  ///< indices of lights of the scene, in the order of the light tables
  std::vector<Source> stored_;          ///< [source]
  std::vector<device::Photon> gone_;    ///< photons of removed sources
  std::uint64_t frame_ = 0;             ///< counts the frames with work
  std::uint32_t turn_ = 0;              ///< index of the probe in each group
  std::uint32_t quiet_ = 0;             ///< successive frames in which probes found nothing
};

}  // namespace prelight
