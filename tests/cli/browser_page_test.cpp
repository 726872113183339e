#include <gmock/gmock.h>

#include <regex>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"
#include "support/installed_programs.h"

namespace prelight::test {
namespace {

/// Draws a picture of each shading when the page is there, and leaves their mean radiance, or what went
/// wrong, in the title.
constexpr const char* drawAll = R"(<script type="module">
const wait = setInterval(() => {
  const page = window.prelight, status = document.getElementById('status');
  if (!page && status.className !== 'failed') return;
  clearInterval(wait);
  const said = page ? page.shadings.map(({ name }) => {
    try {
      page.set({ technique: name });
      const picture = page.picture(32, 18);
      return `${name}=${(picture.reduce((sum, value) => sum + value, 0) / picture.length).toFixed(5)}`;
    } catch (error) {
      return `${name} fails: ${error.message.slice(0, 300)}`;
    }
  }) : [status.textContent];
  document.title = `said ${said.join('; ')} end`;
}, 20);
</script>)";

/// Pages in Chromium, where it is installed: whether every shader of theirs compiles there.
class CliBrowser : public CliTest {
 protected:
  void SetUp() override {
    SKIP_WITHOUT("chromium");
    CliTest::SetUp();
  }

  std::string titleOf(const std::string& page) {
    const ProcessResult result =
        runProcess({"chromium", "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
                    "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                    "--user-data-dir=" + path("browser").string(), "--virtual-time-budget=120000",
                    "--dump-dom", "file://" + path(page).string()});
    std::smatch found;
    const std::regex title("<title>([^<]*)</title>");
    return std::regex_search(result.output, found, title) ? found[1].str() : result.errors;
  }
};

TEST_F(CliBrowser, EveryShading_IsDrawn) {
  writeFile("scene.glb", floorAndRoof().bytes());
  prelightDone({"bake",        "scene.glb",
                "-o",          "baked.glb",
                "--sh",        "3",
                "--ch",        "3",
                "--glossy",    "2",
                "--haar",      "4",
                "--ao",        "--cones",
                "--vo",        "--lightmap",
                "--radiosity", "--near-lamps",
                "4",           "--light-groups",
                "--rays",      "16"});
  prelightDone({"export", "baked.glb", "-o", "page.html", "--target", "web", "--env", "neutral"});
  std::string page = readFile("page.html");
  page.insert(page.rfind("</body>"), drawAll);
  writeFile("told.html", page);
  const std::string said = titleOf("told.html");
  EXPECT_THAT(said, ::testing::StartsWith("said "));
  EXPECT_THAT(said, ::testing::EndsWith(" end"));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("fail"))) << said;
  for (const char* shading : {"sh=", "ch=", "glossy=", "haar=", "lights=", "lightmap=", "radiosity=", "vo=",
                              "cones=", "ao=", "phong="})
    EXPECT_THAT(said, ::testing::HasSubstr(shading));
}

}  // namespace
}  // namespace prelight::test
