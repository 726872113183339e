#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/state_file.h"
#include "cast/light_caster.h"
#include "cast/occluder_caster.h"
#include "cast/sector_caster.h"
#include "cast/sender_rows.h"
#include "cast/shell_caster.h"
#include "cast/specular_caster.h"
#include "gpu/tracer.h"
#include "prelight/request.h"
#include "shared/cast_types.h"

namespace prelight {

/// Where rays end: nothing that obscures lies farther than where obscurance has faded out. 0: nowhere.
double reachOf(const OcclusionLimits& limits);

/// [triangle][3], orientedNormal of each.
std::vector<float> orientedNormals(const CompiledScene& scene);

/// [triangle], 1 where both sides are fronts, or light comes through from one to the other.
std::vector<std::uint8_t> twoSidedTriangles(const CompiledScene& scene);

/// Receivers a block, of that many rays each: what one round of launches takes.
std::uint32_t receiversPerBlock(const DeviceInfo& device, std::uint32_t raysPerReceiver);

/// Values of a vertex's transfer that a bounce carries at once. Results are the same whatever their number.
constexpr std::uint32_t widestPart = 16;

/// How many where memory is short, and where it is not.
constexpr std::uint32_t partValuesOf(bool memoryIsShort) { return memoryIsShort ? 8 : widestPart; }

struct CastOptions {
  int shOrder = 0;                        ///< 0: no SH
  std::uint32_t raysPerReceiver = 64;     ///< a power of two, 8 to 256
  std::uint32_t storedReceivers = 0;      ///< rows of senders that may be kept; 0: no bounces follow
  std::uint32_t rowsInMemory = 0;         ///< of them; further ones lie in a file
  std::size_t bounceColumns = 0;          ///< values a channel that bounces carry
  std::uint32_t partValues = widestPart;  ///< of them that they carry at once, 8 or 16
  int texelFaceSize = 0;                  ///< of the cube map that rays are coded on; 0: they are not
  const GroupedLights* lights = nullptr;  ///< read by the constructor alone; nullptr: none
  int incidentOrder = 0;                  ///< of the lights: incident radiance in SH of this order as well
  ShellShape shells;                      ///< of distance that blocks' hits are told apart by
  std::uint32_t sectors = 0;              ///< of azimuth that blocks' hits are told apart by; 0: none
  SpecularWays specular;                  ///< of rays that meet mirrors and glass
  OcclusionLimits limits;
  const OccluderGroups* occluders =
      nullptr;               ///< read by the constructor alone; nullptr: they are not told apart
  bool marksInside = false;  ///< tell which receivers lie inside objects
  std::span<const std::uint8_t> solids =
      {};                             ///< [triangle], read by the constructor alone: 1 where it is one
                                      ///< of the solids that receivers are told to lie inside; empty:
                                      ///< where rays meet nothing but backs of one-sided surfaces
  bool overlaps = false;              ///< two blocks may be under way, where these options allow it
  const ShadowSets* sets = nullptr;   ///< read by the constructor alone; nullptr: all see everything
  std::span<Tracer> setTracers = {};  ///< [set - 1]; must outlive the caster
};

/// What a block's receivers saw.
struct CastValues {
  std::vector<float> values;  ///< [receiver][valueCount]
  std::vector<std::uint32_t>
      texels;                 ///< [receiver][raysPerReceiver], texel x 256 + blocked part of 255; or empty
  std::vector<float> lights;  ///< [receiver][3][group], with an
                              ///< incidentOrder [..][value], see LightCaster; or empty
  std::vector<std::uint8_t> inside;  ///< [receiver], 1: inside an object; or empty
  std::vector<float> shells;         ///< [receiver][shell][1 + order^2], see ShellCaster; or empty
  std::vector<float> sectors;        ///< [receiver][3][sector], see SectorCaster; or empty
  std::vector<float> specular;       ///< [receiver][3][i], see SpecularCaster; or empty
  OccluderValues occluders;          ///< where they were asked for
};

/// What a block is cast for, besides the values that are projected for all.
struct CastPurpose {
  const std::uint32_t* storedRow =
      nullptr;             ///< rows of senders are kept from this one on; nullptr: they are not
  std::uint32_t set = 0;   ///< of occluders, that all receivers are of
  bool occluders = false;  ///< tell occluders apart; after setAccessibility()
  bool shells = false;     ///< tell hits apart by distance, where the options have shells
  bool sectors = false;    ///< tell hits apart by azimuth, where the options have sectors
  bool inside = true;      ///< mark receivers inside objects, where the options do
};

/// Of the values of a vertex's transfer, [3][columns], the partValues from firstValue on. They stand
/// together, [vertex][partValues], in the transfer on the device, from vertex firstPlace on.
struct TransferPart {
  std::uint32_t firstValue = 0;
  std::uint32_t firstPlace = 0;
};

/// The device's part of a bake: receivers -> rays -> hits -> projected values, block by block, and the stored
/// rows of senders that bounces read instead of casting again.
class Caster {
 public:
  /// The tracer must outlive the caster.
  Caster(const CompiledScene& scene, Tracer& tracer, const CastOptions& options);

