"""Examples of the README and of docs/python.md run as they stand, and so do the notebooks."""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]


class Documents(unittest.TestCase):
    def test_Examples_Run(self):
        text = "".join((SOURCE / document).read_text() for document in ("README.md", "docs/python.md"))
        examples = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        self.assertGreater(len(examples), 5)
        for number, example in enumerate(examples):
            with self.subTest(example=number + 1), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, "-c", example], cwd=folder, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{example}\n{done.stderr}")

    def test_Package_IsTyped(self):
        spec = importlib.util.find_spec("prelight")
        folder = pathlib.Path(spec.origin).parent
        self.assertTrue((folder / "py.typed").exists())
        self.assertIn("class Scene", (folder / "_native.pyi").read_text())

    def test_Import_LoadsNoOpenGl(self):
        code = "import prelight, os; print(open(f'/proc/{os.getpid()}/maps').read())"
        maps = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
        self.assertIn("prelight/_native", maps)
        self.assertNotRegex(maps, r"libGL|libEGL|libepoxy|libglfw|libX11")


LACKING = [name for name in ("nbclient", "nbformat", "ipykernel", "matplotlib") if importlib.util.find_spec(name) is None]


class Notebooks(unittest.TestCase):
    @unittest.skipIf(LACKING, f"there is no {', '.join(LACKING)}")
    def test_Notebooks_Run(self):
        import nbclient
        import nbformat

        notebooks = sorted((SOURCE / "python/notebooks").glob("*.ipynb"))
        self.assertEqual(len(notebooks), 2)
        for path in notebooks:
            with self.subTest(notebook=path.name), tempfile.TemporaryDirectory() as folder:
                notebook = nbformat.read(path, as_version=4)
                os.environ.pop("MPLBACKEND", None)  # Pictures must appear in the notebook.
                nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": folder}}).execute()
                outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
                pictures = [output for output in outputs if "image/png" in output.get("data", {})]
                self.assertTrue(pictures, "it shows no picture")
                keep = os.environ.get("PRELIGHT_KEEP_NOTEBOOKS")
                if keep:
                    nbformat.write(notebook, pathlib.Path(keep) / path.name)


if __name__ == "__main__":
    unittest.main()
