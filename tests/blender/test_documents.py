"""The example of docs/blender.md runs as it stands."""

import pathlib
import re

from support import AddonTest, add, lambertian, lamp

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/blender.md"


class Documents(AddonTest):
    def test_Example_Runs(self):
        examples = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.M | re.S)
        self.assertEqual(len(examples), 1)
        add("plane").data.materials.append(lambertian())
        lamp("SUN", energy=1)
        found = {}
        exec(examples[0], found)
        self.assertGreater(found["image"].size[0], 100)
