// Projection of skies to spherical harmonics and to Haar wavelets on a cube map, and rotation. Every sum has the same order
// on all devices.

// One work-item per row and wave. sky [channel][row][column]; cosine, sine [m][column], integrals of the waves over a column
// -> moments [row][m][even, odd][channel]. Sixteen columns are summed side by side and added up at the end.
__kernel void skyMoments(__global const float* sky, __global const float* cosine, __global const float* sine,
                         uint width, uint height, uint order, __global float* moments) {
  const size_t row = get_global_id(0) / order, m = get_global_id(0) % order;
  if (row >= height) return;
  cosine += m * width;
  sine += m * width;
  for (size_t c = 0; c < 3; ++c) {
    __global const float* texels = sky + (c * height + row) * width;
    float16 even = 0.0f, odd = 0.0f;
    uint column = 0;
    for (; column + 16 <= width; column += 16) {
      const float16 radiance = vload16(0, texels + column);
      even += radiance * vload16(0, cosine + column);
      odd += radiance * vload16(0, sine + column);
    }
    float evenRest = 0.0f, oddRest = 0.0f;
    for (; column < width; ++column) {
      evenRest += texels[column] * cosine[column];
      oddRest += texels[column] * sine[column];
    }
    const float8 even8 = even.lo + even.hi, odd8 = odd.lo + odd.hi;
    const float4 even4 = even8.lo + even8.hi, odd4 = odd8.lo + odd8.hi;
    __global float* out = moments + (row * order + m) * 6 + c;
    out[0] = (even4.x + even4.y) + (even4.z + even4.w) + evenRest;
    out[3] = (odd4.x + odd4.y) + (odd4.z + odd4.w) + oddRest;
  }
}

// One work-item per coefficient of a channel. polar [l (l + 1) / 2 + m][row]: integrals over a row of the functions at
// azimuth 0 -> coefficients [channel][i] in the sky's own frame. Rows are added in runs of 32, then the runs are added.
__kernel void skyCoefficients(__global const float* moments, __global const float* polar, uint height, uint order,
                              __global float* coefficients) {
  const uint count = order * order;
  const uint channel = (uint)get_global_id(0) / count, i = (uint)get_global_id(0) % count;
  if (channel >= 3) return;
  uint l = 0;
  while ((l + 1) * (l + 1) <= i) ++l;
  const int signedM = (int)i - (int)(l * (l + 1));
  const uint m = (uint)abs(signedM);
  polar += (size_t)(l * (l + 1) / 2 + m) * height;
  moments += m * 6 + (signedM < 0 ? 3 : 0) + channel;
  float sum = 0.0f;
  for (uint first = 0; first < height; first += 32) {
    float run = 0.0f;
    for (uint row = first; row < min(height, first + 32); ++row) run += polar[row] * moments[(size_t)row * order * 6];
    sum += run;
  }
  coefficients[channel * count + i] = sum;
}

// One work-item per coefficient of a function. matrices: bands one after the other, each [2l+1][2l+1];
// in, out [function][i].
__kernel void rotateBands(__global const float* matrices, __global const float* in, uint order, uint functionCount,
                          __global float* out) {
  const uint count = order * order;
  const size_t function = get_global_id(0) / count;
  const uint i = (uint)(get_global_id(0) % count);
  if (function >= functionCount) return;
  uint l = 0;
  while ((l + 1) * (l + 1) <= i) ++l;
  const uint width = 2 * l + 1;
  matrices += l * (4 * l * l - 1) / 3 + (i - l * l) * width;  // bands below hold sum (2k+1)^2 numbers
  in += function * count + l * l;
  float sum = 0.0f;
  for (uint j = 0; j < width; ++j) sum += matrices[j] * in[j];
  out[function * count + i] = sum;
}

// Returns the world direction of a point of a cube's face, not normalised (basis/cube_map.h).
float3 cubeDirection(uint face, float a, float b) {
  switch (face) {
    case 0: return (float3)(1.0f, -b, -a);
    case 1: return (float3)(-1.0f, -b, a);
    case 2: return (float3)(a, 1.0f, b);
    case 3: return (float3)(a, -1.0f, -b);
    case 4: return (float3)(a, -b, 1.0f);
    default: return (float3)(-a, -b, -1.0f);
  }
}

// One work-item per texel: mean radiance of samples x samples points, weighted by their solid angle. xAxis, yAxis and
// zAxis: the axes of the sky's map in the world. sky [channel][row][column] -> texels [channel][face][row][column].
__kernel void sampleCube(__global const float* sky, uint width, uint height, uint faceSize, uint samples, float4 xAxis,
                         float4 yAxis, float4 zAxis, __global float* texels) {
  const uint faceTexels = faceSize * faceSize;
  const uint texel = (uint)get_global_id(0);
  if (texel >= 6 * faceTexels) return;
  const uint face = texel / faceTexels, row = texel % faceTexels / faceSize, column = texel % faceSize;
  float sum[3] = {0.0f, 0.0f, 0.0f}, total = 0.0f;
  for (uint k = 0; k < samples * samples; ++k) {
    const float a = 2.0f * ((float)column + ((float)(k % samples) + 0.5f) / (float)samples) / (float)faceSize - 1.0f;
    const float b = 2.0f * ((float)row + ((float)(k / samples) + 0.5f) / (float)samples) / (float)faceSize - 1.0f;
    const float3 w = cubeDirection(face, a, b);
    const float3 d = (float3)(dot(xAxis.xyz, w), dot(yAxis.xyz, w), dot(zAxis.xyz, w));
    const float squared = 1.0f + a * a + b * b, inverse = 1.0f / sqrt(squared);
    const float u = 0.5f + atan2(d.x, -d.z) * (0.5f * M_1_PI_F);
    const float v = acos(clamp(d.y * inverse, -1.0f, 1.0f)) * M_1_PI_F;
    const uint x = min(width - 1, (uint)(u * (float)width)), y = min(height - 1, (uint)(v * (float)height));
    const float weight = inverse / squared;
    for (size_t c = 0; c < 3; ++c) sum[c] += weight * sky[(c * height + y) * width + x];
    total += weight;
  }
  for (size_t c = 0; c < 3; ++c) texels[c * 6 * faceTexels + texel] = sum[c] / total;
}

// One work-item per block of a level: Haar lifting in place (basis/haar.h). values [image][row][column], where the images
// are faces of channels; half_ is the distance between the values that are joined.
__kernel void liftLevel(__global float* values, uint imageCount, uint faceSize, uint half_) {
  const uint blocks = faceSize / (2 * half_);
  const size_t image = get_global_id(0) / (blocks * blocks);
  const uint block = (uint)(get_global_id(0) % (blocks * blocks));
  if (image >= imageCount) return;
  __global float* at = values + image * faceSize * faceSize + (size_t)(block / blocks) * 2 * half_ * faceSize +
                       block % blocks * 2 * half_;
  const size_t below = (size_t)half_ * faceSize;
  const float p = at[0], q = at[half_], s = at[below], t = at[below + half_];
  at[0] = 0.5f * ((p + q) + (s + t));
  at[half_] = 0.5f * ((p - q) + (s - t));
  at[below] = 0.5f * ((p + q) - (s + t));
  at[below + half_] = 0.5f * ((p - q) - (s - t));
}
