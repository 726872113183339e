#include "viewer/techniques/screen/occlusion_pass.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "viewer/core/uniform_blocks.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/programs/sliced_drawing.h"
#include "viewer/techniques/screen/disks/disk_occlusion.h"
#include "viewer/techniques/screen/fields/field_occlusion.h"
#include "viewer/techniques/screen/occlusion_target.h"

namespace prelight::viewer {
/// Pixels of a picture that occlusion is looked for at: every stride-th of the whole picture, each way.
struct OcclusionGrid {
  glm::ivec2 corner;   ///< of the first in the layers
  glm::ivec2 size;     ///< how many
  glm::ivec2 pattern;  ///< number of the first, modulo that of a pattern's side
};

namespace {

/// The shader that finds what occludes a pixel.
const char* shaderOf(OcclusionMethod method) {
  switch (method) {
    case OcclusionMethod::Ssao:
      return "screen_ssao.frag";
    case OcclusionMethod::Hbao:
      return "screen_hbao.frag";
    case OcclusionMethod::Gtao:
      return "screen_gtao.frag";
    case OcclusionMethod::Ssdo:
      return "screen_ssdo.frag";
    case OcclusionMethod::Disks:
      return "screen_disks.frag";
    case OcclusionMethod::Fields:
      return "screen_fields.frag";
  }
  return "";
}

glm::ivec2 below(const glm::ivec2& value, int stride) { return ((value % stride) + stride) % stride; }

OcclusionGrid gridOf(const OcclusionPicture& picture, int around, int stride) {
  const glm::ivec2 first = picture.origin - around;
  const glm::ivec2 shift = below(first, stride);
  const glm::ivec2 last = glm::ivec2(picture.width, picture.height) - 1 + around + shift;
  // Patterns repeat every four samples.
  return {glm::ivec2(picture.margin - around) - shift, last / stride + OcclusionPass::filterReach + 1,
          below((first - shift) / stride, 4)};
}

void prepare(const gl::Program& program) {
  program.bindBlock("Frame", frameBinding);
  program.bindBlock("Lights", lightBinding);
  program.use();
  program.set("firstLayer", static_cast<int>(firstLayerUnit));
  program.set("secondLayer", static_cast<int>(secondLayerUnit));
  program.set("sent", static_cast<int>(sentUnit));
  program.set("skyMap", static_cast<int>(skyUnit));
  setSamplers(program, "found", OcclusionPass::mostOutputs, foundUnit);
}

std::string constant(const std::string& name, int value) {
  return "const int " + name + " = " + std::to_string(value) + ";\n";
}
std::string constant(const std::string& name, bool value) {
  return "const bool " + name + " = " + (value ? "true" : "false") + ";\n";
}

/// Added to turns and shifts of a pattern, so that pictures one after the other fill the gaps between its 16
/// turns and 4 shifts evenly: the R2 sequence (Roberts 2018) of parts of them.
glm::vec2 rotationOf(int turn) {
  const glm::dvec2 steps((6.0 + 0.7548776662466927) / 16.0, (2.0 + 0.5698402909980532) / 4.0);
  return glm::vec2(glm::fract(static_cast<double>(turn) * steps));
}

}  // namespace

int OcclusionPass::outputsOf(const ScreenOcclusionOptions& options) {
  if (options.method != OcclusionMethod::Ssdo) return 1;
  return gathers(options) ? 3 : 2;
}

const gl::Framebuffer& OcclusionPass::layer(int index, const OcclusionPicture& picture) {
  return fitted(layers_[static_cast<std::size_t>(index)], picture.width + 2 * picture.margin,
                picture.height + 2 * picture.margin);
}

const gl::Framebuffer& OcclusionPass::sent(const OcclusionPicture& picture) {
  return fitted(sent_, picture.width + 2 * picture.margin, picture.height + 2 * picture.margin);
}

const gl::Program& OcclusionPass::programOf(const Variant& variant) {
  const auto found = programs_.find(variant);
  if (found != programs_.end()) return found->second;
  ShaderVariant surface;
  surface.features = variant.light.sky;
  gl::Program program(
      "fullscreen.vert", shaderOf(variant.method),
      {{"screen_variant.glsl",
        constant("layers", variant.layers) + constant("hasThickness", variant.hasThickness) +
            constant("gathers", variant.gathers) + constant("shadowedLamps", variant.light.lamps)},
       {"variant.glsl", textOf(surface)}});
  prepare(program);
  return programs_.emplace(variant, std::move(program)).first->second;
}

const gl::Program& OcclusionPass::filterOf(int outputs) {
  const auto found = filters_.find(outputs);
  if (found != filters_.end()) return found->second;
  gl::Program program("fullscreen.vert", "screen_filter.frag",
                      {{"screen_variant.glsl", constant("outputs", outputs)}});
  prepare(program);
  return filters_.emplace(outputs, std::move(program)).first->second;
}

void OcclusionPass::bindLayers(const ScreenOcclusionOptions& options) const {
  gl::bind(firstLayerUnit, GL_TEXTURE_2D, layers_[0]->color());
  if (layersOf(options) > 1 || options.method == OcclusionMethod::Fields)
    gl::bind(secondLayerUnit, GL_TEXTURE_2D, layers_[1]->color());
  if (gathers(options)) gl::bind(sentUnit, GL_TEXTURE_2D, sent_->color());
}

/// Finds occlusion in the picture and `around` samples of its margin, and filters it.
SlicedWork OcclusionPass::find(OcclusionPicture picture, int around, ScreenOcclusionOptions options,
                               OcclusionLight light, int turn, Targets& targets) {
  const gl::Framebuffer& first = *layers_[0];
  const int layers = layersOf(options), outputs = outputsOf(options);
  const OcclusionGrid grid = gridOf(picture, around + filterReach * options.stride, options.stride);
  const glm::vec4 screen(first.width(), first.height(), picture.radius, picture.margin);

  const gl::Program& program =
      programOf({options.method, layers, layers > 1 && options.thickness > 0.0, gathers(options), light});
  program.use();
  program.set("screen", screen);
  program.set("corner", glm::ivec4(grid.corner, grid.pattern));
  program.set("stride", options.stride);
  program.set("rotation", rotationOf(turn));
  program.set("slices", options.slices);
  program.set("steps", options.steps);
  program.set("samples", options.samples);
  program.set("thickness", static_cast<float>(options.thickness));
  DiskOcclusion::setUniforms(program, options, picture.radius, disksUnit);
  FieldOcclusion::setUniforms(program, fieldsUnit);
  const gl::Framebuffer& found = fitted(targets.found, grid.size.x, grid.size.y, outputs);
  SlicedWork finding = drawInSlices(grid.size.x, grid.size.y, picture.slice, [&](const SampleRect&) {
    bindLayers(options);
    program.use();
    drawOver(found, noVertices_);
  });
  while (finding.goOn()) co_await endOfSlice;

  const gl::Program& filter = filterOf(outputs);
  filter.use();
  filter.set("screen", screen);
  filter.set("corner", glm::ivec4(glm::ivec2(picture.margin - around), grid.corner));
  filter.set("stride", options.stride);
  filter.set("averages", isFiltered(options) ? 1 : 0);
  bindColors(found, outputs, foundUnit);
  const gl::Framebuffer& filtered =
      fitted(targets.filtered, picture.width + 2 * around, picture.height + 2 * around, outputs);
  SlicedWork filtering =
      drawInSlices(filtered.width(), filtered.height(), picture.slice, [&](const SampleRect&) {
        bindLayers(options);
        filter.use();
        drawOver(filtered, noVertices_);
      });
  while (filtering.goOn()) co_await endOfSlice;
  bindLayers(options);
  gl::check("drawing screen-space occlusion");
}

SlicedWork OcclusionPass::drawSenders(OcclusionPicture picture, ScreenOcclusionOptions options,
                                      OcclusionLight light) {
  ScreenOcclusionOptions coarse = options;
  coarse.bounces = 0;
  coarse.filtered = true;
  coarse.slices = 1;  // those of 4 x 4 pixels have another direction each
  coarse.stride = std::max(options.stride, 2);
  return find(picture, picture.margin, coarse, light, 0, ofSenders_);
}

SlicedWork OcclusionPass::draw(OcclusionPicture picture, ScreenOcclusionOptions options, OcclusionLight light,
                               int turn) {
  return find(picture, 0, options, light, turn, ofPicture_);
}

}  // namespace prelight::viewer
