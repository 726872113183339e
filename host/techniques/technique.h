#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/state_file.h"
#include "compress/stored_forms.h"
#include "io/values/baked_ranges.h"
#include "io/values/quantized_column.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/options.h"
#include "prelight/plan.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

struct BakeContext;
struct BakedPart;
struct ShadingInfo;
class Progress;
class Projector;
struct Relighting;

/// Options that set a technique's part of a request.
struct TechniqueOptions {
  std::span<const Option<BakeRequest>> rows = {};
  /// Name of an option of a technique before, behind which lists of options have these; empty: they come
  /// last.
  std::string_view behind = {};
};

/// Input from which the passes of a technique are planned.
struct PlanInput {
  const Scene& source;
  const CompiledScene& scene;
  const BakeRequest& request;
  bool bounces;  ///< bounces of the requested transfer run

  /// Returns whether something colours the light of transfer.
  bool colored() const { return bounces || request.specular; }
};

/// What a technique tells a bake before it begins. A function that is nullptr has nothing to say.
struct TechniquePlan {
  /// The technique bakes irradiance of the scene's own lights, which has bounces of its own; others bake
  /// transfer or visibility.
  bool staticLight = false;

  /// The technique reads nothing but the hemisphere's column (cast/hemisphere_column.h), whose rows may be
  /// drawn as well as traced.
  bool drawable = false;

  /// Sets what a request leaves to the plan as suits the scene.
  void (*choose)(const CompiledScene&, BakeRequest&) = nullptr;

  /// Returns the passes, whether each runs, and why.
  std::vector<PlannedPass> (*passes)(const PlanInput&) = nullptr;

  /// Adds the memory that it takes beyond what all bakes take.
  void (*addMemory)(const PlanInput&, Plan&) = nullptr;

  /// Returns why rays must know the closest of what they hit, or nullptr if they need not.
  const char* (*closestHits)(const BakeRequest&) = nullptr;

  /// As `closestHits`, if only some scenes need it. Reasons that hold for every scene are given first.
  const char* (*closestHitsOfSome)(const BakeRequest&) = nullptr;

  /// Returns the begin of "only NAME carry specular light", or nullptr if the technique carries none.
  const char* (*specularLight)(const BakeRequest&) = nullptr;

  /// Adds the options that the state of an interrupted bake depends on.
  void (*addToKey)(const BakeRequest&, StateHash&) = nullptr;
};

/// What a baked file is written from. Accessors are appended to the document.
struct BakedOutput {
  GltfDocument& document;
  const CompiledScene& scene;
  const Bake& bake;
  const StoredForms* forms;          ///< in place of the bake's; nullptr: none
  SavingsByColumn* saved = nullptr;  ///< takes what columns of bytes save; present if `forms` has any

  /// Returns whether columns become bytes.
  bool quantizes() const { return forms != nullptr && forms->columns; }

  /// Appends `width` numbers per vertex of a primitive, as floats or as bytes of this form, and returns what
  /// refers to them. `name` is the column's for people.
  nlohmann::ordered_json column(std::string_view name, std::span<const float> values,
                                const PrimitiveRanges& ranges, std::size_t width, const ByteForm& form,
                                const char* type = "SCALAR") const;
};

/// What a baked file is read from.
struct BakedInput {
  const GltfDocument& document;
  const JsonCursor& root;  ///< the whole glTF object
  const CompiledScene& scene;
  std::optional<JsonCursor> extension;  ///< the root's PRELIGHT_transfer
};

/// Reads what a file holds of a technique into a bake. Throws InputError for what does not fit the scene,
/// itself or the other primitives.
class TechniqueReader {
 public:
  virtual ~TechniqueReader() = default;

  /// Reads a primitive's entry; primitives come in any order.
  virtual void read(const JsonCursor& /*entry*/, const PrimitiveRanges& /*ranges*/, Bake& /*bake*/) {}

  /// Comes after all primitives.
  virtual void finish(Bake& /*bake*/) {}
};

template <class Reader>
std::unique_ptr<TechniqueReader> makeTechniqueReader(const BakedInput& input) {
  return std::make_unique<Reader>(input);
}

/// A bake whose numbers are to become small.
struct BakeToCompress {
  Bake& bake;
  std::span<const double> surface;  ///< area of each vertex, which weights errors
  const Progress& progress;
};

/// How a technique is kept in a baked file. A function that is nullptr has nothing to do.
struct TechniqueFile {
  std::vector<std::string_view> members = {};  ///< of a primitive's entry
  bool everywhere = true;                      ///< on all primitives that have vertices, or on none
  /// Where columns become bytes, the members stand in the entry's `quantized`.
  bool quantizable = false;
  std::vector<std::string_view> accessors = {};  ///< members at any depth whose values are accessors

