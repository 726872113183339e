// Irradiance that other surfaces send, of the light map of photons; needs light_map.glsl. n, geometric: on the side that is asked about.
vec3 indirectIrradiance(int triangle, bool front, vec3 n, vec3 geometric) { return lightMapIrradiance(triangle, front, vPosition); }