  /// Receivers a block at most: what one round of launches takes.
  std::uint32_t blockSize() const { return blockSize_; }

  /// Floats a receiver that cast() yields: open fraction, 3 of the bent normal, order^2 of SH; see
  /// kernels/project/project_kernels.cl.
  std::uint32_t valueCount() const { return valueCount_; }

  /// Casts a block of receivers of one set of occluders.
  void cast(std::span<const device::Receiver> receivers, CastValues& values, const CastPurpose& purpose) {
    start(0, receivers, purpose);
    finish(0, values);
  }

  /// The same in two halves: what start() gives the device to do for a block, finish() waits for. As many
  /// blocks as there are places may be under way, each in a place of its own.
  void start(std::size_t place, std::span<const device::Receiver> receivers, const CastPurpose& purpose);
  void finish(std::size_t place, CastValues& values);
  std::size_t places() const { return blocks_.size(); }

  /// Frees all places but one, for what follows a cast: memory is at its peak then.
  void keepOnePlace() { blocks_.resize(1); }

  /// AO of every vertex, which what occluders send is damped by. Only with CastOptions::occluders.
  void setAccessibility(const CompiledScene& scene, std::span<const float> accessibility) {
    occluders_.value().setAccessibility(scene, accessibility);
  }

  /// Rays cast so far besides those of the hemispheres and to lights.
  std::uint64_t furtherRays() const {
    return earlierRays_ + (occluders_ ? occluders_->rays() : 0) + (specular_ ? specular_->rays() : 0);
  }

  /// Of these, steps within bodies, and those that go on from mirrors and glass.
  std::uint64_t walkSteps() const { return earlierSteps_ + (specular_ ? specular_->steps() : 0); }
  std::uint64_t specularRays() const { return furtherRays() - walkSteps(); }

  std::uint32_t raysPerReceiver() const { return options_.raysPerReceiver; }
  std::uint32_t partValues() const { return options_.partValues; }
  std::uint32_t rowsInMemory() const { return options_.rowsInMemory; }
  DeviceContext& device() const { return device_; }
  std::uint32_t groupCount() const { return lights_ ? lights_->groupCount() : 0; }

  /// The first `rows` stored rows and the marks, for a bake that will go on later.
  void save(StateWriter& state, std::uint32_t rows) const;

  /// What load() found.
  struct Loaded {
    std::uint32_t rows = 0;
    bool fromBacks = false;  ///< some rows have senders that are backs
    bool marked = false;     ///< some triangle's back was hit
  };
  Loaded load(StateReader& state);

  /// [triangle], 1 where a stored ray hit a back.
  std::vector<std::uint8_t> backMarks() const { return marks_.read(); }

  /// Transfer that gathering reads, of vertices, then of their backs. A part of it, from value `first` on,
  /// into room for all.
  void setTransfer(std::span<const float> transfer, std::size_t first = 0);
  void resizeTransfer(std::size_t values);
  std::vector<float> readTransfer() const { return transfer_.read(); }

  /// Rows that gather() takes at most: several blocks, for a row is far less work than its rays were.
  std::uint32_t rowsPerGather() const { return 4 * blockSize_; }

  /// Mean over each stored row's rays of albedo x transfer, for rows [first, first + count), and for a part
  /// of a vertex's values [3][bounceColumns]: [row][partValues].
  void gather(std::uint32_t first, std::uint32_t count, const TransferPart& part, std::vector<float>& values);

