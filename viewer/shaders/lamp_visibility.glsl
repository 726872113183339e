// What shells of distance leave of the light of near lamps, from a vertex to its fragments.
#ifdef GL_ES
void passLampVisibility() {}
#else
layout(location = 12) in vec4 lampVisibility[4];
out vec4 vLampVisibility[4];

void passLampVisibility() { vLampVisibility = lampVisibility; }
#endif
