// Runs commands while system calls fail (failing_calls.c), at places sampled over all calls of a run: one
// call alone, or that call and all later ones. Whatever fails, a command ends with an agreed exit code, its
// outputs are complete or absent, nothing else is left behind, and the caches that it wrote serve the next
// run.
//
// PRELIGHT_FAULT_SAMPLES is the number of places per command (default 14; docs/notes/robustness.md has the
// table for 500).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/glb_scene.h"
#include "cli/subprocess.h"

namespace prelight::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> kinds = {"allocation", "open", "write", "thread", "rename", "read"};
constexpr std::size_t readKind = 5;
constexpr std::array<const char*, 2> lengths = {"once", "forever"};

/// Number of calls of each kind in a run, and of failed calls.
struct Counts {
  std::array<std::uint64_t, kinds.size()> calls{};
  std::uint64_t failed = 0;
};

struct Fault {
  std::size_t kind = 0;
  std::size_t length = 0;
  std::uint64_t number = 0;

  std::string text() const {
    return std::string(kinds[kind]) + " " + std::to_string(number) + " " + lengths[length];
  }
};

/// A command to try; `@` stands for the folder of inputs.
struct Command {
  const char* name;
  const char* arguments;
  std::set<std::string> outputs;  ///< Files, or folders of files.
};

void PrintTo(const Command& command, std::ostream* out) { *out << command.name; }

std::string textOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

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

/// Contents of all files in a folder, [path below the folder].
std::map<std::string, std::string> contentsOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = comparable(entry.path());
  return files;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

class FaultRuns : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "prelight-faults-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    for (const char* name : {"inputs", "work", "spill"}) fs::create_directory(folder_ / name);
    fs::create_directories(cache());
    makeInputs();
    spareLibraries();
  }
  void TearDown() override {
    std::error_code ignored;
    if (HasFailure()) fs::remove_all(cache(), ignored);
    fs::remove_all(folder_, ignored);
  }
  static void TearDownTestSuite() {
    std::error_code ignored;
    fs::remove_all(cache(), ignored);
  }

  /// The folder of compiled kernels and shaders: kept between the cases of a process, because kernels take
  /// long to compile, and not shared with other processes, whose failing calls would spoil it.
  static fs::path cache() { return fs::path(PRELIGHT_FAULT_CACHE) / std::to_string(getpid()); }

  /// Runs a command in a folder that was emptied before.
  ProcessResult run(const std::string& arguments, const std::string& fault, Counts& counts) const {
    fs::remove_all(folder_ / "work");
    fs::create_directory(folder_ / "work");
    const fs::path shared = folder_ / "counts";
    std::ofstream(shared, std::ios::binary) << std::string(sizeof(Counts), '\0');
    std::vector<std::string> words = {"timeout", "-k", "5", "300", PRELIGHT_PROGRAM};
    for (std::string word : wordsOf(arguments)) {
      if (word.starts_with('@')) word = (folder_ / "inputs" / word.substr(1)).string();
      words.push_back(word);
    }
    ProcessOptions options{.directory = folder_ / "work",
                           .environment = {{"LD_PRELOAD", PRELIGHT_FAILING_CALLS},
                                           {"PRELIGHT_FAULT_COUNTS", shared.string()},
                                           {"PRELIGHT_FAULT", fault},
                                           {"PRELIGHT_FAULT_SPARES", spared_},
                                           {"TMPDIR", (folder_ / "spill").string()},
                                           {"XDG_CACHE_HOME", cache().string()},
                                           {"POCL_CACHE_DIR", cache().string()}}};
    ProcessResult result = runProcess(words, options);
    const std::string bytes = textOf(shared);
    std::copy_n(bytes.data(), std::min(bytes.size(), sizeof(Counts)), reinterpret_cast<char*>(&counts));
    return result;
  }

  void makeInputs() const {
    Counts ignored;
    const auto make = [&](const std::string& arguments, const char* name) {
      const ProcessResult made = run(arguments, "", ignored);
      ASSERT_EQ(made.exitCode, 0) << arguments << "\n" << made.errors;
      fs::copy(folder_ / "work" / name, folder_ / "inputs" / name);
    };
    make("scene cornell -o scene.glb", "scene.glb");
    make("bake @scene.glb -o baked.glb --ao --sh 2 --light-groups --rays 16", "baked.glb");
    make("render @baked.glb -o picture.exr --size 24x16 --shading sh", "picture.exr");
    make("reference @scene.glb -o 1.part --slice 1/2 --size 16x8 --spp 4", "1.part");
  }

  /// Libraries answer a small allocation or a read that fails alone in ways that no caller can notice
  /// (docs/notes/robustness.md): Mesa leaves out a part of a picture, and PoCL 3 waits for ever for a lock of
  /// its own. Where hwloc cannot read what the processor is, PoCL gives the device another name.
  void spareLibraries() {
    spared_ = "swrast_dri:gallium:libhwloc";
    Counts ignored;
    const ProcessResult listed = run("devices --json", "", ignored);
    ASSERT_EQ(listed.exitCode, 0) << listed.errors;
    for (const auto& device : nlohmann::json::parse(listed.output)["devices"])
      if (device["platform"] == "Portable Computing Language" &&
          device["driverVersion"].get<std::string>().starts_with("3."))
        spared_ += ":libpocl";
  }

  fs::path folder_;
  std::string spared_;  ///< parts of file names of libraries whose single allocations do not fail
};

class FaultSampling : public FaultRuns, public ::testing::WithParamInterface<Command> {};

