// The GLSL of each encoding compared with its C++.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "encodings/registry/registry.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/egl_context.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/object.h"

namespace prelight {

void PrintTo(const Encoding& encoding, std::ostream* out) { *out << encoding.name; }

namespace {

using namespace viewer;

constexpr int cases = 200;

struct Place {
  std::vector<float> values;
  glm::mat3 frame;
  glm::vec3 normal;
};

glm::vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<float> normal;
  glm::vec3 d;
  do d = {normal(random), normal(random), normal(random)};
  while (glm::length(d) < 0.1f);
  return glm::normalize(d);
}

/// Values that come from light, and values that do not: interpolated values may not either.
std::vector<Place> randomPlaces(const Encoding& encoding) {
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  std::vector<Place> places;
  for (int i = 0; i < cases; ++i) {
    Place place;
    const glm::vec3 n = randomDirection(random), t = glm::normalize(glm::cross(n, randomDirection(random)));
    place.frame = {t, glm::cross(n, t), n};
    place.normal = randomDirection(random);
    if (glm::dot(place.normal, n) < 0.0f && i % 8 != 0) place.normal = -place.normal;
    place.values.assign(encoding.values, 0.0f);
    if (i % 2 == 0) {
      std::vector<float> incident(3 * incidentTerms);
      for (std::size_t k = 0; k < incident.size(); ++k)
        incident[k] = k % incidentTerms == 0 ? 5.0f + normal(random) : normal(random);
      encoding.encode(incident, place.frame, place.values);
    } else if (i > 1) {
      for (float& value : place.values) value = 1.0f + normal(random);
    }
    places.push_back(std::move(place));
  }
  return places;
}

struct ShaderTraits {
  static void destroy(GLuint name) { glDeleteShader(name); }
};

/// A shader with one vertex per case, whose irradiance is captured.
std::string vertexShader(const Encoding& encoding) {
  return "#version 330 core\n" + std::string(encoding.shader) +
         "\nuniform samplerBuffer numbers;\n"
         "out vec3 found;\n"
         "void main() {\n"
         "  int at = gl_VertexID * (encodedValueCount + 12);\n"
         "  float v[encodedValueCount];\n"
         "  for (int i = 0; i < encodedValueCount; ++i) v[i] = texelFetch(numbers, at + i).x;\n"
         "  at += encodedValueCount;\n"
         "  vec3 column[4];\n"
         "  for (int i = 0; i < 4; ++i)\n"
         "    column[i] = vec3(texelFetch(numbers, at + 3 * i).x, texelFetch(numbers, at + 3 * i + 1).x,\n"
         "                     texelFetch(numbers, at + 3 * i + 2).x);\n"
         "  found = encodedIrradiance(v, mat3(column[0], column[1], column[2]), column[3]);\n"
         "}\n";
}

gl::Object<gl::ProgramTraits> program(const std::string& text) {
  gl::Object<ShaderTraits> shader(glCreateShader(GL_VERTEX_SHADER));
  const char* source = text.c_str();
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  std::string log(10000, '\0');
  glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  EXPECT_EQ(compiled, GL_TRUE) << log.c_str() << text;
  gl::Object<gl::ProgramTraits> made;
  glAttachShader(made.name(), shader.name());
  const char* captured = "found";
  glTransformFeedbackVaryings(made.name(), 1, &captured, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(made.name());
  glGetProgramiv(made.name(), GL_LINK_STATUS, &compiled);
  EXPECT_EQ(compiled, GL_TRUE);
  return made;
}

std::vector<float> packed(const std::vector<Place>& places) {
  std::vector<float> numbers;
  for (const Place& place : places) {
    numbers.insert(numbers.end(), place.values.begin(), place.values.end());
    for (const glm::vec3& column : {place.frame[0], place.frame[1], place.frame[2], place.normal})
      numbers.insert(numbers.end(), {column.x, column.y, column.z});
  }
  return numbers;
}

std::vector<glm::vec3> runShader(const Encoding& encoding, const std::vector<Place>& places) {
  // OpenGL draws nothing without a framebuffer, not even for transform feedback.
  const gl::Framebuffer target(1, 1);
  target.bind();
  const gl::VertexArray vertices;
  glBindVertexArray(vertices.name());
  const gl::Object<gl::ProgramTraits> shader = program(vertexShader(encoding));
  glUseProgram(shader.name());
  const std::vector<float> numbers = packed(places);
  const gl::Buffer input(GL_TEXTURE_BUFFER, std::span<const float>(numbers));
  const gl::Object<gl::TextureTraits> texture;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_BUFFER, texture.name());
  glTexBuffer(GL_TEXTURE_BUFFER, GL_R32F, input.name());
  glUniform1i(glGetUniformLocation(shader.name(), "numbers"), 0);
  std::vector<glm::vec3> found(places.size(), glm::vec3(-1.0f));
  const gl::Buffer output(GL_TRANSFORM_FEEDBACK_BUFFER, std::span<const glm::vec3>(found));
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, output.name());
  glEnable(GL_RASTERIZER_DISCARD);
  glBeginTransformFeedback(GL_POINTS);
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(places.size()));
  glEndTransformFeedback();
  glFinish();
  glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0,
                     static_cast<GLsizeiptr>(found.size() * sizeof(glm::vec3)), found.data());
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  return found;
}

class EncodingShader : public testing::TestWithParam<Encoding> {};

INSTANTIATE_TEST_SUITE_P(Registry, EncodingShader, testing::ValuesIn(encodings().begin(), encodings().end()),
                         [](const testing::TestParamInfo<Encoding>& tested) {
                           std::string name(tested.param.name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Rounding errors are relative to the summed terms, whose size the values indicate.
TEST_P(EncodingShader, Irradiance_IsThatOfTheHost) {
  const gl::EglContext context;
  const std::vector<Place> places = randomPlaces(GetParam());
  const std::vector<glm::vec3> found = runShader(GetParam(), places);
  int lit = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::vec3 wanted = GetParam().irradiance(places[i].values, places[i].frame, places[i].normal);
    float size = glm::length(wanted);
    for (const float value : places[i].values) size = std::max(size, std::abs(value));
    EXPECT_LE(glm::distance(found[i], wanted), 1e-5f * size) << i;
    lit += glm::length(wanted) > 0.05f * size;
  }
  EXPECT_GT(lit, cases / 2);
}

}  // namespace
}  // namespace prelight
