#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "reference/film.h"
#include "reference/reference.h"

namespace prelight::reference {

/// All that the bytes of a picture depend on, a member each: options in words, scene and sky as hashes.
nlohmann::ordered_json identityOf(const ReferenceInputs& inputs, const ReferenceRequest& request,
                                  const DeviceInfo& device);

/// Where the state of an unfinished picture lies: beside it, with ".partial" appended.
std::filesystem::path partialPath(const std::filesystem::path& output);

/// Writes beside and renames.
void writePartial(const std::filesystem::path& path, const nlohmann::ordered_json& identity,
                  const Film& film);

/// The film that was interrupted; nothing when there is no such file. Throws InputError when the file is
/// broken or its identity is another, naming each difference.
std::optional<Film> readPartial(const std::filesystem::path& path, const nlohmann::ordered_json& identity);

}  // namespace prelight::reference
