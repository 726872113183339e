#include "gi/update/live_photons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "gi/update/live_scenes.h"
#include "support/devices.h"

namespace prelight::test {
namespace {

LivePhotonOptions optionsOf(PhotonKind kind, std::uint64_t photons) {
  LivePhotonOptions options;
  options.request.kind = kind;
  options.request.photons = photons;
  options.request.seed = 7;
  return options;
}

/// A scene that moves, and photons that follow it.
class Live {
 public:
  Live(const LoadedScene& loaded, const LivePhotonOptions& options)
      : loaded_(loaded),
        scene_(loaded.scene, loaded.compiled),
        transport_({scene_.compiled(), loaded.scene.images, scene_.compiled().lights}, sharedDevice()),
        photons_(scene_, transport_, options, progress_) {}

  void move(const std::string& node, const RigidMotion& motion) {
    scene_.moveNode(loaded_.node(node), motion);
    const std::vector<std::uint32_t> triangles = scene_.trianglesOf(loaded_.node(node));
    separated_.insert(separated_.end(), triangles.begin(), triangles.end());
    std::sort(separated_.begin(), separated_.end());
    separated_.erase(std::unique(separated_.begin(), separated_.end()), separated_.end());
    follow();
  }
  void setLight(std::size_t index, const Light& light) {
    scene_.setLight(index, light);
    follow();
  }
  void look(const glm::dvec3& eye) { photons_.look(eye); }
  PhotonFrame advance() { return photons_.advance(delta_, progress_); }
  const PhotonDelta& delta() const { return delta_; }
  const LivePhotons& photons() const { return photons_; }
  const LiveScene& scene() const { return scene_; }

 private:
  void follow() {
    const SceneChange change = scene_.takeChanges();
    if (!change.triangles.empty()) {
      transport_.tracer().separate(scene_.compiled(), separated_);
      transport_.follow(scene_.compiled());
    }
    if (!change.lights.empty()) transport_.setLights(scene_.compiled(), scene_.compiled().lights);
    photons_.changed(change);
  }