/// Places among the calls of a run. Every kind and both lengths get their share; kinds with few calls are
/// tried at all of them.
std::vector<Fault> sampledFaults(const Counts& counts, std::size_t samples) {
  std::vector<Fault> faults;
  std::mt19937 random(1);
  constexpr std::array<double, kinds.size()> shares = {0.4, 0.15, 0.1, 0.1, 0.1, 0.15};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    for (std::size_t length = 0; length < lengths.size(); ++length) {
      const std::uint64_t calls = counts.calls[kind];
      const auto wanted = static_cast<std::uint64_t>(shares[kind] / 2 * static_cast<double>(samples) + 0.5);
      const std::uint64_t places = std::min(calls, std::max<std::uint64_t>(1, wanted));
      for (std::uint64_t i = 0; i < places; ++i) {
        const std::uint64_t first = i * calls / places, end = (i + 1) * calls / places;
        faults.push_back({kind, length, 1 + first + random() % std::max<std::uint64_t>(1, end - first)});
      }
    }
  return faults;
}

std::size_t sampleCount() {
  const char* asked = std::getenv("PRELIGHT_FAULT_SAMPLES");
  return asked != nullptr ? std::strtoul(asked, nullptr, 10) : 14;
}

/// Exit codes of docs/command-line.md that a command may end with when a system call fails.
const std::set<int> agreed = {0, 1, 3, 4, 5};

/// Prints how often runs ended with each code, for people to read.
void printTable(const Command& command, const Counts& calls,
                const std::map<std::string, std::map<int, int>>& ends) {
  std::cout << command.name << ":";
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    std::cout << (kind > 0 ? ", " : " ") << calls.calls[kind] << " " << kinds[kind] << "s";
  std::cout << "\n";
  for (const auto& [what, codes] : ends) {
    std::cout << "  " << what << ":";
    for (const auto& [code, count] : codes) std::cout << "  code " << code << " " << count << "x";
    std::cout << "\n";
  }
}

TEST_P(FaultSampling, CallThatFails_EndsInTheAgreedWay) {
  const Command& command = GetParam();
  Counts warmed, calls, counts;
  const ProcessResult first = run(command.arguments, "", warmed);
  ASSERT_EQ(first.exitCode, 0) << first.errors;
  const ProcessResult clean = run(command.arguments, "", calls);
  const std::map<std::string, std::string> whole = contentsOf(folder_ / "work");
  ASSERT_EQ(clean.exitCode, 0) << clean.errors;
  std::map<std::string, std::map<int, int>> ends;
  for (const Fault& fault : sampledFaults(calls, sampleCount())) {
    SCOPED_TRACE(fault.text());
    const ProcessResult result = run(command.arguments, fault.text(), counts);
    ++ends[std::string(kinds[fault.kind]) + " " + lengths[fault.length]][result.exitCode];
    EXPECT_EQ(agreed.count(result.exitCode), 1u) << "code " << result.exitCode << "\n" << result.errors;
    const std::map<std::string, std::string> left = contentsOf(folder_ / "work");
    for (const auto& [name, bytes] : left) {
      // A state or a part may stay, for another run to continue it.
      if (result.exitCode != 0 && (name.ends_with(".state") || name.ends_with(".part"))) continue;
      const auto expected = whole.find(name);
      if (expected == whole.end()) {
        ADD_FAILURE() << "code " << result.exitCode << ": it left " << name << " behind\n" << result.errors;
        continue;
      }
      EXPECT_TRUE(bytes == expected->second) << "code " << result.exitCode << ": " << name << " is another\n"
                                             << result.errors;
    }
    if (result.exitCode == 0) {
      EXPECT_EQ(left.size(), whole.size()) << "a file is missing\n" << result.errors;
      EXPECT_TRUE(result.output == clean.output || command.outputs.count("stdout") == 0);
    }
    EXPECT_TRUE(fs::is_empty(folder_ / "spill")) << "a temporary file is left";
  }
  printTable(command, calls, ends);
  const ProcessResult after = run(command.arguments, "", counts);
  EXPECT_EQ(after.exitCode, 0) << "the caches are spoilt\n" << after.errors;
  EXPECT_EQ(contentsOf(folder_ / "work"), whole);
}

TEST_F(FaultRuns, InputThatCannotBeRead_IsNamed) {
  Counts calls, counts;
  ASSERT_EQ(run("info @scene.glb", "", calls).exitCode, 0);
  int refused = 0;
  for (std::uint64_t number = 1; number <= calls.calls[readKind]; ++number) {
    const ProcessResult result = run("info @scene.glb", "read " + std::to_string(number) + " once", counts);
    if (result.exitCode == 0) continue;
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_THAT(result.errors,
                ::testing::AllOf(::testing::HasSubstr("scene.glb"), ::testing::HasSubstr("cannot read"),
                                 ::testing::HasSubstr("check the disk")));
    ++refused;
  }
  EXPECT_GE(refused, 1);
}

const std::vector<Command> commands = {
    {"scene", "scene cornell -o out.glb --quiet", {}},
    {"info", "info @baked.glb --ao --sh 3 --quiet", {}},
    {"devices", "devices --quiet", {}},
    {"bake_transfer",
     "bake @scene.glb -o out.glb --ao --sh 2 --bounces 1 --rays 16 --report r.json --quiet",
     {}},
    {"bake_all",
     "bake @scene.glb -o out.glb --ch 2 --haar 4 --glossy 2 --vo --near-lamps 2 --horizons 3 --light-groups "
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

INSTANTIATE_TEST_SUITE_P(OfCommands, FaultSampling, ::testing::ValuesIn(commands),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace prelight::test
