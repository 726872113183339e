"""Draws an exported scene by three.js in Chromium."""

import base64
import functools
import http.server
import pathlib
import shutil
import threading
import time

import numpy

HERE = pathlib.Path(__file__).resolve().parent


def three_bundle():
    """three.js with its GLTFLoader as one module, from the bundle in PyPI's nicegui."""
    import importlib.util

    spec = importlib.util.find_spec("nicegui")
    if spec is None:
        raise RuntimeError("nicegui is not installed, whose three.js is used")
    return pathlib.Path(spec.submodule_search_locations[0]) / "elements/scene/dist/index.js"


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".js": "text/javascript"}

    def log_message(self, *arguments):
        pass


def serve(folder):
    handler = functools.partial(QuietHandler, directory=str(folder))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def start_browser():
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))


def open_page(browser, folder, page, query, patience=120.0):
    """The page's window.picture, as floats, and the messages of three.js in the browser's console."""
    shutil.copy(three_bundle(), folder / "three.js")
    picture, messages = wait_for_picture(browser, folder, page, query, patience)
    return floats(picture), messages


def wait_for_picture(browser, folder, page, query, patience=120.0):
    """What the page leaves in window.picture, and the messages of the browser's console."""
    shutil.copy(HERE / page, folder / page)
    server = serve(folder)
    try:
        browser.get(f"http://127.0.0.1:{server.server_port}/{page}?{query}")
        end = time.monotonic() + patience
        while time.monotonic() < end:
            failure, picture = browser.execute_script("return [window.failure, window.picture]")
            if failure:
                raise RuntimeError(failure)
            if picture:
                break
            time.sleep(0.1)
        else:
            raise RuntimeError("no picture in time")
    finally:
        server.shutdown()
    # Chromium requests an icon on its own.
    messages = [entry["message"] for entry in browser.get_log("browser")
                if "favicon" not in entry["message"] and "GPU stall" not in entry["message"]]
    return picture, messages


def floats(text):
    return numpy.frombuffer(base64.b64decode(text), numpy.float32)


def upright(values, width, height):
    return numpy.ascontiguousarray(values.reshape(height, width, 4)[::-1, :, :3])


def draw(browser, folder, name, width, height, map_kind, samples):
    """Linear radiance [row][column][channel], the messages of the browser's console, and each pixel's u, v and distance."""
    values, messages = open_page(browser, folder, "three_page.html",
                                 f"scene={name}&width={width}&height={height}&map={map_kind}&samples={samples}")
    places = floats(browser.execute_script("return window.places"))
    return upright(values, width, height), messages, upright(places, width, height)


def draw_probe_ball(browser, folder, name, point, size):
    """A ball lit by probes, with these messages, and the numbers of the texture of LightProbeGrid."""
    values, messages = open_page(browser, folder, "probes_page.html",
                                 f"scene={name}&size={size}&point={','.join(map(str, point))}")
    return upright(values, size, size), floats(browser.execute_script("return window.grid")), messages
