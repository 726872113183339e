// All lights of surface.frag. Where they are few the text of viewer/shader_variant.h takes the place of this file: it
// names one after the other, since software looks up what a counter names pixel by pixel.
vec3 shadeLights(FragmentMaterial m, vec3 n, vec3 toEye, float specularWeight) {
  vec3 sum = vec3(0.0);
  for (int k = 0; k < counts.x; ++k) sum += shadeLight(lights[k], m, n, toEye, specularWeight);
  return sum;
}
