#include "viewer/hemisphere/disc_pictures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <vector>

#include "scene/compile/compile_parts.h"

namespace prelight::viewer {
namespace {

/// Vertices of a draw call at most: a second of a slow GPU, beyond which some systems reset it.
constexpr std::size_t verticesAtOnce = std::size_t{1} << 26;
constexpr std::uint32_t noFilter = 16;  ///< disc.frag, textureAlpha
constexpr GLint cornersUnit = 0, receiversUnit = 1, holedUnit = 2, radianceUnit = 3, holesUnit = 4,
                alphasUnit = 5;

std::array<std::uint32_t, 4> bitsOf(const glm::vec3& v, std::uint32_t last = 0) {
  return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
          std::bit_cast<std::uint32_t>(v.z), last};
}

template <std::size_t count>
void append(std::vector<std::uint32_t>& to, const std::array<std::uint32_t, count>& bits) {
  to.insert(to.end(), bits.begin(), bits.end());
}

std::vector<glm::vec3> cornersOf(const CompiledScene& scene) {
  std::vector<glm::vec3> corners;
  corners.reserve(3 * scene.triangles.size());
  for (const glm::uvec3& t : scene.triangles)
    for (int c = 0; c < 3; ++c) corners.push_back(scene.positions[t[c]]);
  return corners;
}

/// Coverage of triangles as disc.frag reads it.
class Holes {
 public:
  explicit Holes(const CompiledScene& scene) : scene_(scene) {
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      const CompiledMaterial& m = scene.materials[scene.triangleMaterials[t]];
      holed.push_back(m.alphaCutoff < 0.0f ? 0 : ++count_);
      if (m.alphaCutoff >= 0.0f) add(t, m);
    }
    // Textures of buffers are not empty.
    if (records.empty()) records.resize(16, 0);
    if (alphas.empty()) alphas.push_back(255);
  }

  std::vector<std::uint32_t> holed;    ///< [triangle]
  std::vector<std::uint32_t> records;  ///< [coverage][16]
  std::vector<std::uint8_t> alphas;

 private:
  void add(std::uint32_t triangle, const CompiledMaterial& m) {
    const TextureRef& use = m.baseColorTexture;
    const std::vector<glm::vec2>& coords =
        use.texCoord == 1 && !scene_.texCoords1.empty() ? scene_.texCoords1 : scene_.texCoords;
    std::array<glm::vec2, 3> uv{};
    glm::vec3 alpha(m.alphaFactor);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = scene_.triangles[triangle][c];
      if (use.image >= 0)
        uv[static_cast<std::size_t>(c)] = glm::vec2(use.transform * glm::vec3(coords[v], 1.0f));
      if (scene_.hasVertexColors()) alpha[c] *= scene_.colors[v].w;
    }
    append(records, bitsOf({uv[0], uv[1].x}, std::bit_cast<std::uint32_t>(uv[1].y)));
    append(records, bitsOf({uv[2], m.alphaCutoff}, std::bit_cast<std::uint32_t>(m.blended ? 1.0f : 0.0f)));
    append(records, bitsOf(alpha));
    append(records, textureOf(use));
  }

  std::array<std::uint32_t, 4> textureOf(const TextureRef& use) {
    if (use.image < 0) return {};
    const Image& image = scene_.images[static_cast<std::size_t>(use.image)];
    if (image.rgba.empty()) return {};
    const auto [place, isNew] = firstOf_.try_emplace(use.image, static_cast<std::uint32_t>(alphas.size()));
    for (std::size_t i = 3; isNew && i < image.rgba.size(); i += 4) alphas.push_back(image.rgba[i]);
    return {place->second, static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height),
            deviceWrap(use.wrapS) | deviceWrap(use.wrapT) << 2 |
                (use.filter == TextureFilter::Nearest ? noFilter : 0u)};
  }

  const CompiledScene& scene_;
  std::uint32_t count_ = 0;
  std::map<int, std::uint32_t> firstOf_;  ///< first texel of an image
};

