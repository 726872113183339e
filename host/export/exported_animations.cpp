#include "export/exported_animations.h"

#include <fmt/format.h>

#include "scene/gltf/json_cursor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

const Json::json_pointer pointerMember("/target/extensions/KHR_animation_pointer/pointer");

/// Returns the pointer of a channel, empty for a channel without a target.
std::string pointerOf(const Json& channel) {
  if (channel.contains(pointerMember) && channel[pointerMember].is_string())
    return channel[pointerMember].get<std::string>();
  const Json::json_pointer node("/target/node"), path("/target/path");
  if (!channel.contains(node) || !channel.contains(path) || !channel[path].is_string()) return {};
  return fmt::format("/nodes/{}/{}", unsignedValue(channel[node]).value_or(0),
                     channel[path].get<std::string>());
}

void setPointer(Json& channel, const std::string& pointer) {
  if (channel.contains(pointerMember)) {
    channel[pointerMember] = pointer;
    return;
  }
  constexpr std::size_t before = std::string_view("/nodes/").size();
  channel["target"]["node"] = std::stoul(pointer.substr(before));
}

bool isWithin(const std::string& pointer, const std::string& whole) {
  return pointer.starts_with(whole) && (pointer.size() == whole.size() || pointer[whole.size()] == '/');
}

/// Appends a channel, or the channels for its copies.
void appendChannels(const Json& channel, const std::vector<AnimatedCopies>& copies, Json& channels) {
  const std::string pointer = pointerOf(channel);
  bool kept = true;
  Json further = Json::array();
  for (const AnimatedCopies& copy : copies) {
    if (!isWithin(pointer, copy.from)) continue;
    if (copy.moved) kept = false;
    for (const std::string& to : copy.to) {
      further.push_back(channel);
      setPointer(further.back(), to + pointer.substr(copy.from.size()));
    }
  }
  if (kept) channels.push_back(channel);
  channels.insert(channels.end(), further.begin(), further.end());
}

}  // namespace

void animateCopies(Json& root, const std::vector<AnimatedCopies>& copies) {
  if (!root.contains("animations")) return;
  for (Json& animation : root["animations"]) {
    Json channels = Json::array();
    for (const Json& channel : animation["channels"]) appendChannels(channel, copies, channels);
    animation["channels"] = std::move(channels);
  }
}

void dropChannels(Json& root, const std::function<bool(const std::string& pointer)>& gone) {
  if (!root.contains("animations")) return;
  Json animations = Json::array();
  for (Json& animation : root["animations"]) {
    Json channels = Json::array();
    for (Json& channel : animation["channels"])
      if (!gone(pointerOf(channel))) channels.push_back(channel);
    if (channels.empty()) continue;
    animation["channels"] = std::move(channels);
    animations.push_back(std::move(animation));
  }
  if (animations.empty())
    root.erase("animations");
  else
    root["animations"] = std::move(animations);
}

}  // namespace prelight
