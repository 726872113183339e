#pragma once

/// Everything of the library that a program needs to load, plan, bake, store and read back a scene:
///
///     Warnings warnings;
///     GltfDocument document = readGltf("level.glb", warnings);
///     const Scene scene = loadScene(document, warnings);
///     const CompiledScene compiled = compileScene(scene, warnings);
///     const BakeRequest request{.ao = true, .shOrder = 3};
///     const Plan plan = makePlan(scene, compiled, request);
///     Progress progress;
///     BakeReport report;
///     const Bake bake = bakeScene(compiled, request, plan, Device::open({}), progress, report);
///     embedBake(document, compiled, bake);
///     writeGlb("baked.glb", document);

#include "bake/bake.h"
#include "bake/baker.h"
#include "base/diagnostics.h"
#include "base/error.h"
#include "base/progress.h"
#include "basis/ch.h"
#include "basis/cube_light.h"
#include "basis/cube_map.h"
#include "basis/cube_rotation.h"
#include "basis/haar.h"
#include "basis/haar_model.h"
#include "basis/haar_relight.h"
#include "basis/haar_selection.h"
#include "basis/sh.h"
#include "compress/compressed_light.h"
#include "compress/compressed_transfer.h"
#include "compress/compression_error.h"
#include "device/device.h"
#include "io/baked_file.h"
#include "io/environment.h"
#include "io/picture.h"
#include "io/state_file.h"
#include "plan/plan.h"
#include "scene/builtin.h"
#include "scene/compiled_scene.h"
#include "scene/gltf_document.h"
#include "scene/loader.h"
#include "scene/scene.h"
