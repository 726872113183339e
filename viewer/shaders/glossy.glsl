// Reflection of what arrives at a surface through glossy transfer; needs frame.glsl, material.glsl, specular.glsl and
// triangles.glsl.
uniform int glossyOrder;
uniform int lobeIsBrdf;          // 1: the lobe is the BRDF over F0 (Phong), 0: the split-sum reflectance's shape
uniform samplerBuffer arriving;  // [vertex][i] RGB: SH of radiance x visibility x cosine / pi
uniform samplerBuffer lobes;     // [step][band], LobeTable of specular_lobes.h

const int maxGlossyOrder = 8;
const int lobeSteps = 65;

vec3 arrivingNumber(ivec3 rows, vec3 weights, int i) {
  return weights.x * texelFetch(arriving, rows.x + i).rgb + weights.y * texelFetch(arriving, rows.y + i).rgb +
         weights.z * texelFetch(arriving, rows.z + i).rgb;
}

vec2 lobeAt(float roughness, int band) {
  float step = clamp(roughness, 0.0, 1.0) * float(lobeSteps - 1);
  int lower = min(int(step), lobeSteps - 2);
  return mix(texelFetch(lobes, lower * glossyOrder + band).xy, texelFetch(lobes, (lower + 1) * glossyOrder + band).xy,
             step - float(lower));
}

vec3 reflectThroughTransfer(FragmentMaterial m, int triangle, vec3 point, vec3 n, vec3 toEye) {
  ivec3 corners = ivec3(texelFetch(triangleCorners, triangle).xyz);
  vec3 weights = weightsOfCorners(corners, point);
  ivec3 rows = corners * (glossyOrder * glossyOrder);
  vec3 w = reflect(-toEye, n);
  float cosine = dot(n, w);

  // What an open surface under an even sky of 1 would get: bands of Legendre polynomials.
  float factors[maxGlossyOrder];
  float open = 0.0;
  float legendreBefore = 0.0;
  float legendre = 1.0;
  for (int l = 0; l < glossyOrder; ++l) {
    if (l > 0) {
      float next = (float(2 * l - 1) * cosine * legendre - float(l - 1) * legendreBefore) / float(l);
      legendreBefore = legendre;
      legendre = next;
    }
    vec2 lobe = lobeAt(m.roughness, l);
    factors[l] = lobe.x;
    open += lobe.y * legendre;
  }

  vec3 sum = vec3(0.0);
  float real = 1.0;
  float imaginary = 0.0;
  float sectoral = 0.282094792;  // sqrt(1 / (4 pi))
  for (int k = 0; k < glossyOrder; ++k) {
    if (k > 0) {
      float next = real * w.x - imaginary * w.y;
      imaginary = imaginary * w.x + real * w.y;
      real = next;
      sectoral *= sqrt(float(2 * k + 1) / float(2 * k));
    }
    float before = 0.0;
    float p = k > 0 ? 1.41421356 * sectoral : sectoral;
    for (int l = k; l < glossyOrder; ++l) {
      if (l > k) {
        float a = sqrt(float(4 * l * l - 1) / float(l * l - k * k));
        float b = l > 1 ? sqrt(float((l - 1) * (l - 1) - k * k) / float(4 * (l - 1) * (l - 1) - 1)) : 0.0;
        float next = a * (w.z * p - b * before);
        before = p;
        p = next;
      }
      vec3 band = real * arrivingNumber(rows, weights, l * (l + 1) + k);
      if (k > 0) band += imaginary * arrivingNumber(rows, weights, l * (l + 1) - k);
      sum += factors[l] * p * band;
    }
  }
  if (lobeIsBrdf != 0) return max(m.f0 * pi * sum, vec3(0.0));
  return max(skyReflectance(m, max(dot(n, toEye), 0.0)) * sum / max(open, 1e-6), vec3(0.0));
}
