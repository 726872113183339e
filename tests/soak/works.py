"""Random commands of the program."""
import collections

# arguments: without the program; outputs: names of files or folders that it writes, the first one by -o; resumes: whether
# --resume continues it; divides: whether slices can share it.
Work = collections.namedtuple("Work", "arguments outputs resumes divides", defaults=(False, False))

TECHNIQUES = [["--ao"], ["--cones"], ["--horizons", "4"], ["--thickness"], ["--sh", "2"], ["--sh", "3", "--bounces", "1"],
              ["--ch", "2"], ["--haar", "4"], ["--glossy", "2"], ["--light-groups"], ["--vo"],
              ["--radiosity", "--patch-size", "0.7"], ["--lightmap", "--texel-size", "0.5", "--photons", "500"],
              ["--sh", "2", "--volume", "3"], ["--sh", "2", "--near-lamps", "2"]]
SHADINGS = ["phong", "ao", "sh", "lights", "radiosity", "lightmap", "full", "screen", "instant", "cones"]
QUICK_FULL = ["--photons", "500", "--map-texels", "200", "--gather-rays", "64"]


def without_repeats(arguments):
    """Drops options that stand there already, with their values."""
    kept, seen, skipping = [], set(), False
    for word in arguments:
        if word.startswith("--"):
            skipping = word in seen
            seen.add(word)
        if not skipping:
            kept.append(word)
    return kept


def bake(random, scene):
    chosen = [word for words in random.sample(TECHNIQUES, random.randint(1, 3)) for word in words]
    options = without_repeats(chosen + ["--rays", random.choice(["16", "64"]), "--seed", str(random.randrange(3))])
    reports = random.random() < 0.3
    arguments = ["bake", scene, *options, *(["--report", "report.json"] if reports else [])]
    return Work(arguments, ["baked.glb", "report.json"] if reports else ["baked.glb"], True, not reports)


def reference(random, scene):
    options = ["--size", random.choice(["24x16", "48x32"]), "--spp", random.choice(["2", "8"])]
    return Work(["reference", scene, *options], ["truth.exr"], True, True)


def render(random, scene):
    shading = random.choice(SHADINGS)
    options = ["--size", "24x16", "--shading", shading]
    if shading == "full":
        options += ["--spp", "1", *QUICK_FULL]
    if random.random() < 0.5:
        options += ["--env", random.choice(["studio", "neutral"])]
    return Work(["render", scene, *options], [random.choice(["picture.png", "picture.exr"])])


def export(random, scene):
    target = random.choice(["gltf", "three", "blender", "godot", "unity", "raw", "web"])
    return Work(["export", scene, "--target", target], ["page.html" if target == "web" else "exported"])


def info(random, scene):
    return Work(["info", scene, *random.choice([[], ["--json"], ["--ao", "--sh", "3"]])], [])


def first_work(random, scene):
    """A command on a scene as it was made."""
    return random.choices([bake, reference, render, info], weights=[6, 2, 2, 1])[0](random, scene)


def later_work(random, scene):
    """A command on a baked scene."""
    return random.choices([render, export, info], weights=[4, 3, 1])[0](random, scene)
