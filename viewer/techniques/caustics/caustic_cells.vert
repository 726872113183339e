#version 410 core
// A cell of a level of the picture, four corners an instance; none where neither it nor a neighbour holds photons.
uniform sampler2D marks;
uniform ivec4 cells;  // number in x and y, texels of a cell's side, pixels of a texel's side
uniform ivec4 level;  // of caustic_filter.frag
uniform vec4 size;    // of the picture, pixels

void main() {
  ivec2 cell = ivec2(gl_InstanceID % cells.x, gl_InstanceID / cells.x);
  float marked = 0.0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      marked += texelFetch(marks, clamp(cell + ivec2(i, j), ivec2(0), cells.xy - 1), 0).r;
  ivec2 corner = cell + (marked > 0.0 ? ivec2(gl_VertexID % 2, gl_VertexID / 2) : ivec2(0));
  vec2 pixel = vec2(corner * cells.z * cells.w - level.xy);
  gl_Position = vec4(2.0 * pixel / size.xy - 1.0, -float(level.z) / 16.0, 1.0);
}
