#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace prelight {

/// Something that animations may move, which the export has more than once, by JSON pointers.
struct AnimatedCopies {
  std::string from;             ///< "/materials/3"
  std::vector<std::string> to;  ///< "/materials/7"
  bool moved = false;           ///< it is no longer where it was
};

/// Gives a channel that moves something for each of its copies. Channels of glTF itself are those of the
/// pointers "/nodes/N/PATH".
void animateCopies(nlohmann::ordered_json& root, const std::vector<AnimatedCopies>& copies);

/// Removes channels that move what `gone` says is no longer there, by its pointer. Animations need a channel;
/// one that is left without any goes.
void dropChannels(nlohmann::ordered_json& root, const std::function<bool(const std::string& pointer)>& gone);

}  // namespace prelight
