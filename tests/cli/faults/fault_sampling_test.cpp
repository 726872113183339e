// Runs commands while calls of the system or of OpenCL fail (failing_calls.c), at places sampled over all
// calls of a run: one call alone, or that call and all later ones. Whatever fails, a command ends with an
// agreed exit code, its outputs are complete or absent, nothing else is left behind, and the caches that it
// wrote serve the next run.
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
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "cli/faults/command_runs.h"

namespace prelight::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 8> kinds = {"allocation", "open", "write", "thread",
                                              "rename",     "read", "sync",  "device"};
constexpr std::size_t readKind = 5, deviceKind = 7;
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

class FaultRuns : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(runs_.folder() / "spill");
    fs::create_directories(cache());
    ASSERT_EQ(runs_.makeInputs(environmentOf("")), "");
    spareLibraries();
  }
  void TearDown() override {
    std::error_code ignored;
    if (HasFailure()) fs::remove_all(cache(), ignored);
  }
  static void TearDownTestSuite() {
    std::error_code ignored;
    fs::remove_all(cache(), ignored);
  }

  /// The folder of compiled kernels and shaders: kept between the cases of a process, because kernels take
  /// long to compile, and not shared with other processes, whose failing calls would spoil it.
  static fs::path cache() { return fs::path(PRELIGHT_FAULT_CACHE) / std::to_string(getpid()); }

  fs::path countsFile() const { return runs_.folder() / "counts"; }

  CommandRuns::Environment environmentOf(const std::string& fault) const {
    return {{"LD_PRELOAD", PRELIGHT_FAILING_CALLS},
            {"PRELIGHT_FAULT_COUNTS", countsFile().string()},
            {"PRELIGHT_FAULT", fault},
            {"PRELIGHT_FAULT_SPARES", spared_},
            {"TMPDIR", (runs_.folder() / "spill").string()},
            {"XDG_CACHE_HOME", cache().string()},
            {"POCL_CACHE_DIR", cache().string()}};
  }

  ProcessResult run(const std::string& arguments, const std::string& fault, Counts& counts) const {
    std::ofstream(countsFile(), std::ios::binary) << std::string(sizeof(Counts), '\0');
    ProcessResult result = runs_.run(arguments, environmentOf(fault));
    const std::string bytes = textOf(countsFile());
    std::copy_n(bytes.data(), std::min(bytes.size(), sizeof(Counts)), reinterpret_cast<char*>(&counts));
    return result;
  }

  /// Libraries answer a small allocation or a read that fails alone in ways that no caller can notice
  /// (docs/notes/robustness.md): Mesa leaves out a part of a picture, and PoCL 3 waits for ever for a lock of
  /// its own, and LLVM within Mesa's driver ends the process by a trap. Where hwloc cannot read what the
  /// processor is, PoCL gives the device another name.
  void spareLibraries() {
    spared_ = "swrast_dri:gallium:libLLVM:libhwloc";
    Counts ignored;
    const ProcessResult listed = run("devices --json", "", ignored);
    ASSERT_EQ(listed.exitCode, 0) << listed.errors;
    for (const auto& device : nlohmann::json::parse(listed.output)["devices"])
      if (device["platform"] == "Portable Computing Language" &&
          device["driverVersion"].get<std::string>().starts_with("3."))
        spared_ += ":libpocl";
  }

  CommandRuns runs_;
  std::string spared_;  ///< parts of file names of libraries whose single allocations do not fail
};

class FaultSampling : public FaultRuns, public ::testing::WithParamInterface<Command> {};

/// Places among the calls of a run. Every kind and both lengths get their share; kinds with few calls are
/// tried at all of them.
std::vector<Fault> sampledFaults(const Counts& counts, std::size_t samples) {
  std::vector<Fault> faults;
  std::mt19937 random(1);
  constexpr std::array<double, kinds.size()> shares = {0.35, 0.12, 0.1, 0.08, 0.08, 0.12, 0.03, 0.12};
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
  const std::map<std::string, std::string> whole = runs_.outputs();
  ASSERT_EQ(clean.exitCode, 0) << clean.errors;
  std::map<std::string, std::map<int, int>> ends;
  for (const Fault& fault : sampledFaults(calls, sampleCount())) {
    SCOPED_TRACE(fault.text());
    const ProcessResult result = run(command.arguments, fault.text(), counts);
    ++ends[std::string(kinds[fault.kind]) + " " + lengths[fault.length]][result.exitCode];
    EXPECT_EQ(agreed.count(result.exitCode), 1u) << "code " << result.exitCode << "\n" << result.errors;
    const std::map<std::string, std::string> left = runs_.outputs();
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
    EXPECT_TRUE(fs::is_empty(runs_.folder() / "spill")) << "a temporary file is left";
  }
  printTable(command, calls, ends);
  const ProcessResult after = run(command.arguments, "", counts);
  EXPECT_EQ(after.exitCode, 0) << "the caches are spoilt\n" << after.errors;
  EXPECT_EQ(runs_.outputs(), whole);
}

TEST_F(FaultRuns, DeviceThatIsLost_IsToldWithWhatToDo) {
  const std::string command = "bake @scene.glb -o out.glb --ao --rays 16 --quiet";
  Counts calls, counts;
  ASSERT_EQ(run(command, "", calls).exitCode, 0);
  constexpr std::uint64_t places = 12;
  const std::uint64_t all = calls.calls[deviceKind];
  ASSERT_GT(all, places);
  for (std::uint64_t i = 0; i < places; ++i) {
    const std::string fault = "device " + std::to_string(1 + i * all / places) + " forever";
    const ProcessResult result = run(command, fault, counts);
    EXPECT_NE(result.exitCode, 0) << fault;
    EXPECT_THAT(result.errors, ::testing::AllOf(::testing::HasSubstr("cl"), ::testing::HasSubstr("--device")))
        << fault;
  }
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

INSTANTIATE_TEST_SUITE_P(OfCommands, FaultSampling, ::testing::ValuesIn(everyCommand()),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace prelight::test
