#include "viewer/techniques/vector_occluders/occluder_pass.h"

#include <algorithm>
#include <array>
#include <utility>

#include "occluders/wave_table.h"

namespace prelight::viewer {
namespace {

/// Records x lights of a draw: drivers end what runs for seconds.
constexpr std::size_t mostPairs = std::size_t{1} << 22;

/// Units of the passes' own programs.
enum PassUnit : GLuint {
  recordsUnit,
  ownersUnit,
  offsetsUnit,
  receiversUnit,
  wavesUnit,
  preparedUnit,
  lightsUnit
};

void nameUnits(const gl::Program& program) {
  constexpr std::array<std::pair<const char*, PassUnit>, 7> samplers = {{{"records", recordsUnit},
                                                                         {"owners", ownersUnit},
                                                                         {"offsets", offsetsUnit},
                                                                         {"receivers", receiversUnit},
                                                                         {"waves", wavesUnit},
                                                                         {"prepared", preparedUnit},
                                                                         {"lights", lightsUnit}}};
  program.use();
  for (const auto& [name, unit] : samplers) program.set(name, static_cast<int>(unit));
}

void setTerms(const gl::Program& program, const device::OccluderTerms& terms) {
  program.set("terms.stored", terms.stored);
  program.set("terms.stride", terms.stride);
  program.set("terms.lightCount", terms.lightCount);
  program.set("terms.thesisFormula", terms.thesisFormula);
  program.set("terms.thesisMirrors", terms.thesisMirrors);
  program.set("terms.orenNayar", terms.orenNayar);
  program.set("terms.shadowStrength", terms.shadowStrength);
  program.set("terms.causticStrength", terms.causticStrength);
  program.set("terms.bleeding", terms.bleeding);
  program.set("terms.diffuseFromSpecular", terms.diffuseFromSpecular);
  program.set("terms.specularFromSpecular", terms.specularFromSpecular);
  program.set("terms.specularExponent", terms.specularExponent);
  program.set("terms.waves", terms.waves);
  program.set("terms.waveNumber", terms.waveNumber);
  program.set("terms.moment", terms.moment);
  program.set("terms.fire", terms.fire);
  program.set("terms.eyeIsPoint", terms.eyeIsPoint);
  program.set("terms.eyeX", terms.eyeX);
  program.set("terms.eyeY", terms.eyeY);
  program.set("terms.eyeZ", terms.eyeZ);
  program.set("terms.normalWaves", terms.normalWaves);
}

/// The outputs of occluder_records.vert that are captured for a stride of OccluderUpload.
std::vector<const char*> preparedNames(int stored) {
  std::vector<const char*> names = {"prepared0", "prepared1", "prepared2", "prepared3", "prepared4"};
  if ((stored & (PRELIGHT_STORES_TRANSMISSIVE | PRELIGHT_STORES_CAUSTIC)) != 0)
    names.insert(names.end(), {"opacity", "caustic", "carried"});
  if ((stored & PRELIGHT_STORES_SPECULAR) != 0)
    names.insert(names.end(), {"mirrored", "mirrorNormal", "mirrorColor"});
  return names;
}

template <typename T>
gl::BufferTexture asTexels(std::span<const T> values, const char* what) {
  return gl::makeBufferTexture(std::as_bytes(values), values.size_bytes() / sizeof(glm::vec4), GL_RGBA32F,
                               what);
}

}  // namespace

OccluderPass::OccluderPass(const OccluderTransfer& transfer, const glm::dvec3& origin,
                           std::span<const device::OccluderReceiverPoint> points)
    : upload_(transfer, origin),
      vertices_(points.size()),
      prepareProgram_("occluder_records.vert", preparedNames(upload_.stored)),
      lightProgram_("occluders.vert", {"litDiffuse", "litSpecular", "litReflected"}),
      receivers_(asTexels(points, "receivers of vector occluders")),
      waves_(asTexels(std::span<const glm::vec4>(makeWaveTable()), "waves")) {
  const std::vector<device::LitVertex> dark(vertices_);
  lit_.fill(GL_TRANSFORM_FEEDBACK_BUFFER, std::span<const device::LitVertex>(dark), GL_DYNAMIC_COPY);
  upload(transfer);
  nameUnits(prepareProgram_);
  nameUnits(lightProgram_);
  gl::check("preparing vector occluders");
}

void OccluderPass::upload(const OccluderTransfer& transfer) {
  records_ = asTexels(std::span<const glm::vec4>(upload_.records), "records of vector occluders");
  owners_ = gl::makeBufferTexture(std::span<const std::int32_t>(upload_.owners), 1, GL_R32I,
                                  "vertices of vector occluders");
  offsets_ = gl::makeBufferTexture(std::span<const std::uint32_t>(transfer.offsets), 1, GL_R32UI,
                                   "offsets of vector occluders");
  const std::size_t texels = upload_.owners.size() * static_cast<std::size_t>(upload_.stride);
  if (texels > preparedTexels_) {
    prepared_ =
        asTexels(std::span<const glm::vec4>(std::vector<glm::vec4>(texels)), "prepared vector occluders");
    preparedTexels_ = texels;
  }
  upload_.records = {};
  preparedFor_.reset();
}

void OccluderPass::setTransfer(const OccluderTransfer& transfer, const glm::dvec3& origin) {
  upload_ = OccluderUpload(transfer, origin);
  upload(transfer);
  gl::check("replacing vector occluders");
}

void OccluderPass::setReceivers(std::span<const device::OccluderReceiverPoint> points) {
  receivers_.buffer.fill(GL_TEXTURE_BUFFER, points, GL_STATIC_DRAW);
}

void OccluderPass::prepare(const device::OccluderTerms& terms) {
  if (preparedFor_ && samePreparation(*preparedFor_, terms)) return;
  prepareProgram_.use();
  setTerms(prepareProgram_, terms);
  gl::bind(recordsUnit, GL_TEXTURE_BUFFER, records_.texture);
  gl::bind(ownersUnit, GL_TEXTURE_BUFFER, owners_.texture);
  gl::bind(preparedUnit, GL_TEXTURE_BUFFER, gl::Texture(0));
  gl::Capture::run(prepared_.buffer.name(), upload_.owners.size(), mostPairs);
  preparedFor_ = terms;
}

void OccluderPass::light(std::span<const device::OccluderLight> lights, const OccluderShading& shading,
                         const OccluderEye& eye) {
  const device::OccluderTerms terms = upload_.terms(shading, eye, lights.size());
  lights_ = asTexels(lights, "lights of vector occluders");
  capture_.begin();
  glBindVertexArray(noVertices_.name());
  gl::bind(receiversUnit, GL_TEXTURE_BUFFER, receivers_.texture);
  gl::bind(wavesUnit, GL_TEXTURE_BUFFER, waves_.texture);
  prepare(terms);
  lightProgram_.use();
  setTerms(lightProgram_, terms);
  gl::bind(offsetsUnit, GL_TEXTURE_BUFFER, offsets_.texture);
  gl::bind(preparedUnit, GL_TEXTURE_BUFFER, prepared_.texture);
  gl::bind(lightsUnit, GL_TEXTURE_BUFFER, lights_.texture);
  const std::size_t pairs = (upload_.longestRow + 1) * std::max<std::size_t>(lights.size(), 1);
  gl::Capture::run(lit_.name(), vertices_, std::max<std::size_t>(mostPairs / pairs, 256));
  glBindVertexArray(0);
  gl::check("lighting vector occluders");
}

std::vector<device::LitVertex> OccluderPass::read() const {
  std::vector<device::LitVertex> result(vertices_);
  glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, lit_.name());
  glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0,
                     static_cast<GLsizeiptr>(result.size() * sizeof(device::LitVertex)), result.data());
  gl::check("reading lit vertices");
  return result;
}

}  // namespace prelight::viewer
