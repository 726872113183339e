#include "cli/faults/command_runs.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "cli/glb_scene.h"

namespace prelight::test {

namespace fs = std::filesystem;

namespace {

/// Contents of an output without times, which two equal runs write alike.
std::string comparable(const fs::path& path) {
  std::string bytes = textOf(path);
  if (path.extension() == ".json") return nlohmann::json::accept(bytes) ? "a report" : "broken";
  if (path.extension() == ".part") return "a part";  // it holds the time that its work took
  if (path.extension() != ".glb") return bytes;
  GlbScene scene = parseGlb(bytes);
  if (scene.json.contains("extensions") && scene.json["extensions"].contains("PRELIGHT_transfer"))
    scene.json["extensions"]["PRELIGHT_transfer"].erase("seconds");
  return scene.json.dump() + scene.bin;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace

void PrintTo(const Command& command, std::ostream* out) { *out << command.name; }

std::string textOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

const std::vector<Command>& everyCommand() {
  static const std::vector<Command> commands = {
      {"scene", "scene cornell -o out.glb --quiet", {}},
      {"info", "info @baked.glb --ao --sh 3 --quiet", {}},
      {"devices", "devices --quiet", {}},
      {"bake_transfer",
       "bake @scene.glb -o out.glb --ao --sh 2 --bounces 1 --rays 16 --report r.json --quiet",
       {}},
      {"bake_all",
       "bake @scene.glb -o out.glb --ch 2 --haar 4 --glossy 2 --vo --near-lamps 2 --horizons 3 "
       "--light-groups "
       "--volume 2 --sh 2 --rays 16 --quiet",
       {}},
      {"bake_light_map",
       "bake @scene.glb -o out.glb --lightmap --texel-size 0.5 --photons 500 --rays 16 --quiet",
       {}},
      {"bake_radiosity", "bake @scene.glb -o out.glb --radiosity --patch-size 0.5 --rays 16 --quiet", {}},
      {"render", "render @baked.glb -o out.png --size 24x16 --shading sh --quiet", {}},
      {"render_full",
       "render @scene.glb -o out.exr --size 16x8 --shading full --spp 1 --photons 500 --map-texels 200 "
       "--gather-rays 64 --quiet",
       {}},
      {"reference", "reference @scene.glb -o out.exr --size 16x8 --spp 4 --quiet", {}},
      {"slice", "bake @scene.glb -o 1.part --slice 1/2 --ao --rays 16 --quiet", {}},
      {"merge", "merge @1.part -o out.exr --quiet", {}},
      {"export", "export @baked.glb -o out --target three --quiet", {}},
      {"compare", "compare @picture.exr @picture.exr --json", {"stdout"}},
  };
  return commands;
}

CommandRuns::CommandRuns() {
  std::string pattern = (fs::temp_directory_path() / "prelight-runs-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
  folder_ = pattern;
  for (const char* name : {"inputs", "work"}) fs::create_directory(folder_ / name);
}

CommandRuns::~CommandRuns() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

ProcessResult CommandRuns::run(const std::string& arguments, const Environment& environment) const {
  fs::remove_all(folder_ / "work");
  fs::create_directory(folder_ / "work");
  std::vector<std::string> words = {"timeout", "-k", "5", "300", PRELIGHT_PROGRAM};
  for (std::string word : wordsOf(arguments)) {
    if (word.starts_with('@')) word = (folder_ / "inputs" / word.substr(1)).string();
    words.push_back(word);
  }
  return runProcess(words, {.directory = folder_ / "work", .environment = environment});
}

std::string CommandRuns::makeInputs(const Environment& environment) {
  std::string errors;
  const auto make = [&](const std::string& arguments, const char* name) {
    const ProcessResult made = run(arguments, environment);
    if (made.exitCode != 0)
      errors += arguments + "\n" + made.errors;
    else
      fs::copy(folder_ / "work" / name, folder_ / "inputs" / name);
  };
  make("scene cornell -o scene.glb", "scene.glb");
  make("bake @scene.glb -o baked.glb --ao --sh 2 --light-groups --rays 16", "baked.glb");
  make("render @baked.glb -o picture.exr --size 24x16 --shading sh", "picture.exr");
  make("reference @scene.glb -o 1.part --slice 1/2 --size 16x8 --spp 4", "1.part");
  return errors;
}

std::map<std::string, std::string> CommandRuns::outputs() const {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "work"))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder_ / "work").string()] = comparable(entry.path());
  return files;
}

}  // namespace prelight::test
