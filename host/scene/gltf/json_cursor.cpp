#include "scene/gltf/json_cursor.h"

#include <fmt/format.h>

#include <cmath>

#include "prelight/error.h"

namespace prelight {

namespace {

std::string describe(const nlohmann::ordered_json& value) {
  constexpr std::size_t longest = 40;
  switch (value.type()) {
    case nlohmann::ordered_json::value_t::object:
      return "an object";
    case nlohmann::ordered_json::value_t::array:
      return fmt::format("an array of {}", value.size());
    case nlohmann::ordered_json::value_t::string: {
      const auto& text = value.get_ref<const std::string&>();
      return text.size() <= longest ? '"' + text + '"' : '"' + text.substr(0, longest) + "...\"";
    }
    default:
      return value.dump();
  }
}

std::string escapePointer(std::string_view key) {
  std::string escaped;
  for (const char c : key) {
    if (c == '~') {
      escaped += "~0";
    } else if (c == '/') {
      escaped += "~1";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::optional<std::uint64_t> unsignedValue(const nlohmann::ordered_json& json) {
  if (json.is_number_unsigned()) return json.get<std::uint64_t>();
  if (json.is_number_integer()) {
    const auto value = json.get<std::int64_t>();
    return value < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(value));
  }
  constexpr double exactIntegers = 9007199254740992.0;  // 2^53
  const double value = json.is_number_float() ? json.get<double>() : -1.0;
  if (!(value >= 0.0 && value <= exactIntegers) || value != std::floor(value)) return std::nullopt;
  return static_cast<std::uint64_t>(value);
}

void JsonCursor::fail(const std::string& what, const std::string& fix) const {
  throw InputError(where(), what, fix);
}

JsonCursor JsonCursor::at(std::string_view key) const {
  std::optional<JsonCursor> member = find(key);
  if (!member) fail(fmt::format("required member \"{}\" is missing", key));
  return *std::move(member);
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
  expectObject();
  const auto found = value_->find(std::string(key));
  if (found == value_->end()) return std::nullopt;
  return memberAt(key, *found);
}

JsonCursor JsonCursor::memberAt(std::string_view key, const Json& value) const {
  return {file_, &value, path_ + '/' + escapePointer(key)};
}

JsonCursor JsonCursor::at(std::size_t index) const {
  return {file_, &(*value_)[index], path_ + '/' + std::to_string(index)};
}

void JsonCursor::expectObject() const {
  if (!value_->is_object()) fail("expected an object, got " + describe(*value_));
}

std::size_t JsonCursor::arraySize() const {
  if (!value_->is_array()) fail("expected an array, got " + describe(*value_));
  return value_->size();
}

std::uint64_t JsonCursor::asUnsigned() const {
  const std::optional<std::uint64_t> value = unsignedValue(*value_);
  if (!value) fail("expected a non-negative integer, got " + describe(*value_));
  return *value;
}

std::size_t JsonCursor::asIndex(std::size_t count, std::string_view kind) const {
  const std::uint64_t index = asUnsigned();
  if (index < count) return index;
  if (count == 0) fail(fmt::format("{} index {} out of range, the file has none", kind, index));
  fail(fmt::format("{} index {} out of range, expected 0..{}", kind, index, count - 1));
}

double JsonCursor::asNumber() const {
  if (!value_->is_number()) fail("expected a number, got " + describe(*value_));
  return value_->get<double>();
}

bool JsonCursor::asBool() const {
  if (!value_->is_boolean()) fail("expected true or false, got " + describe(*value_));
  return value_->get<bool>();
}

const std::string& JsonCursor::asString() const {
  if (!value_->is_string()) fail("expected a string, got " + describe(*value_));
  return value_->get_ref<const std::string&>();
}

void JsonCursor::expectNumbers(std::size_t count) const {
  if (arraySize() != count) fail(fmt::format("expected {} numbers, got {}", count, describe(*value_)));
  for (std::size_t i = 0; i < count; ++i) at(i).asNumber();
}

std::uint64_t JsonCursor::unsignedOr(std::string_view key, std::uint64_t fallback) const {
  const auto member = find(key);
  return member ? member->asUnsigned() : fallback;
}

double JsonCursor::numberOr(std::string_view key, double fallback) const {
  const auto member = find(key);
  return member ? member->asNumber() : fallback;
}

bool JsonCursor::boolOr(std::string_view key, bool fallback) const {
  const auto member = find(key);
  return member ? member->asBool() : fallback;
}

std::string JsonCursor::stringOr(std::string_view key, const std::string& fallback) const {
  const auto member = find(key);
  return member ? member->asString() : fallback;
}

std::size_t JsonCursor::countOf(std::string_view key) const {
  const auto member = find(key);
  return member ? member->arraySize() : 0;
}

}  // namespace prelight