  const LoadedScene& loaded_;
  Progress progress_;
  LiveScene scene_;
  TransportScene transport_;
  LivePhotons photons_;
  PhotonDelta delta_;
  std::vector<std::uint32_t> separated_;
};

/// All photons of the scene in its current state, traced anew.
std::vector<device::Photon> tracedAnew(const LiveScene& scene, const std::vector<Image>& images,
                                       const PhotonRequest& request) {
  TransportScene transport({scene.compiled(), images, scene.compiled().lights}, sharedDevice());
  PhotonHits hits;
  Progress progress;
  PhotonTracer(scene.compiled(), transport).trace(request, hits, progress);
  return hits.photons;
}

std::vector<device::Photon> sorted(std::vector<device::Photon> photons) {
  std::sort(photons.begin(), photons.end(), [](const device::Photon& a, const device::Photon& b) {
    return std::memcmp(&a, &b, sizeof a) < 0;
  });
  return photons;
}

/// Number of photons in `a` that are not in `b`.
std::size_t lacking(const std::vector<device::Photon>& a, const std::vector<device::Photon>& b) {
  const std::vector<device::Photon> left = sorted(a), right = sorted(b);
  std::size_t count = 0;
  for (const device::Photon& p : left)
    count += std::binary_search(right.begin(), right.end(), p,
                                [](const device::Photon& x, const device::Photon& y) {
                                  return std::memcmp(&x, &y, sizeof x) < 0;
                                })
                 ? 0
                 : 1;
  return count;
}

void expectTracedAnew(const Live& live, const LoadedScene& loaded, const PhotonRequest& request) {
  const std::vector<device::Photon> anew = tracedAnew(live.scene(), loaded.scene.images, request);
  const std::vector<device::Photon> kept = live.photons().photons();
  EXPECT_EQ(kept.size(), anew.size());
  // A ray through an edge may meet either triangle, depending on the tree.
  EXPECT_LE(lacking(kept, anew), anew.size() / 5000);
  EXPECT_LE(lacking(anew, kept), anew.size() / 5000);
}

struct Motion {
  std::string scene, node;
  RigidMotion motion;
};

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all = {{"cornell", "Short box", shifted(0.15, 0.1, 0.1)},
                                          {"rooms", "Left crate", shifted(0.3, 0.2, 0.0)},
                                          {"shapes", "Torus", shifted(0.0, 0.5, 0.2)},
                                          {"caustics", "Mirror box", shifted(0.1, 0.2, 0.0)}};
  return all;
}

TEST(LivePhotons, MovedObject_LeavesThePhotonsOfATracingAnew) {
  for (const Motion& m : motions()) {
    SCOPED_TRACE(m.scene);
    const LoadedScene loaded(m.scene);
    const LivePhotonOptions options = optionsOf(PhotonKind::All, 20000);
    Live live(loaded, options);
    live.move(m.node, m.motion);
    const PhotonFrame frame = live.advance();
    EXPECT_GT(frame.changed, 0u);
    EXPECT_TRUE(live.photons().settled());
    expectTracedAnew(live, loaded, options.request);
  }
}

TEST(LivePhotons, MovedObject_SendsOnlyPhotonsThatChange) {
  for (const Motion& m : motions()) {
    SCOPED_TRACE(m.scene);
    const LoadedScene loaded(m.scene);
    Live live(loaded, optionsOf(PhotonKind::All, 20000));
    live.move(m.node, m.motion);
    const PhotonFrame frame = live.advance();
    EXPECT_GT(frame.traced, 0u);
    // Some rays end on edges of the moved object, or pass it within rounding.
    EXPECT_GE(static_cast<double>(frame.changed), 0.99 * static_cast<double>(frame.traced));
  }
}

TEST(LivePhotons, ObjectThatMovedBefore_HasNothingSentWhenAnotherMoves) {
  const LoadedScene loaded("shapes");
  Live live(loaded, optionsOf(PhotonKind::All, 20000));
  live.move("Cone", shifted(0.0, 0.1, 0.0));
  live.advance();
  live.move("Box", shifted(0.1, 0.1, 0.0));
  const PhotonFrame frame = live.advance();
  EXPECT_GT(frame.changed, 0u);
  EXPECT_GE(static_cast<double>(frame.changed), 0.99 * static_cast<double>(frame.traced));
}

TEST(LivePhotons, NothingMoved_SendsNothing) {
  const LoadedScene loaded("cornell");
  Live live(loaded, optionsOf(PhotonKind::All, 5000));
  EXPECT_TRUE(live.photons().settled());
  EXPECT_EQ(live.advance().rays, 0u);
  live.move("Short box", RigidMotion{});
  live.advance();
  EXPECT_TRUE(live.delta().removed.empty());
  EXPECT_TRUE(live.delta().added.empty());
}

TEST(LivePhotons, Delta_TurnsTheOldPhotonsIntoTheNew) {
  const LoadedScene loaded("cornell");
  Live live(loaded, optionsOf(PhotonKind::All, 5000));
  std::vector<device::Photon> before = live.photons().photons();
  live.move("Tall box", shifted(0.1, 0.0, 0.1));
  live.advance();
  before.insert(before.end(), live.delta().added.begin(), live.delta().added.end());
  std::vector<device::Photon> after = live.photons().photons();
  after.insert(after.end(), live.delta().removed.begin(), live.delta().removed.end());
  const std::vector<device::Photon> a = sorted(before), b = sorted(after);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0);
}

TEST(LivePhotons, Budget_SpreadsOverFramesAndEndsTheSame) {
  const LoadedScene loaded("cornell");
  LivePhotonOptions options = optionsOf(PhotonKind::All, 5000);
  options.photonsPerFrame = 200;
  Live live(loaded, options);
  live.move("Tall box", shifted(0.1, 0.0, 0.1));
  int frames = 0;
  while (!live.photons().settled()) {
    EXPECT_LE(live.advance().traced, 200u);
    ASSERT_LT(++frames, 100);
  }
  EXPECT_GT(frames, 3);
  expectTracedAnew(live, loaded, options.request);
}

