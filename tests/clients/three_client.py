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
    """three.js with its GLTFLoader as one module: the bundle of PyPI's nicegui."""
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


def draw(browser, folder, name, width, height, map_kind, patience=120.0):
    """Linear radiance [row][column][channel], and what the browser's console says."""
    shutil.copy(HERE / "three_page.html", folder / "three_page.html")
    shutil.copy(three_bundle(), folder / "three.js")
    server = serve(folder)
    try:
        browser.get(f"http://127.0.0.1:{server.server_port}/three_page.html"
                    f"?scene={name}&width={width}&height={height}&map={map_kind}")
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
    # Chromium asks for an icon by itself.
    messages = [entry["message"] for entry in browser.get_log("browser")
                if "favicon" not in entry["message"] and "GPU stall" not in entry["message"]]
    values = numpy.frombuffer(base64.b64decode(picture), numpy.float32).reshape(height, width, 4)
    return numpy.ascontiguousarray(values[::-1, :, :3]), messages
