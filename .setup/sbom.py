#!/usr/bin/env python3
"""What a build links and bundles, with versions and licences, as CycloneDX 1.5 (JSON): `make sbom`.

    sbom.py PROGRAM [FILE]     PROGRAM: the built ambulo; to FILE, or the standard output

Shared libraries are those that PROGRAM asks for; one that LIBRARIES does not know is an error, so that
nothing comes in without its licence. The page of `ambulo report` bundles the npm packages of
src/show/viewer/package.json. No time and no random number: the same build, the same bytes.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
# soname begins with: name, licence, package of pkg-config
LIBRARIES = {
    "libnlopt": ("nlopt", "MIT AND LGPL-2.1-or-later AND BSD-3-Clause", "nlopt"),
    "libyaml": ("libyaml", "MIT", "yaml-0.1"),
    "libopenblas": ("openblas", "BSD-3-Clause", "openblas"),
    "libscipy_openblas": ("openblas", "BSD-3-Clause AND GPL-3.0-or-later WITH GCC-exception-3.1", None),
    "liblapack": ("lapack", "BSD-3-Clause", "lapack"),
    "libblas": ("blas", "BSD-3-Clause", "blas"),
    "libexpat": ("expat", "MIT", "expat"),
    "libz": ("zlib", "Zlib", "zlib"),
}
ALWAYS = ["libyaml", "libexpat", "libz"]  # within the program where it does not ask for them
SYSTEM = ("libc.", "libm.", "libpthread.", "libdl.", "librt.", "ld-linux", "libgcc_s.", "libstdc++.")
PAGE = {"three": "MIT", "uplot": "MIT", "fflate": "MIT"}


def output(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def component(name, version, licence, how, kind="library", purl=None):
    made = {"type": kind, "name": name, "licenses": [{"expression": licence}],
            "properties": [{"name": "ambulo:use", "value": how}]}
    if version:
        made["version"] = version
    if purl:
        made["purl"] = purl
    return made


def libraries(program):
    needed = re.findall(r"NEEDED.*\[(.*)\]", output("readelf", "-dW", str(program)))
    if not needed:
        raise SystemExit(f"sbom.py: {program}: its libraries could not be read (readelf)")
    told = output(str(program), "--version")
    found = {}
    for name in needed:
        if name.startswith(SYSTEM):
            continue
        known = [key for key in LIBRARIES if re.match(re.escape(key) + r"[-.]", name)]
        if not known:
            raise SystemExit(f"sbom.py: {name}: no licence is known; add it to LIBRARIES")
        found[known[0]] = "shared"
    for key in ALWAYS:
        found.setdefault(key, "static")
    for key in sorted(found):
        name, licence, package = LIBRARIES[key]
        version = re.search(rf"\b{name} ([0-9][0-9.]*)", told, re.IGNORECASE)
        yield component(name, version.group(1) if version else package and output("pkg-config", "--modversion", package),
                        licence, found[key])


def page():
    packages = json.loads((TOP / "src/show/viewer/package.json").read_text())["dependencies"]
    for name, version in sorted(packages.items()):
        if name not in PAGE:
            raise SystemExit(f"sbom.py: npm package {name}: no licence is known; add it to PAGE")
        yield component(name, version, PAGE[name], "bundled in the page of ambulo report",
                        purl=f"pkg:npm/{name}@{version}")


def bill(program):
    header = (TOP / "include/ambulo/ambulo.h").read_text()
    version = re.search(r'AMBULO_VERSION_STRING "(.*)"', header).group(1)
    return {
        "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
        "metadata": {"component": {"type": "application", "name": "ambulo", "version": version,
                                   "licenses": [{"expression": "MIT"}]}},
        "components": [*libraries(program), *page(),
                       component("models/norms/young_adults.csv", None, "CC-BY-4.0", "data", "data")],
    }


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        raise SystemExit(__doc__)
    text = json.dumps(bill(Path(sys.argv[1])), indent=1, sort_keys=True) + "\n"
    if len(sys.argv) == 3:
        Path(sys.argv[2]).parent.mkdir(parents=True, exist_ok=True)
        Path(sys.argv[2]).write_text(text)
    else:
        sys.stdout.write(text)
