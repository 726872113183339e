#include "bake/animated_bake.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "base/kept_work.h"
#include "base/state_file.h"
#include "compress/compression_error.h"
#include "scene/deform.h"
#include "scene/pose.h"
#include "techniques/sh/animated_transfer.h"

namespace prelight {

namespace {

/// Transfer of one pose.
struct PoseTransfer {
  HarmonicTransfer sh;
  std::optional<NearLampTransfer> nearLamps;
};

using SharedTransfer = std::shared_ptr<const PoseTransfer>;

/// Progress of one pose: prefixes stages with its name and forwards the rest to the whole bake.
class PoseProgress final : public Progress {
 public:
  PoseProgress(Progress& whole, std::string name) : whole_(whole), name_(std::move(name)) {}

  void report(std::string_view stage, double fraction) override {
    whole_.report(fmt::format("{}: {}", name_, stage), fraction);
  }
  void compiling(const KernelCompilation& program) override { whole_.compiling(program); }
  void warn(std::string_view warning) override { whole_.warn(warning); }
  bool stopRequested() const override { return whole_.stopRequested(); }
  WorkKeeper* keeper() const override { return whole_.keeper(); }

 private:
  Progress& whole_;
  std::string name_;
};

/// Returns the request for a pose: SH transfer, and near lamps in the shells that the bake at rest has.
BakeRequest requestForPoses(const BakeRequest& request, const std::optional<NearLampTransfer>& rest) {
  BakeRequest only = request.withoutTechniques();
  only.sh.order = request.sh.order;
  only.nearLamps = rest ? NearLampsRequest{rest->shells, rest->farthest, rest->order} : NearLampsRequest{0};
  return only;
}

std::uint64_t poseHash(const CompiledScene& scene) {
  StateHash hash;
  hash.values(scene.positions).values(scene.normals);
  hash.values(scene.texCoords).values(scene.texCoords1).values(scene.colors).values(scene.tangents);
  for (const CompiledMaterial& m : scene.materials) {
    hash.values(std::vector<glm::vec3>{m.baseColor, m.albedo, m.diffuseTransmission});
    hash.values(std::vector<float>{m.alphaCutoff, m.alphaFactor, m.metallic, m.roughness, m.transmission});
  }
  for (int i = 0; i < 3; ++i) hash.value(scene.origin[i]);
  return hash.result();
}

/// Bakes poses of an animation. Equal poses are baked once.
class PoseBaker {
 public:
  PoseBaker(const Scene& scene, const CompiledScene& compiled, std::size_t animation,
            const BakeRequest& request, const Bake& rest, const Device& device, Progress& progress,
            AnimationReport& report)
      : scene_(scene),
        compiled_(compiled),
        animation_(animation),
        request_(requestForPoses(request, rest.nearLamps)),
        device_(device),
        progress_(progress),
        report_(report),
        posed_(scene) {
    shape_ = rest.sh->coefficients.size();
    known_[poseHash(compiled)] = std::make_shared<PoseTransfer>(PoseTransfer{*rest.sh, rest.nearLamps});
    if (rest.nearLamps) shells_ = *rest.nearLamps;
    shells_.halves.clear();
    shellsSize_ = rest.nearLamps ? rest.nearLamps->halves.size() : 0;
  }

  SharedTransfer bake(double seconds) {
    progress_.check();
    const CompiledScene compiled = compiledAt(seconds);
    const std::uint64_t hash = poseHash(compiled);
    SharedTransfer& transfer = known_[hash];
    if (transfer) {
      ++report_.reused;
      return transfer;
    }
    PoseProgress progress(progress_, fmt::format("pose {} at {:.3g} s", ++report_.bakes, seconds));
    auto made = std::make_shared<PoseTransfer>();
    std::uint64_t rays = 0;
    NearLampTransfer shells = shells_;
    WorkPart part(progress_, fmt::format("pose {:016x}", hash), [&](auto& state) {
      state.value(rays);
      state.value(made->sh.order);
      state.value(made->sh.channels);
      state.value(made->sh.bounces);
      state.values(made->sh.coefficients);
      state.require(made->sh.order == request_.sh.order && made->sh.coefficients.size() == shape_);
      state.requireFinite(made->sh.coefficients);
      state.values(shells.halves);
      state.require(shells.halves.size() == shellsSize_);
    });
    if (!part.finished()) {
      *made = bakePose(compiled, seconds, progress, rays);
      if (made->nearLamps) shells = *made->nearLamps;
      part.finish();
    }
    if (shellsSize_ > 0) made->nearLamps = std::move(shells);
    report_.rays += rays;
    return transfer = std::move(made);
  }

  /// Returns the difference of `baked` from the interpolation of the two keys, relative RMS over the surface
  /// posed at `seconds`.
  double difference(double first, const HarmonicTransfer& firstKey, double last,
                    const HarmonicTransfer& lastKey, double seconds, const HarmonicTransfer& baked) {
    const auto posed = [&](const HarmonicTransfer& key, double time) {
      return PosedTransfer{key, transformsAt(scene_, animation_, time)};
    };
    const double blend = (seconds - first) / (last - first);
    const HarmonicTransfer mixed =
        mixTransfers(posed(firstKey, first), posed(lastKey, last), blend,
                     transformsAt(scene_, animation_, seconds), scene_, compiled_, KeyMix::Turned);
    return compressionError(baked, mixed, surfaceOfVertices(compiledAt(seconds))).vectorRms;
  }