  /// The same into transfer matrices: mean of Y_i(direction) x albedo x transfer, [row][i][3][columns] with i
  /// below order^2. `receivers` are those of the rows from `first` on, at most a block; the transfer is
  /// [vertex][3][columns], `columns` at most 8.
  void gatherGlossy(std::span<const device::Receiver> receivers, std::uint32_t first, int order,
                    std::size_t columns, std::vector<float>& values);

 private:
  /// What the device has of a block under way.
  struct Block {
    DeviceLane lane;
    Buffer<device::CastParameters> parameters;
    Buffer<device::Receiver> receivers;
    Buffer<device::Ray> rays;
    Buffer<device::Hit> hits;
    Buffer<float> values;
    Buffer<std::uint32_t> texels;
    std::uint32_t count = 0;  ///< receivers
    std::uint32_t set = 0;
    bool occluders = false;
    bool shells = false;
    bool sectors = false;
    bool closest = false;  ///< hits are
    Buffer<std::uint8_t> inside;
    std::vector<device::Receiver> placed;    ///< where they are marked inside objects
    std::optional<std::uint32_t> storedRow;  ///< the first, where rows of senders are stored
  };

  Block makeBlock(DeviceLane lane) const;
  Tracer& tracerOf(std::uint32_t set) const { return set == 0 ? tracer_ : options_.setTracers[set - 1]; }
  void setParameters(Block& block, std::uint32_t receivers, std::uint32_t firstStored);
  BuildOptions transportOptions(std::size_t columns) const;
  void generate(Block& block, std::span<const device::Receiver> receivers);
  void markInside(Block& block);
  void readInside(Block& block, std::vector<std::uint8_t>& inside);
  void codeTexels(Block& block);
  void store(const Block& block);
  void follow(const Block& block, CastValues& values);

  Tracer& tracer_;
  DeviceContext& device_;
  CastOptions options_;
  std::uint32_t vertexCount_;
  bool translucent_;
  std::uint32_t valueCount_;
  std::uint32_t blockSize_;
  std::uint64_t earlierRays_ = 0, earlierSteps_ = 0;  ///< of runs that load() goes on with
  std::vector<Block> blocks_;                         ///< [place]; the first one for all else, too
  Buffer<float> shTable_;
  Buffer<float> geometricNormals_;
  std::optional<SenderRows> senders_;  ///< where rows may be kept
  Buffer<std::uint8_t> marks_;
  bool findsSolids_ = false;  ///< receivers inside are marked by a part of their rays
  Buffer<std::uint8_t> hides_;
  Buffer<float> transfer_;
  std::optional<LightCaster> lights_;
  std::optional<OccluderCaster> occluders_;
  std::optional<ShellCaster> shells_;
  std::optional<SectorCaster> sectors_;
  std::optional<SpecularCaster> specular_;
  using Parameters = Buffer<device::CastParameters>;
  using Receivers = Buffer<device::Receiver>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Floats = Buffer<float>;
  Kernel<Parameters, Receivers, Rays> generate_;
  Kernel<Parameters, Floats, Rays, Hits, Floats> project_;
  Kernel<Parameters, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>, Floats, Receivers, Rays, Hits,
         Buffer<device::Sender>, Buffer<std::uint8_t>>
      store_;
  Kernel<Parameters, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>, Floats, Receivers,
         Buffer<device::SpecularEnd>, Buffer<device::Sender>, Buffer<std::uint8_t>>
      storeFollowed_;
  Kernel<Parameters, std::uint32_t, std::uint32_t, Buffer<device::Sender>, Floats, Floats> gather_;
  Kernel<Parameters, std::uint32_t, Rays, Hits, Buffer<std::uint32_t>> texelCodes_;
  Kernel<Parameters, std::uint32_t, std::uint32_t, Receivers, Rays, Hits, Floats, Buffer<std::uint8_t>,
         Buffer<std::uint8_t>>
      insideMarks_;
  Kernel<Parameters, Floats, Rays, Buffer<device::Sender>, Floats, Floats> glossy_;
  Buffer<float> glossyTable_;
  Buffer<float> glossyValues_;
  Buffer<float> gatheredValues_;
};

}  // namespace prelight
