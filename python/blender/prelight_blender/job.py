"""A bake in a thread of its own, which the window polls. Nothing here touches Blender's data."""

import threading

import numpy as np

from . import package, results
from .light_map_layout import LightMapLayout
from .problems import Problem


class Job:
    """Runs `work`, which takes a function that is told the progress, and returns the result."""

    def __init__(self, work):
        self._work, self._stop = work, threading.Event()
        self._told = ("", 0.0)
        self._result, self._error = None, None
        self._thread = threading.Thread(target=self._run, name="prelight", daemon=True)
        self._thread.start()

    def _run(self):
        try:
            self._result = self._work(self._tell)
        except Exception as error:  # handed to the thread that asks for the result
            self._error = error

    def _tell(self, stage, done):
        self._told = (stage, done)
        return not self._stop.is_set()

    def progress(self):
        """(stage, finished share of it)."""
        return self._told

    def is_done(self):
        return not self._thread.is_alive()

    def cancel(self):
        """Asks the work to end, which takes about a second."""
        self._stop.set()

    def wait(self, seconds=None):
        self._thread.join(seconds)

    def result(self):
        """The result of the work, or None after cancel(). Raises the exception that the work raised."""
        if self._stop.is_set():
            return None
        if self._error is not None:
            raise self._error
        return self._result


def work_of(request, path, targets, sky):
    """The work of a job: it reads a file, bakes it, and sorts the results by the objects' corners."""

    def work(tell):
        prelight = package.find()
        try:
            scene = prelight.load(path)
            sky_light = None if sky is None else prelight.Sky(np.ascontiguousarray(sky, np.float32))
            options = request.options()
            if sky_light is not None:
                options["sky"] = sky_light
            baked = prelight.bake(scene, progress=tell, **options)
        except prelight.Interrupted:
            return None
        except prelight.Error as error:
            within = "" if str(path) in error.where else f"{error.where}: "  # the user does not know the temporary file
            raise Problem(within + error.what, error.fix) from error
        return _result(request, targets, scene, baked)

    return work


def _result(request, targets, scene, baked):
    if request.what == "AO":
        return _vertex_colors(results.AO, request, targets, scene, baked.ao)
    if request.what == "LIGHT":
        return _vertex_colors(results.LIGHT, request, targets, scene, baked.irradiance)
    layout = LightMapLayout(baked.light_map, scene)
    fronts, backs = ({t.name: layout.places(t, back) for t in targets} for back in (False, True))
    picture = layout.picture()
    size = np.float32([picture.shape[1], picture.shape[0]])
    for places in (fronts, backs):
        for name, texels in places.items():
            if texels is not None:
                places[name] = texels / size * (1, -1) + (0, 1)
    return results.LightMap(picture, fronts, backs)


def _vertex_colors(name, request, targets, scene, values):
    ranges = {(p.node, p.primitive): p for p in scene.primitives}
    colors = {}
    for target in targets:
        rgba = np.ones((target.shape.corner_count, 4), np.float32)
        for index, part in enumerate(target.parts):
            placed = ranges.get((target.node, index))
            if placed is not None:
                found = values[placed.first_vertex + part.vertices]
                rgba[part.corners, :3] = found if found.ndim == 2 else found[:, None]
        colors[target.name] = rgba
    return results.VertexColors(name, request.domain, colors)
