"""Opens an exported page in Chromium and Firefox, without any network, and compares its pictures with Prelight's own."""

import base64
import shutil
import time

import numpy

# SwiftShader, Chromium's own rasteriser, places vertices on a grid of 1/16 of a sample; the system's OpenGL
# uses 1/256. With SwiftShader, pictures are drawn finer by this factor, and only the samples of an ordinary
# picture are kept, so that both see the same edges.
FINER_OF_COARSE = 5

RENDERER = """
const gl = document.createElement('canvas').getContext('webgl2'), names = gl?.getExtension('WEBGL_debug_renderer_info');
return gl ? gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER) : '';
"""

PICTURE = """
const [width, height, samples, finer, state] = arguments, page = window.prelight, gl = page.renderer.gl;
page.set(state);
page.renderer.draw(page.view(), width, height, samples * finer);
const target = page.renderer.target, texels = new Float32Array(4 * target.width * target.height), picture = new Float32Array(3 * width * height);
gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
gl.readPixels(0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, texels);
for (let y = 0; y < samples * height; ++y)
  for (let x = 0; x < samples * width; ++x)
    for (let c = 0; c < 3; ++c) {
      const pixel = (height - 1 - Math.floor(y / samples)) * width + Math.floor(x / samples), middle = (finer - 1) / 2;
      picture[3 * pixel + c] += texels[4 * ((y * finer + middle) * target.width + x * finer + middle) + c] / samples ** 2;
    }
const bytes = new Uint8Array(picture.buffer);
let text = '';
for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
return btoa(text);
"""


def start_chromium(*arguments, offline=True):
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--disable-dev-shm-usage", "--window-size=960,640", *arguments):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))
    if not offline:
        return browser
    browser.execute_cdp_cmd("Network.enable", {})
    browser.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})
    return browser


def start_browser(offline=True):
    """Chromium on the system's OpenGL, as `render` uses it, or else on its own rasteriser; with its name and how much finer it has to draw."""
    for arguments, finer in ((("--use-angle=gl-egl", "--ignore-gpu-blocklist"), 1),
                             (("--use-angle=swiftshader", "--enable-unsafe-swiftshader"), FINER_OF_COARSE)):
        browser = start_chromium(*arguments, offline=offline)
        browser.get("about:blank")
        renderer = browser.execute_script(RENDERER)
        if renderer:
            return browser, renderer, finer
        browser.quit()
    raise RuntimeError("Chromium has no WebGL 2 here")


class Firefox:
    """Firefox in a window of a virtual screen, because its headless mode has no WebGL, by its own protocol, with selenium's names."""

    def __init__(self):
        import os
        import subprocess
        import tempfile
        from marionette_driver.marionette import Marionette

        read, write = os.pipe()
        self.screen = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24"], pass_fds=[write],
                                       stderr=subprocess.DEVNULL)
        os.environ["DISPLAY"] = f":{os.read(read, 16).decode().strip()}"
        preferences = {"webgl.force-enabled": True, "gfx.x11-egl.force-enabled": True, "layers.acceleration.force-enabled": True,
                       "security.sandbox.content.level": 0, "network.proxy.type": 1, "network.proxy.socks": "127.0.0.1",
                       "network.proxy.socks_port": 1}
        self.folder = tempfile.TemporaryDirectory()
        self.driver = Marionette(bin=shutil.which("firefox-esr") or shutil.which("firefox"), prefs=preferences,
                                 # A file of that name would be removed, even /dev/null.
                                 gecko_log=self.folder.name)
        self.driver.start_session()

    def get(self, address):
        self.driver.navigate(address)

    def execute_script(self, script, *arguments):
        return self.driver.execute_script(script, script_args=arguments, sandbox=None)

    def quit(self):
        self.driver.quit(in_app=False)
        self.driver.cleanup()
        self.screen.terminate()
        self.screen.wait()
        self.folder.cleanup()


def open_page(browser, page, patience=120.0):
    """Waits for the first picture and returns the milliseconds that it took."""
    browser.get(page.resolve().as_uri())
    end = time.monotonic() + patience
    while time.monotonic() < end:
        first, status, kind = browser.execute_script(
            "const s = document.getElementById('status'); return [window.prelight?.firstPicture ?? 0, s.textContent, s.className]")
        if kind == "failed":
            raise RuntimeError(status)
        if first:
            return first
        time.sleep(0.1)
    raise RuntimeError("no picture in time")


def draw(browser, width, height, state, samples=2, finer=1):
    """Linear radiance [row][column][channel]."""
    text = browser.execute_script(PICTURE, width, height, samples, finer, state)
    return numpy.frombuffer(base64.b64decode(text), numpy.float32).reshape(height, width, 3)


