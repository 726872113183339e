#include "benchmarks/suites/techniques/technique_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "images/picture_codecs.h"

namespace prelight::benchmarks {

namespace {

using Json = nlohmann::ordered_json;

struct Cell {
  std::string name;
  std::string errors;
  std::string costs;
  std::span<const glm::vec3> picture;  ///< as displayed
};

/// Returns "FLIP 0.12, RMSE 0.0123", without FLIP if it was not measured.
std::string errorText(const std::optional<double>& flip, double rmse) {
  return (flip ? fmt::format("FLIP {:.3f}, ", *flip) : std::string()) + fmt::format("RMSE {:.4f}", rmse);
}

std::vector<Cell> cellsOf(const SceneComparison& scene) {
  std::vector<Cell> cells = {
      {"path traced", "own error: " + errorText(scene.truthFlip, scene.truth.rmse),
       fmt::format("{} samples, {:.3g} s", samplesText(scene.truth), scene.truth.seconds),
       scene.truth.displayed}};
  for (const TechniqueResult& row : scene.techniques)
    cells.push_back({row.name, errorText(row.flip, row.error.rmse),
                     fmt::format("{:.3g} s, {:.3g} MB, {:.0f} ms", row.firstPass + row.secondPass,
                                 static_cast<double>(row.bytes) * 1e-6, 1e3 * row.frameSeconds),
                     row.displayed});
  return cells;
}

void writeDisplayed(const std::filesystem::path& path, std::span<const glm::vec3> pixels, int width) {
  Image image{path.filename().string(), width, static_cast<int>(pixels.size()) / width, {}};
  for (const glm::vec3& pixel : pixels) {
    for (int c = 0; c < 3; ++c)
      image.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(pixel[c], 0.0f, 1.0f) * 255.0f)));
    image.rgba.push_back(255);
  }
  const std::vector<std::uint8_t> bytes = encodePng(image);
  const std::array<std::span<const std::byte>, 1> pieces = {std::as_bytes(std::span(bytes))};
  writeFileAtomically(path, pieces);
}

/// Returns the name of a scene's contact sheet, which plot.py draws: "techniques-crowd-under-a-sky.png".
std::string contactSheetName(const SceneComparison& scene) {
  std::string name = "techniques-" + scene.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name + ".png";
}

/// Writes the inputs of contact sheets into an existing folder: the path-traced picture and that of every
/// technique per scene as .png, and techniques.json with names, errors and costs.
void writeContactSheets(const std::filesystem::path& folder, const std::vector<SceneComparison>& scenes) {
  Json sheets = Json::array();
  for (const SceneComparison& scene : scenes) {
    Json cells = Json::array();
    const std::filesystem::path sheet = contactSheetName(scene);
    for (const Cell& cell : cellsOf(scene)) {
      const std::string picture = fmt::format("{}-{:02}.png", sheet.stem().string(), cells.size());
      writeDisplayed(folder / picture, cell.picture, scene.width);
      cells.push_back(
          {{"name", cell.name}, {"errors", cell.errors}, {"costs", cell.costs}, {"picture", picture}});
    }
    sheets.push_back({{"file", sheet.string()},
                      {"title", fmt::format("{}: {} vertices, {}, {} x {}", scene.name, scene.vertices,
                                            scene.light, scene.width, scene.height)},
                      {"cells", cells}});
  }
  const std::string text = sheets.dump(2) + "\n";
  const std::array<std::span<const std::byte>, 1> pieces = {std::as_bytes(std::span(text))};
  writeFileAtomically(folder / "techniques.json", pieces);
}

void writeText(const std::filesystem::path& path, const std::string& text) {
  const std::array<std::span<const std::byte>, 1> pieces = {std::as_bytes(std::span(text))};
  writeFileAtomically(path, pieces);
}

/// Returns an empty text if FLIP was not measured.
std::string flipText(const std::optional<double>& flip, int digits) {
  return flip ? fmt::format("{:.{}g}", *flip, digits) : std::string();
}

std::string bytesText(std::size_t bytes) {
  return bytes == 0 ? "0" : fmt::format("{:.3g} MB", static_cast<double>(bytes) * 1e-6);
}

