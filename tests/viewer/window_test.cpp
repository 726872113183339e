// The window on a virtual display, compared with the headless picture of the same view.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/installed_programs.h"
#include "viewer/window_scene.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;
using viewer::Shading;

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("window_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path shot() const { return folder_ / "shot.exr"; }

  /// Runs a shell script on its own display; $PROBE starts the window, and $TITLE is its title.
  int runOnDisplay(const std::string& script) const {
    std::ofstream(folder_ / "script.sh") << "PROBE='" << WINDOW_PROBE << "'\nTITLE='" << test::windowTitle
                                         << "'\nSHOT='" << shot().string() << "'\n"
                                         << script;
    return run("timeout 120 xvfb-run -a -s '-screen 0 800x600x24' sh '" + (folder_ / "script.sh").string() +
               "'");
  }

  void expectShows(const viewer::RenderOptions& options) const {
    const Picture shown = readPicture(shot());
    const Picture expected = test::windowScene().render(options);
    ASSERT_EQ(shown.width, expected.width);
    ASSERT_EQ(shown.height, expected.height);
    double sum = 0.0;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
      const glm::vec3 difference = shown.pixels[i] - expected.pixels[i];
      sum += glm::dot(difference, difference);
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(shown.pixels.size())), 1e-3);
  }

  fs::path folder_;
};

TEST_F(WindowTest, Screenshot_AfterThreeFrames_IsTheHeadlessPicture) {
  SKIP_WITHOUT("xvfb-run");
  ASSERT_EQ(runOnDisplay("exec \"$PROBE\" \"$SHOT\" 3\n"), 0);
  expectShows(test::windowOptions());
}

TEST_F(WindowTest, Keys_PressedInTheWindow_SwitchTheShadingTurnTheSkyAndQuit) {
  SKIP_WITHOUT("xvfb-run");
  SKIP_WITHOUT("xdotool");
  ASSERT_EQ(runOnDisplay("\"$PROBE\" \"$SHOT\" 0 & probe=$!\n"
                         "window=$(xdotool search --sync --onlyvisible --name \"$TITLE\" | head -1)\n"
                         "xdotool windowfocus --sync \"$window\"; sleep 1\n"
                         "xdotool key 3; sleep 0.3; xdotool key q; sleep 0.3; xdotool key h; sleep 0.3\n"
                         "xdotool key Escape\n"
                         "wait $probe\n"),
            0);
  viewer::RenderOptions options = test::windowOptions();
  options.shading = Shading::Sh;
  options.skyRotation = 5.0 * 3.14159265358979323846 / 180.0;
  expectShows(options);
}

TEST_F(WindowTest, Mouse_DraggedAcrossTheScene_MovesThePicture) {
  SKIP_WITHOUT("xvfb-run");
  SKIP_WITHOUT("xdotool");
  ASSERT_EQ(
      runOnDisplay("\"$PROBE\" \"$SHOT\" 0 & probe=$!\n"
                   "window=$(xdotool search --sync --onlyvisible --name \"$TITLE\" | head -1)\n"
                   "xdotool windowfocus --sync \"$window\"; sleep 1\n"
                   "xdotool mousemove --window \"$window\" 250 200 mousedown 1; sleep 0.3\n"
                   "xdotool mousemove --window \"$window\" 280 180; sleep 0.3; xdotool mouseup 1; sleep 0.3\n"
                   "xdotool key Escape\n"
                   "wait $probe\n"),
      0);
  const Picture shown = readPicture(shot());
  const Picture first = test::windowScene().render(test::windowOptions());
  double sum = 0.0;
  for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
    sum += glm::length(shown.pixels[i] - first.pixels[i]);
  }
  EXPECT_GT(sum / static_cast<double>(shown.pixels.size()), 0.02);
}

TEST_F(WindowTest, File_DroppedOnTheWindow_ClosesItAndIsReturned) {
  SKIP_WITHOUT("xvfb-run");
  ASSERT_EQ(runOnDisplay("exec \"$PROBE\" \"$SHOT\" 100 other.glb >\"$SHOT.dropped\"\n"), 0);
  std::string dropped;
  std::getline(std::ifstream(shot().string() + ".dropped"), dropped);
  EXPECT_EQ(dropped, "other.glb");
  EXPECT_FALSE(fs::exists(shot()));
}

TEST_F(WindowTest, WithoutADisplay_SaysSoAndWhatToUseInstead) {
  const fs::path log = folder_ / "log.txt";
  const int status = run("env -u DISPLAY -u WAYLAND_DISPLAY '" + std::string(WINDOW_PROBE) + "' '" +
                         shot().string() + "' 1 2>'" + log.string() + "'");
  EXPECT_EQ(status, 1);
  std::stringstream text;
  text << std::ifstream(log).rdbuf();
  EXPECT_NE(text.str().find("no display"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("prelight render"), std::string::npos) << text.str();
  EXPECT_FALSE(fs::exists(shot()));
}

}  // namespace
}  // namespace prelight
