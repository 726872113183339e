# Shows a light map that Prelight exported, in Godot 3: the script of a node above the imported scene. Import the map without mipmaps.
extends Spatial

export(Texture) var light_map

const SHADER = """
shader_type spatial;
render_mode ambient_light_disabled;

uniform sampler2D light_map;
uniform vec4 base_color : hint_color = vec4(1.0);
uniform sampler2D base_texture : hint_albedo;
uniform float metallic = 0.0;
uniform float roughness = 1.0;
uniform vec4 glow : hint_color = vec4(0.0);
uniform float glow_energy = 0.0;
uniform sampler2D glow_texture : hint_black_albedo;

void fragment() {
	vec3 base = base_color.rgb * texture(base_texture, UV).rgb;
	ALBEDO = base * metallic;
	METALLIC = metallic;
	ROUGHNESS = roughness;
	EMISSION = (glow.rgb + texture(glow_texture, UV).rgb) * glow_energy + base * (1.0 - metallic) * textureLod(light_map, UV2, 0.0).rgb / 3.14159265358979;
}
"""


func _ready():
	var shader = Shader.new()
	shader.code = SHADER
	_light_all(self, shader)


func _light_all(node, shader):
	for child in node.get_children():
		if child is MeshInstance and child.mesh != null:
			_light(child, shader)
		_light_all(child, shader)


func _light(drawn, shader):
	for i in drawn.mesh.get_surface_count():
		var uv2 = drawn.mesh.surface_get_arrays(i)[Mesh.ARRAY_TEX_UV2]
		var old = drawn.get_surface_material(i)
		if old == null:
			old = drawn.mesh.surface_get_material(i)
		if uv2 == null or uv2.size() == 0 or not old is SpatialMaterial:
			continue
		var material = ShaderMaterial.new()
		material.shader = shader
		material.set_shader_param("light_map", light_map)
		material.set_shader_param("base_color", old.albedo_color)
		if old.albedo_texture != null:
			material.set_shader_param("base_texture", old.albedo_texture)
		material.set_shader_param("metallic", old.metallic)
		material.set_shader_param("roughness", old.roughness)
		if old.emission_enabled:
			material.set_shader_param("glow", old.emission)
			material.set_shader_param("glow_energy", old.emission_energy)
			if old.emission_texture != null:
				material.set_shader_param("glow_texture", old.emission_texture)
		drawn.set_surface_material(i, material)
