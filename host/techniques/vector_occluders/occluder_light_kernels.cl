// Lighting through vector occluders.
#include "techniques/vector_occluders/occluder_shade_funcs.cl"

// One work-item per record. records [record][stored], owners [record]: vertex, receivers [vertex], waves [row][column]
// -> prepared [record][terms.stride].
__kernel void prepareOccluders(__global const float4* records, __global const int* owners,
                               __global const OccluderReceiverPoint* receivers, __global const float4* waves,
                               OccluderTerms terms, uint recordCount, __global float4* prepared) {
  const size_t record = get_global_id(0);
  if (record >= recordCount) return;
  __global const OccluderReceiverPoint* receiver = receivers + owners[record];
  const PreparedRecord result = preparedFrom(readRecord(records, (int)record, terms), vload3(0, receiver->position),
                                             vload3(0, receiver->normal), waves, terms);
  __global float4* to = prepared + record * terms.stride;
  to[0] = result.direction;
  to[1] = result.facing;
  to[2] = result.place;
  to[3] = result.blob;
  to[4] = result.color;
  to += 5;
  if ((terms.stored & (PRELIGHT_STORES_TRANSMISSIVE | PRELIGHT_STORES_CAUSTIC)) != 0) {
    to[0] = result.opacity;
    to[1] = result.caustic;
    to[2] = result.carried;
    to += 3;
  }
  if ((terms.stored & PRELIGHT_STORES_SPECULAR) != 0) {
    to[0] = result.mirrored;
    to[1] = result.mirrorNormal;
    to[2] = result.mirrorColor;
  }
}

// One work-item per vertex, from `firstVertex` on. offsets [vertex] into the records, then the end; lights [light][4]
// -> lit [vertex].
__kernel void relightOccluders(__global const uint* offsets, __global const float4* prepared,
                               __global const OccluderReceiverPoint* receivers, __global const float4* lights,
                               __global const float4* waves, OccluderTerms terms, uint firstVertex, uint endVertex,
                               __global LitVertex* lit) {
  const size_t vertex = firstVertex + get_global_id(0);
  if (vertex >= endVertex) return;
  __global const OccluderReceiverPoint* point = receivers + vertex;
  LitReceiver receiver;
  receiver.position = vload3(0, point->position);
  receiver.normal = vload3(0, point->normal);
  receiver.f0 = vload3(0, point->f0);
  receiver.roughness = point->roughness;
  receiver.toEye = directionToEye(receiver.position, terms);
  const ShadeSums sums =
      litVertex(prepared, (int)offsets[vertex], (int)offsets[vertex + 1], lights, waves, receiver, terms);
  vstore3(sums.diffuse, 0, lit[vertex].diffuse);
  vstore3(sums.specular, 0, lit[vertex].specular);
  vstore3(sums.reflected, 0, lit[vertex].reflected);
  lit[vertex].highlight = highlightShare(sums);
  lit[vertex].pad0 = 0.0f;
  lit[vertex].pad1 = 0.0f;
}

// One work-item per vertex: the light that diffuse receivers send on, before their albedo. lit [vertex] -> radiance
// [vertex][3].
__kernel void takeDiffuse(__global const LitVertex* lit, uint vertexCount, __global float* radiance) {
  const size_t vertex = get_global_id(0);
  if (vertex >= vertexCount) return;
  vstore3(vload3(0, lit[vertex].diffuse), vertex, radiance);
}
