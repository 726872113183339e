#include "io/bake_reader.h"

#include <fmt/format.h>

#include "io/values/transfer_extension.h"
#include "io/values/value_reader.h"
#include "techniques/registry/registry.h"

namespace prelight {

BakeReader::BakeReader(const BakedInput& input) : input_(input) {
  for (const Technique& technique : techniques()) {
    const TechniqueFile& file = technique.file;
    if (file.everywhere) members_.insert(members_.end(), file.members.begin(), file.members.end());
    if (file.makeReader != nullptr) readers_.push_back(file.makeReader(input));
  }
}

bool BakeReader::readVertices() {
  bool any = input_.extension.has_value();
  for (const auto& [key, ranges] : groupRanges(input_.scene)) {
    const JsonCursor node = input_.root.at("nodes").at(static_cast<std::size_t>(key.first));
    const auto extension = transferExtension(node);
    any = any || extension.has_value();
    if (!any || vertexCount(ranges) == 0) continue;
    if (!extension) node.fail("no PRELIGHT_transfer on the node, other nodes have it", rebake);
    const JsonCursor primitives = extension->at("primitives");
    const auto index = static_cast<std::size_t>(key.second);
    if (index >= primitives.arraySize())
      primitives.fail(fmt::format("{} primitives, expected more than {}", primitives.arraySize(), index),
                      rebake);
    readEntry(primitives.at(index), ranges);
  }
  return any;
}

void BakeReader::readEntry(const JsonCursor& entry, const PrimitiveRanges& ranges) {
  entry.expectObject();
  std::vector<bool> there;
  for (const std::string_view member : members_) there.push_back(entry.find(member).has_value());
  if (there_ && *there_ != there)
    entry.fail("expected the same techniques as on the other primitives", rebake);
  there_ = std::move(there);
  for (const auto& reader : readers_) reader->read(entry, ranges, bake_);
}

Bake BakeReader::finish() {
  for (const auto& reader : readers_) reader->finish(bake_);
  return std::move(bake_);
}

}  // namespace prelight
