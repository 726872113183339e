// Passes the visibility of near lamps by shells of distance from a vertex to its fragments.
#ifdef GL_ES
uniform TEXELS lampVisibilities;  // [four lamps][vertex]
uniform ivec4 lampStreams;        // x: fours of lamps, y: vertices
out vec4 vLampVisibility[4];

void passLampVisibility() {
  int v = int(FETCH(triangleCorners, gl_VertexID / 3)[gl_VertexID % 3]);
  for (int k = 0; k < 4; ++k)
    vLampVisibility[k] = k < lampStreams.x ? FETCH(lampVisibilities, k * lampStreams.y + v) : vec4(1.0);
}
#else
layout(location = 12) in vec4 lampVisibility[4];
out vec4 vLampVisibility[4];

void passLampVisibility() { vLampVisibility = lampVisibility; }
#endif
