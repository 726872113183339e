#include "scene/gltf/json_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

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

namespace {

std::string lineAndColumn(const std::string& file, std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t lineStart = before.rfind('\n');
  const std::size_t column = before.size() - (lineStart == std::string_view::npos ? 0 : lineStart + 1) + 1;
  return fmt::format("{}: line {}, column {}", file, line, column);
}

/// Bounds the cost of the tree before it is built: its users recurse over nesting and search members of an
/// ordered object linearly.
void checkShape(std::string_view text, const std::string& file) {
  constexpr std::size_t maxDepth = 128;
  constexpr std::size_t maxMembers = 16384;
  std::vector<std::size_t> members;  // number of members of every open object or array
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      members.push_back(0);
      if (members.size() > maxDepth) {
        throw InputError(lineAndColumn(file, text, i), fmt::format("nested deeper than {} levels", maxDepth));
      }
    } else if (c == '}' || c == ']') {
      if (!members.empty()) members.pop_back();
    } else if (c == ':' && !members.empty() && ++members.back() > maxMembers) {
      throw InputError(lineAndColumn(file, text, i),
                       fmt::format("an object of more than {} members", maxMembers));
    }
  }
}

/// Returns the library's message without its error number and position, which our message states.
std::string plainMessage(std::string message) {
  const std::size_t colon = message.find(": ");
  if (colon != std::string::npos) message.erase(0, colon + 2);
  constexpr std::string_view prefix = "syntax error while parsing ";
  const std::size_t prefixAt = message.find(prefix);
  return prefixAt == std::string::npos ? message : message.substr(prefixAt);
}

/// Builds the tree as the library's own parser does: the last of equal members replaces the first. Takes time
/// linear in the text, while an ordered object searches linearly for a duplicate of every new member.
class TreeBuilder final : public nlohmann::json_sax<nlohmann::ordered_json> {
 public:
  using Json = nlohmann::ordered_json;

  /// The error that stopped the parser.
  struct Failure {
    std::size_t position = 0;  ///< bytes read before it
    bool outOfRange = false;   ///< a number beyond double's range
    std::string message;
  };

  Json root;
  std::optional<Failure> failure;

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t& value) override { return put(std::move(value)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    containers_.back().key = std::move(name);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    constexpr int firstOutOfRange = 400;
    failure = {position, error.id >= firstOutOfRange, error.what()};
    return false;
  }

 private:
  /// An object or array that is not complete yet.
  struct Container {
    Json* json = nullptr;
    std::string key = {};                                 ///< key of the next member
    std::unordered_map<std::string, std::size_t> places;  ///< indices of the members, once there are many
  };

  bool put(Json value) {
    add(std::move(value));
    return true;
  }

  bool open(Json empty) {
    Json& added = add(std::move(empty));
    containers_.push_back({&added, {}, {}});
    return true;
  }

  bool close() {
    containers_.pop_back();
    return true;
  }

  Json& add(Json value) {
    if (containers_.empty()) return root = std::move(value);
    Container& container = containers_.back();
    if (container.json->is_object()) return addMember(container, std::move(value));
    auto& elements = container.json->get_ref<Json::array_t&>();
    elements.push_back(std::move(value));
    return elements.back();
  }

  static std::ptrdiff_t at(std::size_t place) { return static_cast<std::ptrdiff_t>(place); }

  static Json& addMember(Container& container, Json value) {
    constexpr std::size_t few = 16;  // up to so many are found faster by linear search
    auto& members = container.json->get_ref<Json::object_t&>();
    std::size_t place = members.size();
    if (members.size() < few) {
      place = static_cast<std::size_t>(members.find(container.key) - members.begin());
    } else {
      if (container.places.empty()) {
        for (std::size_t i = 0; i < members.size(); ++i)
          container.places.emplace(members.begin()[at(i)].first, i);
      }
      place = container.places.emplace(container.key, members.size()).first->second;
    }
    if (place == members.size()) {
      members.emplace_back(std::move(container.key), std::move(value));
      return members.back().second;
    }
    return members.begin()[at(place)].second = std::move(value);
  }

  std::vector<Container> containers_;
};

/// Returns the position of a number beyond double's range, which the library quotes without its position.
std::size_t offsetOfNumber(std::string_view text, const std::string& message) {
  const std::size_t open = message.find('\'');
  const std::size_t close = message.rfind('\'');
  if (open == std::string::npos || close <= open) return 0;
  return text.find(message.substr(open + 1, close - open - 1));
}

}  // namespace

nlohmann::ordered_json parseJson(std::string_view text, const std::string& file) {
  checkShape(text, file);
  TreeBuilder builder;
  nlohmann::ordered_json::sax_parse(text.begin(), text.end(), &builder);
  if (!builder.failure) return std::move(builder.root);
  const TreeBuilder::Failure& failure = *builder.failure;
  const std::string message = plainMessage(failure.message);
  const std::size_t offset =
      failure.outOfRange ? offsetOfNumber(text, message) : std::max<std::size_t>(failure.position, 1) - 1;
  throw InputError(lineAndColumn(file, text, offset), message);
}

}  // namespace prelight