gl::BufferTexture upload(std::span<const std::uint32_t> words, std::size_t perTexel, GLenum format) {
  return gl::makeBufferTexture(words, perTexel, format, "triangles of drawn views");
}

gl::BufferTexture uploadReceivers(std::span<const DiscReceiver> receivers) {
  std::vector<std::uint32_t> words;
  for (const DiscReceiver& r : receivers) {
    append(words, bitsOf(r.position, r.triangle));
    for (int c = 0; c < 3; ++c) append(words, bitsOf(r.frame[c]));
    append(words, bitsOf(r.geometricNormal));
  }
  return upload(words, 4, GL_RGBA32UI);
}

/// Sets what is left of a texel when something is drawn over it.
void setBlending(bool radiance) {
  glDisable(GL_CULL_FACE);
  if (radiance) {
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  } else {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glDisable(GL_DEPTH_TEST);
    glClearColor(1.0f, 1.0f, 1.0f, 1.0f);
  }
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

DiscPictures::DiscPictures(const CompiledScene& scene, bool orthographic, int side, float farthest)
    : side_(side), triangles_(scene.triangleCount()), program_("disc.vert", "disc.frag") {
  const std::vector<glm::vec3> corners = cornersOf(scene);
  corners_ =
      gl::makeBufferTexture(std::span<const glm::vec3>(corners), 1, GL_RGB32F, "triangles of drawn views");
  setRadiance(std::array<glm::vec3, 1>{});
  const Holes holes(scene);
  holed_ = upload(holes.holed, 1, GL_R32UI);
  holes_ = upload(holes.records, 4, GL_RGBA32UI);
  alphas_ =
      gl::makeBufferTexture(std::span<const std::uint8_t>(holes.alphas), 1, GL_R8, "alpha of drawn views");
  program_.use();
  for (const auto& [name, unit] : {std::pair{"corners", cornersUnit}, std::pair{"receivers", receiversUnit},
                                   std::pair{"holed", holedUnit}, std::pair{"radiance", radianceUnit},
                                   std::pair{"holes", holesUnit}, std::pair{"alphas", alphasUnit}})
    program_.set(name, unit);
  program_.set("orthographic", orthographic ? 1 : 0);
  program_.set("farthest", farthest);
}

void DiscPictures::setRadiance(std::span<const glm::vec3> radiance) {
  radiance_ = gl::makeBufferTexture(radiance, 1, GL_RGB32F, "radiance of drawn views");
}

void DiscPictures::draw(const gl::Framebuffer& atlas, std::span<const DiscReceiver> receivers,
                        bool radiance) const {
  atlas.bind();
  setBlending(radiance);
  const gl::BufferTexture uploaded = uploadReceivers(receivers);
  program_.use();
  program_.set("showsRadiance", radiance ? 1 : 0);
  for (const auto& [unit, texture] :
       {std::pair{cornersUnit, &corners_}, std::pair{receiversUnit, &uploaded}, std::pair{holedUnit, &holed_},
        std::pair{radianceUnit, &radiance_}, std::pair{holesUnit, &holes_}, std::pair{alphasUnit, &alphas_}})
    gl::bind(static_cast<GLuint>(unit), GL_TEXTURE_BUFFER, texture->texture);
  drawAll(atlas.width(), receivers.size());
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  gl::check("drawing views of receivers");
}

void DiscPictures::drawAll(int atlasSide, std::size_t count) const {
  const std::size_t most =
      std::max<std::size_t>(1, verticesAtOnce / std::max<std::size_t>(1, 3 * triangles_));
  glBindVertexArray(noVertices_.name());
  for (std::size_t first = 0; first < count; first += most) {
    program_.set("tiles", glm::ivec4(side_, atlasSide / side_, static_cast<int>(first), atlasSide));
    glDrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangles_),
                          static_cast<GLsizei>(std::min(most, count - first)));
  }
  glBindVertexArray(0);
}

}  // namespace prelight::viewer
