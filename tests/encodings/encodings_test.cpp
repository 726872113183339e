#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "encodings/analytic_light.h"
#include "encodings/registry/registry.h"

namespace prelight {

/// Prints test parameters by name in messages.
void PrintTo(const Encoding& encoding, std::ostream* out) { *out << encoding.name; }

namespace {

using test::AnalyticLight;
using test::LightSum;

/// Accuracy that an encoding promises.
struct Promise {
  bool constantExact;  ///< Exact for light that is the same from everywhere, above and below.
  bool skyExact;       ///< Exact for an even sky over the surface alone.
  double error;        ///< Rms over surfaceLights() and normals up to 45 degrees from the surface's.
  double lampError;    ///< Rms for a lamp at 40 degrees from the normal.
};

const std::map<std::string, Promise, std::less<>>& promises() {
  static const std::map<std::string, Promise, std::less<>> all = {
      {"sh-2", {true, true, 0.21, 0.21}},
      {"sh-3", {true, true, 0.041, 0.045}},
      {"sky-and-lamp", {false, true, 0.165, 0.0002}},
      {"hemisphere", {true, true, 0.30, 0.39}},
      {"trilight", {true, true, 0.082, 0.0045}},
      {"ambient-cube", {true, false, 0.14, 0.19}},
      {"sg-6", {false, false, 0.105, 0.091}},
      {"sg-9", {false, false, 0.080, 0.066}},
      {"sg-12", {false, false, 0.058, 0.051}},
      {"sg-24", {false, false, 0.025, 0.026}},
      {"h-basis-4", {true, true, 0.068, 0.057}},
      {"h-basis-6", {true, true, 0.066, 0.056}},
      {"zh3", {true, true, 0.087, 0.041}},
      {"zh3-hallucinated", {true, false, 0.185, 0.048}},
      {"dominant-direction", {true, true, 0.088, 0.0035}},
      {"dominant-directions-2", {true, true, 0.042, 0.0035}},
      {"dominant-directions-3", {true, true, 0.041, 0.0035}},
      {"ahd", {true, true, 0.12, 0.0035}},
      {"half-life-2", {true, false, 0.165, 0.21}},
  };
  return all;
}

std::vector<float> encoded(const Encoding& encoding, const std::vector<float>& incident,
                           const glm::dmat3& frame) {
  std::vector<float> values(encoding.values, std::numeric_limits<float>::quiet_NaN());
  encoding.encode(incident, glm::mat3(frame), values);
  return values;
}

/// Rms difference, over normals, from the reference sums, relative to the irradiance at the surface's own
/// normal.
double relativeError(const Encoding& encoding, const AnalyticLight& light, double degrees) {
  const glm::dmat3 frame = test::obliqueFrame();
  const LightSum sum(light, frame);
  const std::vector<float> values = encoded(encoding, sum.incident(), frame);
  const std::vector<glm::dvec3> normals = test::normalsWithin(degrees, frame, 60);
  double squares = 0.0;
  for (const glm::dvec3& normal : normals) {
    const glm::dvec3 found(encoding.irradiance(values, glm::mat3(frame), glm::vec3(normal)));
    const glm::dvec3 difference = found - sum.irradiance(normal);
    squares += glm::dot(difference, difference);
  }
  return std::sqrt(squares / static_cast<double>(normals.size())) / glm::length(sum.irradiance(frame[2]));
}

class EveryEncoding : public testing::TestWithParam<Encoding> {
 protected:
  const Promise& promise() const { return promises().find(GetParam().name)->second; }
};

INSTANTIATE_TEST_SUITE_P(Registry, EveryEncoding, testing::ValuesIn(encodings().begin(), encodings().end()),
                         [](const testing::TestParamInfo<Encoding>& tested) {
                           std::string name(tested.param.name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Encodings, Names_AreFoundAndDiffer) {
  std::set<std::string_view> names;
  for (const Encoding& encoding : encodings()) {
    EXPECT_TRUE(names.insert(encoding.name).second) << encoding.name;
    ASSERT_NE(encodingNamed(encoding.name), nullptr);
    EXPECT_EQ(encodingNamed(encoding.name)->name, encoding.name);
    EXPECT_FALSE(encoding.summary.empty());
    EXPECT_EQ(promises().count(encoding.name), 1u) << encoding.name << " promises nothing";
  }
  EXPECT_EQ(names.size(), promises().size());
  EXPECT_EQ(encodingNamed("no such thing"), nullptr);
}

TEST_P(EveryEncoding, ConstantLight_IsExactWherePromised) {
  const double error = relativeError(GetParam(), test::constantLight({0.2, 1.0, 3.0}), 80.0);
  if (promise().constantExact)
    EXPECT_LT(error, 2e-4);  // The sums' own error is 1e-5.
  else
    EXPECT_GT(error, 2e-4) << "the promise is too modest";
}

TEST_P(EveryEncoding, EvenSky_IsExactWherePromised) {
  const double error = relativeError(GetParam(), test::surfaceLights().front(), 80.0);
  if (promise().skyExact)
    EXPECT_LT(error, 2e-4);
  else
    EXPECT_GT(error, 2e-4) << "the promise is too modest";
}

TEST_P(EveryEncoding, Lamp_IsWithinItsBound) {
  const double error = relativeError(GetParam(), test::lamp(10.0, 40.0), 45.0);
  RecordProperty("error", std::to_string(error));
  EXPECT_LT(error, promise().lampError);
  EXPECT_GT(error, 0.7 * promise().lampError) << "the bound is too wide";
}

TEST_P(EveryEncoding, LightsOfManyKinds_AreWithinTheirBound) {
  double squares = 0.0;
  const std::vector<AnalyticLight> lights = test::surfaceLights();
  for (const AnalyticLight& light : lights) {
    const double error = relativeError(GetParam(), light, 45.0);
    squares += error * error;
  }
  const double error = std::sqrt(squares / static_cast<double>(lights.size()));
  RecordProperty("error", std::to_string(error));
  EXPECT_LT(error, promise().error);
  EXPECT_GT(error, 0.7 * promise().error) << "the bound is too wide";
}

/// Zero, huge and one-coloured light, and coefficients that no light can have.
TEST_P(EveryEncoding, UnusualLight_GivesFiniteIrradianceThatIsNeverNegative) {
  const glm::dmat3 frame = test::obliqueFrame();
  std::vector<std::vector<float>> inputs = {std::vector<float>(3 * incidentTerms, 0.0f)};
  for (const AnalyticLight& light : test::surfaceLights()) {
    const std::vector<float> incident = LightSum(light, frame).incident();
    std::vector<float> huge = incident, tiny = incident, red = incident;
    for (float& value : huge) value *= 1e6f;
    for (float& value : tiny) value *= 1e-12f;
    std::fill(red.begin() + incidentTerms, red.end(), 0.0f);
    inputs.insert(inputs.end(), {incident, huge, tiny, red});
  }
  for (std::size_t i = 0; i < incidentTerms; ++i) {
    inputs.emplace_back(3 * incidentTerms, 0.0f);
    inputs.back()[incidentTerms + i] = i % 2 == 0 ? 1.0f : -1.0f;
  }
  for (const std::vector<float>& incident : inputs) {
    const std::vector<float> values = encoded(GetParam(), incident, frame);
    for (const float value : values) EXPECT_TRUE(std::isfinite(value));
    for (const glm::dvec3& normal : test::normalsWithin(180.0, frame, 50)) {
      const glm::vec3 found = GetParam().irradiance(values, glm::mat3(frame), glm::vec3(normal));
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_TRUE(std::isfinite(found[channel]));
        EXPECT_GE(found[channel], 0.0f);
      }
    }
  }
}

/// Light of one channel does not leak into the others.
TEST_P(EveryEncoding, LightOfOneChannel_StaysThere) {
  const glm::dmat3 frame = test::obliqueFrame();
  std::vector<float> incident = LightSum(test::lamp(30.0, 30.0), frame).incident();
  std::fill(incident.begin(), incident.begin() + 2 * incidentTerms, 0.0f);
  const std::vector<float> values = encoded(GetParam(), incident, frame);
  for (const glm::dvec3& normal : test::normalsWithin(60.0, frame, 20)) {
    const glm::vec3 found = GetParam().irradiance(values, glm::mat3(frame), glm::vec3(normal));
    EXPECT_EQ(found.x, 0.0f);
    EXPECT_EQ(found.y, 0.0f);
    EXPECT_GT(found.z, 0.0f);
  }
}

TEST_P(EveryEncoding, ValuesBesideItsOwn_StayAsTheyAre) {
  const glm::dmat3 frame = test::obliqueFrame();
  const std::vector<float> incident = LightSum(test::surfaceLights()[4], frame).incident();
  std::vector<float> values(GetParam().values + 2, -7.0f);
  GetParam().encode(incident, glm::mat3(frame), std::span(values).subspan(1, GetParam().values));
  EXPECT_EQ(values.front(), -7.0f);
  EXPECT_EQ(values.back(), -7.0f);
  for (std::size_t i = 1; i + 1 < values.size(); ++i) EXPECT_NE(values[i], -7.0f) << i;
}

TEST_P(EveryEncoding, BrighterLight_IsBrighterByTheSameFactor) {
  const glm::dmat3 frame = test::obliqueFrame();
  std::vector<float> incident = LightSum(test::surfaceLights()[3], frame).incident();
  const std::vector<float> once = encoded(GetParam(), incident, frame);
  for (float& value : incident) value *= 1024.0f;
  const std::vector<float> often = encoded(GetParam(), incident, frame);
  for (const glm::dvec3& normal : test::normalsWithin(60.0, frame, 20)) {
    const glm::vec3 a = GetParam().irradiance(once, glm::mat3(frame), glm::vec3(normal)),
                    b = GetParam().irradiance(often, glm::mat3(frame), glm::vec3(normal)) / 1024.0f;
    EXPECT_LT(glm::distance(a, b), 1e-4f * glm::length(a));
  }
}

/// Values along the world's axes do not depend on the direction of the tangents; values along the frame's
/// axes turn with it.
TEST_P(EveryEncoding, FramesTurnedAroundTheNormal_ChangeWhatIsInTheirTerms) {
  const glm::dmat3 frame = test::obliqueFrame();
  const double c = std::cos(0.7), s = std::sin(0.7);
  const glm::dmat3 turned(c * frame[0] + s * frame[1], c * frame[1] - s * frame[0], frame[2]);
  const std::vector<float> incident = LightSum(test::surfaceLights()[3], frame).incident();
  const std::vector<float> first = encoded(GetParam(), incident, frame),
                           second = encoded(GetParam(), incident, turned);
  float most = 0.0f, change = 0.0f;
  for (std::size_t i = 0; i < first.size(); ++i) {
    most = std::max(most, std::abs(first[i]));
    change = std::max(change, std::abs(first[i] - second[i]));
  }
  if (GetParam().inFrame)
    EXPECT_GT(change, 0.05f * most);
  else
    EXPECT_LT(change, 0.05f * most);
}

/// Fits with more freedom are no worse by the measure that they minimise: rms over the hemisphere of normals,
/// cosine-weighted, for the bands of light that they are given.
TEST(Encodings, ThatExtendOthers_AreNoWorse) {
  const glm::dmat3 frame = test::obliqueFrame();
  const std::vector<glm::dvec3> normals = test::normalsWithin(90.0, frame, 2000);
  const std::vector<std::pair<const char*, const char*>> pairs = {
      {"sh-2", "zh3"},
      {"hemisphere", "dominant-direction"},
      {"dominant-direction", "dominant-directions-2"},
      {"dominant-directions-2", "dominant-directions-3"},
      {"h-basis-4", "h-basis-6"},
      {"hemisphere", "h-basis-4"}};
  for (const AnalyticLight& light : test::surfaceLights()) {
    const std::vector<float> incident = LightSum(light, frame).incident();
    const auto error = [&](const char* name) {
      const Encoding& encoding = *encodingNamed(name);
      const std::vector<float> values = encoded(encoding, incident, frame);
      double squares = 0.0;
      for (const glm::dvec3& normal : normals) {
        const glm::dvec3 wanted = test::irradianceOfBands(incident, normal);
        const glm::dvec3 difference =
            glm::dvec3(encoding.irradiance(values, glm::mat3(frame), glm::vec3(normal))) - wanted;
        squares += glm::dot(normal, frame[2]) * glm::dot(difference, difference);
      }
      return std::sqrt(squares / static_cast<double>(normals.size()));
    };
    const double scale = glm::length(test::irradianceOfBands(incident, frame[2]));
    for (const auto& [simple, extended] : pairs)
      EXPECT_LT(error(extended), 1.001 * error(simple) + 1e-5 * scale)
          << extended << " against " << simple << ", " << light.name;
  }
}

}  // namespace
}  // namespace prelight
