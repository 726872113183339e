#pragma once

#include <gtest/gtest.h>

#include <ostream>

#include "io/baked_file.h"
#include "support/gltf_files.h"

namespace prelight::test {

/// A change to one place in the JSON of a baked file, and what the message must name.
struct Misfit {
  const char* name;
  const char* pointer;
  const char* value;
  const char* expected;
};

inline std::ostream& operator<<(std::ostream& out, const Misfit& m) { return out << m.name; }

/// Bakes into the document, spoils it, and expects the reader to name the place.
inline void expectRefused(GltfDocument document, const Bake& bake, const CompiledScene& scene,
                          const Misfit& misfit) {
  embedBake(document, scene, bake);
  document.json[nlohmann::ordered_json::json_pointer(misfit.pointer)] =
      nlohmann::ordered_json::parse(misfit.value);
  const std::string message = inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find(misfit.expected), std::string::npos) << message;
}

}  // namespace prelight::test
