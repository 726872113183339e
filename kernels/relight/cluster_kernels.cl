// Transfer as a mean and components of clusters: products with the light are computed once per cluster on the host, and each
// vertex sums its own weights (Sloan et al. 2003; Kautz 2004).
// Options: PRELIGHT_COMPONENTS  a cluster, 0 for vector quantisation
//          PRELIGHT_CLUSTERED   1: vertices name their cluster; else all are of the first
//          PRELIGHT_STORAGE     of weights, 0: float, 1: IEEE half, 2: unsigned byte

#ifndef PRELIGHT_COMPONENTS
#define PRELIGHT_COMPONENTS 8
#endif
#ifndef PRELIGHT_STORAGE
#define PRELIGHT_STORAGE 1
#endif

#if PRELIGHT_STORAGE == 0
typedef float Weight;
#define WEIGHTS_4(stored) (stored)
#define WEIGHT(stored) (stored)
#elif PRELIGHT_STORAGE == 1
typedef short Weight;
#define WEIGHTS_4(stored) floatsOfHalves(stored)
#define WEIGHT(stored) floatsOfHalves((short4)(stored)).x
#else
typedef uchar Weight;
#define WEIGHTS_4(stored) convert_float4(stored)
#define WEIGHT(stored) (float)(stored)
#endif

// Returns four halves as floats, like lanesOfHalves in lane_funcs.cl.
float4 __attribute__((always_inline)) floatsOfHalves(short4 halves) {
  return as_float4((convert_int4(halves) << 13) & (int)0x8fffe000) * 0x1p112f;
}

// One work-item per vertex. terms [cluster][1 + component], rgb and a 0; clusters [vertex]; weights [vertex][component]
// -> radiance [vertex][3] before albedo.
__kernel void relightClusters(__global const float4* terms, __global const ushort* clusters,
                              __global const Weight* weights, uint vertexCount, __global float* radiance) {
  const size_t vertex = get_global_id(0);
  if (vertex >= vertexCount) return;
#ifdef PRELIGHT_CLUSTERED
  terms += (size_t)clusters[vertex] * (1 + PRELIGHT_COMPONENTS);
#endif
  weights += vertex * PRELIGHT_COMPONENTS;
  float4 color = terms[0];
  int j = 0;
  for (; j + 4 <= PRELIGHT_COMPONENTS; j += 4) {
    const float4 weight = WEIGHTS_4(vload4(0, weights + j));
    color += weight.x * terms[1 + j];
    color += weight.y * terms[2 + j];
    color += weight.z * terms[3 + j];
    color += weight.w * terms[4 + j];
  }
  for (; j < PRELIGHT_COMPONENTS; ++j) color += WEIGHT(weights[j]) * terms[1 + j];
  vstore3(color.xyz, vertex, radiance);
}
