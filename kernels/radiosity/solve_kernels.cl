// The radiosity equation H = D + F B with B = albedo x H + transmission x H of the other side. H: irradiance, D: direct
// light, B: exitance without emission, which D contains; all [element] float4, rgb. F_ij = scale[i] x values[k] with
// column k = j; values are symmetric.
// Options: PRELIGHT_TRANSLUCENT (a material lets light through diffusely; elements of the backs then follow `perSide`
// elements of the fronts).
#include "shared/radiosity_types.h"

// The form factor matrix F in compressed rows.
typedef struct Exchange {
  __global const uint* rowStart;
  __global const uint* columns;
  __global const float* values;
  __global const float* scale;
} Exchange;

// Factors that turn arriving light into leaving light, per element.
typedef struct Reflection {
  uint perSide;
  __global const float* areas;
  __global const float4* albedo;
  __global const float4* transmission;
} Reflection;

float4 gatherRow(uint i, __global const uint* rowStart, __global const uint* columns, __global const float* values,
                 __global const float* scale, __global const float4* exitance) {
  float4 sum = (float4)(0.0f);
  const uint end = rowStart[i + 1u];
  for (uint k = rowStart[i]; k < end; ++k) sum += values[k] * exitance[columns[k]];
  return scale[i] * sum;
}

// One work-item per row of [first, first + count) -> irradiance, and residual, the change of irradiance.
// Next: reflectRows.
__kernel void gatherRows(uint first, uint count, __global const uint* rowStart, __global const uint* columns,
                         __global const float* values, __global const float* scale, __global const float4* direct,
                         __global const float4* exitance, __global float4* irradiance, __global float4* residual) {
  if (get_global_id(0) >= count) return;
  const uint i = first + (uint)get_global_id(0);
  if (scale[i] <= 0.0f) return;
  const float4 gathered = direct[i] + gatherRow(i, rowStart, columns, values, scale, exitance);
  residual[i] = gathered - irradiance[i];
  irradiance[i] = gathered;
}

// Computes the residual without changing irradiance.
__kernel void measureRows(uint count, __global const uint* rowStart, __global const uint* columns,
                          __global const float* values, __global const float* scale, __global const float4* direct,
                          __global const float4* exitance, __global const float4* irradiance,
                          __global float4* residual) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  residual[i] = scale[i] > 0.0f
                    ? direct[i] + gatherRow(i, rowStart, columns, values, scale, exitance) - irradiance[i]
                    : (float4)(0.0f);
}

float4 exitanceOf(uint i, uint perSide, __global const float4* albedo, __global const float4* transmission,
                  __global const float4* irradiance) {
  float4 leaves = albedo[i] * irradiance[i];
#ifdef PRELIGHT_TRANSLUCENT
  leaves += transmission[i] * irradiance[i < perSide ? i + perSide : i - perSide];
#endif
  return leaves;
}

// One work-item per element of [first, first + count): exitance of the element and, with PRELIGHT_TRANSLUCENT, of its
// other side.
__kernel void reflectRows(uint first, uint count, uint perSide, __global const float4* albedo,
                          __global const float4* transmission, __global const float4* irradiance,
                          __global float4* exitance) {
  if (get_global_id(0) >= count) return;
  const uint i = first + (uint)get_global_id(0);
  exitance[i] = exitanceOf(i, perSide, albedo, transmission, irradiance);
#ifdef PRELIGHT_TRANSLUCENT
  const uint other = i < perSide ? i + perSide : i - perSide;
  if (other < first || other >= first + count)
    exitance[other] = exitanceOf(other, perSide, albedo, transmission, irradiance);
#endif
}

// Chebyshev's semi-iteration: next = weight x (step + current - previous) + previous, where step is the residual and
// `irradiance` is current + step -> irradiance next, previous current.
__kernel void accelerateRows(uint count, float weight, __global const float4* residual, __global float4* irradiance,
                             __global float4* previous) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const float4 gathered = irradiance[i], current = gathered - residual[i];
  irradiance[i] = weight * (gathered - previous[i]) + previous[i];
  previous[i] = current;
}

// One work-item per 256 elements -> sums [item]: area x |residual|, rgb, and the greatest |residual| of any channel.
__kernel void sumResiduals(uint count, __global const float* areas, __global const float4* residual,
                           __global float4* sums) {
  const uint begin = (uint)get_global_id(0) * 256u;
  if (begin >= count) return;
  float4 sum = (float4)(0.0f);
  const uint end = min(count, begin + 256u);
  for (uint i = begin; i < end; ++i) {
    const float4 r = fabs(residual[i]);
    sum.xyz += areas[i] * r.xyz;
    sum.w = fmax(sum.w, fmax(r.x, fmax(r.y, r.z)));
  }
  sums[get_global_id(0)] = sum;
}

