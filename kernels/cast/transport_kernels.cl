// Rows of stored transport: what each receiver's rays hit, kept so that bounces need no new rays.
#include "bvh/alpha_funcs.cl"
#include "core/sampling_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// A ray a work-item. rays, hits [receiver][raysPerReceiver] -> senders, same shape, rows
// from firstStored on; marks [triangle] is set to 1
// where a back was hit. The hit's value will be interpolated from three vertices: taking one of them with its
// barycentric weight as probability has the same mean and a third of the reads.
// Next: gatherBounce.
__kernel void storeSenders(__constant const CastParameters* parameters, __global const Ray* rays,
                           __global const Hit* hits, __global const DeviceTriangle* triangles,
                           __global const DeviceMaterial* materials, __global const float2* texCoords,
                           __global const float4* colors, __global const ushort4* texels,
                           __global const float* geometricNormals, __global const Receiver* receivers,
                           __global Sender* senders, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  const Hit hit = hits[i];
  Sender sender = {PRELIGHT_NO_TRIANGLE, 0u};
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) {
    const Surface surface = {triangles, materials, texCoords, colors, texels};
    const float3 albedo = clamp(surfaceColor(surface, hit.triangle, hit.u, hit.v).xyz, 0.0f, 1.0f);
    const uint3 packed = convert_uint3_rte(albedo * 1023.0f);
    const uint bits = packed.x | (packed.y << 10) | (packed.z << 20);
    if (bits != 0u) {
      __global const Receiver* r = receivers + i / parameters->raysPerReceiver;
      const uint sample = r->firstSample + (uint)(i % parameters->raysPerReceiver);
      const float pick = (float)(hashInteger(sample ^ hashInteger(r->seed ^ 0x5bd1e995u)) >> 8) * 5.9604644775390625e-8f;
      const uint corner = pick < hit.u ? 1u : (pick < hit.u + hit.v ? 2u : 0u);
      const bool back = dot(vload3(0, rays[i].direction), vload3(hit.triangle, geometricNormals)) > 0.0f;
      if (back) marks[hit.triangle] = 1;
      sender.slot = triangles[hit.triangle].vertex[corner] + (back ? parameters->vertexCount : 0u);
      sender.albedo = bits;
    }
  }
  senders[(size_t)parameters->firstStored * parameters->raysPerReceiver + i] = sender;
}

// A receiver a work-item. senders [firstStored + receiver][raysPerReceiver], transfer [slot][3][coefficients] of the previous
// bounce -> values [receiver][3][coefficients], the mean over the receiver's rays of albedo x transfer.
// Option: PRELIGHT_SH_ORDER.
__kernel void gatherBounce(__constant const CastParameters* parameters, __global const Sender* senders,
                           __global const float* transfer, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint n = PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER;
  float sum[3 * PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER];
  for (uint i = 0; i < 3 * n; ++i) sum[i] = 0.0f;
  for (uint j = 0; j < parameters->raysPerReceiver; ++j) {
    const Sender s = senders[((size_t)parameters->firstStored + receiver) * parameters->raysPerReceiver + j];
    if (s.slot == PRELIGHT_NO_TRIANGLE) continue;
    __global const float* t = transfer + (size_t)s.slot * 3 * n;
    for (uint c = 0; c < 3; ++c) {
      const float albedo = (float)((s.albedo >> (10 * c)) & 1023u) * (1.0f / 1023.0f);
      for (uint i = 0; i < n; ++i) sum[c * n + i] += albedo * t[c * n + i];
    }
  }
  const float scale = 1.0f / (float)parameters->raysPerReceiver;
  for (uint i = 0; i < 3 * n; ++i) values[receiver * 3 * n + i] = sum[i] * scale;
}