TEST(LivePhotons, Probes_FindEveryChangeAfterARoundOfTheirGroups) {
  for (const Motion& m : motions()) {
    SCOPED_TRACE(m.scene);
    const LoadedScene loaded(m.scene);
    LivePhotonOptions options = optionsOf(PhotonKind::All, 5000);
    options.detection = ChangeDetection::Probes;
    options.groupSize = 20;
    Live live(loaded, options);
    live.move(m.node, m.motion);
    for (std::uint32_t f = 0; f <= options.groupSize; ++f)
      EXPECT_EQ(live.advance().probes, live.photons().groupCount());
    expectTracedAnew(live, loaded, options.request);
    for (std::uint32_t f = 0; f <= options.groupSize; ++f) live.advance();
    EXPECT_TRUE(live.photons().settled());
  }
}

TEST(LivePhotons, MovedLight_SendsItsPhotonsAndNoOthers) {
  const LoadedScene plain("rooms");
  LoadedScene loaded("rooms");
  Light second = loaded.compiled.lights.at(0);
  second.position += glm::dvec3(0.3, 0.0, 0.1);
  loaded.compiled.lights.push_back(second);
  const LivePhotonOptions options = optionsOf(PhotonKind::All, 8000);
  Live live(loaded, options);
  second.position.y -= 0.2;
  live.setLight(1, second);
  const PhotonFrame frame = live.advance();
  EXPECT_NEAR(static_cast<double>(frame.traced), 4000.0, 2.0);
  expectTracedAnew(live, loaded, options.request);
}

TEST(LivePhotons, BrighterLight_KeepsItsPhotonsWaysAndRaisesTheirPower) {
  const LoadedScene loaded("rooms");
  Live live(loaded, optionsOf(PhotonKind::All, 2000));
  const std::vector<device::Photon> before = live.photons().photons();
  Light light = loaded.compiled.lights.at(0);
  light.intensity *= 2.0f;
  live.setLight(0, light);
  live.advance();
  const std::vector<device::Photon> after = live.photons().photons();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].position[1], after[i].position[1]);
    EXPECT_FLOAT_EQ(2.0f * before[i].power[1], after[i].power[1]);
  }
}

TEST(LivePhotons, CausticsOfAMovedCaster_AreSentAgainOverTheirFrames) {
  const LoadedScene loaded("caustics");
  LivePhotonOptions options = optionsOf(PhotonKind::Caustic, 8000);
  options.request.rouletteDepth = 8;
  options.photonsPerFrame = 1000;
  Live live(loaded, options);
  live.move("Glass sphere", shifted(0.1, 0.0, 0.0));
  int frames = 0;
  while (!live.photons().settled()) {
    live.advance();
    ASSERT_LT(++frames, 20);
  }
  EXPECT_GE(frames, 8);
  expectTracedAnew(live, loaded, options.request);
}

TEST(LivePhotons, CasterThatKeepsMoving_HasAllItsCausticsRenewedInTurn) {
  const LoadedScene loaded("caustics");
  LivePhotonOptions options = optionsOf(PhotonKind::Caustic, 4000);
  options.photonsPerFrame = 500;
  Live live(loaded, options);
  const std::vector<device::Photon> before = live.photons().photons();
  for (int f = 1; f <= 12; ++f) {
    live.move("Glass sphere", shifted(0.01 * f, 0.0, 0.0));
    live.advance();
  }
  // Photons that flew before the first move and would not fly now are gone, except for a few whose path still
  // existed when they were retraced.
  const std::vector<device::Photon> kept = live.photons().photons();
  const std::vector<device::Photon> now = tracedAnew(live.scene(), loaded.scene.images, options.request);
  std::vector<device::Photon> gone;
  for (const device::Photon& p : before)
    if (lacking({p}, now) > 0) gone.push_back(p);
  EXPECT_GT(gone.size(), before.size() / 2);
  EXPECT_GT(lacking(gone, kept), gone.size() * 19 / 20);
}

TEST(LivePhotons, CasterThatKeepsMoving_HasNoPhotonOfMoreFramesBefore) {
  LoadedScene loaded("caustics");
  Light faint;  // Emits a few photons only.
  faint.intensity = glm::vec3(5e-3f);
  faint.position = {0.3, 0.4, 0.4};
  loaded.compiled.lights.push_back(faint);
  LivePhotonOptions options = optionsOf(PhotonKind::Caustic, 2000);
  options.frames = 4;
  Live live(loaded, options);
  std::vector<std::vector<device::Photon>> states;
  for (int f = 1; f <= 7; ++f) {
    live.move("Glass sphere", shifted(0.06 * f, 0.0, 0.0));
    live.advance();
    states.push_back(tracedAnew(live.scene(), loaded.scene.images, options.request));
  }
  const std::vector<device::Photon> kept = live.photons().photons();
  EXPECT_GT(lacking(kept, states.back()), kept.size() / 10) << "nothing is late";
  std::vector<device::Photon> recent;
  for (std::size_t i = states.size() - options.frames; i < states.size(); ++i)
    recent.insert(recent.end(), states[i].begin(), states[i].end());
  EXPECT_EQ(lacking(kept, recent), 0u);
}