def complaints(browser):
    """The messages of the console, without remarks of graphics drivers about speed."""
    return [entry["message"] for entry in browser.get_log("browser") if "OpenGL, Performance" not in entry["message"]]


def shown(radiance):
    """0..1 as on the screen: Khronos' PBR Neutral tone mapping, then sRGB."""
    color = numpy.clip(radiance.astype(numpy.float64), 0.0, 1e6)
    least = color.min(axis=-1, keepdims=True)
    color = color - numpy.where(least < 0.08, least - 6.25 * least * least, 0.04)
    peak = color.max(axis=-1, keepdims=True)
    start, headroom = 0.76, 0.24
    compressed = 1.0 - headroom * headroom / (numpy.maximum(peak, start) + headroom - start)
    grey = 1.0 - 1.0 / (0.15 * (numpy.maximum(peak, start) - compressed) + 1.0)
    bright = color * compressed / numpy.maximum(peak, 1e-9) * (1.0 - grey) + compressed * grey
    color = numpy.clip(numpy.where(peak < start, color, bright), 0.0, 1.0)
    return numpy.where(color <= 0.0031308, 12.92 * color, 1.055 * numpy.power(numpy.maximum(color, 1e-9), 1.0 / 2.4) - 0.055)


def rms(reference, picture):
    return float(numpy.sqrt(numpy.mean((shown(picture) - shown(reference)) ** 2)))


def state_of(browser):
    return browser.execute_script(
        "const p = window.prelight; return {position: p.camera.position, angle: p.state.angle, time: p.state.time, plays: Boolean(p.plays), technique: p.state.technique,"
        " split: p.state.split, sky: p.state.sky, exposure: p.state.exposure, lamps: p.lights.lamps.map(l => l.position)}")


def use_controls(browser):
    """Drags, presses keys and makes choices; yields (action, whether it had the right effect)."""
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select

    canvas = browser.find_element(By.ID, "picture")

    def done(act):
        before = state_of(browser)
        act()
        time.sleep(0.5)
        return before, state_of(browser)

    before, after = done(lambda: ActionChains(browser).move_to_element_with_offset(canvas, -200, 100).click_and_hold().move_by_offset(60, 20).release().perform())
    yield "a drag turns the view", before["position"] != after["position"]
    before, after = done(lambda: canvas.send_keys("d"))
    yield "D turns the sky", before["angle"] != after["angle"]
    before, after = done(lambda: canvas.send_keys("+"))
    yield "+ comes nearer", before["position"] != after["position"]
    before, after = done(lambda: canvas.send_keys("b"))
    yield "B shows before and after", before["split"] == 0 and after["split"] == 0.5
    divider = browser.find_element(By.ID, "divider")
    before, after = done(lambda: ActionChains(browser).drag_and_drop_by_offset(divider, -120, 0).perform())
    yield "the divider is dragged", after["split"] < before["split"]
    lamps = [b for b in browser.find_elements(By.CSS_SELECTOR, "#lamps button") if b.is_displayed()]
    if lamps:
        before, after = done(lambda: ActionChains(browser).drag_and_drop_by_offset(lamps[0], 30, 25).perform())
        yield "a lamp is dragged", before["lamps"] != after["lamps"]
        before, after = done(lambda: lamps[0].send_keys(Keys.ARROW_LEFT))
        yield "a key moves a lamp", before["lamps"] != after["lamps"]
    select = Select(browser.find_element(By.CSS_SELECTOR, "#panel select"))
    before, after = done(lambda: select.select_by_index(1))
    yield "another shading is chosen", before["technique"] != after["technique"]
    if browser.execute_script("return Boolean(window.prelight.page.motion)"):
        before, after = done(lambda: canvas.send_keys(" "))
        yield "Space plays", after["plays"] and after["time"] > 0
        before, after = done(lambda: canvas.send_keys(" "))
        time.sleep(0.5)
        yield "Space pauses", not after["plays"] and state_of(browser)["time"] == after["time"]
        slider = browser.find_element(By.XPATH, "//label[contains(., 'Time')]/input")
        before, after = done(lambda: slider.send_keys(Keys.ARROW_RIGHT))
        yield "the time is slid", after["time"] > before["time"]
    before, after = done(lambda: canvas.send_keys("e"))
    yield "E meters the picture", before["exposure"] != after["exposure"]
    before, after = done(lambda: canvas.send_keys("r"))
    yield "R is the first view", before["position"] != after["position"]
    unnamed = browser.execute_script(
        "return [...document.querySelectorAll('input, select, button, canvas, [role=slider]')]"
        ".filter(e => !e.labels?.length && !e.getAttribute('aria-label') && !e.textContent.trim()).length")
    yield "every control has a name", unnamed == 0
