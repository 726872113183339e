// Constants for which a program of screen-space occlusion is compiled: the text of viewer/techniques/screen/occlusion_pass.cpp takes the place of
// this file.
const int layers = 2;            // of surfaces that are looked at
const bool hasThickness = true;  // surfaces without a back have one
const bool gathers = true;       // light that the surfaces seen send
const int outputs = 3;           // pictures that are found
const int shadowedLamps = 4;     // lights that shadows are found of
