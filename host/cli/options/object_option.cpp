#include "cli/options/object_option.h"

#include <optional>
#include <string_view>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight::cli {
namespace {

constexpr double farthestObject = 1e6;  // in m, degrees or as a factor

PlacedObject parsePlacedObject(const std::string& text) {
  const auto fail = [&](const char* what) {
    return UsageError("--object " + text, what,
                      "expected FILE:x,y,z, FILE:x,y,z:yaw or FILE:x,y,z:yaw:scale, for example "
                      "ball.glb:0.5,0,0:30:2");
  };
  PlacedObject object;
  std::vector<double> after;  // the numbers after the coordinates, in reverse order
  for (std::size_t end = text.size();;) {
    const std::size_t colon = end == 0 ? std::string::npos : text.rfind(':', end - 1);
    if (colon == std::string::npos || colon == 0) throw fail("the file or the place is missing");
    const auto numbers = numbersIn(std::string_view(text).substr(colon + 1, end - colon - 1), farthestObject);
    if (!numbers || (numbers->size() != 3 && (numbers->size() != 1 || after.size() == 2)))
      throw fail("its coordinates are not three numbers");
    end = colon;
    if (numbers->size() == 1) {
      after.push_back(numbers->front());
      continue;
    }
    object.at = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    object.file = text.substr(0, colon);
    break;
  }
  if (!after.empty()) object.yawDegrees = after.back();
  if (after.size() == 2) object.scale = after.front();
  if (!(object.scale > 0.0)) throw fail("its scale is not above 0");
  return object;
}

}  // namespace

void addObjectOption(CLI::App& app, std::vector<PlacedObject>& objects, const std::string& help) {
  app.add_option_function<std::vector<std::string>>(
         "--object",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) objects.push_back(parsePlacedObject(text));
         },
         help +
             ": FILE:x,y,z[:yaw[:scale]], with the place of its origin in metres and the yaw in degrees; "
             "repeat it for more")
      ->type_name("OBJECT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace prelight::cli
