"""A bake from the scene to the scene: begin, look at it until it is done, finish. Scripts and the window use the same."""

import pathlib
import shutil
import tempfile

from . import package, results, scene_file, show, sky, targets
from .job import Job, work_of


class Run:
    """Begins at once, in the main thread; raises Problem where it cannot."""

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
                self.written.notes.append("no lamp, glowing surface or world shines: all is dark")
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
        """Waits, and puts the results into the scene; False after cancel()."""
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
    """A whole bake; returns its notes."""
    run = Run(context, request)
    run.finish()
    return run.notes()