/// Total power in the red channel, which is enough here.
double powerOf(const std::vector<device::Photon>& photons) {
  double sum = 0.0;
  for (const device::Photon& p : photons) sum += p.power[0];
  return sum;
}

LivePhotonOptions thinnedOptions(const LoadedScene& loaded, double distance) {
  LivePhotonOptions options = optionsOf(PhotonKind::All, 16000);
  options.thinning.beyond = 1.0;
  options.thinning.eye =
      loaded.compiled.lights.at(0).position - loaded.compiled.origin + glm::dvec3(0.0, distance, 0.0);
  return options;
}

TEST(LivePhotons, FarLamp_SendsFewerPhotonsOfAsMuchPower) {
  const LoadedScene loaded("rooms");
  const Live near(loaded, thinnedOptions(loaded, 0.5)), far(loaded, thinnedOptions(loaded, 100.0));
  EXPECT_EQ(near.photons().pathCount(), 16000u);
  EXPECT_EQ(far.photons().pathCount(), 1000u);
  const double power = powerOf(near.photons().photons());
  EXPECT_NEAR(powerOf(far.photons().photons()), power, 0.05 * power);
}

TEST(LivePhotons, EyeThatWalks_BringsThePhotonsOfItsPlaceAndKeepsTheirPower) {
  const LoadedScene loaded("rooms");
  const LivePhotonOptions there = thinnedOptions(loaded, 100.0), here = thinnedOptions(loaded, 0.5);
  Live live(loaded, there);
  const double power = powerOf(live.photons().photons());
  for (const LivePhotonOptions& options : {here, there}) {
    live.look(*options.thinning.eye);
    int frames = 0;
    while (!live.photons().settled()) {
      const std::uint64_t before = live.photons().pathCount();
      const PhotonFrame frame = live.advance();
      const std::uint64_t now = live.photons().pathCount();
      EXPECT_EQ(frame.traced, now > before ? before : 0u);
      EXPECT_EQ(std::max(now, before), 2 * std::min(now, before));
      EXPECT_NEAR(powerOf(live.photons().photons()), power, 0.05 * power);
      ASSERT_LE(++frames, 4);
    }
    EXPECT_EQ(frames, 4);
    const Live anew(loaded, options);
    EXPECT_EQ(live.photons().pathCount(), anew.photons().pathCount());
    EXPECT_EQ(lacking(live.photons().photons(), anew.photons().photons()), 0u);
    EXPECT_EQ(lacking(anew.photons().photons(), live.photons().photons()), 0u);
  }
}

TEST(LivePhotons, ObjectMovedFarFromTheEye_LeavesThePhotonsOfATracingAnew) {
  const LoadedScene loaded("rooms");
  const LivePhotonOptions options = thinnedOptions(loaded, 100.0);
  Live live(loaded, options);
  live.move("Left crate", shifted(0.3, 0.2, 0.0));
  EXPECT_LE(live.advance().traced, 1000u);
  EXPECT_TRUE(live.photons().settled());
  LoadedScene moved = loaded;
  moved.compiled = live.scene().compiled();
  const Live anew(moved, options);
  EXPECT_LE(lacking(live.photons().photons(), anew.photons().photons()), 2u);
}

TEST(LivePhotons, CausticsOfAFarLamp_AreNotThinned) {
  const LoadedScene loaded("caustics");
  LivePhotonOptions options = optionsOf(PhotonKind::Caustic, 4000);
  const Live all(loaded, options);
  options.thinning = {0.01, glm::dvec3(1000.0)};
  EXPECT_EQ(Live(loaded, options).photons().pathCount(), all.photons().pathCount());
}

}  // namespace
}  // namespace prelight::test
