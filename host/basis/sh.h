#pragma once

/// Includes all headers about spherical harmonics, of which each holds one concept.
#include "basis/sh_dominant_light.h"
#include "basis/sh_environment.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_lights.h"
#include "basis/sh_products.h"
#include "basis/sh_projection.h"
#include "basis/sh_rotation.h"
#include "basis/sh_windows.h"
#include "basis/sh_zonal.h"
