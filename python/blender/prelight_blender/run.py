"""A bake from the scene into the scene: begin, poll until it is done, finish. Scripts and the window use this class."""

import pathlib
import shutil
import tempfile

from . import package, results, scene_file, show, sky, targets
from .job import Job, work_of


class Run:
    """A bake that begins at once, in the main thread. Raises a Problem if it cannot begin."""

    def __init__(self, context, request):
        package.find()
        self.request = request
        chosen = targets.chosen(context)
        if request.what == "LIGHT_MAP":
            for item in chosen:
                results.check_room(item)
        lit = request.what != "AO"
        radiance = sky.radiance_of(context.scene.world) if lit and request.world else None
        self._folder = pathlib.Path(tempfile.mkdtemp(prefix="prelight_"))
        try:
            path = self._folder / "scene.glb"
            self.written = scene_file.write(context, path, chosen, lamps=lit, only_chosen=request.only_selected)
            if lit and radiance is None and not self.written.shines:
                self.written.notes.append("no lamp, glowing surface or world shines: everything is dark")
            self._job = Job(work_of(request, path, self.written.targets, radiance))
        except BaseException:
            self._remove_folder()
            raise

    def notes(self):
        return self.written.notes

    def progress(self):
        return self._job.progress()

    def is_done(self):
        return self._job.is_done()

    def wait(self, seconds=None):
        self._job.wait(seconds)

    def cancel(self):
        self._job.cancel()

    def finish(self):
        """Waits and writes the results into the scene. Returns False after cancel()."""
        try:
            self._job.wait()
            result = self._job.result()
            if result is None:
                return False
            items = results.apply(result, self.written.targets)
            if self.request.show:
                show.show(items, self.request.what)
            else:
                show.hide(items)
            results.remove_unused()
            return True
        finally:
            self._remove_folder()

    def _remove_folder(self):
        shutil.rmtree(self._folder, ignore_errors=True)


def bake(context, request):
    """Runs a whole bake and returns its notes."""
    run = Run(context, request)
    run.finish()
    return run.notes()
