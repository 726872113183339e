"""One-token changes of C++ and OpenCL C: the places where a text can be changed, and the new tokens."""

import dataclasses
import pathlib
import random
import re

SWAPPED = {
    "arithmetic": {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"], "+=": ["-="], "-=": ["+="],
                   "*=": ["/="], "/=": ["*="], "++": ["--"], "--": ["++"]},
    "comparison": {"<": ["<=", ">"], "<=": ["<", ">"], ">": [">=", "<"], ">=": [">", "<"], "==": ["!="], "!=": ["=="]},
    "logic": {"&&": ["||"], "||": ["&&"], "&": ["|"], "|": ["&"], "|=": ["&="], "&=": ["|="]},
    "shift": {"<<": [">>"], ">>": ["<<"]},
}
SWAPPED_NAMES = {
    "true": ["false"], "false": ["true"], "min": ["max"], "max": ["min"], "fmin": ["fmax"], "fmax": ["fmin"],
    "sin": ["cos"], "cos": ["sin"], "floor": ["ceil"], "ceil": ["floor"], "front": ["back"], "back": ["front"],
    "any_of": ["all_of"], "all_of": ["any_of"], "lower_bound": ["upper_bound"], "upper_bound": ["lower_bound"],
    "break": ["continue"], "continue": ["break"],
}
SWIZZLES = {"x": ["y", "z"], "y": ["z", "x"], "z": ["x", "y"], "w": ["x"], "s0": ["s1"], "s1": ["s0"],
            "lo": ["hi"], "hi": ["lo"]}

NUMBER = re.compile(r"(?<![\w.])(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)([uUlLfF]*)(?![\w.])")
WORD = re.compile(r"(?<![\w.])[a-z_]+(?=\b)")
MEMBER = re.compile(r"(?<=\.)(?:[xyzw]|s[01]|lo|hi)\b(?!\()")
# clang-format puts spaces around binary operators, and none inside template brackets.
BINARY = re.compile(r"(?<= )(?:&&|\|\||==|!=|<=|>=|<<|>>|\+=|-=|\*=|/=|\|=|&=|[-+*/%<>&|])(?= )")
STEP = re.compile(r"\+\+|--")
NOT = re.compile(r"(?<![\w)\]])!(?=[\w(])")
RETURN = re.compile(r"\breturn;")

SKIPPED_LINE = re.compile(r"^\s*(?:#|using\b|namespace\b|template\b|static_assert\b|PRELIGHT_SHARED)|\bassert\(|\bpad\d?\b")


@dataclasses.dataclass(frozen=True)
class Mutation:
    file: str  # Below the root.
    line: int  # Counted from 1.
    column: int  # Counted from 1.
    kind: str
    old: str
    new: str
    text: str  # The whole line as it was.

    def applied(self, source):
        lines = source.split("\n")
        line = lines[self.line - 1]
        start = self.column - 1
        assert line[start:start + len(self.old)] == self.old, f"{self.file}:{self.line} is no longer what it was"
        lines[self.line - 1] = line[:start] + self.new + line[start + len(self.old):]
        return "\n".join(lines)


def blanked(text):
    """The text with comments, strings and characters replaced by blanks; lines and columns stay."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.DOTALL)
    return pattern.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def number_changes(token, suffix):
    body = token[:len(token) - len(suffix)]
    if body.lower().startswith("0x"):
        return [hex(int(body, 16) ^ 1) + suffix]
    if not re.fullmatch(r"\d+", body):
        value = float(body)
        changed = [value * 2, -value] if value != 0 else [1.0]
        return [repr(v) + suffix for v in changed]
    value = int(body)
    changed = {value + 1, value * 2} if "u" in suffix.lower() else {value + 1, value - 1, value * 2}
    return [str(v) + suffix for v in sorted(changed - {value})]


def line_changes(code):
    """(column from 0, kind, old, [new...]) of a line without comments and strings."""
    for found in NUMBER.finditer(code):
        before, after = code[:found.start()].rstrip(), code[found.end():]
        if re.search(r"[\w>],$", before) and re.match(r">", after) or before.endswith("<") and after.startswith(">"):
            continue  # A template argument: a size of types, not of work.
        yield found.start(), "number", found.group(), number_changes(found.group(), found.group(1))
    for found in BINARY.finditer(code):
        for kind, table in SWAPPED.items():
            if found.group() in table:
                yield found.start(), kind, found.group(), table[found.group()]
    for found in STEP.finditer(code):
        yield found.start(), "arithmetic", found.group(), SWAPPED["arithmetic"][found.group()]
    for found in WORD.finditer(code):
        if found.group() in SWAPPED_NAMES:
            yield found.start(), "name", found.group(), SWAPPED_NAMES[found.group()]
    for found in MEMBER.finditer(code):
        yield found.start(), "component", found.group(), SWIZZLES[found.group()]
    for found in NOT.finditer(code):
        yield found.start(), "negation", "!", [""]
    for found in RETURN.finditer(code):
        yield found.start(), "return", "return;", [";"]


def mutated_files(root):
    for folder in ("kernels", "host"):
        for path in sorted(pathlib.Path(root, folder).rglob("*")):
            if path.suffix in (".cl", ".h", ".cpp"):
                yield path.relative_to(root).as_posix()


def sites_of(root, file):
    """A list of alternatives, one Mutation each, for every token of the file that can be changed."""
    text = pathlib.Path(root, file).read_text()
    lines, sites = text.split("\n"), []
    for number, code in enumerate(blanked(text).split("\n"), 1):
        if SKIPPED_LINE.search(code):
            continue
        for column, kind, old, news in line_changes(code):
            sites.append([Mutation(file, number, column + 1, kind, old, new, lines[number - 1]) for new in news])
    return sites


def drawn(root, seed):
    """All sites of kernels/ and host/ in a random order that the seed fixes, with one alternative each."""
    sites = [site for file in mutated_files(root) for site in sites_of(root, file)]
    chance = random.Random(seed)
    chance.shuffle(sites)
    return [chance.choice(site) for site in sites]
