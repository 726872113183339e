"""Checks of a page besides its pictures: with fingers, on phones, with screen readers, and when the graphics card goes away."""

import time

import page_client

PHONES = {"upright": (390, 844), "on its side": (844, 390)}
PIXELS_OF_PHONE = 3  # Per CSS pixel.
LEAST_TEXT = 12  # CSS pixels.
LEAST_TARGET = 24  # CSS pixels (WCAG 2.2, 2.5.8).

LAYOUT = """
document.querySelector('#panel details').open = arguments[0];
const rect = id => document.getElementById(id).getBoundingClientRect(), picture = rect('picture'), panel = rect('panel'), canvas = document.getElementById('picture');
const visible = [...document.querySelectorAll('main *, #panel *')].filter(e => e.checkVisibility() && e.getClientRects().length > 0 && !e.closest('h1, #announcer, option'));
const texts = visible.filter(e => [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()));
return {
  sideways: document.documentElement.scrollWidth - window.innerWidth,
  covered: Math.max(0, Math.min(picture.right, panel.right) - Math.max(picture.left, panel.left)) * Math.max(0, Math.min(picture.bottom, panel.bottom) - Math.max(picture.top, panel.top)),
  share: picture.width * picture.height / (window.innerWidth * window.innerHeight),
  text: Math.min(...texts.map(e => parseFloat(getComputedStyle(e).fontSize))),
  target: Math.min(...visible.filter(e => e.matches('button, select, input, summary')).map(e => Math.min(e.getBoundingClientRect().width, e.getBoundingClientRect().height))),
};
"""

VIEW = """
const c = window.prelight.camera, canvas = window.prelight.canvas;
return {position: c.position, back: c.back, distance: c.distance, lamps: window.prelight.lights.lamps.map(l => l.position), ratio: canvas.width / canvas.clientWidth};
"""


def be_phone(browser, size):
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": size[0], "height": size[1], "deviceScaleFactor": PIXELS_OF_PHONE, "mobile": True})
    browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 5})


def be_desktop(browser):
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})


def touch(browser, *ways, steps=6):
    """Moves fingers from one place to another, each given as ((x, y), (x, y))."""
    def send(kind, share):
        points = [{"id": i, "x": a[0] + share * (b[0] - a[0]), "y": a[1] + share * (b[1] - a[1])} for i, (a, b) in enumerate(ways)]
        browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [] if kind == "touchEnd" else points})

    before = browser.execute_script(VIEW)
    send("touchStart", 0.0)
    for step in range(1, steps + 1):
        send("touchMove", step / steps)
    send("touchEnd", 1.0)
    time.sleep(0.6)
    return before, browser.execute_script(VIEW)


def use_phone(browser, page, screenshot):
    """Yields (what, whether it is so)."""
    for name, size in PHONES.items():
        be_phone(browser, size)
        page_client.open_page(browser, page)
        time.sleep(0.6)
        for is_open in (False, True):
            found = browser.execute_script(LAYOUT, is_open)
            time.sleep(0.6)
            screenshot(f"phone {name} {'open' if is_open else 'closed'}")
            where = f"a phone {name}, controls {'open' if is_open else 'closed'}"
            yield f"{where}: nothing scrolls sideways", found["sideways"] <= 0
            yield f"{where}: the picture has {100 * found['share']:.0f} % of the screen, and nothing lies over it" if is_open else \
                f"{where}: the picture has {100 * found['share']:.0f} % of the screen", found["share"] > 0.5 and (not is_open or found["covered"] == 0)
            yield f"{where}: texts of {found['text']:.0f} px, controls of {found['target']:.0f} px", found["text"] >= LEAST_TEXT and found["target"] >= LEAST_TARGET
    be_phone(browser, PHONES["upright"])
    page_client.open_page(browser, page)
    yield from use_fingers(browser)
    be_desktop(browser)


