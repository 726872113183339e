#pragma once

/// Includes all headers about spherical harmonics, of which each holds one concept.
#include "basis/sh_evaluate.h"
#include "basis/sh_products.h"
#include "basis/sh_projection.h"
#include "basis/sh_rotation.h"
#include "basis/sh_zonal.h"
