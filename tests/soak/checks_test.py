"""Programs that break each promise are found out (checks.py, troubles.py, trial.py)."""
import pathlib
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import checks
import trial
import troubles
import works


def glb(numbers):
    binary = struct.pack(f"<{len(numbers)}f", *numbers)
    text = ('{"bufferViews": [{"buffer": 0, "byteLength": %d}], "accessors": [{"bufferView": 0, "componentType": 5126}]}'
            % len(binary)).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def content(self, name, data):
        (self.folder / name).write_bytes(data)
        return checks.content_of(self.folder / name)

    def test_wholeGlb_isTaken(self):
        self.assertTrue(self.content("a.glb", glb([1.0, 2.0])))

    def test_brokenFiles_areFaults(self):
        broken = {"a.glb": glb([1.0])[:-1], "b.glb": glb([float("nan")]), "c.png": b"\x89PNG", "d.exr": b""}
        for name, data in broken.items():
            with self.assertRaises(checks.Fault, msg=name):
                self.content(name, data)

    def test_otherContent_isAFault(self):
        checks.check_same({"a": b"1"}, {"a": b"1"}, "")
        for got in [{"a": b"2"}, {}, {"a": b"1", "b": b""}]:
            with self.assertRaises(checks.Fault):
                checks.check_same(got, {"a": b"1"}, "")
        checks.check_part({}, {"a": b"1"}, "")
        with self.assertRaises(checks.Fault):
            checks.check_part({"a": b"2"}, {"a": b"1"}, "")


class Programs(unittest.TestCase):
    """A trial of a program in Python that writes the file after -o."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def trial(self, body):
        program = self.folder / "program"
        program.write_text(f"#!{sys.executable}\nimport os, sys, time\nout = sys.argv[sys.argv.index('-o') + 1]\n{body}\n")
        program.chmod(0o755)
        one = trial.Trial("1", trial.Place(self.folder, program, None, self.folder / "cache"), lambda *told: None)
        return one.do_work(works.Work(["render"], ["a.txt"]))

    def setTrouble(self, trouble):
        drawn = troubles.draw
        troubles.draw = lambda random: trouble
        self.addCleanup(setattr, troubles, "draw", drawn)

    def test_goodProgram_passes(self):
        self.setTrouble(troubles.Trouble("stop", 30.0))
        self.assertTrue(self.trial("open(out, 'w').write('whole')"))

    def test_badPrograms_areFaults(self):
        self.setTrouble(troubles.Trouble())
        for body in ["open(out, 'w').write(str(time.time()))",                    # other bytes each time
                     "os.abort()",                                                # a signal
                     "sys.exit(1)",                                               # a code, and no message
                     "print('no', file=sys.stderr); sys.exit(7)",                 # a code that nobody agreed to
                     "pass",                                                      # no output
                     "open(out, 'w').write('a'); open('.prelight-1', 'w').write('')"]:  # a temporary file
            with self.assertRaises(checks.Fault, msg=body):
                self.trial(body)

    def test_halfAFile_isAFault(self):
        self.setTrouble(troubles.Trouble("stop", 0.5))
        with self.assertRaises(checks.Fault):
            self.trial("os.path.exists('../again') or (open('../again', 'w'), open(out, 'w').write('whole'), sys.exit(0))\n"
                       "file = open(out, 'w'); file.write('wh'); file.flush(); time.sleep(20)")


if __name__ == "__main__":
    unittest.main()
