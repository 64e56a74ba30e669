"""What Python adds to a solve.

    python3 src/python/package.py stage build/libambulo.so build/python
    PYTHONPATH=build/python OPENBLAS_NUM_THREADS=1 python3 bench/python.py
    PYTHONPATH=build/python OPENBLAS_NUM_THREADS=1 python3 bench/python.py instructions

Each line sets Problem.solve() (with its options, its callback that looks for Ctrl-C, its result)
beside ambulo_solve() called through cffi with nothing around it. First by processor time, in turns in
one process, the least of each; with the argument by instructions, counted by valgrind's callgrind:
two solves less one, each in a process of its own.
"""

import os
import re
import subprocess
import sys
import time

import ambulo
from ambulo._native import ffi, lib

TURNS = 15
CASES = ("two_link_reach", "yardstick_12", "walk_normal")


def bare(problem):
    out = ffi.new("ambulo_result **")
    assert not lib.ambulo_solve(problem._pointer, ffi.NULL, ffi.NULL, ffi.NULL, ffi.NULL, out)
    lib.ambulo_result_free(out[0])


def whole(problem):
    problem.solve()


def told(problem):
    problem.solve(progress=lambda now: False)


def seconds(function, problem):
    begin = time.process_time()
    function(problem)
    return time.process_time() - begin


def power_squared(state, gradient):
    power = state.tau * state.qd
    if gradient is not None:
        gradient.tau += 2 * power * state.qd
        gradient.qd += 2 * power * state.tau
    return float(power @ power)


def by_time():
    for name in CASES:
        with ambulo.Problem.load(ambulo.MODELS / f"{name}.yaml") as problem:
            least = [1e9] * 3
            for _ in range(TURNS):
                for i, function in enumerate((bare, whole, told)):
                    least[i] = min(least[i], seconds(function, problem))
            print(f"{name}: {1e3 * least[0]:.2f} ms bare; solve() {least[1] / least[0] - 1:+.2%}, "
                  f"with a progress function {least[2] / least[0] - 1:+.2%}")
    calls = [0]

    def counted(state, gradient):
        calls[0] += 1
        return power_squared(state, gradient)

    with ambulo.Problem.load(ambulo.MODELS / "walk_normal.yaml") as problem:
        own = problem.extend(terms=[ambulo.Term("user_term", function=counted, weight=1e-9)])
        with_term, without = seconds(whole, own), seconds(whole, problem)
        print(f"a term in Python on walk_normal: {calls[0]} calls, {with_term:.2f} s instead of "
              f"{without:.2f} s, {1e6 * (with_term - without) / calls[0]:.1f} us a call")


def instructions(name, which, times):
    code = (f"import sys; sys.path.insert(0, 'bench'); import python as b; import ambulo\n"
            f"p = ambulo.Problem.load(ambulo.MODELS / '{name}.yaml')\n"
            f"for _ in range({times}): b.{which}(p)\n")
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                           sys.executable, "-c", code], stderr=subprocess.PIPE, text=True,
                          check=True, env=dict(os.environ, PYTHONHASHSEED="0"))
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


def by_instructions():
    for name in CASES:
        cost = {which: instructions(name, which, 2) - instructions(name, which, 1)
                for which in ("bare", "whole", "told")}
        print(f"{name}: {cost['bare'] / 1e6:.1f} million instructions bare; solve() "
              f"{cost['whole'] / cost['bare'] - 1:+.2%}, with a progress function "
              f"{cost['told'] / cost['bare'] - 1:+.2%}")


if __name__ == "__main__":
    by_instructions() if "instructions" in sys.argv else by_time()
