// What a material of three.js gains so that light through transfer takes the place of its ambient light.
const vertexDeclarations = `
attribute vec4 prelightLight;  // mean radiance that arrives
attribute float prelightOpen;  // share of the sky
varying vec4 vPrelightLight;
#ifdef PRELIGHT_GROUPS
attribute vec4 prelightGroups;
#endif
#ifdef PRELIGHT_SHADOWS
attribute vec4 prelightShadows;  // shares of the light of four lamps
varying vec4 vPrelightShadows;
#endif
`;

const vertexStatements = `
vPrelightLight = vec4( max( prelightLight.rgb, 0.0 ), prelightOpen );
#ifdef PRELIGHT_GROUPS
vPrelightLight.rgb += max( prelightGroups.rgb, 0.0 );
#endif
#ifdef PRELIGHT_SHADOWS
vPrelightShadows = prelightShadows;
#endif
`;

const fragmentDeclarations = `
uniform int prelightLamps;              // number of lamps
uniform vec4 prelightLampPlaces[ 8 ];   // world; w: 0 directional
uniform vec4 prelightLampWays[ 8 ];     // xyz: of the light; w: 1: it reaches diffuse surfaces through the transfer
uniform vec4 prelightLampCones[ 8 ];    // scale and offset of a spot; z: range, 0: infinite
uniform vec3 prelightLampColors[ 8 ];
uniform int prelightEmitters;           // number of samples of emissive surfaces
uniform vec4 prelightEmitterPlaces[ 32 ];  // world; w: area
uniform vec4 prelightEmitterWays[ 32 ];    // xyz: normal; w: 1: it shines to both sides
uniform vec4 prelightEmitterColors[ 32 ];  // radiance; w: number of the shadow
varying vec4 vPrelightLight;
#ifdef PRELIGHT_SHADOWS
varying vec4 vPrelightShadows;
#endif

float prelightShadow( int lamp ) {
  #ifdef PRELIGHT_SHADOWS
  if ( lamp >= 0 && lamp < 4 && gl_FrontFacing ) return clamp( 0.5 + 3.0 * ( vPrelightShadows[ lamp ] - 0.5 ), 0.0, 1.0 );
  #endif
  return 1.0;
}
`;

// What lies behind what hides the sky is reflected as the mean of what arrives from there.
const fragmentStatements = `
#ifdef RE_IndirectSpecular
{
  vec3 hidden = max( vPrelightLight.rgb - vPrelightLight.a * iblIrradiance * RECIPROCAL_PI, 0.0 );
  radiance = radiance * vPrelightLight.a + hidden;
  #ifdef USE_CLEARCOAT
  clearcoatRadiance = clearcoatRadiance * vPrelightLight.a + hidden;
  #endif
  iblIrradiance = PI * vPrelightLight.rgb;
}
#elif defined( RE_IndirectDiffuse )
irradiance += PI * vPrelightLight.rgb;
#endif
#ifdef RE_Direct
for ( int k = 0; k < prelightLamps; ++ k ) {
  vec3 diffuseBefore = reflectedLight.directDiffuse;
  vec3 path = ( viewMatrix * vec4( prelightLampPlaces[ k ].xyz, 1.0 ) ).xyz - geometryPosition;
  vec3 way = ( viewMatrix * vec4( prelightLampWays[ k ].xyz, 0.0 ) ).xyz;
  float far = dot( path, path ), share = prelightShadow( k );
  IncidentLight lamp;
  lamp.visible = true;
  lamp.direction = - way;
  if ( prelightLampPlaces[ k ].w > 0.5 ) {
    lamp.direction = path * inversesqrt( max( far, 1e-30 ) );
    float range = prelightLampCones[ k ].z, ratio = far / max( range * range, 1e-30 );
    float cone = clamp( - dot( way, lamp.direction ) * prelightLampCones[ k ].x + prelightLampCones[ k ].y, 0.0, 1.0 );
    share *= cone * cone / max( far, 1e-6 ) * ( range > 0.0 ? clamp( 1.0 - ratio * ratio, 0.0, 1.0 ) : 1.0 );
  }
  bool transferred = prelightLampWays[ k ].w > 0.5;
  #ifdef STANDARD
  if ( transferred ) share *= metalnessFactor;  // which alone shows their reflections: no shadow of theirs is known by itself
  #endif
  lamp.color = share * prelightLampColors[ k ];
  RE_Direct( lamp, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
  if ( transferred ) reflectedLight.directDiffuse = diffuseBefore;
}
vec3 emitted = vec3( 0.0 );
for ( int k = 0; k < prelightEmitters; ++ k ) {
  vec3 path = ( viewMatrix * vec4( prelightEmitterPlaces[ k ].xyz, 1.0 ) ).xyz - geometryPosition;
  float cosine = - dot( ( viewMatrix * vec4( prelightEmitterWays[ k ].xyz, 0.0 ) ).xyz, path );
  float far = dot( path, path ), area = prelightEmitterPlaces[ k ].w, lobe = prelightEmitterWays[ k ].w > 0.5 ? abs( cosine ) : max( cosine, 0.0 );
  float facing = lobe * max( dot( geometryNormal, path ), 0.0 ) * area / max( far * ( far + area * RECIPROCAL_PI ), 1e-37 );
  emitted += prelightShadow( int( prelightEmitterColors[ k ].w ) ) * facing * prelightEmitterColors[ k ].rgb;
}
reflectedLight.directDiffuse += emitted * BRDF_Lambert( material.diffuseColor );
#endif
`;

const afterInclude = (text, chunk, added) => text.replace(`#include <${chunk}>`, `#include <${chunk}>\n${added}`);

// A copy of a lit material that shows the light of the meshes that have it; `uniforms` of the lamps are shared.
function relitMaterial(material, uniforms, defines) {
  const copy = material.clone(), before = material.onBeforeCompile;  // which clone() does not copy, like the key
  copy.defines = { ...copy.defines, ...defines };
  copy.onBeforeCompile = (shader, renderer) => {
    before.call(copy, shader, renderer);
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = afterInclude(afterInclude(shader.vertexShader, 'common', vertexDeclarations), 'begin_vertex', vertexStatements);
    shader.fragmentShader = afterInclude(afterInclude(shader.fragmentShader, 'common', fragmentDeclarations), 'lights_fragment_maps', fragmentStatements);
  };
  copy.customProgramCacheKey = () => `prelight ${material.customProgramCacheKey()}`;
  return copy;
}
