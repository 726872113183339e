#include "pictures/recorded_sky.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "io/baked_sky.h"
#include "pictures/named_sky.h"
#include "prelight/error.h"

namespace prelight::pictures {
namespace {

namespace fs = std::filesystem;

std::string textOf(const BakedSky& sky) {
  return sky.name.empty() ? std::string("a sky without a name") : fmt::format("the sky \"{}\"", sky.name);
}

/// Returns the places where a sky's file may be: the recorded one, and beside the baked file.
std::vector<fs::path> placesOf(const BakedSky& sky, const fs::path& baked) {
  const fs::path name(sky.name), folder = baked.parent_path();
  std::vector<fs::path> places = {folder / name};
  if (name.has_parent_path()) places.push_back(folder / name.filename());
  return places;
}

/// Reads a sky if it is the very picture that was baked under. A stranger's bake cannot make the viewer show
/// another file of this machine, because its author would have to know that file's contents.
std::optional<Environment> skyAt(const fs::path& place, std::uint64_t hash) {
  std::error_code missing;
  if (!fs::is_regular_file(place, missing)) return std::nullopt;
  try {
    Environment sky = readEnvironment(place);
    if (skyHash(sky) == hash) return sky;
  } catch (const Error&) {  // an unreadable sky counts as missing
  }
  return std::nullopt;
}

std::optional<Environment> findSky(const BakedSky& sky, const fs::path& baked) {
  if (sky.name.empty()) return std::nullopt;
  if (isBuiltinSky(sky.name)) {
    try {
      return readNamedSky(sky.name);
    } catch (const Error&) {  // recorded by another version or program
      return std::nullopt;
    }
  }
  for (const fs::path& place : placesOf(sky, baked))
    if (std::optional<Environment> found = skyAt(place, sky.hash)) return found;
  return std::nullopt;
}

}  // namespace

std::optional<PictureSky> bakedSkyOf(DrawingSession& session, const LoadedScene& loaded) {
  const std::optional<BakedSky> recorded = readBakedSky(*loaded.document);
  if (!recorded) return std::nullopt;
  std::optional<Environment> sky = session.measure("sky", [&] { return findSky(*recorded, loaded.path); });
  if (!sky) {
    session.warn(
        fmt::format("{}: its light was baked under {}, which is missing or is another picture now: nothing "
                    "is behind the scene, and mirrors are dark (name it with DrawRequest::skyName)",
                    loaded.path.string(), textOf(*recorded)));
    return std::nullopt;
  }
  session.note(
      fmt::format("under {}, the sky of the bake (DrawRequest::skyName chooses another)", textOf(*recorded)));
  const fs::path name(recorded->name);
  return PictureSky{.map = std::move(sky),
                    .studio = recorded->name == studioName,
                    .name = isBuiltinSky(recorded->name) ? recorded->name : name.stem().string(),
                    .rotation = recorded->rotation};
}

bool isSkyOfBake(const LoadedScene& loaded, const Environment* sky, double turn) {
  constexpr double alike = 1e-6;
  const std::optional<BakedSky> recorded = readBakedSky(*loaded.document);
  if (!recorded || sky == nullptr) return !recorded && sky == nullptr;
  const double difference = std::remainder(turn - recorded->rotation, 2.0 * std::numbers::pi);
  return skyHash(*sky) == recorded->hash && std::abs(difference) <= alike;
}

void warnOfOtherSky(DrawingSession& session, const LoadedScene& loaded, const Environment& sky,
                    double rotation) {
  const std::optional<BakedSky> recorded = readBakedSky(*loaded.document);
  if (!recorded || isSkyOfBake(loaded, &sky, rotation)) return;
  session.warn(fmt::format(
      "{}: its light was baked under {} and does not change with the sky; bake it anew for other light",
      loaded.path.string(), textOf(*recorded)));
}

}  // namespace prelight::pictures
