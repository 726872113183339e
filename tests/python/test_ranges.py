"""Calls with senseless values end at once and name the values that they take."""

import inspect
import math
import subprocess
import sys
import textwrap
import time
import unittest

import support

import prelight
from prelight import _native, arguments


def bad_values(text):
    """Values outside of a range that is given in words, such as "a whole number from 1 to 32, or 0 (none)"."""
    least, most = (float(word) for word in (text.split(" from ")[1].split(" to ")[0], text.split(" to ")[1].split(",")[0]))
    wrong = ["three", [1], True, {}, b"1", 1j]
    if text.startswith("a number from"):
        return wrong + [math.nan, math.inf, -math.inf, most + 1, -1 - most, least - 1]
    return wrong + [2.5, math.nan, math.inf, int(most) + 1, -1 - int(most), 2**40 * int(most), -(2**70)]


class Ranges(unittest.TestCase):
    def refuses(self, call, name, value, text):
        start = time.monotonic()
        with self.assertRaises(prelight.UsageError, msg=f"{name}={value!r}") as caught:
            call(**{name: value})
        self.assertLess(time.monotonic() - start, 2.0)
        self.assertEqual(caught.exception.where, name)
        self.assertIn("got ", caught.exception.what)
        self.assertIn(f"expected {text}", caught.exception.what)

    def walk(self, structure, call, known):
        walked = 0
        for name, option in arguments._options_of(structure).items():
            if name not in known or option.kind != "number":
                continue
            text = option.expected
            for value in bad_values(text):
                with self.subTest(name=name, value=value):
                    self.refuses(call, name, value, text)
            walked += 1
        return walked

    def test_EveryNumberOfABake_IsRefusedOutOfItsRange(self):
        room = support.cornell()
        known = set(inspect.signature(prelight.bake).parameters) | {option.name for option in prelight.options("bake")}
        bakes = self.walk(_native._BakeRequest, lambda **bad: prelight.bake(room, **{"ao": True, **bad}), known)
        plans = self.walk(_native._BakeRequest, lambda **bad: prelight.plan(room, **{"ao": True, **bad}), known)
        self.assertEqual(bakes, plans)
        self.assertGreater(bakes, 20)

    def test_NumbersOfOtherCalls_AreRefusedOutOfTheirRanges(self):
        room, swing = support.cornell(), prelight.builtin("swing")
        pictures = {"width", "height", "samples", "depth", "sky_rotation"}
        self.walk(_native._RenderOptions, lambda **bad: prelight.render(room, **bad), pictures)
        self.walk(_native._RenderOptions, lambda **bad: prelight.reference(room, **bad), pictures)
        self.walk(_native._ReferenceGoal, lambda **bad: prelight.reference(room, **bad), {"error", "seconds"})
        self.walk(_native._PhotonOptions, lambda **bad: prelight.photons(room, **bad), {"photons", "sky_rotation"})
        self.walk(_native._LoadOptions, lambda **bad: prelight.load("none.glb", **bad), {"scale", "at"})
        self.walk(
            _native._AnimationKeys,
            lambda **bad: prelight.bake(swing, sh=2, animation=0, **bad),
            {"keys", "key_error"},
        )

    def test_DefaultsOfFunctions_AreThoseOfTheTables(self):
        # None stands for the library's default.
        for name in ("bake", "load", "photons", "reference", "render"):
            arguments_of = inspect.signature(getattr(prelight, name)).parameters
            for option in prelight.options(name):
                default = arguments_of[option.name].default if option.name in arguments_of else None
                if option.kind == "own" or default is None or (name, option.name) == ("reference", "samples"):
                    continue
                with self.subTest(function=name, option=option.name):
                    self.assertEqual(default, option.default)

    def test_FlagsThatAreNoArgumentsByName_AreTaken(self):
        named = inspect.signature(prelight.bake).parameters
        for option in prelight.options("bake"):
            if option.kind == "flag" and option.name not in named:
                with self.subTest(option=option.name):
                    prelight.plan(support.cornell(), **{option.name: True})
        support.named(self, "thickening", lambda: prelight.bake(support.cornell(), thickening=True), "no such argument")

    def test_FlagsAndChoices_OfOtherTypes_AreRefused(self):
        room = support.cornell()
        for option in prelight.options("bake"):
            if option.kind not in ("flag", "choice"):
                continue
            for value in (2, "other", None, 0.5):
                with self.subTest(option=option.name, value=value):
                    self.refuses(lambda **bad: prelight.plan(room, **bad), option.name, value, option.expected)

    def test_NumbersThatExcludeEachOther_AreRefused(self):
        room = support.cornell()
        for options in ({"rays": 16, "error": 0.1}, {"rays": 16, "seconds": 1.0}, {"error": 0.1, "seconds": 1.0}):
            first, second = options
            support.named(self, first, lambda: prelight.bake(room, ao=True, **options), f"excludes {second}")
        support.named(self, "error", lambda: prelight.reference(room, error=0.1, seconds=1.0), "excludes seconds")
        support.named(self, "nearest", lambda: prelight.bake(room, ao=True, nearest=2.0, farthest=1.0), "farthest")
        support.named(self, "texel_size", lambda: prelight.bake(room, ao=True, texel_size=0.1), "light_map")
        support.named(self, "volume", lambda: prelight.bake(room, ao=True, volume=4), "sh")

    def test_OtherTypes_AreNamedInPlainWords(self):
        room = support.cornell()
        calls = (
            ("scene", lambda: prelight.bake("room.glb", ao=True)),
            ("scene", lambda: prelight.plan("room.glb", ao=True)),
            ("scene", lambda: prelight.render(None)),
            ("device", lambda: prelight.bake(room, ao=True, device=5)),
            ("device", lambda: prelight.render(room, device="cpu")),
            ("sky", lambda: prelight.render(room, sky=1)),
            ("camera", lambda: prelight.render(room, camera=0)),
            ("progress", lambda: prelight.bake(room, ao=True, progress=3)),
            ("bake", lambda: prelight.save("x.glb", room, "bake")),
            ("bake", lambda: prelight.relight(None, None)),
            ("radiance", lambda: prelight.constant_sky("blue")),
            ("selector", lambda: prelight.Device(2.5)),
        )
        for where, call in calls:
            with self.subTest(where=where):
                error = support.named(self, where, call, "got ", "expected")
                self.assertNotIn("_native", str(error))
                self.assertNotIn("incompatible function arguments", str(error))

    def test_DeviceByItsNumber_IsTaken(self):
        self.assertEqual(prelight.Device(0).info.index, 0)
        self.assertEqual(prelight.constant_sky(2).radiance.max(), 2.0)

    def test_BakeThatNeedsMoreThanIsAllowed_IsOutOfMemory(self):
        with self.assertRaises(MemoryError) as caught:
            prelight.bake(support.cornell(), sh=32, max_memory=64 << 20)
        self.assertIn("64 MB are allowed", str(caught.exception))


