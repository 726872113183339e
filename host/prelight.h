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

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "base/diagnostics.h"
#include "base/error.h"
#include "base/progress.h"
#include "base/state_file.h"
#include "basis/ch.h"
#include "basis/cube_light.h"
#include "basis/cube_map.h"
#include "basis/cube_rotation.h"
#include "basis/haar.h"
#include "basis/haar_selection.h"
#include "basis/sh.h"
#include "compress/compression_error.h"
#include "device/device.h"
#include "images/environment.h"
#include "images/picture.h"
#include "io/baked_file.h"
#include "plan/plan.h"
#include "relight/compressed_light.h"
#include "relight/haar_model.h"
#include "relight/haar_relight.h"
#include "scene/builtin/builtin.h"
#include "scene/compiled_scene.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/loader.h"
#include "scene/scene.h"
#include "transfer/bake.h"
#include "transfer/compressed_transfer.h"
