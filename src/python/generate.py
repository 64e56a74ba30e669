"""The parts of the package that follow from the headers: written anew with every build.

    _declarations.py   what cffi has to know of the C interface (out-of-line ABI mode)
    _records.py        one Python class for each public structure and enumeration, with the
                       comments of the headers as docstrings and with type hints

Nothing of the interface is written down a second time, so nothing can drift: the declarations are
the headers as the compiler's own preprocessor gives them, and the records are made from what cffi
read in those. tests/python/test_layout.py compares sizes and offsets with the compiler's.

    python3 generate.py INCLUDE FOLDER      headers in INCLUDE/ambulo; environment: CC
"""

import contextlib
import io
import keyword
import os
import re
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

# Structures that Python code never holds: callbacks' views, arrays of outputs, the allocator.
INTERNAL = {
    "ambulo_allocator", "ambulo_node_state", "ambulo_node_gradient", "ambulo_motion",
    "ambulo_jacobians", "ambulo_output_weights", "ambulo_motion_gradient", "ambulo_outputs",
    "ambulo_point_motion", "ambulo_inverse_outputs", "ambulo_problem_text", "ambulo_muscle",
    "ambulo_muscle_pull", "ambulo_muscles_definition", "ambulo_sharing_states",
    "ambulo_sharing_outputs", "ambulo_muscle_values",
}

# Arrays of doubles that come without a count: their shapes. d: coordinates; feet: of the model;
# devices, nodes, knots: of the problem; marks: of the same term; a field of the same record by its name.
SHAPES = {
    ("ambulo_term", "scale"): ("d",),
    ("ambulo_term", "offset"): ("d",),
    ("ambulo_term", "passive"): ("d", 4),
    ("ambulo_term", "strength"): ("d", 2, 3),
    ("ambulo_term", "price"): ("d", 2),
    ("ambulo_term", "tendon"): ("d",),
    ("ambulo_term", "device_scale"): ("devices",),
    ("ambulo_term", "reference"): ("nodes", "d"),
    ("ambulo_term", "mark_scale"): ("marks",),
    ("ambulo_term", "mark_reference"): ("nodes", "marks", 3),
    ("ambulo_term", "foot_scale"): ("feet",),
    ("ambulo_term", "foot_reference"): ("nodes", "feet", 3),
    ("ambulo_tube", "reference"): ("samples", "d"),
    ("ambulo_tube", "half_width"): ("d",),
    ("ambulo_problem_definition", "node_times"): ("nodes",),
    ("ambulo_problem_definition", "breakpoints"): ("knots",),
}

# What the package fills by itself.
OWN = {
    ("ambulo_options", "progress"), ("ambulo_options", "multipliers"), ("ambulo_progress", "point"),
    ("ambulo_solver_state", "x"), ("ambulo_parameters", "problem_at"),
    ("ambulo_parameters", "start"), ("ambulo_report_options", "sensitivities"),
    ("ambulo_report_options", "muscles"),
    ("ambulo_batch_options", "progress"), ("ambulo_fit_options", "progress"),
    ("ambulo_film_options", "progress"),
    ("ambulo_export_options", "inverse"), ("ambulo_export_options", "problem"),
}

# Numbers that stand for something of the model and may be given by its name.
NAMED = {
    "coordinate": "coordinate", "link": "link", "load_link": "link", "parent": "link",
    "point": "point", "about": "point", "heel": "point", "toe": "point", "heel_center": "point",
    "toe_center": "point", "tip": "point", "arc": "point", "foot": "foot", "first_foot": "foot",
    "patch": "patch", "hand": "point", "marks": "point", "one": "capsule", "other": "capsule", "capsules": "capsule",
}
MIRRORED = {
    "ambulo_coordinate": "coordinate", "ambulo_foot": "foot", "ambulo_patch": "patch",
    "ambulo_capsule": "capsule",
}


