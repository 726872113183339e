#include "fuzz/glb_mutator.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "scene/gltf/glb_container.h"

namespace prelight::fuzz {

namespace {

using Json = nlohmann::ordered_json;
using Random = std::minstd_rand;

constexpr std::size_t deepest = 100;  ///< nesting of trees that are changed: some functions of trees recurse

struct Glb {
  Json json;
  std::vector<std::uint8_t> bin;
};

const std::array<double, 38> numbers = {
    0,   1,    2,     3,     4,          5,          6,           7,    8,    16,   127,   128,  255,
    256, 1024, 65535, 65536, 2147483647, 2147483648, 4294967295., 5120, 5121, 5122, 5123,  5125, 5126,
    -1,  -2,   0.5,   1e-30, 1e-7,       1e15,       1e19,        1e30, 1e38, 1e39, 1e308, -1e38};

const std::array<const char*, 50> words = {"POSITION",
                                           "NORMAL",
                                           "TANGENT",
                                           "TEXCOORD_0",
                                           "TEXCOORD_1",
                                           "COLOR_0",
                                           "JOINTS_0",
                                           "WEIGHTS_0",
                                           "TRANSLATION",
                                           "ROTATION",
                                           "SCALE",
                                           "SCALAR",
                                           "VEC2",
                                           "VEC3",
                                           "VEC4",
                                           "MAT2",
                                           "MAT3",
                                           "MAT4",
                                           "LINEAR",
                                           "STEP",
                                           "CUBICSPLINE",
                                           "translation",
                                           "rotation",
                                           "scale",
                                           "weights",
                                           "pointer",
                                           "OPAQUE",
                                           "MASK",
                                           "BLEND",
                                           "perspective",
                                           "orthographic",
                                           "directional",
                                           "point",
                                           "spot",
                                           "ATTRIBUTES",
                                           "TRIANGLES",
                                           "INDICES",
                                           "OCTAHEDRAL",
                                           "QUATERNION",
                                           "EXPONENTIAL",
                                           "COLOR",
                                           "NONE",
                                           "image/png",
                                           "image/jpeg",
                                           "image/ktx2",
                                           "data:,",
                                           "data:application/octet-stream;base64,AAAA",
                                           "../a",
                                           "a.bin",
                                           ""};

std::size_t below(Random& random, std::size_t count) { return random() % std::max<std::size_t>(1, count); }

bool isShallow(std::string_view text) {
  std::size_t depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > deepest) return false;
  }
  return true;
}

