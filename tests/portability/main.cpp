// Runs the tests with the OpenCL implementations of the build folder besides the system's. The loader and the
// dynamic linker read their variables once, so the program restarts itself with them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

void restartWithSecondImplementation(char** arguments) {
  const std::filesystem::path folder = PRELIGHT_OPENCL_FOLDER;
  if (std::getenv("OCL_ICD_VENDORS") != nullptr || !std::filesystem::exists(folder / "complete")) return;
  const char* libraries = std::getenv("LD_LIBRARY_PATH");
  const std::string path =
      (folder / "lib").string() + (libraries != nullptr ? std::string(":") + libraries : "");
  setenv("LD_LIBRARY_PATH", path.c_str(), 1);
  setenv("OCL_ICD_VENDORS", (folder / "vendors").c_str(), 1);
  execv("/proc/self/exe", arguments);
}

}  // namespace

int main(int argc, char** argv) {
  restartWithSecondImplementation(argv);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
