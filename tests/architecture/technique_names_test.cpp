#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "architecture/source_files.h"

namespace prelight {
namespace {

/// A technique, the words by which sources name it, and how many sources outside its folders may do so.
struct NamedTechnique {
  const char* name;                     ///< of its folders
  std::vector<std::string_view> words;  ///< a lower-case letter behind a word makes another word of it
  std::vector<const char*> rooms;       ///< further folders of its own, from the root
  std::size_t most;                     ///< sources; this number is only ever lowered
};

const std::vector<NamedTechnique>& techniques() {
  static const std::vector<NamedTechnique> all = {
      {"ambient_occlusion", {"mbientOcclusion", "ambient_occlusion", ".ao", ">ao", "::Ao"}, {}, 25},
      {"ch", {".ch", ">ch", "::Ch", "ChTransfer", "ChRequest"}, {}, 17},
      {"chart_transfer", {"hartTransfer", "chart_transfer"}, {}, 19},
      {"encoded_light", {"ncodedLight", "ncodedLights", "encoded_light"}, {}, 19},
      {"glossy",
       {".glossy", ">glossy", "::Glossy", "lossyTransfer", "lossyRequest", "lossyLighting"},
       {},
       20},
      {"haar", {"haar", "Haar"}, {"host/basis"}, 30},
      {"horizons", {"orizon", "orizons"}, {}, 27},
      {"light_groups", {"ightGroup", "ightGroups", "light_group", "light_groups"}, {}, 46},
      {"light_map", {"ightMap", "ightMaps", "light_map", "light_maps"}, {"host/charts"}, 100},
      {"near_lamps", {"earLamp", "earLamps", "near_lamp", "near_lamps"}, {}, 20},
      {"occlusion_cones", {".cones", ">cones", "::Cones", "cclusionCones", "occlusion_cones"}, {}, 5},
      {"radiosity", {"radiosity", "Radiosity"}, {"host/radiosity", "kernels/radiosity"}, 42},
      {"sh", {".sh", ">sh", "::Sh", "ShTransfer"}, {}, 49},
      {"subsurface", {"ubsurface"}, {}, 12},
      {"vector_occluders", {"ccluder", "ccluders"}, {"host/occluders"}, 80},
      {"volume", {"volume", "Volume"}, {}, 50},
      {"full", {"lobalIllumination", "global_illumination"}, {"host/gi"}, 29},
      {"instant",
       {"nstantRadiosity", "instant_radiosity", "irtualLight", "irtualLights", "virtual_light",
        "virtual_lights", "::Instant"},
       {},
       32},
      {"screen", {"creenOcclusion", "screen_occlusion", "creenShading", "screen_shading", "::Screen"}, {}, 8},
  };
  return all;
}

bool containsWord(const std::string& text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if (end == text.size() || text[end] < 'a' || text[end] > 'z') return true;
  }
  return false;
}

bool isOwn(const NamedTechnique& technique, const std::string& file) {
  return file.find("/" + std::string(technique.name) + "/") != std::string::npos ||
         std::any_of(technique.rooms.begin(), technique.rooms.end(),
                     [&](const std::string& room) { return file.starts_with(room + "/"); });
}

using Sources = std::map<std::string, std::string>;  ///< [file], its text without comments

std::vector<std::string> outsidersOf(const NamedTechnique& technique, const Sources& sources) {
  std::vector<std::string> outsiders;
  for (const auto& [file, text] : sources)
    if (!isOwn(technique, file) &&
        std::any_of(technique.words.begin(), technique.words.end(),
                    [&](std::string_view word) { return containsWord(text, word); }))
      outsiders.push_back(file);
  return outsiders;
}

Sources allSources() {
  const std::regex comment("//[^\n]*");
  Sources sources;
  for (const char* top : {"host", "kernels", "viewer", "python"})
    for (const std::string& file : test::filesBelow(top, {".h", ".cpp", ".cl", ".glsl", ".frag", ".vert"}))
      sources[file] = std::regex_replace(test::textOf(file), comment, "");
  return sources;
}

/// What a technique needs of others is to be asked by a row of its own, not by its name.
TEST(TechniqueNames, InSourcesOutsideItsFolders_BecomeFewer) {
  const Sources sources = allSources();
  ASSERT_GT(sources.size(), 500u) << "the sources were not found";
  for (const NamedTechnique& technique : techniques()) {
    const std::vector<std::string> outsiders = outsidersOf(technique, sources);
    ASSERT_FALSE(outsiders.empty()) << technique.name << " is named nowhere: are these its words?";
    std::string list;
    for (const std::string& file : outsiders) list += "\n  " + file;
    EXPECT_LE(outsiders.size(), technique.most)
        << technique.name << " is named by sources outside its folders:" << list;
  }
}

TEST(TechniqueNames, AreWholeWords) {
  const NamedTechnique technique{"horizons", {"orizon", "orizons"}, {"host/own"}, 0};
  const Sources sources = {{"host/horizons/a.cpp", "Horizons"},     {"host/own/a.cpp", "Horizons"},
                           {"host/io/b.cpp", "bake.horizons = 1"},  {"host/io/c.cpp", "horizontal"},
                           {"viewer/core/d.h", "horizonSoftness_"}, {"viewer/core/e.h", "sky"}};
  EXPECT_EQ(outsidersOf(technique, sources), (std::vector<std::string>{"host/io/b.cpp", "viewer/core/d.h"}));
}

}  // namespace
}  // namespace prelight
