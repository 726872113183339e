#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/gltf/gltf_document.h"

/// Right inputs from which fuzzing starts, made by this program's own writers.
namespace prelight::fuzz {

using Seed = std::vector<std::uint8_t>;

/// Inputs by TARGET/FILE.
using Seeds = std::map<std::string, Seed>;

/// glTF files: every kind of accessor, decoder, animation, deformation, light, sky and material.
void addSceneSeeds(Seeds& seeds);

/// Streams of meshopt and Draco.
void addStreamSeeds(Seeds& seeds);

/// Textures, skies and light maps.
void addPictureSeeds(Seeds& seeds);

/// Profiles, option values, URIs, measured BRDFs and entries of the kernel cache.
void addTextSeeds(Seeds& seeds);

/// States of runs that were interrupted at two points.
void addStateSeeds(Seeds& seeds);

/// Files of slices.
void addPartSeeds(Seeds& seeds);

/// A room of two meshes with a lamp, light-map coordinates and an animation, small enough that every
/// technique's bake of it is.
GltfDocument roomToBake();

/// The bytes of a document's .glb file.
Seed glbOf(const GltfDocument& document);

Seed bytesOf(const std::string& text);

}  // namespace prelight::fuzz
