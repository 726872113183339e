#version 410 core
// Prepares a record of vector occluders: a vertex is a record, and what is captured is its row of OccluderTerms.stride.
#include "techniques/vector_occluders/occluder_record_funcs.cl"

uniform OccluderTerms terms;
uniform TEXELS records;    // [record][stored]
uniform ITEXELS owners;    // [record]: vertex
uniform TEXELS receivers;  // [vertex][3], OccluderReceiverPoint
uniform TEXELS waves;

out vec4 prepared0;
out vec4 prepared1;
out vec4 prepared2;
out vec4 prepared3;
out vec4 prepared4;
out vec4 opacity;
out vec4 caustic;
out vec4 carried;
out vec4 mirrored;
out vec4 mirrorNormal;
out vec4 mirrorColor;

void main() {
  int owner = FETCH(owners, gl_VertexID).x;
  vec3 place = FETCH(receivers, 3 * owner).xyz;
  vec3 normal = FETCH(receivers, 3 * owner + 1).xyz;
  PreparedRecord record = preparedFrom(readRecord(records, gl_VertexID, terms), place, normal, waves, terms);
  prepared0 = record.direction;
  prepared1 = record.facing;
  prepared2 = record.place;
  prepared3 = record.blob;
  prepared4 = record.color;
  opacity = record.opacity;
  caustic = record.caustic;
  carried = record.carried;
  mirrored = record.mirrored;
  mirrorNormal = record.mirrorNormal;
  mirrorColor = record.mirrorColor;
  gl_Position = vec4(0.0);
}