class Ending(unittest.TestCase):
    """The interpreter ends while other threads work."""

    def ends(self, work, tells=True):
        """Starts `work` in a daemon thread, ends a moment later, and returns what was said. `tells`: it calls tell()
        when it has begun."""
        text = f"""
            import sys, threading, time
            import prelight
            room = prelight.builtin("cornell")
            device = prelight.Device()
            begun = threading.Event()
            tell = lambda stage, fraction: begun.set()
            threading.Thread(target=lambda: {work}, daemon=True).start()
            begun.wait({120 if tells else 0})
            time.sleep(0.2)
            sys.exit(7)
        """
        done = subprocess.run([sys.executable, "-c", textwrap.dedent(text)], capture_output=True, text=True, timeout=240)
        self.assertEqual(done.returncode, 7, done.stderr)
        self.assertNotIn("terminate called", done.stderr)
        self.assertNotIn("Fatal", done.stderr)

    def test_InABake_StopsIt(self):
        self.ends("prelight.bake(room, sh=3, rays=1 << 20, device=device, progress=tell)")

    def test_InAPicture_StopsIt(self):
        self.ends("prelight.render(room, height=512, samples=1 << 20, device=device, progress=tell)")

    def test_InCallsThatCannotBeInterrupted_WaitsForThem(self):
        self.ends("[prelight.builtin('rooms') for i in range(10**6)]", tells=False)


if __name__ == "__main__":
    unittest.main()
