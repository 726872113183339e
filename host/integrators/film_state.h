#pragma once

#include <filesystem>
#include <optional>

#include "base/state_file.h"
#include "integrators/film.h"
#include "integrators/reference.h"

namespace prelight::reference {

/// All that the bytes of a picture depend on, part by part.
StateKey filmKey(const ReferenceInputs& inputs, const ReferenceRequest& request, const DeviceInfo& device);

/// Keeps an unfinished picture (base/state_file.h).
void writeFilmState(const std::filesystem::path& path, const StateKey& key, const Film& film);

/// The unfinished picture, with its parts or without; nothing when there is no such file. Throws InputError
/// when the file is damaged, UsageError when it belongs to another key.
std::optional<Film> readFilmState(const std::filesystem::path& path, const StateKey& key, bool parts = false);

}  // namespace prelight::reference
