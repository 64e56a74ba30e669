"""The declarations are those of the headers: layout and constants against the compiler's."""

import ctypes
import os
import shutil
import subprocess
import unittest

from ambulo import _native
from ambulo._declarations import ffi
from support import TOP, Case

COMPILER = os.environ.get("CC", "cc").split()


def is_known(name):
    """Not one of the structures of which callers see pointers only."""
    try:
        return ffi.sizeof(name) > 0
    except Exception:  # of another class in each form of cffi
        return False


class Layout(Case):
    def printed(self, lines):
        """What a C program prints that prints these expressions."""
        source = self.folder / "layout.c"
        source.write_text(
            "#include <ambulo/tools/tools.h>\n#include <stddef.h>\n#include <stdio.h>\nint main(void) {\n"
            + "".join(f'  printf("%lld\\n", (long long)({line}));\n' for line in lines)
            + "  return 0;\n}\n")
        subprocess.run(COMPILER + ["-std=c11", f"-I{TOP}/include", str(source), "-o",
                                   str(self.folder / "layout")], check=True)
        out = subprocess.run([str(self.folder / "layout")], check=True, stdout=subprocess.PIPE)
        return [int(line) for line in out.stdout.split()]

    @unittest.skipUnless(shutil.which(COMPILER[0]), "no C compiler")
    def test_structures_and_constants_are_the_compilers(self):
        lines, ours, structures = [], [], 0
        for name in ffi.list_types()[0]:
            kind = ffi.typeof(name)
            if kind.kind == "enum":
                for constant, value in kind.relements.items():
                    lines.append(constant)
                    ours.append(value)
            if kind.kind != "struct" or not is_known(name):
                continue
            structures += 1
            lines.append(f"sizeof({name})")
            ours.append(ffi.sizeof(name))
            for field, about in kind.fields:
                lines += [f"offsetof({name}, {field})", f"sizeof((({name} *)0)->{field})"]
                ours += [about.offset, ffi.sizeof(about.type)]
        self.assertGreater(structures, 50)
        differ = [(line, a, b) for line, a, b in zip(lines, self.printed(lines), ours) if a != b]
        self.assertEqual(differ, [])

    def test_every_function_is_in_the_library(self):
        names = [name for name in dir(_native.lib) if name.startswith("ambulo_")]
        self.assertGreater(len(names), 100)
        for name in names:
            getattr(_native.lib, name)

    @unittest.skipUnless(shutil.which("nm"), "no nm")
    def test_every_function_of_the_library_is_declared(self):
        listed = subprocess.run(["nm", "-D", "--defined-only", _native.FOLDER / "libambulo.so"],
                                check=True, stdout=subprocess.PIPE, text=True).stdout
        exported = {line.split()[-1].split("@")[0] for line in listed.splitlines() if " T ambulo_" in line}
        self.assertGreater(len(exported), 100)
        self.assertEqual(exported - set(dir(_native.lib)), set())

    def test_pointers_are_as_wide_as_here(self):
        self.assertEqual(ffi.sizeof("void *"), ctypes.sizeof(ctypes.c_void_p))
