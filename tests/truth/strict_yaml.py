"""Reads the subset of YAML that Ambulo's files keep to: block and flow lists and mappings, plain and
quoted scalars, comments. A reader of its own, so that nothing here leans on the reader under test.
"""

import re

KEY = re.compile(r"""("[^"]*"|'[^']*'|[^\s:\[{"'][^:]*):(?:\s+(.*))?$""")
WORDS = {"true": True, "false": False, "none": None, "null": None, "~": None}


def load(path):
    with open(path, encoding="utf-8") as file:
        blocks = Blocks(lines_of(file))
    value = blocks.block(0)
    if blocks.at < len(blocks.lines):
        raise ValueError(f"{path}: what does {blocks.lines[blocks.at][1][:60]!r} mean?")
    return value


def lines_of(file):
    """(indent, text) without comments; a flow that is open goes on in the next lines."""
    lines, depth = [], 0
    for line in file:
        text, change = without_comment(line.rstrip("\n"))
        if not text.strip() or text.strip() == "---":
            continue
        if depth > 0:
            lines[-1][1] += " " + text.strip()
        else:
            lines.append([len(text) - len(text.lstrip()), text.strip()])
        depth += change
    return lines


def without_comment(line):
    """The text before a comment, and how many brackets it opens."""
    quote, depth = "", 0
    for i, c in enumerate(line):
        if quote:
            quote = "" if c == quote else quote
        elif c in "\"'" and (i == 0 or line[i - 1] in " [{,:"):
            quote = c
        elif c == "#" and (i == 0 or line[i - 1] == " "):
            return line[:i].rstrip(), depth
        else:
            depth += (c in "[{") - (c in "]}")
    return line.rstrip(), depth


class Blocks:
    def __init__(self, lines):
        self.lines, self.at = lines, 0

    def block(self, least):
        """What begins here, indented by at least so much."""
        if self.at >= len(self.lines) or self.lines[self.at][0] < least:
            return None
        indent, text = self.lines[self.at]
        if text.startswith("- ") or text == "-":
            return self.list(indent)
        if KEY.match(text):
            return self.mapping(indent)
        self.at += 1
        return flow(text)

    def list(self, indent):
        items = []
        while self.here(indent) and self.lines[self.at][1].startswith("-"):
            text = self.lines[self.at][1][1:]
            inner = indent + 1 + len(text) - len(text.lstrip())
            if KEY.match(text.strip()):
                self.lines[self.at] = [inner, text.strip()]
                items.append(self.mapping(inner))
            else:
                self.at += 1
                items.append(flow(text.strip()))
        return items

    def mapping(self, indent):
        result = {}
        while self.here(indent) and (match := KEY.match(self.lines[self.at][1])):
            self.at += 1
            key, value = match.group(1).strip("\"' "), match.group(2)
            if value:
                result[key] = flow(value)
            else:  # a list may stand as far left as its key
                inner = self.at < len(self.lines) and self.lines[self.at][1].startswith("-")
                result[key] = self.block(indent if inner else indent + 1)
        return result

    def here(self, indent):
        return self.at < len(self.lines) and self.lines[self.at][0] == indent


def flow(text):
    """A value of a block: a flow, or a scalar that may have commas."""
    if text[:1] not in tuple("[{'\""):
        return scalar(text)
    value, rest = flow_at(text.strip())
    if rest.strip():
        raise ValueError(f"what does {rest!r} behind {text[:40]!r} mean?")
    return value


def flow_at(text):
    """A value at the beginning of text, and what follows it."""
    text = text.lstrip()
    if text[:1] == "[":
        return sequence(text[1:])
    if text[:1] == "{":
        return pairs(text[1:])
    if text[:1] in ("'", '"'):
        end = text.index(text[0], 1)
        return text[1:end], text[end + 1:]
    end = re.search(r"[,\]}]|$", text).start()
    return scalar(text[:end].strip()), text[end:]


def sequence(text):
    items = []
    while (text := text.lstrip())[:1] != "]":
        value, text = flow_at(text)
        items.append(value)
        text = text.lstrip().removeprefix(",")
    return items, text[1:]


def pairs(text):
    result = {}
    while (text := text.lstrip())[:1] != "}":
        match = re.match(r"""("[^"]*"|'[^']*'|[^:,{}]+?)\s*:\s*""", text)
        result[match.group(1).strip("\"'")], text = flow_at(text[match.end():])
        text = text.lstrip().removeprefix(",")
    return result, text[1:]


def scalar(text):
    if text in WORDS:
        return WORDS[text]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text
