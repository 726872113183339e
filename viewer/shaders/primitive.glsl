// The number of the triangle that a fragment belongs to.
#ifdef GL_ES
flat in int vTriangle;  // of vertex.glsl, as GLSL ES numbers no primitives
int triangleHere() { return vTriangle; }
#else
uniform int firstTriangle;  // of the draw
int triangleHere() { return firstTriangle + gl_PrimitiveID; }
#endif
