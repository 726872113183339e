#pragma once

#include <CLI/CLI.hpp>

#include "encodings/encoding.h"

namespace prelight::cli {

/// Adds --encoding.
void addEncodingOption(CLI::App& app, const Encoding*& encoding);

}  // namespace prelight::cli