/// Returns a number with three digits, or all digits before the point.
std::string shortNumber(double value) {
  return value >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

double precompute(const TechniqueResult& row) { return row.firstPass + row.secondPass; }

/// Returns the light that a technique claims to show, in words.
std::string claimText(int claim) {
  if (claim == claims::directLight) return "direct";
  return claim == claims::oneBounce ? "a bounce" : "all";
}

std::string truthText(const SceneComparison& scene) {
  const Truth& truth = scene.truth;
  const TruthShare share = truthShare(scene);
  std::string text = fmt::format(
      "The truth is of {} samples per pixel, of direct light, of one bounce and of the rest. Its RMSE is its "
      "standard error, "
      "{:.2f} of the "
      "best technique's,\nof which two truths leave {:.3f} in what is measured; its FLIP is that of one half "
      "of "
      "its samples against the other.",
      samplesText(truth), share.picture, share.left);
  for (const Truth& claimed : scene.claimed)
    text += fmt::format(" That of {} light is of {} samples, with a standard error of {:.4f}.",
                        claimed.depth == claims::directLight ? "direct" : "once reflected",
                        samplesText(claimed), claimed.rmse);
  return text + "\n\n";
}

std::string sceneTable(const SceneComparison& scene) {
  std::string text = fmt::format(
      "## {}\n\n{} vertices, {} triangles, {}; pictures of {} x {}.\n\n![{}]({})\n\n"
      "| | precompute, s | stored | frame, ms | processor, ms | RMSE | ± | rank | claims | RMSE of that | "
      "FLIP "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n",
      scene.name, scene.vertices, scene.triangles, scene.light, scene.width, scene.height, scene.name,
      contactSheetName(scene));
  for (const TechniqueResult& row : scene.techniques)
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {:.4f} | {:.1g} | {} | {} | {:.4f} | {} |\n", row.name,
                    shortNumber(precompute(row)), bytesText(row.bytes), shortNumber(1e3 * row.frameSeconds),
                    shortNumber(1e3 * row.frameProcessorSeconds), row.error.rmse, row.error.standardError,
                    row.rank, claimText(row.claim), row.ofClaim.rmse, flipText(row.flip, 3));
  const Truth& truth = scene.truth;
  text += fmt::format("| path traced | 0 | 0 | {} | | {:.4f} | | | all | | {} |\n\n",
                      shortNumber(1e3 * truth.seconds), truth.rmse, flipText(scene.truthFlip, 3));
  return text + truthText(scene);
}

/// Returns the rows of Table 7.1: each technique on the first of the scenes of the thesis' size that it was
/// measured on.
std::string thesisTable(const std::vector<SceneComparison>& scenes) {
  std::string text =
      "## Table 7.1 of the thesis\n\n"
      "Its scene of 5 013 vertices with 1 light at 10 000 rays per vertex, on a machine and a GPU of 2013; "
      "then the scenes above\n"
      "of about as many vertices. Seconds are of the first and the second pass. The thesis counts 16 bytes a "
      "number.\n\n"
      "| | thesis, s | now, s | thesis, frames/s | now | thesis, MB | now | on "
      "|\n|---|---|---|---|---|---|---|---|\n";
  std::vector<std::string> done;
  for (const SceneComparison& scene : scenes) {
    if (scene.name != "shapes" && scene.name != "shiny shapes") continue;
    for (const TechniqueResult& row : scene.techniques) {
      if (!row.thesis || std::find(done.begin(), done.end(), row.name) != done.end()) continue;
      done.push_back(row.name);
      text += fmt::format("| {} | {:g} + {:g} | {:.3g} + {:.3g} | {:g} | {:.3g} | {:g} | {:.3g} | {} |\n",
                          row.name, row.thesis->firstPass, row.thesis->secondPass, row.firstPass,
                          row.secondPass, row.thesis->frames, 1.0 / row.frameSeconds, row.thesis->megabytes,
                          static_cast<double>(row.bytes) * 1e-6, scene.name);
    }
  }
  return text + "\n";
}

