#version 410 core
// Contribution of a row of texels of a cube map's face to a coefficient of SH.
uniform samplerCubeArray maps;    // rgb: radiance
uniform samplerBuffer integrals;  // [face][row][column][i], of the functions over texels
uniform ivec4 shape;              // x: texels of a face's side, y: cube, z: coefficients

layout(location = 0) out vec4 sum;

#include "cube_directions.glsl"

void main() {
  int i = int(gl_FragCoord.x), line = int(gl_FragCoord.y);
  int face = line / shape.x, row = line % shape.x;
  vec3 found = vec3(0.0);
  for (int column = 0; column < shape.x; ++column) {
    vec2 p = (2.0 * vec2(column, row) + 1.0) / float(shape.x) - 1.0;
    float integral = texelFetch(integrals, (line * shape.x + column) * shape.z + i).x;
    found += integral * textureLod(maps, vec4(directionOn(face, p), float(shape.y)), 0.0).rgb;
  }
  sum = vec4(found, 0.0);
}
