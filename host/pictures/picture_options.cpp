#include <array>
#include <glm/glm.hpp>

#include "options/rows.h"
#include "pictures/picture_request.h"

namespace prelight {
namespace {

using namespace options;
using pictures::PictureRequest;
using Row = Rows<PictureRequest>;

constexpr std::array<Choice, 3> lightings = {
    {{"auto", "the volume if there is one, else cube maps"},
     {"volume", "the one in the file"},
     {"cube", "cube maps of the lit scene, drawn at the objects' places"}}};
constexpr std::array<Choice, 3> shadows = {
    {{"rays"},
     {"vo", "as vector occluders, blurred but in a fraction of the time"},
     {"neighbourhood",
      "by matrices around objects that hold how they hide and reflect the sky, with shadows of lamps as for "
      "vo"}}};

constexpr Option<PictureRequest> skyRotation() {
  Option<PictureRequest> row = Row::number<&PictureRequest::render, &viewer::RenderOptions::skyRotation>(
      real(-360, 360), {.field = "PictureRequest::skyRotation",
                        .name = "rotate-env",
                        .help = "turn the sky by this many degrees, counter-clockwise seen from above",
                        .unit = "deg"});
  row.get = [](const PictureRequest& r) -> std::optional<double> {
    return r.render.skyRotation == 0.0 ? std::nullopt : std::optional(glm::degrees(r.render.skyRotation));
  };
  row.set = [](PictureRequest& r, double degrees) { r.render.skyRotation = glm::radians(degrees); };
  return row;
}

constexpr auto rows = std::to_array<Option<PictureRequest>>({
    Row::number<&PictureRequest::render, &viewer::RenderOptions::camera>(
        whole(0, 1 << 20),
        {.field = "PictureRequest::camera",
         .name = "camera",
         .help = "camera of the file, counted from 0 (default: the first, or one that frames the scene)"}),
    skyRotation(),
    Row::number<&PictureRequest::causticPhotons>(
        whole(1, 1e8, "no caustics"),
        {.field = "PictureRequest::causticPhotons",
         .name = "caustics",
         .help = "add the light that mirrors and glass focus, from this many photons sent towards them"}),
    Row::choice<&PictureRequest::objects, &ObjectOptions::lighting>(
        lightings,
        {.field = "ObjectOptions::lighting", .name = "object-light", .help = "source of light for objects"}),
    Row::choice<&PictureRequest::objects, &ObjectOptions::shadows>(
        shadows, {.field = "ObjectOptions::shadows",
                  .name = "object-shadow",
                  .help = "how objects cast shadows on the scene"}),
    Row::flag<&PictureRequest::objects, &ObjectOptions::probes>(
        {.field = "ObjectOptions::probes",
         .name = "probes",
         .help = "draw a ball in every cell of the volume that is not inside an object, with the light of "
                 "that cell"}),
    Row::number<&PictureRequest::thinBeyond>(
        real(1e-6, 1e9, "as many as their power asks for"),
        {.field = "PictureRequest::thinBeyond",
         .name = "thin-beyond",
         .help = "lamps farther from the viewer than X metres send fewer photons, by the square of the "
                 "distance, down to a sixteenth (default: as many as their power asks for)",
         .unit = "m",
         .shadings = "full"}),
});

}  // namespace

template <>
std::span<const Option<PictureRequest>> optionsOf<PictureRequest>() {
  return rows;
}

}  // namespace prelight
