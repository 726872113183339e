#include "scene/gltf/uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>

namespace prelight {

namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Returns the value of a base64 digit (also of the URL-safe alphabet), or -1.
int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

std::string percentDecode(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = high >= 0 ? hexDigit(text[i + 2]) : -1;
    if (low >= 0) {
      decoded += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

std::optional<std::vector<std::uint8_t>> decodeBase64(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int bitCount = 0;
  bool padded = false;
  for (const char c : text) {
    if (isSpace(c)) continue;
    if (c == '=') {
      padded = true;
      continue;
    }
    const int digit = base64Digit(c);
    if (digit < 0 || padded) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    bitCount += 6;
    if (bitCount >= 8) {
      bitCount -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> bitCount));
    }
  }
  if (bitCount >= 6) return std::nullopt;  // one lone digit carries no whole byte
  return bytes;
}

std::string uriScheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return {};
  const std::string_view scheme = uri.substr(0, colon);
  const auto isSchemeCharacter = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  };
  if (!std::all_of(scheme.begin(), scheme.end(), isSchemeCharacter)) return {};
  return lowerCase(scheme);
}

bool isDataUri(std::string_view uri) { return uriScheme(uri) == "data"; }

std::optional<DataUri> parseDataUri(std::string_view uri) {
  if (!isDataUri(uri)) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  constexpr std::size_t schemeLength = 5;  // "data:"
  const std::string_view header = uri.substr(schemeLength, comma - schemeLength);
  const std::string_view body = uri.substr(comma + 1);

  DataUri data;
  data.mimeType = std::string(header.substr(0, header.find(';')));
  const std::size_t lastParameter = header.rfind(';');
  const bool base64 =
      lastParameter != std::string_view::npos && lowerCase(header.substr(lastParameter + 1)) == "base64";
  if (!base64) {
    const std::string text = percentDecode(body);
    data.bytes.assign(text.begin(), text.end());
    return data;
  }
  const bool escaped = body.find('%') != std::string_view::npos;
  std::optional<std::vector<std::uint8_t>> bytes =
      escaped ? decodeBase64(percentDecode(body)) : decodeBase64(body);
  if (!bytes) return std::nullopt;
  data.bytes = *std::move(bytes);
  return data;
}

namespace fs = std::filesystem;

namespace {

// Limits of file systems: PATH_MAX for path and folder together, and NAME_MAX.
constexpr std::size_t longestPath = 4095;
constexpr std::size_t longestName = 255;

void checkName(const JsonCursor& uri, const fs::path& file) {
  const std::string& text = file.native();
  if (text.find('\0') != std::string::npos) uri.fail("the name has a zero byte, which no file name can have");
  std::size_t longest = 0;
  for (const fs::path& part : file) longest = std::max(longest, part.native().size());
  if (text.size() > longestPath || longest > longestName)
    uri.fail(fmt::format("a name of {} characters, expected at most {} and {} between slashes", text.size(),
                         longestPath, longestName));
}

/// Some exporters forget to percent-encode, so the raw name is tried as well.
fs::path namedFile(const fs::path& folder, const std::string& uri) {
  std::error_code ignored;
  fs::path decoded = folder / percentDecode(uri);
  if (!fs::exists(decoded, ignored) && fs::exists(folder / uri, ignored)) return folder / uri;
  return decoded;
}

/// Returns true when a file lies in a folder or below. Both paths are without symbolic links, "." and "..".
bool liesBelow(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

void requireInside(const JsonCursor& uri, const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path home = fs::canonical(folder, error);
  // weakly_canonical() does not make a relative path absolute if it does not exist.
  const fs::path place = error ? fs::path() : fs::weakly_canonical(fs::absolute(file), error);
  if (error) uri.fail(fmt::format("cannot tell where \"{}\" lies: {}", uri.asString(), error.message()));
  if (!liesBelow(place, home))
    uri.fail(fmt::format("\"{}\" lies outside of the scene's folder, expected a file in it or below",
                         uri.asString()),
             "put the file beside the scene, or set LoadOptions::allowOutside if you trust the scene");
}

bool isRelative(const JsonCursor& uri) {
  // One letter before the colon is a drive of the file system, not a scheme.
  return uri.value().is_string() && uriScheme(uri.asString()).size() <= 1;
}

void checkReference(const GltfDocument& document, const JsonCursor& object, const char* member) {
  if (!object.value().is_object()) return;
  const auto uri = object.find(member);
  if (uri && isRelative(*uri)) (void)referencedFile(document, *uri);
}

/// Calls visit for the elements of an array member, if it is an array.
template <class Visit>
void visitObjects(const JsonCursor& holder, std::string_view key, Visit visit) {
  const auto array = holder.value().is_object() ? holder.find(key) : std::nullopt;
  if (!array || !array->value().is_array()) return;
  for (std::size_t i = 0; i < array->value().size(); ++i) visit(array->at(i));
}

void checkLightMaps(const GltfDocument& document, const JsonCursor& node) {
  const auto member = [](const JsonCursor& object, std::string_view key) {
    return object.value().is_object() ? object.find(key) : std::nullopt;
  };
  const auto extensions = member(node, "extensions");
  const auto bake = extensions ? member(*extensions, "PRELIGHT_transfer") : std::nullopt;
  if (!bake) return;
  visitObjects(*bake, "primitives", [&](const JsonCursor& primitive) {
    const auto map = member(primitive, "lightmap");
    if (!map) return;
    checkReference(document, *map, "image");
    if (const auto back = member(*map, "back")) checkReference(document, *back, "image");
  });
}

}  // namespace

fs::path referencedFile(const GltfDocument& document, const JsonCursor& uri) {
  const fs::path parent = document.path.parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  checkName(uri, folder / percentDecode(uri.asString()));
  checkName(uri, folder / uri.asString());
  fs::path file = namedFile(parent, uri.asString());
  if (!document.outsideAllowed) requireInside(uri, file, folder);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
    uri.fail(fmt::format("\"{}\" is a device, a pipe or a socket, expected a file", uri.asString()));
  return file;
}

void checkFileReferences(const GltfDocument& document) {
  const std::string name = document.path.string();
  const JsonCursor root(name, document.json);
  visitObjects(root, "buffers", [&](const JsonCursor& b) { checkReference(document, b, "uri"); });
  visitObjects(root, "images", [&](const JsonCursor& image) { checkReference(document, image, "uri"); });
  const auto extensions = root.value().is_object() ? root.find("extensions") : std::nullopt;
  if (extensions && extensions->value().is_object()) {
    const auto profiles = extensions->find("EXT_lights_ies");
    if (profiles && profiles->value().is_object())
      visitObjects(*profiles, "lights",
                   [&](const JsonCursor& profile) { checkReference(document, profile, "uri"); });
  }
  visitObjects(root, "nodes", [&](const JsonCursor& node) { checkLightMaps(document, node); });
}

}  // namespace prelight
