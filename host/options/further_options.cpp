#include "prelight/find_option.h"

#include <array>

#include "prelight/refine.h"

namespace prelight {

namespace {

/// Options that are texts, of structures without a table of their own.
constexpr auto furtherOptions = std::to_array<OptionInfo>({
    {.field = "DeviceOptions::selector",
     .name = "device",
     .help = "OpenCL device: a number of `prelight devices`, or part of its name",
     .argument = "selector"},
    {.field = "DeviceOptions::dumpKernels",
     .name = "dump-kernels",
     .help = "write the source of every compiled kernel into this folder"},
    {.field = "OccluderKind::Node",
     .name = "vo-kind",
     .help = "one occluder per node",
     .argument = "vo_kind=\"node\"",
     .commandLine = "occluders node"},
    {.field = "OccluderKind::Auto",
     .name = "vo-kind",
     .help = "parts of nodes as occluders",
     .argument = "vo_kind=\"auto\"",
     .commandLine = "occluders auto:N"},
    {.field = "CompressionRequest::method",
     .name = "compress",
     .help = "make the result small: auto (all that vertices have), or a method for the SH transfer alone, "
             "including that of keys, texels and volumes: half, band8, rgbe, pca:K, vq:N or cpca:N:K (N "
             "clusters, K components); auto:METHOD does both",
     .example = "auto"},
    {.field = "CompressionRequest::components", .name = "compress", .help = "components of a cluster"},
    {.field = "CompressionRequest::clusters", .name = "compress", .help = "clusters of vertices"},
    {.field = "FileCompression::transfer", .name = "compress", .help = "compression of the SH transfer"},
    {.field = "FileCompression::everything", .name = "compress", .help = "make everything small"},
    {.field = "FileCompression::occluders",
     .name = "vo-compress",
     .help = "store vector occluders as whole numbers, in about a quarter of the bytes",
     .argument = "compress_occluders"},
    {.field = "ExportRequest::target", .name = "target", .help = "program to export for"},
    {.field = "ExportRequest::form", .name = "as", .help = "what is exported", .argument = "form"},
    {.field = "ExportOptions::target",
     .name = "target",
     .help = "program to export for: gltf (every file there is), three (three.js), blender, godot, unity, "
             "raw (numbers with descriptions), or web (a page that relights the scene in any browser)"},
    {.field = "ExportOptions::form",
     .name = "as",
     .help = "lightmap (second texture coordinates and a map), occlusion (occlusionTexture), vertex-light or "
             "vertex-occlusion (COLOR_0), probes (light at points in the air), volume (their transfer) or "
             "transfer (that of the vertices, only for the target raw); default: lightmap or else occlusion, "
             "whichever the bake holds, and for the target raw transfer if it holds neither",
     .argument = "form"},
    {.field = "ExportOptions::lights",
     .name = "lights",
     .help = "remove (the default), mark or keep those of the scene's lights whose light the export holds"},
    {.field = "ExportOptions::rays", .name = "rays", .help = "rays per texel of a map of occlusion"},
    {.field = "DrawRequest::shading", .name = "shading", .help = "how light reaches surfaces"},
    {.field = "DrawRequest::skyName",
     .name = "env",
     .help = "sky: equirectangular .hdr or .exr, or the name of a built-in one",
     .argument = "sky"},
    {.field = "DrawRequest::skyRotation",
     .name = "rotate-env",
     .help = "turn of the sky, counter-clockwise seen from above",
     .argument = "sky_rotation"},
    {.field = "DrawRequest::lights",
     .name = "light",
     .help = "light in place of the file's",
     .argument = "lights"},
    {.field = "DrawRequest::groups", .name = "group", .help = "factor for a light group's colour"},
    {.field = "DrawRequest::encoding", .name = "encoding", .help = "encoding of the light that is drawn"},
    {.field = "DrawRequest::causticPhotons", .name = "caustics", .help = "photons of caustics"},
    {.field = "DrawRequest::denoise", .name = "denoise", .help = "remove noise with Open Image Denoise"},
    {.field = "DrawRequest::width", .name = "width", .help = "pixels", .commandLine = "size"},
    {.field = "DrawRequest::height", .name = "height", .help = "pixels", .commandLine = "size"},
    {.field = "DrawRequest::samplesPerAxis",
     .name = "samples-per-axis",
     .help = "samples along each axis of a pixel"},
    {.field = "ObjectOptions::objects",
     .name = "object",
     .help = "glTF file that is put into the scene",
     .argument = "objects"},
    {.field = "ObjectOptions::probes", .name = "probes", .help = "balls in the cells of a volume"},
    {.field = "ObjectOptions::lighting", .name = "object-light", .help = "source of light for objects"},
    {.field = "PoseOptions::at", .name = "at", .help = "moment of an animation, in seconds", .unit = "s"},
    {.field = "PoseOptions::animation", .name = "animation", .help = "animation that the moment refers to"},
    {.field = "PoseOptions::moves", .name = "move", .help = "displacement of a node", .argument = "moves"},
});

const OptionInfo* find(std::span<const OptionInfo> rows, std::string_view field) {
  for (const OptionInfo& row : rows)
    if (row.field == field) return &row;
  return nullptr;
}

template <typename Options>
const OptionInfo* findAmong(std::string_view field) {
  for (const Option<Options>& row : optionsOf<Options>())
    if (row.field == field) return &row;
  return nullptr;
}

}  // namespace

const OptionInfo* findOption(std::string_view field) {
  for (const auto among :
       {findAmong<BakeRequest>, findAmong<AnimationKeys>, findAmong<RenderOptions>, findAmong<ReferenceGoal>,
        findAmong<PhotonOptions>, findAmong<LoadOptions>, findAmong<RefineRequest>})
    if (const OptionInfo* found = among(field)) return found;
  return find(furtherOptions, field);
}

}  // namespace prelight
