# Draws scene.glb, shown by the script that was exported with it, and leaves floats RGBA in out.bin, rows from above.
extends Node

var frames = 0
var view

func _find_camera(node):
	for child in node.get_children():
		if child is Camera:
			return child
		var found = _find_camera(child)
		if found != null:
			return found
	return null

func _ready():
	view = Viewport.new()
	view.size = Vector2({WIDTH}, {HEIGHT})
	view.hdr = true
	view.keep_3d_linear = true
	view.own_world = true
	view.render_target_v_flip = true
	view.render_target_update_mode = Viewport.UPDATE_ALWAYS
	add_child(view)
	var root = Spatial.new()
	root.set_script(load("res://prelight_light_map_godot3.gd"))
	root.light_map = load("res://light_map.exr")
	root.add_child(load("res://scene.glb").instance())
	view.add_child(root)
	var camera = _find_camera(root)
	# Godot 3 knows no camera that sees without end.
	camera.far = 10000
	camera.current = true
	var environment = Environment.new()
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color(0, 0, 0)
	environment.ambient_light_energy = 0
	environment.ambient_light_color = Color(0, 0, 0)
	camera.environment = environment

func _process(_delta):
	frames += 1
	if frames < 5:
		return
	var image = view.get_texture().get_data()
	image.convert(Image.FORMAT_RGBAF)
	var file = File.new()
	file.open("res://out.bin", File.WRITE)
	file.store_buffer(image.get_data())
	file.close()
	get_tree().quit()
