"""A trial: a random scene and random commands on it, each undisturbed, in trouble, and once more."""
import json
import pathlib
import random as numbers
import shlex
import shutil

import checks
import scenes
import troubles
import works

MOST_STAGES = 20


class Place:
    """The folders of a trial and the program that runs there."""

    def __init__(self, root, program, faults, cache):
        self.program, self.faults, self.cache = str(program), faults, cache
        self.folder, self.spill = pathlib.Path(root) / "work", pathlib.Path(root) / "spill"
        for folder in (self.folder, self.spill, self.cache):
            folder.mkdir(parents=True, exist_ok=True)


class Trial:
    def __init__(self, seed, place, tell):
        self.random, self.place, self.tell = numbers.Random(seed), place, tell
        self.inputs, self.commands = set(), []

    def run(self, arguments, trouble=troubles.Trouble(), also=()):
        """Runs a command and checks how it ends. `also`: further exit codes that are right."""
        self.commands.append(f"prelight {shlex.join(arguments)}   # {trouble.kind} {trouble.value or ''}".rstrip())
        end = troubles.run(arguments, self.place, trouble)
        self.tell(self.commands[-1], trouble, end)
        if end.late:
            raise checks.Fault(f"no end after {troubles.LONGEST:.0f} s")
        if not troubles.ends_as_agreed(end, trouble) and end.code not in also:
            raise checks.Fault(f"code {end.code}\n{end.errors[-2000:]}")
        if end.code > 0 and end.code != 130 and not end.errors.strip():
            raise checks.Fault(f"code {end.code} without a message")
        checks.check_leftovers(self.place, trouble.kind == "kill")
        return end

    def do(self):
        scene = scenes.make_scene(self.random, self.run, self.place.folder)
        self.inputs.add(scene)
        self.try_spoilt(scene)
        work = works.first_work(self.random, scene)
        if self.do_work(work) and work.outputs[:1] == ["baked.glb"]:
            self.inputs.update(self.left())  # a light map lies beside its bake
            for _ in range(self.random.randint(1, 3)):
                self.do_work(works.later_work(self.random, "baked.glb"))
                self.take_away()

    def try_spoilt(self, scene):
        """A scene with changed bytes is read or refused."""
        path = self.place.folder / ("spoilt" + pathlib.Path(scene).suffix)
        shutil.copy(self.place.folder / scene, path)
        scenes.spoil(self.random, path)
        self.run(["info", path.name], also=troubles.SPOILT)
        path.unlink()

    def do_work(self, work):
        """Runs a command undisturbed, in trouble and once more, and compares the results. Returns whether the scene has
        what the command needs."""
        arguments = work.arguments + (["-o", work.outputs[0]] if work.outputs else [])
        if self.run(arguments, also=troubles.REFUSED).code != 0:
            return False
        whole = self.take_away()
        if bool(work.outputs) != bool(whole):
            raise checks.Fault(f"there are {sorted(whole)}, expected {work.outputs}")
        trouble = troubles.draw(self.random)
        end = self.run(arguments, trouble)
        checks.check_part(self.left(), whole, f"what it left with code {end.code}")
        if end.code == 0:
            checks.check_same(self.left(), whole, "what it wrote in trouble")
        if work.divides and self.random.random() < 0.3:
            self.take_away()
            self.do_in_slices(work)
        else:
            self.run(arguments + (["--resume"] if work.resumes and end.code != 0 else []))
        checks.check_leftovers(self.place, False)
        checks.check_same(self.left(), whole, "the last run")
        return True

    def left(self):
        return checks.contents_of(self.place.folder, self.inputs)

    def take_away(self):
        """Removes what commands have written and returns what it was."""
        contents = self.left()
        for path in self.place.folder.iterdir():
            if path.name not in self.inputs:
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        return contents

    def do_in_slices(self, work):
        """Divides the work into slices, of which one may be lost, and merges them stage by stage."""
        count, start = self.random.randint(1, 3), []
        for stage in range(MOST_STAGES):
            parts = [f"{stage}-{i}.part" for i in range(1, count + 1)]
            for i, part in enumerate(parts, 1):
                self.run(work.arguments + ["-o", part, "--slice", f"{i}/{count}"] + start)
            if count > 1 and self.random.random() < 0.3:
                parts.remove(self.random.choice(parts))
            report = json.loads(self.run(["merge", *parts, "-o", work.outputs[0], "--json"]).output)
            for part in self.place.folder.glob("*.part"):
                part.unlink()
            if "next" not in report:
                return
            start = ["--from", report["state"]]
        raise checks.Fault(f"more than {MOST_STAGES} stages")
