#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "base/resumable_run.h"
#include "prelight/error.h"
#include "support/bakes_of_everything.h"
#include "support/devices.h"
#include "support/gltf_files.h"
#include "support/resumed.h"
#include "support/scenes.h"
#include "support/spoiled.h"

namespace prelight {
namespace {

using namespace test;

/// Bakes in a folder of its own. It keeps every state that was saved, and can start from one of them.
class KeptBake {
 public:
  /// `start` is a state to resume from; empty starts anew.
  explicit KeptBake(const std::string& start = {}) {
    if (!start.empty()) test::writeBytes(path_, start);
  }

  Bake bake(const CompiledScene& scene, const BakeRequest& request, const Plan& plan,
            const Scene* source = nullptr) {
    ResumableRun run(path_, "bake", 0.0, [&] {
      EXPECT_EQ(run.failure(), "");
      if (std::filesystem::exists(path_)) keep(test::readBytes(path_));
    });
    Progress outer;
    BakeReport report;
    return bakeScene(scene, request, plan, test::sharedDevice(), run.begin({}, outer, StateUse::Continue),
                     report, nullptr, source);
  }
  Bake bake(const CompiledScene& scene, const BakeRequest& request) {
    return bake(scene, request, makePlan(Scene(), scene, request));
  }

  std::vector<std::string> states;  ///< At most `most` states, evenly spaced.

