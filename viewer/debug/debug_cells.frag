#version 410 core
// A cell of the picture in which caustics are filtered.
uniform sampler2D marks;  // as caustic_cells.vert reads them
uniform ivec4 cells;      // samples of a pixel's side, pixels of a cell's side, pixels around the picture, 0
uniform float brightness;

out vec4 outColor;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) / cells.x + cells.z;
  ivec2 cell = pixel / cells.y;
  float around = 0.0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      around += texelFetch(marks, clamp(cell + ivec2(i, j), ivec2(0), textureSize(marks, 0) - 1), 0).r;
  if (around == 0.0) discard;
  bool own = texelFetch(marks, cell, 0).r > 0.0;
  bool border = any(equal(pixel % cells.y, ivec2(0)));
  vec3 color = own ? vec3(0.75, 0.35, 0.03) : vec3(0.05, 0.2, 0.7);
  outColor = vec4(brightness * color, border ? 0.9 : 0.45);
}
