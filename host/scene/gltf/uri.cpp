#include "scene/gltf/uri.h"

#include <algorithm>
#include <cctype>

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

}  // namespace prelight