 private:
  void keep(std::string state) {
    constexpr std::size_t most = 64;
    if (count_++ % stride_ != 0) return;
    states.push_back(std::move(state));
    if (states.size() < most) return;
    for (std::size_t i = 1; i < most / 2; ++i) states[i] = std::move(states[2 * i]);
    states.resize(most / 2);
    stride_ *= 2;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "a.state";
  std::size_t count_ = 0, stride_ = 1;
};

/// Resumes from states of all times, as if the process had been killed after saving each.
void expectSameFromAnyState(const BakeRequest& request, std::size_t tried = 12) {
  const CompiledScene scene = groundAndSphere();
  const Scene source;
  const Plan plan = makePlan(source, scene, request);
  KeptBake kept;
  const Bake whole = kept.bake(scene, request, plan, &source);
  ASSERT_GT(kept.states.size(), 2u);
  const std::size_t stride = std::max<std::size_t>(1, kept.states.size() / tried);
  for (std::size_t i = 0; i < kept.states.size(); i += stride) {
    SCOPED_TRACE(i);
    expectSame(KeptBake(kept.states[i]).bake(scene, request, plan, &source), whole);
  }
}

TEST(BakeState, OfVertices_EndsAsIfNeverEnded) { expectSameFromAnyState(vertexRequest()); }
TEST(BakeState, OfOccluders_EndsAsIfNeverEnded) { expectSameFromAnyState(occluderRequest()); }
TEST(BakeState, OfABakeToAnError_EndsAsIfNeverEnded) { expectSameFromAnyState(errorRequest()); }
TEST(BakeState, OfRadiosity_EndsAsIfNeverEnded) { expectSameFromAnyState(radiosityRequest()); }
TEST(BakeState, OfALightMapToBeEncoded_EndsAsIfNeverEnded) { expectSameFromAnyState(lightMapRequest()); }
TEST(BakeState, OfTexelSizes_EndsAsIfNeverEnded) { expectSameFromAnyState(texelErrorRequest()); }

TEST(BakeState, StoppedAgainAndAgain_EndsAsIfNeverStopped) {
  const CompiledScene scene = groundAndSphere();
  const Scene source;
  for (const BakeRequest& request : {vertexRequest(), radiosityRequest(), texelErrorRequest()}) {
    const Plan plan = makePlan(source, scene, request);
    const auto bake = [&](Progress& progress) {
      BakeReport report;
      return bakeScene(scene, request, plan, test::sharedDevice(), progress, report, nullptr, &source);
    };
    Progress progress;
    expectSame(test::inManyRuns(bake), bake(progress));
  }
}

using Bytes = std::vector<std::byte>;

/// A copy of a state in which change(number of the record or array, its bytes) altered the bytes. The hashes
/// match the altered bytes.
std::string altered(const std::string& state, const std::function<void(std::size_t, Bytes&)>& change) {
  const test::TemporaryFolder folder;
  test::writeBytes(folder / "from", state);
  const StateLog from = std::move(*StateLog::open(folder / "from", "bake", {}));
  {
    StateLog to(folder / "to", "bake", {});
    std::size_t number = 0;
    for (const std::string& name : from.names()) {
      Bytes bytes = from.read(name);
      change(number++, bytes);
      to.write(name, [&](const StateWriter::Sink& sink) { sink(bytes); });
    }
    for (const StateLog::ArrayShape& array : from.arrays()) {
      Bytes bytes;
      from.readArray(array.name, array.count, array.elementSize,
                     [&](std::uint64_t, std::span<const std::byte> some) {
                       bytes.insert(bytes.end(), some.begin(), some.end());
                     });
      change(number++, bytes);
      to.writeArray(array.name, array.epoch, array.count, array.elementSize,
                    [&](std::uint64_t first, std::uint64_t count) {
                      return std::span(bytes).subspan(first * array.elementSize, count * array.elementSize);
                    });
    }
    to.commit(0.0);
  }
  return test::readBytes(folder / "to");
}

std::size_t partsOf(const std::string& state) {
  std::size_t parts = 0;
  (void)altered(state, [&](std::size_t, Bytes&) { ++parts; });
  return parts;
}

TEST(BakeState, AlteredPayload_IsRefusedOrHarmless) {
  const CompiledScene scene = groundAndSphere();
  const Scene source;
  std::mt19937 random(17);
  int refused = 0;
  for (const BakeRequest& request :
       {vertexRequest(), occluderRequest(), radiosityRequest(), lightMapRequest(), texelErrorRequest()}) {
    const Plan plan = makePlan(source, scene, request);
    KeptBake kept;
    (void)kept.bake(scene, request, plan, &source);
    for (int i = 0; i < 8; ++i) {
      const std::string& state = kept.states[random() % kept.states.size()];
      const std::size_t parts = partsOf(state);
      if (parts == 0) continue;
      const std::size_t chosen = random() % parts;
      KeptBake from(altered(state, [&](std::size_t number, Bytes& bytes) {
        if (number == chosen && bytes.size() > 1) spoil(bytes, random);
      }));
      try {
        const Bake result = from.bake(scene, request, plan, &source);
        std::vector<float> values = result.ao;
        if (result.sh)
          values.insert(values.end(), result.sh->coefficients.begin(), result.sh->coefficients.end());
        if (result.lightMap)
          values.insert(values.end(), result.lightMap->values.begin(), result.lightMap->values.end());
        for (const float value : values) ASSERT_TRUE(std::isfinite(value));
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 4);
}

/// If they were accepted, a bounce would read far outside its buffers.
TEST(BakeState, SendersOutsideTheScene_AreRefused) {
  const CompiledScene scene = groundAndSphere();
  KeptBake kept;
  (void)kept.bake(scene, vertexTransferRequest(1));
  // The senders are the largest record.
  std::vector<std::size_t> sizes;
  (void)altered(kept.states.back(), [&](std::size_t, Bytes& bytes) { sizes.push_back(bytes.size()); });
  const auto largest = static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  KeptBake from(altered(kept.states.back(), [&](std::size_t number, Bytes& bytes) {
    if (number == largest) std::fill(bytes.end() - 800, bytes.end(), std::byte{0x7f});
  }));
  EXPECT_THROW((void)from.bake(scene, vertexTransferRequest(1)), InputError);
}

/// The cast's record begins with its step and whether it is finished; the seconds follow.
TEST(BakeState, SecondsThatNoClockHolds_AreRefused) {
  const CompiledScene scene = groundAndSphere();
  KeptBake kept;
  (void)kept.bake(scene, vertexTransferRequest(0));
  for (const double seconds : {1e300, -1.0, std::nan(""), 1e10}) {
    KeptBake from(altered(kept.states.front(), [&](std::size_t number, Bytes& bytes) {
      if (number == 0) std::memcpy(&bytes[sizeof(std::uint64_t) + 1], &seconds, sizeof seconds);
    }));
    EXPECT_THROW((void)from.bake(scene, vertexTransferRequest(0)), InputError) << seconds;
  }
}

}  // namespace
}  // namespace prelight
