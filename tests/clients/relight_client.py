"""Turns the sky over baked scenes that prelight.js relights in three.js, and compares the pictures with Prelight's own."""

import shutil

import numpy
import page_client
import pictures
import three_client

SIZE = (320, 180)
SAMPLES, OWN_SAMPLES = 4, 2  # Along each side of a pixel, at the same places in both pictures.


def open_scene(browser, folder, module, scene, sky, **query):
    """Opens a baked .glb of `folder` in a page under a sky, [row][column][channel], and returns the parts of its bake that the
    module leaves out and the messages of the console."""
    shutil.copy(three_client.three_bundle(), folder / "three.js")
    if module != folder / "prelight.js":
        shutil.copy(module, folder / "prelight.js")
    (folder / "sky.f32").write_bytes(numpy.ascontiguousarray(sky, numpy.float32).tobytes())
    fields = {"scene": scene, "width": SIZE[0], "height": SIZE[1], "samples": SAMPLES, "skyWidth": sky.shape[1], **query}
    _, messages = three_client.wait_for_picture(browser, folder, "relight_page.html", "&".join(f"{name}={value}" for name, value in fields.items()))
    return browser.execute_script("return window.leftOut"), messages


def draw(browser, degrees):
    values = three_client.floats(browser.execute_script("return window.draw(arguments[0])", degrees))
    return three_client.upright(values, *SIZE)


def covered(browser):
    """The pixels that the model covers whole."""
    values = three_client.floats(browser.execute_script("return window.drawCoverage()"))
    return values.reshape(SIZE[1], SIZE[0], 4)[::-1, :, 3] > 0.999


def own_picture(prelight, baked, sky, degrees, picture, *arguments):
    """Prelight's own picture, drawn once."""
    finer = SAMPLES // OWN_SAMPLES
    if not picture.exists():
        prelight("render", baked, "-o", picture, "--size", f"{finer * SIZE[0]}x{finer * SIZE[1]}", "--env", sky, "--rotate-env", degrees, *arguments)
    return pictures.averaged(pictures.read_exr(picture), finer)


def complaints(browser):
    """The messages of the console since they were last asked for."""
    return [message for message in page_client.complaints(browser) if "favicon" not in message]


def start_browser():
    return page_client.start_browser(offline=False)