  /// Returns about how many bytes writeEntry appends in all.
  std::size_t (*storedBytes)(const Bake&) = nullptr;

  /// Adds forms that are smaller than columns of bytes, and messages about them. Leaves the bake as it was.
  /// Throws Interrupted.
  void (*addForms)(const BakeToCompress&, StoredForms&, std::vector<std::string>& notes) = nullptr;

  /// Adds the members to a primitive's entry.
  void (*writeEntry)(const BakedOutput&, const PrimitiveRanges&, nlohmann::ordered_json& entry) = nullptr;

  /// Adds what vertices share, and what is not of vertices, to the root's extension.
  void (*writeRoot)(const BakedOutput&, nlohmann::ordered_json& root) = nullptr;

  /// Returns a reader; `input` outlives it.
  std::unique_ptr<TechniqueReader> (*makeReader)(const BakedInput& input) = nullptr;
};

/// Numbers of a bake by name, for comparisons of bakes.
struct BakedArray {
  std::string name;
  std::string layout;  ///< shape and meaning of the numbers; only equal ones are compared
  std::vector<std::span<const float>> parts;  ///< the numbers, one part after the other
};

/// A line of `prelight info` about what a bake holds of a technique.
struct BakedSummary {
  std::string key;              ///< in JSON; as the file's extension calls it
  std::string text;             ///< for people, without the size
  std::size_t bytes = 0;        ///< as they are in the file
  bool perVertex = true;        ///< the bytes belong to vertices
  nlohmann::ordered_json json;  ///< for programs
};

/// How exports for other programs use a technique. Pages have rows of their own (viewer/web).
struct TechniqueExports {
  std::vector<std::string_view> forms = {};  ///< names of the forms of exports that hold it
  std::string_view formsKey = {};            ///< BakedSummary::key of what they hold; empty: all
  bool asNumbers = false;                    ///< numbers of vertices for own programs include it
  bool relitAlone = false;                   ///< prelight.js relights by it without others
  /// Copies what prelight.js relights by. nullptr: nothing.
  void (*copyRelit)(const Bake& from, Bake& to) = nullptr;
};

/// Copies a part of a bake, for TechniqueExports::copyRelit.
template <auto member>
void copyPart(const Bake& from, Bake& to) {
  to.*member = from.*member;
}

/// Properties of a scene that baked values depend on, besides geometry and where surfaces have holes.
struct SceneUse {
  bool bounces = true;      ///< colours of surfaces, where a bake has bounces
  bool scattering = false;  ///< all members of materials
  bool lights = false;      ///< the scene's own lights, and colours
};

/// A technique by which light or visibility is baked: its row in `techniques()`.
struct Technique {
  using Json = nlohmann::ordered_json;

  std::string_view name;                 ///< in messages, with spaces for "_"
  TechniqueOptions options = {};         ///< options of its part of a request
  const ShadingInfo* shading = nullptr;  ///< the shading that is baked by it; nullptr: none
  const BakedPart* part = nullptr;       ///< what pictures show of it along with a shading; nullptr: nothing
  SceneUse use = {};
  TechniquePlan plan = {};

  /// Returns what it does in a bake, or nullptr if the request does not ask for it. nullptr: another
  /// technique's values are turned into its own after the bake.
  std::unique_ptr<Projector> (*makeProjector)(const BakeContext&) = nullptr;

  TechniqueFile file = {};

  /// Adds what a bake of `vertices` vertices holds of it, if anything.
  void (*summarize)(const Bake&, std::size_t vertices, std::vector<BakedSummary>&) = nullptr;

  /// Adds the numbers that a bake holds of it, if they can be compared with those of another bake.
  void (*addArrays)(const Bake&, std::vector<BakedArray>&) = nullptr;

  /// How its transfer is lit on a device (relight/device/relighting.h). nullptr: it is not.
  const Relighting* relighting = nullptr;

  TechniqueExports exports = {};
};

constexpr std::uint64_t senderBytes = 8;  ///< that bounces keep of a ray

/// Returns the number of rays from receivers. With a target instead of a count, memory alone bounds it.
std::uint64_t plannedRays(const CompiledScene& scene, const BakeRequest& request);

/// Returns how many of a scene's materials pass a test.
std::size_t countMaterials(const Scene& scene, bool (*test)(const Material&));

/// Returns a text such as "3 channels".
std::string plannedChannels(bool colored);

template <typename T>
std::size_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// Returns "1 key" or "2 keys".
std::string counted(std::size_t count, const char* one);

/// Returns a text such as "3 channels, 1 bounce".
std::string channelsText(int channels, int bounces);

}  // namespace prelight