std::string curveTable(const TechniqueReport& report) {
  std::string text = fmt::format(
      "## Frames a second by lights\n\nFigure 7.21 of the thesis, on {}; every light moves every frame; of "
      "the quickest of some frames.\n\n"
      "![frames per second by lights](techniques-lights.svg)\n\n| lights |",
      report.curveScene);
  std::string rule = "\n|---|";
  for (const FrameCurve& curve : report.framesByLights) {
    text += fmt::format(" {} |", curve.technique);
    rule += "---|";
  }
  text += rule + "\n";
  for (std::size_t i = 0; i < report.framesByLights.front().points.size(); ++i) {
    text += fmt::format("| {:g} |", report.framesByLights.front().points[i].x);
    for (const FrameCurve& curve : report.framesByLights) text += fmt::format(" {:.1f} |", curve.points[i].y);
    text += "\n";
  }
  return text + "\n";
}

std::string markdown(const TechniqueReport& report) {
  std::string text = fmt::format(
      "# Techniques compared\n\n{}.\n\n"
      "A frame is drawn at one sample a pixel while every light moves, to the end, in turns with the other "
      "techniques'; its\n"
      "milliseconds are medians, by the clock and of all processors. RMSE is of radiance up to 1 (white), "
      "FLIP of what is "
      "displayed\n(where flip-evaluator is installed), of pictures\n"
      "of 9 samples per pixel against a path-traced one. RMSE is measured against two independent truths, so "
      "that "
      "their noise\n"
      "is no part of it; ± is what that noise leaves of doubt (a standard error), and techniques that it "
      "does not "
      "tell apart share a\n"
      "rank. What a technique claims to show is direct light, that and a bounce, or all (the truth has 15 "
      "bounces).\n"
      "DD, DS and SS are diffuse from diffuse, diffuse from specular and specular from specular "
      "interreflection.\n\n",
      report.where);
  for (const std::string& note : report.notes) text += "- " + note + "\n";
  text += "\n";
  for (const SceneComparison& scene : report.scenes) text += sceneTable(scene);
  text += thesisTable(report.scenes);
  if (!report.framesByLights.empty()) text += curveTable(report);
  return text;
}

std::string csv(const std::vector<SceneComparison>& scenes) {
  std::string text =
      "scene,technique,vertices,pass1_s,pass2_s,stored_bytes,frame_ms,frame_processor_ms,rmse,rmse_error,"
      "rank,"
      "claim,rmse_of_claim,flip,thesis_pass1_s,"
      "thesis_pass2_s,thesis_frames_per_s,thesis_mb\n";
  for (const SceneComparison& scene : scenes) {
    for (const TechniqueResult& row : scene.techniques) {
      std::string name = row.name;
      std::erase(name, ',');
      text +=
          fmt::format("{},{},{},{:.5g},{:.5g},{},{:.5g},{:.5g},{:.6g},{:.3g},{},{},{:.6g},{},", scene.name,
                      name, scene.vertices, row.firstPass, row.secondPass, row.bytes, 1e3 * row.frameSeconds,
                      1e3 * row.frameProcessorSeconds, row.error.rmse, row.error.standardError, row.rank,
                      claimText(row.claim), row.ofClaim.rmse, flipText(row.flip, 6));
      text += row.thesis ? fmt::format("{:g},{:g},{:g},{:g}\n", row.thesis->firstPass, row.thesis->secondPass,
                                       row.thesis->frames, row.thesis->megabytes)
                         : ",,,\n";
    }
    text += fmt::format("{},path traced,{},0,0,0,{:.5g},,{:.6g},,,,,{},,,,\n", scene.name, scene.vertices,
                        1e3 * scene.truth.seconds, scene.truth.rmse, flipText(scene.truthFlip, 6));
  }
  return text;
}

std::string curveCsv(const std::vector<FrameCurve>& curves) {
  std::string text = "technique,lights,frames_per_s\n";
  for (const FrameCurve& curve : curves)
    for (const Point& point : curve.points)
      text += fmt::format("{},{:g},{:.5g}\n", curve.technique, point.x, point.y);
  return text;
}

}  // namespace

void writeTechniqueReport(const std::filesystem::path& folder, const TechniqueReport& report) {
  writeText(folder / "techniques.md", markdown(report));
  writeText(folder / "techniques.csv", csv(report.scenes));
  writeContactSheets(folder, report.scenes);
  if (report.framesByLights.empty()) return;
  writeText(folder / "techniques-lights.csv", curveCsv(report.framesByLights));
}

}  // namespace prelight::benchmarks
