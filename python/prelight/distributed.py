"""Bakes and reference pictures that the workers of a Dask cluster divide among them. docs/scaling-out.md is a tutorial.

The workers run the program `prelight`, which has to be installed where they are, beside this package. They and the caller share a folder, or a
store that fsspec reads and writes, such as s3://bucket/folder.
"""

import concurrent.futures
import ctypes
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

__all__ = ["SliceError", "bake", "reference"]


class SliceError(RuntimeError):
    """The program `prelight` ended with an error: `code` is its exit code, `message` what it printed."""

    def __init__(self, code, message):
        self.code, self.message = code, message
        super().__init__(message)

    def __reduce__(self):
        return type(self), (self.code, self.message)


def bake(client, scene, output, *options, **how):
    """Bakes a scene into `output`, a .glb, and returns its path.

    client   a dask.distributed.Client, or a concurrent.futures.Executor
    scene    glTF file. In a store of fsspec it is copied there, and has to be one .glb
    options  those of `prelight bake`, such as "--sh", 4, "--bounces", 2
    slices   of each stage; default: three times the threads of the cluster, or of the processors for an Executor
    store    folder that all reach, or address of fsspec; default: the folder OUTPUT.parts. What was made there is removed at the end
    retries  how often a slice that fails is tried again, in addition to the workers that die (default 2)
    program  name or path of the program (default "prelight")
    threads  of a slice; default: as many as the worker has
    resume   whether to go on with what an earlier call, which has ended early, has left in the store and in OUTPUT.state
    report   called as report(stage, done, slices) when a slice is done; default: a line on a terminal

    Raises SliceError where the program fails on the caller's side or, again and again, on a worker.
    """
    return _Work(client, ["bake", str(scene), *map(str, options)], output, **how).run()


def reference(client, scene, output, *options, **how):
    """Path-traces a picture into `output`, an .exr, as bake() does with the options of `prelight reference`."""
    return _Work(client, ["reference", str(scene), *map(str, options)], output, **how).run()


class _Work:
    def __init__(self, client, command, output, slices=None, store=None, retries=2, program="prelight", threads=None, resume=False, report=None):
        self.command = command
        self.output = pathlib.Path(output).absolute()
        self.pool = _Executor(client) if isinstance(client, concurrent.futures.Executor) else _Dask(client)
        self.slices = slices or 3 * self.pool.threads()
        self.store = str(store) if store is not None else f"{self.output}.parts"
        self.retries, self.program, self.threads, self.resume = retries, program, threads, resume
        self.report = report or _report_on_terminal

    def run(self):
        shared = "://" not in self.store
        if shared:
            self.store = str(pathlib.Path(self.store).absolute())
            os.makedirs(self.store, exist_ok=True)
        name, scene, *options = self.command
        scene = str(pathlib.Path(scene).absolute())
        self.command = [name, scene, *options]
        remote_scene = scene if shared else _put(scene, f"{self.store}/scene{pathlib.Path(scene).suffix}")
        made, stage = ([] if shared else [remote_scene]), 0
        left = f"{self.output}.state" if self.resume and os.path.exists(f"{self.output}.state") else None
        if shared and self.resume:
            made += [str(part) for part in pathlib.Path(self.store).glob("*.part")]
        try:
            while True:
                stage += 1
                tag = _tag_of(left)
                state = left if shared or left is None else _put(left, f"{self.store}/{tag}.state")
                made += [] if shared or state is None else [state]
                parts = self._stage(stage, tag, [name, remote_scene, *options], state)
                made += parts
                merged = self._merge(parts)
                if "next" not in merged:
                    return self.output
                left = merged["state"]
        finally:
            _remove(made, self.store if shared else None)

    def _stage(self, stage, tag, command, state):
        """Returns the addresses of the parts of a stage, one a slice. `tag` is in their names."""
        jobs = []
        for i in range(1, self.slices + 1):
            part = f"{self.store}/{tag}-{i}.part"
            jobs.append(self.pool.submit(self.retries, _do_slice, self.program, command, state, part, f"{i}/{self.slices}", self.threads))
        try:
            for done, job in enumerate(self.pool.as_completed(jobs), 1):
                job.result()
                self.report(stage, done, self.slices)
            return [job.result() for job in jobs]
        except BaseException:
            self.pool.cancel(jobs)
            raise

    def _merge(self, parts):
        with tempfile.TemporaryDirectory() as folder:
            files = [_get(part, folder) for part in parts]
            command = [self.program, *self.command, "-o", str(self.output), "--json"]
            return json.loads(_run([*command, *(f"--parts={file}" for file in files)]))