def preprocessed(include):
    """The headers as C without directives, attributes and system headers."""
    with tempfile.TemporaryDirectory() as empty:
        Path(empty, "stddef.h").write_text("")  # size_t is known to cffi
        Path(empty, "math.h").write_text("")
        command = os.environ.get("CC", "cc").split() + [
            "-E", "-P", "-undef", "-nostdinc", "-DAMBULO_DECLARATIONS_ONLY", "-I" + empty, "-I" + str(include),
            str(Path(include, "ambulo", "tools", "tools.h")),
        ]
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def write_declarations(text, folder):
    import cffi

    ffi = cffi.FFI()
    ffi.cdef(text)
    ffi.set_source("ambulo._declarations", None)
    with contextlib.redirect_stdout(io.StringIO()):  # it says where it writes
        ffi.emit_python_code(str(Path(folder, "_declarations.py")))
    return ffi


# ------------------------------------------------------------------ comments


def plain(comment):
    """A C comment as text in one paragraph; nothing of a heading."""
    text = re.sub(r"^/\*+|\*/$", "", comment.strip())
    if "-----" in text:
        return ""
    return " ".join(re.sub(r"^\s*\*? ?", "", line).strip() for line in text.splitlines()).strip()


def field_comments(body):
    """{field: comment}: what stands behind a declaration, or in a comment of its own before it."""
    found, before, last, end = {}, "", [], 0
    for match in re.finditer(r"/\*.*?\*/|[^;/]+;", body, re.S):
        piece = match.group()
        if not piece.startswith("/*"):
            last = re.findall(r"(\w+)\s*(?:\[\w+\])*\s*(?=[,;)])", piece)
            for name in last:
                found[name] = before
            before, end = "", match.end()
        elif "\n" in body[end:match.start()] or not last:
            before = plain(piece)
        else:
            for name in last:
                found[name] = (found[name] + " " + plain(piece)).strip()
    return found


def member_statements(body):
    """The members of an enumeration as if they were declarations."""
    parts = re.split(r"(/\*.*?\*/)", body, flags=re.S)
    last = max((i for i, part in enumerate(parts) if re.search(r"\w", part)
                and not part.startswith("/*")), default=-1)
    for i, part in enumerate(parts):
        if not part.startswith("/*"):
            part = re.sub(r"\s*=\s*-?\d+", "", part).replace(",", ";")
            parts[i] = part.rstrip() + ";" + part[len(part.rstrip()):] if i == last else part
    return "".join(parts)


def header_comments(include):
    """{structure or enumeration: (comment above, {member: comment})}"""
    known = {}
    pattern = re.compile(
        r"(/\*(?:(?!\*/).)*\*/\s*\n)?typedef (?:struct|enum) (\w+) \{(.*?)\n?\} \2;", re.S)
    for header in sorted(Path(include, "ambulo").rglob("*.h")):
        for match in pattern.finditer(header.read_text()):
            above = plain(match.group(1)) if match.group(1) else ""
            body = match.group(3)
            if match.group().rpartition("typedef ")[2].startswith("enum"):
                body = member_statements(body)
            known[match.group(2)] = (above, field_comments(body))
    return known


# -------------------------------------------------------------------- fields


def class_name(c_name):
    name = re.sub(r"^(struct|enum) ", "", c_name).removeprefix("ambulo_")
    return "".join(part.capitalize() for part in name.split("_"))


def python_name(name):
    return name + "_" if keyword.iskeyword(name) else name


def count_of(name, names):
    """The field that counts the items of the array `name`; None: there is none."""
    single = {"feet": "foot", "patches": "patch", "reaches": "reach", "families": "family",
              "items": "", "contradictory": "contradictory"}.get(name, name.removesuffix("s"))
    count = single + "_count" if single else "count"
    return count if count in names else None


def pointer_spec(struct, name, item, names):
    count = count_of(name, names)
    if (struct, name) in SHAPES:
        return ("numbers", SHAPES[struct, name])
    if item.kind == "primitive" and item.cname == "char":
        return ("text",)
    if item.kind == "pointer" and item.item.cname == "char" and count:
        return ("texts", count)
    if item.kind == "struct" and item.cname.removeprefix("struct ") and count:
        return ("records", class_name(item.cname), count)
    if item.cname == "int" and count:
        return ("ints", count)
    if item.kind == "array" and item.item.cname == "double" and count:
        return ("table", item.length, count)
    return None


