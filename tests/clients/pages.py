"""Pages of scenes, with the pictures and controls that are expected of them."""

import dataclasses
import math
import pathlib

import glb_file
import page_checks
import page_client
import pictures

SIZE = (320, 180)
TURN = 40  # Degrees by which the sky is turned.
MOST_RMS = 1e-3  # As displayed, 0..1.
MOST_RMS_OF = {"vo": 2e-3}
MOST_BYTES = 6e6
MOST_BYTES_OF = {"swing": 12e6}  # Its near lamps have shells at five keys.


def make_metals(scene):
    """Makes every other material reflect like metals."""
    for i, material in enumerate(scene["materials"]):
        if i % 2:
            material.setdefault("pbrMetallicRoughness", {}).update(metallicFactor=1.0, roughnessFactor=(0.25, 0.5)[i // 2 % 2])


def make_leaves(scene):
    """Lets light through all materials but the first."""
    scene.setdefault("extensionsUsed", []).append("KHR_materials_diffuse_transmission")
    for material in scene["materials"][1:]:
        material.setdefault("extensions", {})["KHR_materials_diffuse_transmission"] = {
            "diffuseTransmissionFactor": 0.5, "diffuseTransmissionColorFactor": [0.9, 0.6, 0.3]}


def make_tinted(scene):
    """Makes every other material show half of the surfaces behind it, or glass show them in colours."""
    scene.setdefault("extensionsUsed", []).append("KHR_materials_transmission")
    for i, material in enumerate(scene["materials"][1:]):
        base = material.setdefault("pbrMetallicRoughness", {}).setdefault("baseColorFactor", [1, 1, 1, 1])
        if i % 2:
            material["alphaMode"], base[3] = "BLEND", 0.5
        else:
            material.setdefault("extensions", {})["KHR_materials_transmission"] = {"transmissionFactor": 0.8}
        material["doubleSided"] = True  # Makes each shape visible from both sides.


@dataclasses.dataclass
class Kind:
    """A page: a built-in scene, what it is baked with, what its materials are made, whether all else than pictures is tried on it, and
    whether it has places for texels made first."""

    scene: str
    bake: list
    change: object = None
    is_used: bool = False
    is_unfolded: bool = False  # Whether the export of a light map has unfolded it.


OTHER_SIDES = ["--sh", 3, "--ch", 3, "--ao", "--haar", 8, "--subsurface-transport"]
REFLECTIONS = ["--glossy", 3, "--cones", "--ao", "--haar", 8]
KINDS = {
    "shapes": Kind("shapes", ["--sh", 4, "--ch", 4, "--ao", "--vo", "--lightmap"], is_used=True),
    "rooms": Kind("rooms", ["--sh", 3, "--near-lamps", 8, "--light-groups", "--lightmap", "--radiosity"], is_used=True),
    "swing": Kind("swing", ["--sh", 4, "--ch", 3, "--near-lamps", 8, "--ao", "--animation", "swing", "--keys", 5], is_used=True),
    "metal shapes": Kind("shapes", REFLECTIONS, make_metals),
    "metal cornell": Kind("cornell", REFLECTIONS, make_metals),
    "tinted shapes": Kind("shapes", ["--sh", 3, "--ao"], make_tinted),
    "tinted caustics": Kind("caustics", ["--sh", 3, "--ao"], make_tinted),
    "leafy shapes": Kind("shapes", OTHER_SIDES, make_leaves),
    "leafy cornell": Kind("cornell", OTHER_SIDES, make_leaves),
    "bumps": Kind("bumps", ["--lightmap", "--sh", 3, "--texels", 64]),
    "unfolded shapes": Kind("shapes", ["--sh", 3, "--texels", 64], is_unfolded=True),
}
# Moments of shadings that follow animations.
MOMENTS = {"swing": [("sh", 1.0), ("sh", 1.37), ("sh", 2.9), ("phong", 1.37), ("phong", 3.71)]}


@dataclasses.dataclass
class MadePage:
    name: str
    kind: Kind
    page: pathlib.Path
    pictures: dict  # Prelight's own, by shading and moment.


def change_scene(glb, change):
    """Changes the JSON of a .glb by a function."""
    scene, chunks = glb_file.read(glb)
    change(scene)
    glb_file.write(glb, scene, chunks)


def make(prelight, folder):
    """Bakes the scenes and exports their pages."""
    sky, made = pictures.write_sky_with_sun(folder / "page_sky.exr", 128), []
    for name, kind in KINDS.items():
        source, baked, page = (folder / f"{name.replace(' ', '_')}{end}" for end in (".glb", "_page.glb", "_page.html"))
        prelight("scene", kind.scene, "-o", source)
        if kind.change:
            change_scene(source, kind.change)
        if kind.is_unfolded:
            prelight("bake", source, "-o", baked, "--lightmap", "--rays", 4)
            prelight("export", baked, "-o", source, "--as", "lightmap")
        prelight("bake", source, "-o", baked, *kind.bake, "--rays", 64, "--bounces", 1)
        prelight("export", baked, "-o", page, "--target", "web", "--env", sky)
        made.append(MadePage(name, kind, page, OwnPictures(prelight, folder, name, baked, sky)))
    return made


class OwnPictures(dict):
    """Prelight's own picture in a shading, drawn when it is first asked for."""

    def __init__(self, prelight, folder, name, baked, sky):
        super().__init__()
        self.prelight, self.folder, self.name, self.baked, self.sky = prelight, folder, name, baked, sky

    def __missing__(self, what):
        shading, moment = what
        picture = self.folder / f"{self.name.replace(' ', '_')}_page_{shading}{'' if moment is None else f'_{moment}'}.exr"
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
        pictures.write_png(folder / f"{made.name} {browser_name} {what}.png".replace(" ", "_"), drawn)
    return good


def open_and_report(browser, made, browser_name):
    first = page_client.open_page(browser, made.page)
    size = made.page.stat().st_size
    return say(made.name, f"{browser_name} {size * 1e-6:.2f} MB, first picture after {first * 1e-3:.1f} s", not made.kind.is_used or size <= MOST_BYTES_OF.get(made.name, MOST_BYTES))


def check_in_chromium(all_made, folder):
    browser, renderer, finer = page_client.start_browser()
    print(f"pages in Chromium on {renderer}{'' if finer == 1 else f', drawn {finer} times finer'}")
    good = True
    try:
        for made in all_made:
            good &= open_and_report(browser, made, "Chromium")
            good &= compare(browser, made, finer, folder, "Chromium")
            if made.kind.is_used:
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
        browser.save_screenshot(str(folder / f"{made.name} {what}.png".replace(" ", "_")))

    good = True
    page_client.open_page(browser, made.page)
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
