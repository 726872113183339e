#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace prelight {

/// Decodes "%20" to " ". A percent sign that two hexadecimal digits do not follow is kept.
std::string percentDecode(std::string_view text);

/// Returns the bytes of a base64 text; white space and missing padding are tolerated. nullopt for any other
/// character.
std::optional<std::vector<std::uint8_t>> decodeBase64(std::string_view text);

/// The content of a data URI.
struct DataUri {
  std::string mimeType;  ///< may be empty
  std::vector<std::uint8_t> bytes;
};

bool isDataUri(std::string_view uri);

/// Decodes "data:[MIME][;parameters][;base64],DATA"; nullopt when it is malformed.
std::optional<DataUri> parseDataUri(std::string_view uri);

/// Returns the scheme of "scheme:rest" in lower case; empty for a relative reference.
std::string uriScheme(std::string_view uri);

}  // namespace prelight
