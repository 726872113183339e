#include "io/bake_writer.h"

#include "techniques/registry/registry.h"

namespace prelight {

std::size_t storedBytes(const Bake& bake) {
  std::size_t bytes = 0;
  for (const Technique& technique : techniques())
    if (technique.file.storedBytes != nullptr) bytes += technique.file.storedBytes(bake);
  return bytes;
}

nlohmann::ordered_json entryToJson(const BakedOutput& output, const PrimitiveRanges& ranges) {
  nlohmann::ordered_json entry = nlohmann::ordered_json::object();
  if (vertexCount(ranges) == 0) return entry;
  for (const Technique& technique : techniques())
    if (technique.file.writeEntry != nullptr) technique.file.writeEntry(output, ranges, entry);
  return entry;
}

void addRootMembers(const BakedOutput& output, nlohmann::ordered_json& root) {
  for (const Technique& technique : techniques())
    if (technique.file.writeRoot != nullptr) technique.file.writeRoot(output, root);
}

}  // namespace prelight
