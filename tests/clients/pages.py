"""Pages of scenes: what their pictures and controls are to be."""

import dataclasses
import math
import pathlib

import numpy
import page_checks
import page_client
import pictures

SIZE = (320, 180)
TURN = 40  # degrees, of the sky
MOST_RMS = 1e-3  # as displayed, 0..1
MOST_RMS_OF = {"vo": 2e-3}
MOST_BYTES = 6e6

BAKES = {
    "shapes": ["--sh", 4, "--ch", 4, "--ao", "--vo", "--lightmap"],
    "rooms": ["--sh", 3, "--light-groups", "--lightmap", "--radiosity"],
    "swing": ["--sh", 4, "--ao", "--animation", "swing", "--keys", 5],
}
MOMENTS = {"swing": [("sh", 1.0), ("sh", 1.37), ("sh", 2.9), ("phong", 1.37), ("phong", 3.71)]}  # of shadings that follow animations


@dataclasses.dataclass
class MadePage:
    name: str
    page: pathlib.Path
    pictures: dict  # Prelight's own, by shading and moment


def sky_of_pages(folder):
    """A sky with a sun, as wide as pages keep them."""
    y, x = numpy.mgrid[0:64, 0:128]
    sky = numpy.stack([0.2 + 0.5 * numpy.exp(-((y - 24.0) ** 2 + (x - 40.0) ** 2) / 40.0) * k + 0.2 * (y < 32) for k in (9.0, 8.0, 6.0)], axis=-1)
    pictures.write_exr(folder / "page_sky.exr", sky.astype(numpy.float32))
    return folder / "page_sky.exr"


def make(prelight, folder):
    """Bakes the scenes and exports their pages."""
    sky, made = sky_of_pages(folder), []
    for name, techniques in BAKES.items():
        source, baked, page = (folder / f"{name}{end}" for end in (".glb", "_page.glb", "_page.html"))
        prelight("scene", name, "-o", source)
        prelight("bake", source, "-o", baked, *techniques, "--rays", 64, "--bounces", 1)
        prelight("export", baked, "-o", page, "--target", "web", "--env", sky)
        made.append(MadePage(name, page, OwnPictures(prelight, folder, name, baked, sky)))
    return made


class OwnPictures(dict):
    """Prelight's own picture in a shading, drawn when it is first asked for."""

    def __init__(self, prelight, folder, name, baked, sky):
        super().__init__()
        self.prelight, self.folder, self.name, self.baked, self.sky = prelight, folder, name, baked, sky

    def __missing__(self, what):
        shading, moment = what
        picture = self.folder / f"{self.name}_page_{shading}{'' if moment is None else f'_{moment}'}.exr"
        self.prelight("render", self.baked, "-o", picture, "--shading", shading, "--size", "%dx%d" % SIZE, "--env", self.sky,
                      "--rotate-env", TURN, *([] if moment is None else ["--at", moment]))
        self[what] = pictures.read_exr(picture)
        return self[what]


def say(name, what, good):
    print(f"{name:12} page {what}: {'ok' if good else 'NOT SO'}")
    return good


def compare(browser, made, finer, folder, browser_name):
    good = True
    shadings = browser.execute_script("return window.prelight.shadings.map(s => s.name)")
    for shading, moment in [(shading, None) for shading in shadings] + MOMENTS.get(made.name, []):
        drawn = page_client.draw(browser, *SIZE, {"technique": shading, "angle": math.radians(TURN), "time": moment}, finer=finer)
        away, most = page_client.rms(made.pictures[shading, moment], drawn), MOST_RMS_OF.get(shading, MOST_RMS)
        what = shading if moment is None else f"{shading} at {moment} s"
        good &= say(made.name, f"{browser_name} {what:16} rms {away:.5f} (at most {most})", away <= most)
        pictures.write_png(folder / f"{made.name}_{browser_name}_{what.replace(' ', '_')}.png", drawn)
    return good


def open_and_report(browser, made, browser_name):
    first = page_client.open_page(browser, made.page)
    size = made.page.stat().st_size
    return say(made.name, f"{browser_name} {size * 1e-6:.2f} MB, first picture after {first * 1e-3:.1f} s", size <= MOST_BYTES)


def check_in_chromium(all_made, folder):
    browser, renderer, finer = page_client.start_browser()
    print(f"pages in Chromium on {renderer}{'' if finer == 1 else f', drawn {finer} times finer'}")
    good = True
    try:
        for made in all_made:
            good &= open_and_report(browser, made, "Chromium")
            good &= compare(browser, made, finer, folder, "Chromium")
            page_client.open_page(browser, made.page)
            good &= use(browser, made, folder)
            messages = page_client.complaints(browser)
            good &= say(made.name, f"console says {' '.join(messages) or 'nothing'}", not messages)
        for what, did in page_checks.lose_graphics(browser):
            good &= say(made.name, what, did)
    finally:
        browser.quit()
    told = page_checks.refuse_graphics(all_made[0].page)
    return good & say(all_made[0].name, f"without WebGL: {told!r}", "WebGL 2" in told)


def use(browser, made, folder):
    def screenshot(what):
        browser.save_screenshot(str(folder / f"{made.name}_{what.replace(' ', '_')}.png"))

    good = True
    for what, did in page_client.use_controls(browser):
        good &= say(made.name, what, did)
    screenshot("page")
    page_client.open_page(browser, made.page)
    for what, did in page_checks.read_aloud(browser):
        good &= say(made.name, what, did)
    for what, did in page_checks.use_phone(browser, made.page, screenshot):
        good &= say(made.name, what, did)
    return good


def check_in_firefox(all_made, folder):
    browser = page_client.Firefox()
    good = True
    try:
        for made in all_made:
            good &= open_and_report(browser, made, "Firefox")
            good &= compare(browser, made, 1, folder, "Firefox")
    finally:
        browser.quit()
    return good
