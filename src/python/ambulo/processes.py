"""The program ``ambulo``, which runs the cases of batches and fits in processes of its own.

It comes with the package, and is the command ``ambulo`` of the environment that the package is
installed in.
"""

import os
import sys
from pathlib import Path

from ._native import FOLDER, ffi, keep_exception, pending, take_pending, warn
from .records import from_c


def program() -> Path:
    """The program: that of the package, or what AMBULO_PROGRAM in the environment names."""
    named = os.environ.get("AMBULO_PROGRAM")
    path = Path(named) if named else FOLDER / "bin" / "ambulo"
    if not os.access(path, os.X_OK):
        raise FileNotFoundError(
            f"the program 'ambulo' is not at {path}; AMBULO_PROGRAM in the environment names another")
    return path


def main():
    """The command ``ambulo``: this process becomes the program."""
    path = os.fspath(program())
    os.execv(path, ["ambulo", *sys.argv[1:]])


class Watch:
    """What stands between the library, which asks a few times a second whether to stop, and a
    function of the caller. Ctrl-C finishes what is running, a second one stops it; so does an
    exception of the function, which is raised when the run is back.

    ``options`` become the structure that the library is given; what it points to is held here.
    """

    def __init__(self, carrier, options, progress, show, kind, interrupt):
        if interrupt not in ("keep", "raise"):
            raise ValueError(f"interrupt '{interrupt}'; expected 'keep' or 'raise'")
        options.program = os.fspath(options.program or program())
        self.interrupt, self.stop, self.shown = interrupt, 0, progress is True
        progress = show if self.shown else progress

        def watch(_, state):
            wish = progress(from_c(kind, state)) if progress else 0
            return min(2, max(self.stop, int(wish or 0)))

        self.options = carrier.new(options)
        self.options.progress = self.watch = ffi.callback(
            f"int(void *, const {kind._struct} *)", watch, error=1, onerror=self._stopped)

    def _stopped(self, kind, exception, traceback):
        is_wish = isinstance(exception, KeyboardInterrupt)
        if is_wish and (pending() is None or isinstance(pending(), KeyboardInterrupt)):
            self.stop += 1
        else:
            self.stop = 2
        keep_exception(kind, exception, traceback)

    def finish(self, call, status, left):
        """Raises what ended the run; ``left``: what can be said of a run that was interrupted."""
        if self.shown:
            sys.stderr.write("\n")
        stopped = take_pending()
        if isinstance(stopped, KeyboardInterrupt) and self.interrupt == "keep" and not status:
            warn(f"interrupted: {left}")
        elif stopped is not None:
            raise stopped
        call(status)


def print_line(text):
    """A line on standard error that is written over."""
    sys.stderr.write(f"\r{text}\033[K")
    sys.stderr.flush()


def left_of(seconds):
    return f", {seconds:.0f} s left" if seconds >= 0 else ""
