#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "architecture/source_files.h"

namespace prelight {
namespace {

/// An include of another file of the project.
struct Include {
  std::string file;  ///< Path from the root, such as "host/cast/caster.h".
  std::string included;
};

std::vector<std::string> sourcesBelow(const std::string& folder) {
  return test::filesBelow(folder, {".h", ".cpp", ".cl"});
}

/// A room is a folder of sources; "host/scene" and "host/scene/gltf" are two.
std::string roomOf(const std::string& file) { return file.substr(0, file.rfind('/')); }

/// Names that a file includes, as written; the pattern `form` selects quotes or angle brackets.
std::vector<std::string> writtenIncludes(const std::string& file, const char* form) {
  std::istringstream in(test::textOf(file));
  const std::regex pattern(form);
  std::vector<std::string> includes;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) includes.push_back(match[1]);
  }
  return includes;
}

/// Includes of the project's own files. They are written relative to host/, host/include/, kernels/ or the
/// root.
std::vector<Include> placedIncludesOf(const std::string& file) {
  std::vector<Include> includes;
  for (const std::string& included : writtenIncludes(file, "^#include \"([^\"]+)\"")) {
    for (const char* base : {"host/", "host/include/", "kernels/", ""}) {
      if (std::filesystem::exists(test::sourceRoot() / (base + included))) {
        includes.push_back({file, base + included});
        break;
      }
    }
  }
  return includes;
}

using Graph =
    /// [room][other room] holds one include of `other room` in `room`.
    std::map<std::string, std::map<std::string, Include>>;

/// Folders whose rooms the graph covers.
constexpr std::array<const char*, 5> tops = {"host", "kernels", "viewer", "python", "benchmarks"};

bool liesBelowTops(const std::string& room) {
  return std::any_of(tops.begin(), tops.end(),
                     [&](const std::string& top) { return room == top || room.starts_with(top + "/"); });
}

void addIncludes(const std::string& folder, Graph& graph) {
  for (const std::string& file : sourcesBelow(folder)) {
    for (const Include& include : placedIncludesOf(file)) {
      const std::string from = roomOf(file), to = roomOf(include.included);
      if (from != to && liesBelowTops(to)) graph[from].emplace(to, include);
    }
  }
}

/// A cycle of rooms that is reached from `room`, as text, or empty if there is none.
std::string cycleFrom(const Graph& graph, const std::string& room, std::vector<std::string>& way,
                      std::set<std::string>& done) {
  if (done.count(room) > 0) return {};
  const auto before = std::find(way.begin(), way.end(), room);
  if (before != way.end()) {
    std::string text;
    way.push_back(room);
    for (auto at = std::find(way.begin(), way.end(), room); at + 1 != way.end(); ++at) {
      const Include& include = graph.at(*at).at(*(at + 1));
      text += "  " + include.file + " includes " + include.included + "\n";
    }
    return text;
  }
  way.push_back(room);
  if (const auto found = graph.find(room); found != graph.end())
    for (const auto& [other, include] : found->second)
      if (std::string cycle = cycleFrom(graph, other, way, done); !cycle.empty()) return cycle;
  way.pop_back();
  done.insert(room);
  return {};
}

std::string firstCycle(const Graph& graph) {
  std::set<std::string> done;
  for (const auto& [room, others] : graph) {
    std::vector<std::string> way;
    if (std::string cycle = cycleFrom(graph, room, way, done); !cycle.empty()) return cycle;
  }
  return {};
}

/// Two rooms that include each other are a cycle, too.
TEST(Rooms, Includes_FormNoCycle) {
  Graph graph;
  for (const char* top : tops) {
    ASSERT_FALSE(sourcesBelow(top).empty()) << "the sources of " << top << " were not found";
    addIncludes(top, graph);
  }
  ASSERT_GT(graph.size(), 60u) << "the includes were not found";
  EXPECT_EQ(firstCycle(graph), "");
}

/// The search for cycles finds one of three rooms, and none before the last include closes it.
TEST(Rooms, CycleOfThree_IsFound) {
  Graph graph;
  graph["a"].emplace("b", Include{"a/1.h", "b/1.h"});
  graph["b"].emplace("c", Include{"b/2.h", "c/1.h"});
  graph["b"].emplace("d", Include{"b/2.h", "d/1.h"});
  EXPECT_EQ(firstCycle(graph), "");
  graph["c"].emplace("a", Include{"c/3.h", "a/1.h"});
  EXPECT_EQ(firstCycle(graph), "  a/1.h includes b/1.h\n  b/2.h includes c/1.h\n  c/3.h includes a/1.h\n");
}

constexpr std::size_t mostSources = 40;  ///< of a folder, without its folders

/// Folders with more than mostSources of the files at their top, each with its number of files.
std::map<std::string, std::size_t> crowdedFolders(const std::vector<std::string>& files) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& file : files) ++counts[roomOf(file)];
  std::erase_if(counts, [](const auto& folder) { return folder.second <= mostSources; });
  return counts;
}