 private:
  PoseTransfer bakePose(const CompiledScene& compiled, double seconds, Progress& progress,
                        std::uint64_t& rays) const {
    BakeReport report;
    const Plan plan = makePlan(posed_, compiled, request_);
    Bake bake = bakeScene(compiled, request_, plan, device_, progress, report);
    rays = report.rays;
    if (bake.sh->coefficients.size() != shape_)
      throw Error(ExitCode::RuntimeFailure, fmt::format("animation at {} s", seconds),
                  "the transfer has other channels than that of the rest pose",
                  "give every moving surface some area at all times");
    if (shellsSize_ > 0 && !bake.nearLamps)
      throw Error(ExitCode::RuntimeFailure, fmt::format("animation at {} s", seconds),
                  "the scene is flat, and has no shells of near lamps as it has at rest",
                  "NearLampsRequest::shells 0 leaves them out");
    return {std::move(*bake.sh), std::move(bake.nearLamps)};
  }

  CompiledScene compiledAt(double seconds) {
    Warnings said;  // the same warnings were given for the rest pose
    setPose(posed_, animation_, seconds);
    return compileScene(posed_, said);
  }

  const Scene& scene_;
  const CompiledScene& compiled_;
  std::size_t animation_;
  BakeRequest request_;
  const Device& device_;
  Progress& progress_;
  AnimationReport& report_;
  Scene posed_;
  std::size_t shape_ = 0;
  NearLampTransfer shells_;                        ///< those of every key, without their halves
  std::size_t shellsSize_ = 0;                     ///< halves of every key; 0: there are none
  std::map<std::uint64_t, SharedTransfer> known_;  ///< baked transfer by hash of the pose
};

/// Returns the key times of the animation's samplers, at most 16, evenly thinned out. Motion between them is
/// interpolated.
std::vector<double> motionKeys(const Animation& animation) {
  std::set<double> times;
  for (const AnimationSampler& sampler : animation.samplers)
    times.insert(sampler.times.begin(), sampler.times.end());
  constexpr std::size_t most = 16;
  const std::size_t stride = (times.size() + most - 1) / most;
  std::vector<double> some;
  std::size_t at = 0;
  for (const double time : times)
    if (at++ % stride == 0) some.push_back(time);
  return some;
}

ChosenKeys<SharedTransfer> chooseMoments(PoseBaker& baker, double start, double end, const KeyRequest& keys) {
  if (keys.error) {
    const KeyOperations<SharedTransfer> operations{
        [&](double seconds) { return baker.bake(seconds); },
        [&](double first, const SharedTransfer& firstKey, double last, const SharedTransfer& lastKey,
            double seconds, const SharedTransfer& baked) {
          return baker.difference(first, firstKey->sh, last, lastKey->sh, seconds, baked->sh);
        }};
    return chooseKeys(start, end, keys, operations);
  }
  ChosenKeys<SharedTransfer> chosen;
  chosen.times = evenTimes(start, end, keys.count);
  for (const double time : chosen.times) chosen.keys.push_back(baker.bake(time));
  return chosen;
}

}  // namespace

StateKey keysKey(std::size_t animation, const KeyRequest& keys) {
  StateHash hash;
  hash.value(std::uint64_t{animation}).value(keys.error.value_or(0.0)).value(keys.mostKeys);
  if (!keys.error) hash.value(keys.count);
  return {{"keys of the animation", hash.result()}};
}

AnimatedTransfer bakeAnimation(const Scene& scene, const CompiledScene& compiled, std::size_t animation,
                               const BakeRequest& request, const KeyRequest& keys, const Bake& rest,
                               const Device& device, Progress& progress, AnimationReport& report) {
  if (request.sh.order < 1 || !rest.sh)
    throw UsageError("animation", "keys hold SH transfer, which is not asked for", "set ShRequest::order");
  PoseBaker baker(scene, compiled, animation, request, rest, device, progress, report);
  const Animation& played = scene.animations.at(animation);
  const double start = played.startTime();
  const bool moves = changesTransport(scene, played);
  KeyRequest withMoments = keys;
  if (keys.error) withMoments.moments = motionKeys(played);
  const ChosenKeys<SharedTransfer> chosen =
      chooseMoments(baker, start, moves ? played.endTime() : start, withMoments);
  report.error = chosen.error;
  if (!moves)
    report.notes.push_back("animation: only one key, because it moves no mesh and changes no surface");
  if (keys.error && chosen.error > *keys.error)
    report.notes.push_back(fmt::format("animation: {} keys are not enough for an error of {:g}: {:.3g}",
                                       chosen.times.size(), *keys.error, chosen.error));
  AnimatedTransfer result{animation, chosen.times, {}};
  for (const SharedTransfer& key : chosen.keys) {
    result.keys.push_back(key->sh);
    if (key->nearLamps) result.nearLamps.push_back(*key->nearLamps);
  }
  return result;
}

}  // namespace prelight
