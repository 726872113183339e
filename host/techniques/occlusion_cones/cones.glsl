// Directional occlusion: what is open above a surface is taken for a cone about the bent normal; needs sky.glsl.
#ifndef CONES_GLSL
#define CONES_GLSL

struct OpenCone {
  bool there;
  vec3 axis;       // unit
  float cosine;    // of half the angle
  float softness;  // of its edge, in cosines
};

OpenCone noCone() { return OpenCone(false, vec3(0.0), 0.0, 1.0); }

// The edge is the softer the less the surface is either open or closed: an open region is no cone. A surface that is all
// open has no edge but its horizon.
OpenCone coneAround(vec3 axis, float cosine, float accessibility) {
  return OpenCone(true, axis, cosine, 0.3 * sqrt(max(accessibility * (1.0 - accessibility), 0.0)) + 1e-4);
}

// About an axis, as wide as lets through a share of the cosine around it.
OpenCone coneOfAccessibility(vec3 axis, float accessibility) {
  return coneAround(axis, sqrt(clamp(1.0 - accessibility, 0.0, 1.0)), accessibility);
}

// The sky in the cone over pi times the cosine, as if all of the accessible sky were like it. Three bands say little of what very narrow
// cones see: those take the sky map, as blurred as they are wide, unless lamps of the sky, which the map has, shine as lamps.
vec3 skyInCone(OpenCone cone) {
  vec3 wide = ambientInCone(cone.axis, clamp(cone.cosine, 0.0, 1.0));
  float width = max(2.0 * acos(clamp(cone.cosine, 0.0, 1.0)), 1e-4);
  vec3 narrow = skyRadiance(cone.axis, max(log2(width) - skyLevels.x, 0.0));
  return mix(wide, narrow, smoothstep(0.9, 1.0, cone.cosine) * (1.0 - skyLevels.z));
}

// Returns the angle at a corner of a spherical triangle, given its opposite side and the two that meet there.
float cornerAngle(float opposite, float a, float b) {
  return acos(clamp((cos(opposite) - cos(a) * cos(b)) / max(sin(a) * sin(b), 1e-6), -1.0, 1.0));
}

// Returns the share of a cap of directions that lies within another (Gauss and Bonnet: two arcs bound their common region).
// Radians; `apart`: the angle between their axes.
float shareOfCap(float cap, float other, float apart) {
  if (apart >= cap + other) return 0.0;
  float ofCap = 1.0 - cos(cap), ofOther = 1.0 - cos(other);
  if (apart <= abs(cap - other)) return min(1.0, ofOther / max(ofCap, 1e-6));
  float overlap = pi - cornerAngle(apart, cap, other) - cornerAngle(other, cap, apart) * cos(cap) -
                 cornerAngle(cap, other, apart) * cos(other);
  return clamp(overlap / (pi * max(ofCap, 1e-6)), 0.0, 1.0);
}

// What shadows leave of a lamp: the share of the disk of its directions that lies in the cone, after Oat and Sander, "Ambient
// aperture lighting", 2007. `radius`: half the angle of the lamp's; 0: a point, seen or not by the cone's edge. A soft edge
// widens the disk.
float lampInCone(OpenCone cone, vec3 toLight, float radius) {
  float cosine = dot(cone.axis, toLight);
  if (radius <= 0.0) return smoothstep(cone.cosine - cone.softness, cone.cosine + cone.softness, cosine);
  float inner = acos(clamp(cone.cosine + cone.softness, -1.0, 1.0)), outer = acos(clamp(cone.cosine - cone.softness, -1.0, 1.0));
  float edge = 0.5 * (outer - inner);
  return shareOfCap(sqrt(radius * radius + edge * edge), acos(clamp(cone.cosine, -1.0, 1.0)), acos(clamp(cosine, -1.0, 1.0)));
}

// The share of a reflected lobe that the cone lets through: two caps on the sphere, after Oat and Sander, "Ambient
// aperture lighting", 2007. Half of the lobe's energy lies within its cap.
float lobeInCone(OpenCone cone, float roughness, vec3 reflected) {
  float lobe = min(2.0 * atan(roughness * roughness), 0.5 * pi);
  float open = acos(clamp(cone.cosine, 0.0, 1.0));
  float apart = acos(clamp(dot(cone.axis, reflected), -1.0, 1.0));
  float within = abs(open - lobe);
  float whole = min(1.0, (1.0 - cos(open)) / max(1.0 - cos(lobe), 1e-6));
  return whole * (1.0 - smoothstep(0.0, 1.0, (apart - within) / max(open + lobe - within, 1e-4)));
}

// Returns lobeInCone() over that of an open surface of normal n, whose own horizon the reflectance already contains.
float openShareOfLobe(OpenCone cone, vec3 n, float roughness, vec3 direction) {
  float whole = lobeInCone(coneAround(n, 0.0, 1.0), roughness, direction);
  return min(lobeInCone(cone, roughness, direction) / max(whole, 1e-3), 1.0);
}

#endif