def array_spec(kind):
    shape = []
    while kind.kind == "array":
        shape.append(kind.length)
        kind = kind.item
    if kind.kind == "struct":
        return ("array", "record", class_name(kind.cname), tuple(shape))
    if kind.cname == "char":
        return ("characters",)
    return ("array", {"double": "float", "int": "int"}[kind.cname], None, tuple(shape))


def spec_of(struct, name, kind, names):
    """How a field is carried over; None: it is none of Python's business."""
    is_size = kind.kind == "primitive" and kind.cname in ("size_t", "unsigned long")
    if name == "user" or (is_size and (name == "size" or name.endswith("_size"))):
        return None
    if name == "count" or name.endswith("_count"):
        return ("count",) if not any(count_of(other, names) == name for other in names) else None
    is_object = kind.kind == "pointer" and kind.item.kind == "struct" and not kind.item.fields
    if (struct, name) in OWN or is_object:
        return None
    if kind.kind == "function":
        return ("function",)
    if kind.kind == "pointer":
        found = pointer_spec(struct, name, kind.item, names)
        if not found:
            raise SystemExit(f"generate.py: {struct}.{name} is a pointer without a count: add its "
                             f"shape to SHAPES")
        return found
    if kind.kind == "enum":
        return ("enum", class_name(kind.cname))
    if kind.kind == "struct":
        return ("record", class_name(kind.cname))
    if kind.kind == "array":
        return array_spec(kind)
    return ("float",) if kind.cname in ("double", "float") else ("int",)


def fields_of(ffi, struct):
    fields = ffi.typeof(struct).fields
    names = [name for name, _ in fields]
    result = []
    for name, field in fields:
        spec = spec_of(struct, name, field.type, names)
        if spec:
            named = MIRRORED.get(struct) if name == "mirror" else NAMED.get(name)
            result.append((name, ("int",) if spec == ("count",) else spec,
                           named if spec[0] in ("int", "ints", "array") and named else None))
    return result


# --------------------------------------------------------------------- hints

HINTS = {"text": "Optional[str]", "characters": "str", "int": "int", "float": "float",
         "texts": "Sequence[str]", "ints": "Sequence[int]", "numbers": "Optional[ArrayLike]",
         "table": "ArrayLike", "function": "Optional[Callable[..., Any]]"}


def hint(spec, named):
    kind = spec[0]
    if kind == "enum":
        return f'Union["{spec[1]}", str]'
    if kind == "record":
        return f'"{spec[1]}"'
    if kind == "records":
        return f'Sequence["{spec[1]}"]'
    if kind == "array":
        item = f'"{spec[2]}"' if spec[1] == "record" else spec[1]
        return "Union[Sequence[Any], ArrayLike]" if len(spec[3]) > 1 else (
            "Sequence[Union[int, str]]" if named else f"Sequence[{item}]")
    return "Union[int, str]" if kind == "int" and named else HINTS[kind]


def shape_text(spec):
    if spec[0] == "numbers":
        return "array [" + "][".join(str(s) for s in spec[1]) + "]"
    if spec[0] == "array":
        return "[" + "][".join(str(s) for s in spec[3]) + "]"
    return ""


def sentence(text):
    return text[:1].upper() + text[1:] if text else text


def in_python(text, constants):
    """A comment of C in the words of Python."""
    text = re.sub(r"\bNULL\b", "None", text)
    return re.sub(r"\bAMBULO_\w+", lambda m: constants.get(m.group(), m.group()), text)


def wrapped(text, first, later):
    return textwrap.wrap(text, 96, initial_indent=first, subsequent_indent=later,
                         break_long_words=False, break_on_hyphens=False) or [first.rstrip()]