class _Dask:
    def __init__(self, client):
        self.client = client

    def threads(self):
        return max(1, sum(self.client.nthreads().values()))

    def submit(self, retries, *call):
        return self.client.submit(*call, retries=retries, pure=False)

    def as_completed(self, jobs):
        from dask.distributed import as_completed

        return as_completed(jobs)

    def cancel(self, jobs):
        self.client.cancel(jobs)


class _Executor:
    def __init__(self, executor):
        self.executor = executor

    def threads(self):
        return os.cpu_count() or 1

    def submit(self, retries, *call):
        return self.executor.submit(_tried_again, retries, *call)

    def as_completed(self, jobs):
        return concurrent.futures.as_completed(jobs)

    def cancel(self, jobs):
        for job in jobs:
            job.cancel()


def _tag_of(state):
    """Returns what tells the parts that begin with a state from those that begin with another, also in a later call."""
    return "start" if state is None else f"{os.stat(state).st_mtime_ns:x}"


def _tried_again(retries, call, *arguments):
    for _ in range(retries):
        try:
            return call(*arguments)
        except SliceError:
            pass
    return call(*arguments)


def _do_slice(program, command, state, part, choice, threads):
    """Does a slice where it runs, and returns the address of its part."""
    name, scene, *options = command
    environment = {**os.environ, **({"POCL_MAX_PTHREAD_COUNT": str(threads)} if threads else {})}
    with tempfile.TemporaryDirectory() as folder:
        # In a shared folder a slice that is done again goes on with what the one before has left.
        file = part if "://" not in part else f"{folder}/part"
        came_from = ["--from", _get(state, folder)] if state else []
        slice_command = [program, name, _get(scene, folder), *options, "-o", file, "--slice", choice, *came_from, "--quiet"]
        _run_when_free(slice_command, environment)
        return part if file == part else _put(file, part)


def _run_when_free(command, environment, patience=30.0):
    """Runs a slice. Where its worker has died, the slice of before may need a moment to end."""
    end = time.monotonic() + patience
    while True:
        try:
            return _run(command, environment)
        except SliceError as error:
            if "another run is continuing it" not in error.message or time.monotonic() > end:
                raise
            time.sleep(1.0)


def _end_with_parent():
    """Ends this process, which is about to become the program, when the worker dies. Only Linux can."""
    if sys.platform == "linux":
        set_death_signal = 1
        ctypes.CDLL(None).prctl(set_death_signal, signal.SIGTERM)


def _run(command, environment=None):
    done = subprocess.run(command, env=environment, capture_output=True, text=True, preexec_fn=_end_with_parent)
    if done.returncode != 0:
        raise SliceError(done.returncode, done.stderr.strip() or f"{command[0]} ended with {done.returncode}")
    return done.stdout


def _get(address, folder):
    """Returns the path of a file, which is copied into `folder` if it lies in a store."""
    if "://" not in address:
        return address
    import fsspec

    path = os.path.join(folder, address.rsplit("/", 1)[1])
    with fsspec.open(address, "rb") as source, open(path, "wb") as target:
        _copy(source, target)
    return path


def _put(path, address):
    import fsspec

    with open(path, "rb") as source, fsspec.open(address, "wb") as target:
        _copy(source, target)
    return address


def _copy(source, target, piece=1 << 22):
    while data := source.read(piece):
        target.write(data)


def _remove(addresses, folder):
    for address in addresses:
        if "://" in address:
            import fsspec

            files, path = fsspec.core.url_to_fs(address)
            if files.exists(path):
                files.rm(path)
        elif os.path.exists(address):
            os.remove(address)
    if folder is not None and os.path.isdir(folder) and not os.listdir(folder):
        os.rmdir(folder)


def _report_on_terminal(stage, done, slices):
    if sys.stderr.isatty():
        print(f"\rstage {stage}: {done} of {slices} slices", end="" if done < slices else "\n", file=sys.stderr, flush=True)