std::optional<Glb> split(Bytes file) {
  if (!isGlb(file)) return std::nullopt;
  try {
    Warnings ignored;
    const GlbChunks chunks = splitGlb(file, "", ignored);
    if (!isShallow(chunks.json)) return std::nullopt;
    Glb glb{Json::parse(chunks.json, nullptr, false), {}};
    if (glb.json.is_discarded() || !glb.json.is_object()) return std::nullopt;
    if (chunks.bin) glb.bin.assign(chunks.bin->begin(), chunks.bin->end());
    return glb;
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Writes a file into the buffer. Returns its size, or 0 if the buffer is too small.
std::size_t join(const std::string& json, Bytes bin, std::span<std::uint8_t> buffer) {
  std::vector<std::uint8_t> file = makeGlbPrefix(json, bin.size(), "");
  file.insert(file.end(), bin.begin(), bin.end());
  file.resize((file.size() + 3) / 4 * 4);
  if (file.size() > buffer.size()) return 0;
  std::ranges::copy(file, buffer.begin());
  return file.size();
}

/// A value of a tree, and the array or object that holds it.
struct Place {
  Json* holder = nullptr;
  Json* value = nullptr;
  std::string key = {};   ///< in an object
  std::size_t index = 0;  ///< in an array
};

void listPlaces(Json& holder, std::vector<Place>& places) {
  std::size_t index = 0;
  for (auto& item : holder.items()) {
    places.push_back({&holder, &item.value(), holder.is_object() ? item.key() : std::string(), index++});
    if (item.value().is_structured()) listPlaces(item.value(), places);
  }
}

void changeNumber(Json& value, Random& random) {
  switch (random() % 4) {
    case 0:
      value = numbers[below(random, numbers.size())];
      break;
    case 1:
      value = static_cast<std::int64_t>(numbers[below(random, 20)]);
      break;
    case 2:
      if (value.is_number_integer()) value = value.get<std::int64_t>() / 2;
      break;
    default:
      if (value.is_number_integer())
        value = static_cast<std::int64_t>(value.get<std::uint64_t>() + random() % 9 - 4);
      else if (value.is_number())
        value = value.get<double>() * (random() % 2 == 0 ? -1.0 : 1e6);
  }
}

void changeValue(const Place& place, const std::vector<Place>& places, Random& random) {
  Json& value = *place.value;
  if (value.is_number() && random() % 4 != 0) return changeNumber(value, random);
  if (value.is_string() && random() % 2 == 0) {
    value = words[below(random, words.size())];
    return;
  }
  if (value.is_boolean() && random() % 2 == 0) {
    value = !value.get<bool>();
    return;
  }
  const Json other = *places[below(random, places.size())].value;
  value = other;
}

/// Changes one place of the tree.
void changeTree(Json& tree, Random& random) {
  std::vector<Place> places;
  listPlaces(tree, places);
  if (places.empty()) return;
  const Place place = places[below(random, places.size())];
  switch (random() % 8) {
    case 0:  // removed
      if (place.holder->is_object())
        place.holder->erase(place.key);
      else
        place.holder->erase(place.index);
      return;
    case 1: {  // repeated, or under another name
      const Json copy = *place.value;
      if (place.holder->is_array())
        place.holder->push_back(copy);
      else
        (*place.holder)[words[below(random, words.size())]] = copy;
      return;
    }
    case 2: {  // moved to where another member's name is
      const Place& other = places[below(random, places.size())];
      if (place.holder->is_object() && !other.key.empty()) {
        const Json copy = *other.value;
        (*place.holder)[other.key] = copy;
      }
      return;
    }
    default:
      return changeValue(place, places, random);
  }
}

/// Changes bytes of one buffer view, whose size stays.
void changeView(Glb& glb, Random& random, BlindMutate blind) {
  const auto views = glb.json.find("bufferViews");
  std::size_t first = 0, count = glb.bin.size();
  if (views != glb.json.end() && views->is_array() && !views->empty()) {
    const Json& view = (*views)[below(random, views->size())];
    const auto numberOf = [&](const char* name) -> std::size_t {
      const auto found = view.is_object() ? view.find(name) : view.end();
      return view.is_object() && found != view.end() && found->is_number_unsigned()
                 ? found->get<std::size_t>()
                 : 0;
    };
    first = std::min(numberOf("byteOffset"), glb.bin.size());
    count = std::min(numberOf("byteLength"), glb.bin.size() - first);
  }
  if (count > 0) blind(glb.bin.data() + first, count, count);
}

}  // namespace

std::size_t mutateGlb(std::span<std::uint8_t> buffer, std::size_t size, unsigned seed, BlindMutate blind) {
  Random random(seed);
  std::optional<Glb> glb = random() % 8 == 0 ? std::nullopt : split(Bytes(buffer.data(), size));
  if (!glb) return blind(buffer.data(), size, buffer.size());
  std::string text;
  switch (random() % 4) {
    case 0:
      changeView(*glb, random, blind);
      break;
    case 1: {
      text = glb->json.dump(-1, ' ', false, Json::error_handler_t::replace);
      std::vector<std::uint8_t> bytes(text.begin(), text.end());
      bytes.resize(text.size() + 64);
      const std::size_t length = blind(bytes.data(), text.size(), bytes.size());
      text.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
      break;
    }
    default:
      for (auto changes = 1 + random() % 3; changes > 0; --changes) changeTree(glb->json, random);
  }
  if (text.empty()) text = glb->json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::size_t joined = join(text, glb->bin, buffer);
  return joined > 0 ? joined : size;
}

}  // namespace prelight::fuzz
