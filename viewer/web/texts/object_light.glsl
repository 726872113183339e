// In place of objects that cube maps light, which pages have not.
vec3 objectIrradiance(vec3 n) { return vec3(0.0); }
bool reachesObject(Light light, vec3 point) { return true; }
