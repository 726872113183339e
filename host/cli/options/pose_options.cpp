#include "cli/options/pose_options.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "cli/options/options.h"
#include "prelight/error.h"
#include "prelight/load.h"

namespace prelight::cli {
namespace {

constexpr double farthestMove = 1e6;  // in m or degrees

NodeMove parseNodeMove(const std::string& text) {
  const auto fail = [&](const char* what) {
    return UsageError("--move " + text, what,
                      "expected NODE:x,y,z or NODE:x,y,z:yaw, for example Ball:0.5,0,0:30");
  };
  std::size_t end = text.rfind(':');
  if (end == std::string::npos || end == 0) throw fail("the node or the displacement is missing");
  auto numbers = numbersIn(std::string_view(text).substr(end + 1), farthestMove);
  NodeMove move;
  if (numbers && numbers->size() == 1) {
    move.yawDegrees = numbers->front();
    const std::size_t before = text.rfind(':', end - 1);
    if (before == std::string::npos || before == 0) throw fail("three coordinates are needed");
    numbers = numbersIn(std::string_view(text).substr(before + 1, end - before - 1), farthestMove);
    end = before;
  }
  if (!numbers || numbers->size() != 3) throw fail("its coordinates are not three numbers");
  move.pattern = text.substr(0, end);
  move.by = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  return move;
}

}  // namespace

void addPoseOptions(CLI::App& app, pictures::PoseOptions& options) {
  addOption(app, optionNamed<LoadOptions>("at"), std::nullopt,
            [&options](double seconds) { options.at = seconds; });
  app.add_option("--animation", options.animation,
                 "the animation that --at refers to (default: the one that was baked, else the first)")
      ->type_name("NAME|INDEX");
  app.add_option_function<std::vector<std::string>>(
         "--move",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) options.moves.push_back(parseNodeMove(text));
         },
         "move a node, with its vector occluders: NODE:x,y,z[:yaw], in metres and degrees; repeat it for "
         "more")
      ->type_name("MOVE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace prelight::cli
