# Shows a light map that Prelight exported, in Godot 4: the script of a node above the imported scene.
extends Node3D

@export var light_map: Texture2D

const SHADER := """
shader_type spatial;
render_mode ambient_light_disabled;

uniform sampler2D light_map : filter_linear, repeat_disable;
uniform vec4 base_color : source_color = vec4(1.0);
uniform sampler2D base_texture : source_color, hint_default_white;
uniform float metallic = 0.0;
uniform float roughness = 1.0;
uniform vec4 glow : source_color = vec4(0.0);
uniform float glow_energy = 0.0;
uniform sampler2D glow_texture : source_color, hint_default_black;

void fragment() {
	vec3 base = base_color.rgb * texture(base_texture, UV).rgb;
	ALBEDO = base * metallic;
	METALLIC = metallic;
	ROUGHNESS = roughness;
	EMISSION = (glow.rgb + texture(glow_texture, UV).rgb) * glow_energy + base * (1.0 - metallic) * texture(light_map, UV2).rgb / PI;
}
"""


func _ready() -> void:
	var shader := Shader.new()
	shader.code = SHADER
	for child in find_children("*", "MeshInstance3D", true, false):
		_light(child as MeshInstance3D, shader)


func _light(drawn: MeshInstance3D, shader: Shader) -> void:
	for i in drawn.mesh.get_surface_count():
		var uv2 = drawn.mesh.surface_get_arrays(i)[Mesh.ARRAY_TEX_UV2]
		var old := drawn.get_active_material(i) as BaseMaterial3D
		if uv2 == null or uv2.is_empty() or old == null:
			continue
		var material := ShaderMaterial.new()
		material.shader = shader
		material.set_shader_parameter("light_map", light_map)
		material.set_shader_parameter("base_color", old.albedo_color)
		if old.albedo_texture != null:
			material.set_shader_parameter("base_texture", old.albedo_texture)
		material.set_shader_parameter("metallic", old.metallic)
		material.set_shader_parameter("roughness", old.roughness)
		if old.emission_enabled:
			material.set_shader_parameter("glow", old.emission)
			material.set_shader_parameter("glow_energy", old.emission_energy_multiplier)
			if old.emission_texture != null:
				material.set_shader_parameter("glow_texture", old.emission_texture)
		drawn.set_surface_override_material(i, material)