// Returns the power of a residual that the element would send on, W of the strongest channel; the greatest is shot
// first.
float unsentPower(uint i, Reflection r, float4 residual) {
  float4 share = r.albedo[i];
#ifdef PRELIGHT_TRANSLUCENT
  share += r.transmission[i < r.perSide ? i + r.perSide : i - r.perSide];
#endif
  const float4 sent = fabs(share * residual);
  return r.areas[i] * fmax(sent.x, fmax(sent.y, sent.z));
}

// One work-item per element -> unsent [element], its unsentPower.
__kernel void rankRows(uint count, uint perSide, __global const float* areas, __global const float4* albedo,
                       __global const float4* transmission, __global const float4* residual, __global float* unsent) {
  const uint i = (uint)get_global_id(0);
  const Reflection r = {perSide, areas, albedo, transmission};
  if (i < count) unsent[i] = unsentPower(i, r, residual[i]);
}

// Shoots the light that leaves `source` to the elements that it sees, which its row lists as well as its column does.
void shootRow(uint source, float4 leaves, Exchange f, Reflection r, __global float4* residual, __global float* unsent) {
  const uint end = f.rowStart[source + 1u];
  for (uint k = f.rowStart[source] + (uint)get_local_id(0); k < end; k += PRELIGHT_SOUTHWELL_ITEMS) {
    const uint j = f.columns[k];
    if (f.scale[j] <= 0.0f) continue;
    residual[j] += f.scale[j] * f.values[k] * leaves;
    unsent[j] = unsentPower(j, r, residual[j]);
  }
}

// Returns the greatest value of the work-item's part of `unsent`, and its index. Parts are contiguous because
// processors read them fastest so and run one after the other.
float greatestOfPart(uint count, __global const float* unsent, uint* at) {
  const uint item = (uint)get_local_id(0);
  const uint part = (count + PRELIGHT_SOUTHWELL_ITEMS - 1u) / PRELIGHT_SOUTHWELL_ITEMS;
  const uint end = min(count, (item + 1u) * part);
  float best = 0.0f;
  *at = 0u;
  for (uint i = item * part; i < end; ++i)
    if (unsent[i] > best) {
      best = unsent[i];
      *at = i;
    }
  return best;
}

// Performs step.steps steps of Southwell's relaxation: the element with the most unsent power adds its residual to its
// irradiance and sends it on, as progressive radiosity shoots (Cohen et al. 1988). One work-group, so that the order is
// that of one thread.
__kernel __attribute__((reqd_work_group_size(PRELIGHT_SOUTHWELL_ITEMS, 1, 1))) void relaxGreatest(
    const RelaxStep step, __global const uint* rowStart, __global const uint* columns, __global const float* values,
    __global const float* scale, __global const float* areas, __global const float4* albedo,
    __global const float4* transmission, __global float4* irradiance, __global float4* residual,
    __global float* unsent, __global uint* taken) {
  __local float most[PRELIGHT_SOUTHWELL_ITEMS];
  __local uint place[PRELIGHT_SOUTHWELL_ITEMS];
  const Exchange f = {rowStart, columns, values, scale};
  const Reflection r = {step.perSide, areas, albedo, transmission};
  const uint item = (uint)get_local_id(0);
  uint done = 0;
  for (uint k = 0; k < step.steps; ++k) {
    uint at;
    most[item] = greatestOfPart(step.count, unsent, &at);
    place[item] = at;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item == 0u)
      for (uint other = 1; other < PRELIGHT_SOUTHWELL_ITEMS; ++other)
        if (most[other] > most[0]) {
          most[0] = most[other];
          place[0] = place[other];
        }
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
    const float best = most[0];
    at = place[0];
    if (best <= step.enough) break;
    const float4 change = residual[at];
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
    if (item == 0u) {
      irradiance[at] += change;
      residual[at] = (float4)(0.0f);
      unsent[at] = 0.0f;
    }
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
    shootRow(at, albedo[at] * change, f, r, residual, unsent);
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
#ifdef PRELIGHT_TRANSLUCENT
    const uint other = at < step.perSide ? at + step.perSide : at - step.perSide;
    shootRow(other, transmission[other] * change, f, r, residual, unsent);
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
#endif
    ++done;
  }
  if (item == 0u) taken[0] = done;
}

// Adds their residual to elements that have nothing to send: no other step would do so for black elements.
__kernel void takeUnsendable(uint count, __global float4* irradiance, __global const float4* residual,
                             __global const float* unsent) {
  const size_t i = get_global_id(0);
  if (i < count && unsent[i] <= 0.0f) irradiance[i] += residual[i];
}

// Adds unsent residuals to irradiance without sending them on, which is one iteration of Jacobi's at no cost.
__kernel void takeRest(uint count, __global float4* irradiance, __global const float4* residual) {
  const size_t i = get_global_id(0);
  if (i < count) irradiance[i] += residual[i];
}
