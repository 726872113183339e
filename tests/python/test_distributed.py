"""Work that several processes divide is that of one. PRELIGHT_PROGRAM names the program; default: prelight."""

import concurrent.futures
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

from prelight import distributed

try:
    from dask.distributed import Client, LocalCluster
except ImportError:
    Client = None

PROGRAM = os.environ.get("PRELIGHT_PROGRAM", "prelight")


def prelight(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments), "--quiet"], check=True, capture_output=True)


def contents(path):
    """JSON and binary chunk of a baked file, without the seconds that its bake took."""
    data = pathlib.Path(path).read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    parsed = json.loads(data[20 : 20 + length])
    del parsed["extensions"]["PRELIGHT_transfer"]["seconds"]
    return parsed, data[20 + length :]


class Distributed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scene = self.folder / "cornell.glb"
        prelight("scene", "cornell", "-o", self.scene)

    def bake(self, client, **how):
        options = ("--ao", "--sh", 2, "--bounces", 1, "--rays", 64)
        prelight("bake", self.scene, "-o", self.folder / "whole.glb", *options)
        output = distributed.bake(client, self.scene, self.folder / "baked.glb", *options, program=PROGRAM, slices=3, **how)
        self.assertEqual(contents(output), contents(self.folder / "whole.glb"))
        self.assertEqual({path.suffix for path in self.folder.iterdir() if path.is_file()}, {".glb"})

    def test_bake_by_threads_is_that_of_one_process(self):
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            stages = []
            self.bake(executor, report=lambda stage, done, slices: stages.append((stage, done)))
            self.assertEqual(stages[:4], [(1, 1), (1, 2), (1, 3), (2, 1)])

    def test_bake_that_ended_goes_on_where_it_was(self):
        class Ended(Exception):
            pass

        def end_in_second_stage(stage, done, slices):
            if stage == 2:
                raise Ended

        stages = []
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            with self.assertRaises(Ended):
                self.bake(executor, report=end_in_second_stage)
            self.assertTrue((self.folder / "baked.glb.state").exists())
            self.bake(executor, resume=True, report=lambda stage, done, slices: stages.append((stage, done)))
        again = []
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            self.bake(executor, report=lambda stage, done, slices: again.append((stage, done)))
        self.assertEqual(len(stages), len(again) - 3)

    def test_bake_through_a_store_is_that_of_one_process(self):
        try:
            import fsspec  # noqa: F401
        except ImportError:
            self.skipTest("there is no fsspec")
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            self.bake(executor, store="memory://prelight")

    def test_reference_is_that_of_one_process(self):
        options = ("--spp", 8, "--size", 48)
        prelight("reference", self.scene, "-o", self.folder / "whole.exr", *options)
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            output = distributed.reference(executor, self.scene, self.folder / "a.exr", *options, program=PROGRAM, slices=2)
        self.assertEqual(output.read_bytes(), (self.folder / "whole.exr").read_bytes())

    def test_failure_of_a_slice_is_told(self):
        with concurrent.futures.ThreadPoolExecutor(1) as executor, self.assertRaises(distributed.SliceError) as caught:
            distributed.bake(executor, self.scene, self.folder / "a.glb", "--sh", 99, program=PROGRAM, slices=1, retries=0)
        self.assertEqual(caught.exception.code, 2)
        self.assertIn("--sh", caught.exception.message)

    @unittest.skipIf(Client is None, "there is no Dask")
    def test_bake_by_dask_is_that_of_one_process(self):
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
            self.bake(client, threads=1)


if __name__ == "__main__":
    unittest.main()
