// Transfer as a mean and components of clusters: products with the light are made once a cluster, on the host, and a
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
#elif PRELIGHT_STORAGE == 1
typedef half Weight;
#else
typedef uchar Weight;
#endif

float loadWeight(__global const Weight* weights, size_t at) {
#if PRELIGHT_STORAGE == 1
  return vload_half(at, weights);
#else
  return (float)weights[at];
#endif
}

// A vertex a work-item. terms [cluster][1 + component], rgb and a 0; clusters [vertex]; weights [vertex][component]
// -> radiance [vertex][3] before albedo.
__kernel void relightClusters(__global const float4* terms, __global const ushort* clusters,
                              __global const Weight* weights, uint vertexCount, __global float* radiance) {
  const size_t vertex = get_global_id(0);
  if (vertex >= vertexCount) return;
#ifdef PRELIGHT_CLUSTERED
  terms += (size_t)clusters[vertex] * (1 + PRELIGHT_COMPONENTS);
#endif
  float4 color = terms[0];
#pragma unroll
  for (int j = 0; j < PRELIGHT_COMPONENTS; ++j)
    color += loadWeight(weights, vertex * PRELIGHT_COMPONENTS + j) * terms[1 + j];
  vstore3(color.xyz, vertex, radiance);
}
