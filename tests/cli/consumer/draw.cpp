#include <prelight/prelight.h>

#include <iostream>

/// Bakes a room and draws it. Needs no display.
int main(int count, char** arguments) {
  try {
    const prelight::LoadedScene room = prelight::loadBuiltin("cornell");
    const prelight::Device device = prelight::Device::open({});
    const auto [bake, report] =
        prelight::bake(room, {.sh = {.order = 3}, .bounces = 1, .effort = {.rays = 64}}, {.device = &device});
    const prelight::Drawing drawing = prelight::draw(room, {.shading = prelight::Shading::Sh, .height = 48},
                                                     {.bake = &bake, .device = &device});
    for (const std::string& warning : drawing.warnings) std::cerr << warning << "\n";
    prelight::writePicture(count > 1 ? arguments[1] : "room.png", drawing.picture);
  } catch (const prelight::Error& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(error.code());
  }
}