def class_text(struct, fields, comments):
    above, by_field = comments.get(struct, ("", {}))
    lines = [f"class {class_name(struct)}(Record):"]
    lines += wrapped('"""' + (sentence(above) or f"``{struct}`` of the C interface."), " " * 4,
                     " " * 4) + [""]
    for name, spec, named in fields:
        said = by_field.get(name, "")
        about = [part for part in ("" if said[:1] == "[" else shape_text(spec), said) if part]
        if named:
            about.append(f"a number, or the name of a {named}")
        lines += wrapped(f"{python_name(name)}: {'; '.join(about)}".rstrip(" :"), " " * 4, " " * 8)
    lines += ['    """', "", f'    _struct = "{struct}"', "    _fields = {"]
    for name, spec, named in fields:
        lines.append(f'        "{python_name(name)}": ("{name}", {spec!r}, {named!r}),')
    lines.append("    }")
    lines += [f"    {python_name(name)}: {hint(spec, named)}" for name, spec, named in fields]
    return "\n".join(line.replace("\\", "\\\\") for line in lines) + "\n"


# -------------------------------------------------------------- enumerations


def members_of(ffi, enum):
    """[(name in Python, value, name in C)]: the constants without what all of them begin with"""
    by_value = sorted((value, name) for name, value in ffi.typeof(enum).relements.items())
    words = [name.split("_") for _, name in by_value if not name.endswith("_NOT_SET")]
    shared = 1
    while len(words) > 1 and all(len(w) > shared + 1 and w[shared] == words[0][shared]
                                 for w in words):
        shared += 1
    return [("NOT_SET" if name.endswith("_NOT_SET") else "_".join(name.split("_")[shared:]), value,
             name) for value, name in by_value]


def enum_text(ffi, enum, comments):
    above, by_member = comments.get(enum, ("", {}))
    lines = [f"class {class_name(enum)}(Enumeration):"]
    lines += wrapped('"""' + (sentence(above) or f"``{enum}`` of the C interface."), " " * 4,
                     " " * 4)
    members = members_of(ffi, enum)
    told = {name: by_member[c_name] for name, _, c_name in members if by_member.get(c_name)}
    lines += [""] * bool(told)
    for name, said in told.items():
        lines += wrapped(f"{name.lower()}: {said}", " " * 4, " " * 8)
    lines += ['    """', ""] + [f"    {name} = {value}" for name, value, _ in members]
    return "\n".join(lines) + "\n"


def is_known(ffi, struct):
    """Not one of the structures of which callers see pointers only."""
    try:
        return ffi.sizeof(struct) > 0
    except Exception:  # of another class in each form of cffi
        return False


def write_records(ffi, comments, folder):
    structs, enums = [], []
    for name in ffi._parser._declarations:
        kind, _, c_name = name.partition(" ")
        if kind != "typedef" or not c_name.startswith("ambulo_"):
            continue
        typed = ffi.typeof(c_name)
        if typed.kind == "enum":
            enums.append(c_name)
        elif typed.kind == "struct" and is_known(ffi, c_name) and c_name not in INTERNAL:
            structs.append(c_name)
    parts = ['"""Structures and enumerations of the C interface; made by generate.py."""\n\n'
             "from typing import Any, Callable, Optional, Sequence, Union\n\n"
             "from numpy.typing import ArrayLike\n\n"
             "from .records import Enumeration, Record\n"]
    parts += [enum_text(ffi, name, comments) for name in enums]
    parts += [class_text(name, fields_of(ffi, name), comments) for name in structs]
    names = [class_name(name) for name in enums + structs]
    constants = {"AMBULO_OFF": "nan (or None)"}
    constants.update({c_name: name.lower() for enum in enums for name, _, c_name in members_of(ffi, enum)})
    parts = [in_python(part, constants) for part in parts]
    parts.append("__all__ = [\n" + "".join(f'    "{name}",\n' for name in sorted(names)) + "]\n")
    Path(folder, "_records.py").write_text("\n\n".join(parts))


def generate(include, folder):
    ffi = write_declarations(preprocessed(include), folder)
    write_records(ffi, header_comments(include), folder)


if __name__ == "__main__":
    generate(sys.argv[1], sys.argv[2])
