// A vertex as a light sees it.
layout(location = 0) in vec3 position;
layout(location = 2) in vec4 texCoords;
layout(location = 4) in vec4 color;

uniform vec4 axisX;  // w: half sides of the picture a tangent, or a metre
uniform vec4 axisY;  // w: nearest depth, m; 0: orthographic
uniform vec4 axisZ;  // w: orthographic: depths a metre
uniform vec3 lightPosition;
uniform vec4 baseColorU;  // as in material.glsl
uniform vec4 baseColorV;

out vec2 vTexCoord;
out float vAlpha;

// The vertex in the light's frame; hands over what its alpha takes.
vec3 placeSeen() {
  vec3 way = position - lightPosition;
  vec3 at = vec3(baseColorU.w > 0.5 ? texCoords.zw : texCoords.xy, 1.0);
  vTexCoord = vec2(dot(baseColorU.xyz, at), dot(baseColorV.xyz, at));
  vAlpha = color.a;
  return vec3(dot(axisX.xyz, way), dot(axisY.xyz, way), dot(axisZ.xyz, way));
}
