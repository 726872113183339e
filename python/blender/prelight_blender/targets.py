"""Chooses the objects that get results and checks that they can hold them."""

from .problems import Problem


def chosen(context):
    """The selected meshes. Raises a Problem if there are none, or if one of them cannot hold results."""
    selected = list(context.selected_objects)
    if not selected:
        raise Problem("Nothing is selected", "select the meshes that are to be baked")
    meshes = [item for item in selected if item.type == "MESH"]
    if not meshes:
        kinds = ", ".join(sorted(f'"{item.name}" ({item.type.title()})' for item in selected))
        raise Problem(f"No mesh is selected, only {kinds}", "select a mesh, or use Object > Convert > Mesh")
    for item in meshes:
        check(item)
    return meshes


def check(item):
    mesh = item.data
    if item.library is not None or mesh.library is not None:
        library = (mesh.library or item.library).filepath
        raise Problem(f'"{item.name}" is linked from {library} and cannot be changed', "Object > Relations > Make Local > Selected Objects and Data")
    if item.mode != "OBJECT":
        raise Problem(f'"{item.name}" is in {item.mode.title()} Mode', "press Tab: bakes need Object Mode")
    if mesh.users - mesh.use_fake_user > 1:
        raise Problem(
            f'"{item.name}" shares its mesh "{mesh.name}" with other objects, which get different light',
            "Object > Relations > Make Single User > Object & Data",
        )
    if len(mesh.polygons) == 0:
        raise Problem(f'"{item.name}" has no faces', "deselect it")
