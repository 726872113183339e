#pragma once

/// Everything of the library: reading a scene, baking it, storing what was baked, and looking at the scene
/// with rays, photons and pictures. docs/library.md leads through it.

#include "prelight/bake.h"
#include "prelight/basis.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/error.h"
#include "prelight/light_map.h"
#include "prelight/light_profile.h"
#include "prelight/light_shape.h"
#include "prelight/load.h"
#include "prelight/make_scene.h"
#include "prelight/measured_brdf.h"
#include "prelight/photons.h"
#include "prelight/picture.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/relight.h"
#include "prelight/render.h"
#include "prelight/request.h"
#include "prelight/scene.h"
#include "prelight/trace.h"
#include "prelight/transfer.h"