/// Sources of C++, kernels and shaders.
std::vector<std::string> allSourcesBelow(const std::string& folder) {
  return test::filesBelow(folder, {".h", ".cpp", ".cl", ".glsl", ".frag", ".vert"});
}

TEST(Rooms, Folders_HoldFewSources) {
  for (const char* top : {"host", "kernels", "viewer", "python", "benchmarks"})
    for (const auto& [folder, count] : crowdedFolders(allSourcesBelow(top)))
      ADD_FAILURE() << folder << " holds " << count << " sources, at most " << mostSources
                    << " are allowed: part it by concept";
}

TEST(Rooms, FolderWithManySources_IsFound) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < mostSources; ++i) files.push_back("viewer/a/" + std::to_string(i) + ".h");
  files.emplace_back("viewer/a/b/0.h");
  EXPECT_TRUE(crowdedFolders(files).empty());
  files.emplace_back("viewer/a/0.cpp");
  EXPECT_EQ(crowdedFolders(files), (std::map<std::string, std::size_t>{{"viewer/a", mostSources + 1}}));
}

TEST(Rooms, ViewersTop_HoldsNoSource) {
  for (const std::string& file : allSourcesBelow("viewer"))
    EXPECT_NE(roomOf(file), "viewer") << file << " belongs into a folder of its concept";
}

/// The program joins library, viewer and benchmarks, and host/pictures library and viewer; no other
/// folder of host/ includes viewer or benchmarks.
TEST(Rooms, HostButTheProgramAndPictures_IncludesNeitherViewerNorBenchmarks) {
  for (const std::string& file : sourcesBelow("host")) {
    if (file.starts_with("host/cli/")) continue;
    for (const Include& include : placedIncludesOf(file)) {
      if (file.starts_with("host/pictures/") && include.included.starts_with("viewer/")) continue;
      const char* kernels = file.ends_with(".cl") ? "kernels/" : "kernels/shared/";
      EXPECT_TRUE(include.included.starts_with("host/") || include.included.starts_with(kernels))
          << file << " includes " << include.included;
    }
  }
}

TEST(Rooms, NothingOutsideTheProgram_IncludesIt) {
  for (const char* top : {"host", "viewer", "benchmarks", "python"}) {
    for (const std::string& file : sourcesBelow(top)) {
      if (file.starts_with("host/cli/")) continue;
      for (const Include& include : placedIncludesOf(file))
        EXPECT_FALSE(include.included.starts_with("host/cli/")) << file << " includes " << include.included;
    }
  }
}

/// The Python package uses public headers only, as any client does.
TEST(Rooms, Python_KnowsThePublicHeadersAlone) {
  const std::vector<std::string> sources = sourcesBelow("python");
  ASSERT_FALSE(sources.empty()) << "the sources were not found";
  for (const std::string& file : sources)
    for (const std::string& include : writtenIncludes(file, "^#include \"([^\"]+)\""))
      EXPECT_TRUE(include.starts_with("prelight/") || include.starts_with("python/"))
          << file << " includes " << include;
}

TEST(Rooms, OpenGl_IsTheViewersAlone) {
  const std::regex gl("^(epoxy|GL|GLES[0-9]?|EGL|GLFW)/");
  for (const char* top : {"host", "benchmarks", "python"}) {
    for (const std::string& file : sourcesBelow(top))
      for (const std::string& include : writtenIncludes(file, "^#include <([^>]+)>"))
        EXPECT_FALSE(std::regex_search(include, gl)) << file << " includes " << include;
  }
}

/// A reference implementation that shared code with what it judges would share its faults. References may
/// include the scene, the layout of stored transfer and the basis functions, which are themselves tested
/// against closed forms.
TEST(Rooms, Oracle_KnowsDataAlone) {
  const std::set<std::string> allowed = {"host/include/prelight", "host/base", "host/images", "host/scene",
                                         "host/basis"};
  ASSERT_FALSE(sourcesBelow("tests/oracle").empty());
  for (const std::string& file : sourcesBelow("tests/oracle"))
    for (const Include& include : placedIncludesOf(file))
      EXPECT_TRUE(allowed.count(roomOf(include.included)) > 0) << file << " includes " << include.included;
}

/// A folder of tests is named after the room whose code it tests. The folders in `others` test several rooms,
/// or do not test code.
TEST(Rooms, Tests_MirrorThem) {
  const std::set<std::string> others = {
      "accuracy", "architecture", "benchmarks", "clients", "coverage", "fuzz", "lab",     "materials", "mutation",
      "oracle",   "portability",  "python",     "runner",  "stress",   "support", "transport", "viewer"};
  for (const std::string& file : sourcesBelow("tests")) {
    const std::string room = roomOf(file).substr(std::string("tests/").size());
    EXPECT_TRUE(others.count(room.substr(0, room.find('/'))) > 0 || room.starts_with("cli") ||
                std::filesystem::is_directory(test::sourceRoot() / "host" / room))
        << file << " belongs to no room of host/";
  }
}

}  // namespace
}  // namespace prelight
