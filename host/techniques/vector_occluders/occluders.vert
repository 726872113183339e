#version 410 core
// Light of a vertex through its vector occluders; what is captured is a LitVertex.
#include "techniques/vector_occluders/occluder_shade_funcs.cl"

uniform OccluderTerms terms;
uniform UTEXELS offsets;   // [vertex] into the records, then the end
uniform TEXELS prepared;   // [record][terms.stride]
uniform TEXELS receivers;  // [vertex][3], OccluderReceiverPoint
uniform TEXELS lights;     // [light][4], OccluderLight
uniform TEXELS waves;

out vec4 litDiffuse;
out vec4 litSpecular;
out vec4 litReflected;

void main() {
  vec4 place = FETCH(receivers, 3 * gl_VertexID);
  LitReceiver receiver;
  receiver.position = place.xyz;
  receiver.normal = FETCH(receivers, 3 * gl_VertexID + 1).xyz;
  receiver.f0 = FETCH(receivers, 3 * gl_VertexID + 2).xyz;
  receiver.roughness = place.w;
  receiver.toEye = directionToEye(receiver.position, terms);
  int first = int(FETCH(offsets, gl_VertexID).x);
  int end = int(FETCH(offsets, gl_VertexID + 1).x);
  ShadeSums sums = litVertex(prepared, first, end, lights, waves, receiver, terms);
  litDiffuse = vec4(sums.diffuse, highlightShare(sums));
  litSpecular = vec4(sums.specular, 0.0);
  litReflected = vec4(sums.reflected, 0.0);
  gl_Position = vec4(0.0);
}
