#pragma once

#include <nanobind/nanobind.h>

/// The additions of each file to the module.
namespace prelight::python {

void bindDevices(nanobind::module_& module);
void bindPictures(nanobind::module_& module);
void bindTransfer(nanobind::module_& module);
void bindBaking(nanobind::module_& module);
void bindRendering(nanobind::module_& module);
void bindTracing(nanobind::module_& module);
void bindPhotons(nanobind::module_& module);
void bindBasis(nanobind::module_& module);
void bindHarmonicLights(nanobind::module_& module);
void bindRelighting(nanobind::module_& module);

}  // namespace prelight::python
