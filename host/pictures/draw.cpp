#include "prelight/draw.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "io/finite_results.h"
#include "pictures/drawn_encoding.h"
#include "pictures/drawn_picture.h"
#include "pictures/picture_request.h"
#include "pictures/session/darkness.h"
#include "pictures/session/library_session.h"
#include "pictures/traced_picture.h"
#include "prelight/options.h"
#include "viewer/options/shading_options.h"

namespace prelight {
namespace {

using namespace pictures;

constexpr NumberRange sizes{NumberKind::Whole, 1, DrawRequest::maxSize};
constexpr NumberRange axisSamples{NumberKind::Whole, 1, 8};
constexpr NumberRange rotations{NumberKind::Real, -1e4, 1e4};
constexpr NumberRange scales{NumberKind::Real, 1e-9, 1e9};

void require(const char* field, double value, const NumberRange& range) {
  if (!range.allows(value)) refuseNumber(field, value, range);
}

void check(const DrawRequest& request) {
  require("DrawRequest::height", request.height, sizes);
  if (request.width) require("DrawRequest::width", *request.width, sizes);
  require("DrawRequest::samplesPerAxis", request.samplesPerAxis, axisSamples);
  require("DrawRequest::skyRotation", request.skyRotation, rotations);
  requireRanges(request.options);
  requireRanges(fullRequest(request.full));
  requireRanges(request.instant);
  for (const PlacedObject& object : request.objects.objects)
    require("PlacedObject::scale", object.scale, scales);
  requireRanges(request.bake);
}

/// Returns the request in the form that front ends share. `loaded` receives the camera, which is chosen among
/// those of the scene.
PictureRequest pictureRequest(const DrawRequest& request, LoadedScene& loaded) {
  PictureRequest asked;
  asked.scene = loaded.path;
  asked.sky = request.sky;
  asked.environment = request.skyName;
  asked.shading = request.shading;
  asked.encoding = encodingNamed("DrawRequest::encoding", request.encoding);
  asked.width = request.width;
  asked.height = request.height;
  static_cast<ShadingOptions&>(asked.render) = request.options;
  asked.render.lobe = request.lobe;
  asked.render.groups = request.groups;
  asked.render.lights = request.lights;
  asked.render.skyRotation = request.skyRotation;
  asked.render.samplesPerAxis = request.samplesPerAxis;
  asked.render.camera = request.cameraIndex;
  if (request.camera) {
    asked.render.camera = static_cast<int>(loaded.scene.cameras.size());
    loaded.scene.cameras.push_back(*request.camera);
    loaded.scene.cameras.back().sceneNode = loaded.scene.nodes.size();
  }
  asked.full = fullRequest(request.full);
  asked.full.parts = request.layers;
  asked.instant = request.instant;
  asked.causticPhotons = request.causticPhotons;
  static_cast<Pose&>(asked.pose) = request.pose;
  asked.objects = request.objects;
  asked.bake.request = request.bake;
  asked.bake.request.lightMap.denoise |= request.denoise;
  return asked;
}

/// Traces a picture of full shading.
Drawing traced(LibrarySession& session, const PictureRequest& asked, LoadedScene loaded) {
  PictureDenoising denoising(asked.bake.request.lightMap.denoise);
  const auto opening = openAside(session, asked);
  poseForPicture(session, asked.pose, loaded);
  PictureSetUp setUp = setUpPicture(session, asked, loaded);
  TracedPicture made = tracePicture(session, asked, loaded, setUp, denoising, opening);
  warnOfDarkness(session, made.layered.picture, loaded, made.camera,
                 {made.lights, setUp.sky.map ? &*setUp.sky.map : nullptr, !asked.render.lights});
  Drawing drawing;
  drawing.picture = std::move(made.layered.picture);
  drawing.layers = std::move(made.layered.layers);
  drawing.shading = *asked.shading;
  drawing.passes = std::move(made.report.plan);
  drawing.studio = setUp.sky.studio;
  return drawing;
}

/// Returns whether the bake of a picture is one of the scene as it was given.
bool keepsBake(const PictureRequest& asked, Shading shading) {
  const bool posed = asked.pose.at || !asked.pose.moves.empty();
  return !posed && !asked.objects.any() && !viewer::showsAllLight(shading);
}

Drawing drawn(LibrarySession& session, const PictureRequest& asked, LoadedScene loaded, Bake bake,
              const DrawRequest& request) {
  ShadedScene shaded = prepareScene(session, asked, std::move(loaded), std::move(bake), false, [] {});
  if (asksForFull(asked)) shaded.render.samplesPerAxis = samplesPerAxis(request.full.samples);
  DrawnPicture made = drawPicture(session, std::move(shaded), request.layers);
  warnOfPicture(session, asked, made);
  Drawing drawing;
  drawing.picture = std::move(made.layered.picture);
  drawing.layers = std::move(made.layered.layers);
  drawing.shading = made.shaded.render.shading;
  drawing.passes = std::move(made.plan);
  drawing.studio = made.shaded.studio;
  if (keepsBake(asked, drawing.shading))
    drawing.bake = std::make_shared<const Bake>(std::move(made.shaded.bake));
  drawing.approximations = std::move(made.notes);
  return drawing;
}

}  // namespace

Drawing draw(const LoadedScene& scene, const DrawRequest& request, const DrawOptions& options) {
  check(request);
  LibrarySession session(options);
  LoadedScene loaded = scene;
  const PictureRequest asked = pictureRequest(request, loaded);
  const bool traces = asksForFull(asked) && !request.full.rasterised;
  Drawing drawing;
  if (traces) {
    drawing = traced(session, asked, std::move(loaded));
  } else {
    Bake bake = options.bake != nullptr ? *options.bake : pictures::carriedBake(session, loaded);
    drawing = drawn(session, asked, std::move(loaded), std::move(bake), request);
  }
  requireFinite("picture", drawing.picture);
  drawing.notes = session.takeNotes();
  drawing.warnings = session.takeWarnings();
  return drawing;
}

std::string_view nameOf(Shading shading) { return viewer::shadingName(shading); }

Shading shadingNamed(std::string_view name) { return viewer::parseShading(name); }

std::vector<ShadingSummary> shadings() {
  std::vector<ShadingSummary> all;
  for (const viewer::ShadingInfo& info : viewer::shadings())
    all.push_back({info.shading, info.name(), info.summary});
  return all;
}

}  // namespace prelight