def use_fingers(browser):
    away = lambda a, b: max(abs(x - y) for x, y in zip(a, b))
    before, after = touch(browser, ((150, 600), (230, 620)))
    yield "one finger turns the view", away(before["back"], after["back"]) > 0.1 and abs(after["distance"] / before["distance"] - 1) < 1e-6
    before, after = touch(browser, ((180, 620), (140, 620)), ((210, 620), (250, 620)))
    yield "two fingers that part come nearer", after["distance"] < 0.5 * before["distance"] and away(before["back"], after["back"]) < 1e-6
    before, after = touch(browser, ((120, 550), (180, 600)), ((260, 550), (320, 600)))
    yield "two fingers side by side move the view", (away(before["position"], after["position"]) > 0.01 * before["distance"]
                                                     and abs(after["distance"] / before["distance"] - 1) < 0.01 and away(before["back"], after["back"]) < 1e-6)
    yield f"pictures have at most 2 pixels a CSS pixel ({after['ratio']:.2f})", after["ratio"] <= 2.01
    browser.execute_script("window.prelight.reset()")
    time.sleep(0.6)
    place = browser.execute_script("const b = [...document.querySelectorAll('#lamps button')].find(b => !b.hidden)?.getBoundingClientRect();"
                                   "return b ? [b.x + b.width / 2, b.y + b.height / 2] : null")
    if place:
        before, after = touch(browser, (place, (place[0] + 30, place[1] + 25)))
        yield "a finger drags a lamp", before["lamps"] != after["lamps"] and away(before["back"], after["back"]) < 1e-6


def read_aloud(browser):
    """Checks the page for screen readers; yields (what, whether it is so)."""
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    nodes = [n for n in browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"] if not n.get("ignored")]
    role, name = (lambda n: n.get("role", {}).get("value")), (lambda n: n.get("name", {}).get("value", ""))
    controls = [n for n in nodes if role(n) in ("button", "slider", "combobox", "application", "Canvas", "DisclosureTriangle", "region", "checkbox")]
    unnamed = [role(n) for n in controls if not name(n).strip()]
    yield f"{len(controls)} controls and regions have names in the accessibility tree", len(controls) > 8 and not unnamed
    yield "the page has a heading", any(role(n) == "heading" and name(n).strip() for n in nodes)
    properties = lambda n: {p["name"]: p["value"].get("value") for p in n.get("properties", [])}
    live = [n for n in nodes if properties(n).get("live") == "polite" and properties(n).get("root") is None]
    yield "one place tells politely what changes", len(live) == 1
    canvas = browser.find_element("id", "picture")
    canvas.send_keys("]")
    time.sleep(1.0)
    told = browser.execute_script("return document.getElementById('announcer').textContent")
    yield f"a key is told of: {told!r}", "exposure" in told
    browser.execute_script("document.activeElement.blur()")
    seen, marked = [], True
    for _ in range(40):
        ActionChains(browser).send_keys(Keys.TAB).perform()
        tag, outline = browser.execute_script("const e = document.activeElement, s = getComputedStyle(e); return [e === document.body ? null : e.id || e.textContent || e.title, s.outlineStyle]")
        if tag is None or tag in seen:
            break
        seen.append(tag)
        marked &= outline != "none"
    yield f"Tab goes through {len(seen)} controls, each with an outline", len(seen) > 5 and marked


def lose_graphics(browser):
    """Takes the graphics card away and gives it back; yields (what, whether it is so)."""
    state = {"angle": 0.3}
    before = page_client.draw(browser, 160, 90, state)
    status = "return document.getElementById('status').textContent"
    browser.execute_script("window.lost = window.prelight.renderer.gl.getExtension('WEBGL_lose_context'); window.lost.loseContext()")
    time.sleep(0.5)
    told = browser.execute_script(status)
    browser.find_element("id", "picture").send_keys("d")
    time.sleep(0.5)
    yield "a lost graphics card is told of", "graphics card" in told and told == browser.execute_script(status)
    browser.execute_script("window.lost.restoreContext()")
    for _ in range(100):
        time.sleep(0.1)
        if browser.execute_script("return Boolean(window.prelight.renderer)"):
            break
    time.sleep(1.0)
    after = page_client.draw(browser, 160, 90, state)
    yield "the same picture is there when it comes back", page_client.rms(before, after) < 1e-6 and "ms a picture" in browser.execute_script(status)


def refuse_graphics(page):
    """Checks a browser without WebGL 2."""
    browser = page_client.start_chromium("--disable-3d-apis")
    try:
        page_client.open_page(browser, page)
    except RuntimeError as error:
        return str(error)
    finally:
        browser.quit()
    return ""
