// What a program of screen-space occlusion is compiled for: the text of viewer/screen/occlusion_pass.cpp takes the place of
// this file.
const int layers = 2;            // of surfaces that are looked at
const bool hasThickness = true;  // surfaces without a back have one
