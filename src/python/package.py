"""The Python package: put together from src/python, the headers and the built library, and wheels.

    python3 package.py stage LIBRARY FOLDER     FOLDER/ambulo, to be used by PYTHONPATH
    python3 package.py wheel LIBRARY FOLDER     a wheel in FOLDER

The program `ambulo` beside LIBRARY goes along: it runs the cases of batches and fits. The wheel holds no compiled Python module (cffi opens the library at run time), so one serves every
Python 3 of its platform: py3-none-PLATFORM. NLopt, libyaml and the LAPACK are those of the system,
unless auditwheel and patchelf are there: then they go into the wheel, and its platform is the oldest
manylinux that it runs on (`make wheel` first links for an old one: .setup/old_glibc.sh). AMBULO_WHEEL=system keeps to the system's all the same.

Reading order: package.py, generate.py; ambulo/_native.py, ambulo/errors.py, ambulo/records.py,
ambulo/model.py, ambulo/mechanics.py, ambulo/problem.py, ambulo/callbacks.py, ambulo/motion.py,
ambulo/solving.py, ambulo/result.py; ambulo/files.py, ambulo/tables.py, ambulo/plots.py;
ambulo/processes.py, ambulo/batch.py, ambulo/fit.py.

The module is a build backend too (PEP 517): `pip install src/python` runs make first.
Python's standard library and cffi are all it takes.
"""

import base64
import hashlib
import os
import re
import shutil
import stat
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent
REQUIRES = ["cffi>=1.15", "numpy>=1.21"]
EXTRAS = {"tables": ["pandas"], "plots": ["matplotlib>=3.6"]}


def version():
    text = (TOP / "include" / "ambulo" / "ambulo.h").read_text()
    return re.search(r'AMBULO_VERSION_STRING "(.*)"', text).group(1)


# -------------------------------------------------------------------- staging


def stage(library, folder):
    """Writes FOLDER/ambulo afresh; files that stay the same keep their time."""
    sys.path.insert(0, str(HERE))
    import generate

    package = Path(folder, "ambulo")
    fresh = Path(folder, "ambulo.new")
    shutil.rmtree(fresh, ignore_errors=True)
    shutil.copytree(HERE / "ambulo", fresh, ignore=shutil.ignore_patterns("__pycache__"))
    generate.generate(TOP / "include", fresh)
    shutil.copy2(library, fresh / "libambulo.so")  # of this name on macOS, too: cffi asks for no other
    (fresh / "bin").mkdir()
    shutil.copy2(Path(library).with_name("ambulo"), fresh / "bin" / "ambulo")
    for source in sorted((TOP / "models").rglob("*")):
        if source.suffix in (".yaml", ".csv", ".md"):
            target = fresh / "models" / source.relative_to(TOP / "models")
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, target)
    shutil.rmtree(package, ignore_errors=True)
    fresh.rename(package)


# --------------------------------------------------------------------- wheels


def metadata():
    lines = [
        "Metadata-Version: 2.1", "Name: ambulo", f"Version: {version()}",
        "Summary: prediction of human motion by optimization", "License: MIT",
        "Requires-Python: >=3.9",
    ]
    lines += [f"Requires-Dist: {need}" for need in REQUIRES]
    for extra, needs in EXTRAS.items():
        lines += [f"Provides-Extra: {extra}"]
        lines += [f'Requires-Dist: {need}; extra == "{extra}"' for need in needs]
    lines += ["Description-Content-Type: text/markdown", ""]
    return "\n".join(lines) + "\n" + (TOP / "docs" / "guide-python.md").read_text()


def record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}"


def write_wheel(library, folder):
    """A wheel with the system's libraries; returns its path. The same bytes from the same files."""
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"ambulo-{version()}-py3-none-{platform}.whl"
    info = f"ambulo-{version()}.dist-info"
    with tempfile.TemporaryDirectory() as scratch:
        stage(library, scratch)
        strip(Path(scratch, "ambulo", "libambulo.so"))
        strip(Path(scratch, "ambulo", "bin", "ambulo"))
        files = {str(file.relative_to(scratch)): file.read_bytes()
                 for file in sorted(Path(scratch).rglob("*")) if file.is_file()}
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: ambulo\nRoot-Is-Purelib: false\n"
                              f"Tag: py3-none-{platform}\n").encode()
    files[f"{info}/entry_points.txt"] = b"[console_scripts]\nambulo = ambulo.processes:main\n"
    if sys.platform != "darwin":  # read by readelf; where PEP 770 looks for it
        files[f"{info}/sboms/ambulo.cdx.json"] = subprocess.run(
            [sys.executable, str(TOP / ".setup" / "sbom.py"), str(Path(library).with_name("ambulo"))],
            check=True, stdout=subprocess.PIPE).stdout
    files[f"{info}/LICENSE"] = (TOP / "LICENSE").read_bytes()
    lines = [record_line(name, data) for name, data in files.items()] + [f"{info}/RECORD,,"]
    files[f"{info}/RECORD"] = ("\n".join(lines) + "\n").encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            # pip keeps programs executable where they are said to be regular files
            mode = 0o755 if name.endswith((".so", "/bin/ambulo")) else 0o644
            entry.external_attr = (stat.S_IFREG | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return path


def strip(binary):
    """Leaves debugging information out: five sixths of the file. That of macOS stays in the objects."""
    if shutil.which("strip") and sys.platform != "darwin":
        subprocess.run(["strip", "--strip-unneeded", str(binary)], check=True)


def bundle(wheel, folder):
    """The wheel with NLopt, libyaml and the LAPACK inside; None where that cannot be done here."""
    if os.environ.get("AMBULO_WHEEL") == "system":
        return None
    if not (shutil.which("auditwheel") and shutil.which("patchelf")):
        return None
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run(["auditwheel", "repair", "-w", scratch, str(wheel)],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        found = list(Path(scratch).glob("*.whl"))
        if done.returncode or not found:
            print(f"auditwheel cannot bundle the libraries: {done.stdout.strip()[-300:]}")
            return None
        target = Path(folder, found[0].name)
        shutil.copy2(found[0], target)
    wheel.unlink()
    return target


def make_wheel(library, folder):
    os.umask(0o022)  # the same modes and times for everyone; zip knows none before 1980
    os.environ.setdefault("SOURCE_DATE_EPOCH", "315532800")
    wheel = write_wheel(library, folder)
    bundled = bundle(wheel, folder)
    print(f"{bundled or wheel}")
    print("NLopt, libyaml and the LAPACK are in the wheel" if bundled else
          "NLopt, libyaml and the LAPACK are the system's (auditwheel and patchelf would put them "
          "into the wheel)")
    return bundled or wheel


# ---------------------------------------------------------- build backend (PEP 517)


def get_requires_for_build_wheel(config_settings=None):
    return ["cffi>=1.15"]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    library = "build/libambulo.dylib" if sys.platform == "darwin" else "build/libambulo.so"
    subprocess.run(["make", "-C", str(TOP), library, "build/ambulo"], check=True)
    return make_wheel(TOP / library, wheel_directory).name


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in ("stage", "wheel"):
        raise SystemExit(__doc__)
    (stage if sys.argv[1] == "stage" else make_wheel)(sys.argv[2], sys.argv[3])
