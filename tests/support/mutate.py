#!/usr/bin/env python3
"""mutate.py --room ROOM [--count N] [--seed N] [--only TEXT]: do the tests of a room see a mistaken change?

One fault at a time is put into a file of src/.../ROOM, in a copy of the tree, build/mutate/ROOM. What depends
on the file is rebuilt there, and the room's own tests run: tests/ROOM, and for a file of tests/untested.txt
those that it names. A test that fails, or takes ten times as long as before, kills the fault. What the
compiler refuses is no fault: another one is drawn. Survivors are listed with place and change.

tests/mutants.txt lists faults that no test can see, with the reason; they are not drawn. Neither are lines of
enumerators, constant tables and attributes, most of which are capacities, names and hints.
"""
import argparse
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

EQUIVALENT = pathlib.Path('tests/mutants.txt')
UNTESTED = pathlib.Path('tests/untested.txt')
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS='1', AMBULO=os.path.abspath('build/ambulo'))

# ---------------------------------------------------------------------------------------- faults
# name, pattern in text without comments and strings, what stands there instead (a text, or a
# function of the match that returns None where the fault makes no sense)

SWAPPED = {'<': '<=', '<=': '<', '>': '>=', '>=': '>', '==': '!=', '!=': '==', '&&': '||', '||': '&&',
           '+': '-', '-': '+', '*': '/', '/': '*', '+=': '-=', '-=': '+='}


def other_operator(match):
    return f' {SWAPPED[match[1]]} '


def other_number(match):
    text = match[0]
    if text.isdigit():
        return str(int(text) + 1)
    value = float(text)
    return repr(2.0 * value if value else 1.0)


def without_statement(match):
    return match[1] + ';' if match[2].count('(') == match[2].count(')') else None


def negated(match):
    return None if match[1].count('(') != match[1].count(')') else f'if (!({match[1]}))'


def swapped(match):
    before = match.string[match.string.rfind('\n', 0, match.start()) + 1:match.start()]
    return f'{match[2]}, {match[1]}' if before.count('(') > before.count(')') else None


FAULTS = [
    ('relation', re.compile(r' (<|<=|>|>=|==|!=) '), other_operator),
    ('logic', re.compile(r' (&&|\|\|) '), other_operator),
    ('arithmetic', re.compile(r'(?<=[\w)\]]) (\+|-|\*|/|\+=|-=) (?=[\w(])'), other_operator),
    ('constant', re.compile(r'(?<![\w.\[])(\d+\.\d+(?:e[+-]?\d+)?|\d+)(?![\w.])'), other_number),
    ('condition', re.compile(r'\bif \((.+?)\)(?= [^&|)]*(?:\{|;)?$)', re.M), negated),
    ('statement', re.compile(r'^( +)((?:[a-z_][\w.>\[\]-]* (?:[+*/-]|\|)?= |[a-z_]\w*\(|\(void\)).*);$', re.M),
     without_statement),
    ('arguments', re.compile(r'(?<=[(\s])([a-z]\w*), ([a-z]\w*)(?=[,)])'), swapped),
]


def blank(text):
    """The text with comments, strings and lines of the preprocessor blanked, of the same length."""
    hidden = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^#(?:\\\n|[^\n])*',
                        re.S | re.M)
    return hidden.sub(lambda m: re.sub(r'[^\n]', '\x01', m[0]), text)


def draw(source, text, equivalent):
    """A fault at random: (place in the text, old, new), or None."""
    code = blank(text)
    kind = random.choice(FAULTS)
    found = [match for match in kind[1].finditer(code)
             if not re.match(r'\s*(enum \{|static const|__attribute__)', code[code.rfind('\n', 0, match.start()) + 1:])]
    random.shuffle(found)
    for match in found:
        old = text[match.start():match.end()]
        new = kind[2](match)
        # what the mask hides inside a match stays as it is
        if new is None or '\x01' in new or old == new:
            continue
        fault = (match.start(), old, new)
        if (str(source), *lines_of(text, fault)) not in equivalent:
            return fault
    return None


def lines_of(text, fault):
    """The line of a fault as it was and as it is."""
    start, old, new = fault
    changed = text[:start] + new + text[start + len(old):]
    begin = text.rfind('\n', 0, start + len(old) - len(old.lstrip())) + 1
    return (text[begin:text.find('\n', start + len(old))].strip(),
            changed[begin:changed.find('\n', start + len(new))].strip())


def read_equivalent():
    """{(file, line as it was, line as it is)} of tests/mutants.txt."""
    listed = set()
    if EQUIVALENT.exists():
        for block in EQUIVALENT.read_text().split('\n\n'):
            lines = [line for line in block.splitlines() if line and line[0] != '#']
            if len(lines) == 4:  # file, - line, + line, reason
                listed.add((lines[0], lines[1][2:], lines[2][2:]))
    return listed


# ----------------------------------------------------------------------------------------- tests

def run(command, cwd, limit=None):
    """Exit status, or None past the limit in seconds."""
    process = subprocess.Popen(command, cwd=cwd, env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        return process.wait(limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        process.wait()
        return None


def make(tree, *targets):
    return run(['make', '-s', f'-j{os.cpu_count()}', *targets], tree)


def tests_of(source, room):
    """Programs and scripts, as lists of words."""
    programs = sorted(pathlib.Path('tests', room).glob('test_*.c'))
    scripts = [[str(path)] for path in sorted(pathlib.Path('tests', room).glob('run_*.sh'))]
    for line in UNTESTED.read_text().splitlines():
        if line.startswith(f'{source}: '):
            programs += map(pathlib.Path, re.findall(r'tests/\w+/test_\w+\.c', line))
            folder = re.search(r'tests/(\w+)/', line)
            if folder:
                programs += [pathlib.Path('tests', folder[1], name) for name in re.findall(r' (test_\w+\.c)', line)]
            scripts += [['tests/cli/run.sh', name] for name in re.findall(r'\b(\w+\.txt)\b', line)]
    programs = [path for path in dict.fromkeys(programs) if path.exists()]
    return [[f'build/{path.with_suffix("")}'] for path in programs] + scripts


class Timer:
    """How long each test takes without a fault; they run once, when they are first needed."""

    def __init__(self, tree):
        self.tree = tree
        self.seconds = {}

    def prepare(self, tests):
        tests = [test for test in tests if tuple(test) not in self.seconds]
        if tests and make(self.tree, 'all', *[test[0] for test in tests if test[0].startswith('build/')]):
            sys.exit('mutate: the tree does not build')
        for test in tests:
            begin = time.monotonic()
            if run(test, self.tree):
                sys.exit(f'mutate: {" ".join(test)} fails without a fault')
            self.seconds[tuple(test)] = time.monotonic() - begin


def in_order(tests, source, timer):
    """The test of the file first, then those whose names begin alike, then the shortest."""
    stem = source.stem

    def key(test):
        name = pathlib.Path(test[-1]).stem.removeprefix('test_')
        return name != stem, name.split('_')[0] != stem.split('_')[0], timer.seconds[tuple(test)]
    return sorted(tests, key=key)


def killer(tests, tree, timer):
    """The test that sees what is wrong in the tree; None if none does, '' if it does not build."""
    if make(tree, 'build/libambulo.a', 'build/ambulo'):
        return ''
    for test in tests:
        if test[0].startswith('build/') and make(tree, test[0]):
            return ''
        if run(test, tree, 10.0 + 10.0 * timer.seconds[tuple(test)]) != 0:
            return ' '.join(test)
    return None


# ------------------------------------------------------------------------------------------ tree

def copy_tree(room):
    """The tracked files and what was compiled, with their times, so that make has nothing to do."""
    tree = pathlib.Path('build/mutate', room)
    shutil.rmtree(tree, ignore_errors=True)
    names = subprocess.run(['git', 'ls-files', '-co', '--exclude-standard'], capture_output=True, text=True, check=True).stdout
    for name in names.splitlines():
        if os.path.isfile(name):
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(name, tree / name)
    shutil.copytree('build/obj', tree / 'build/obj', copy_function=shutil.copy2)
    for name in ('libambulo.a', 'libambulo.so', 'ambulo', '.found'):
        shutil.copy2(f'build/{name}', tree / 'build')
    ENVIRONMENT['AMBULO'] = str((tree / 'build/ambulo').resolve())
    return tree


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--room', required=True)
    parser.add_argument('--count', type=int, default=15)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--only', default='', help='files whose names have this text')
    options = parser.parse_args()
    sources = [path for path in sorted(pathlib.Path('src').glob(f'**/{options.room}/*.[ch]'))
               if options.only in path.name and not re.search('_avx|_scalar|_baseline', path.name)]
    if not sources:
        sys.exit(f'mutate: no files of src/.../{options.room}')
    random.seed(options.seed)
    equivalent = read_equivalent()
    tree = copy_tree(options.room)
    timer = Timer(tree)
    done, alive, tried = 0, [], set()
    for _ in range(40 * options.count):
        if done == options.count:
            break
        # a file as often as it has lines
        source = random.choices(sources, [path.stat().st_size for path in sources])[0]
        text = source.read_text()
        fault = draw(source, text, equivalent)
        if not fault or (source, fault) in tried:
            continue
        tried.add((source, fault))
        tests = tests_of(source, options.room)
        timer.prepare(tests)
        start, old, new = fault
        (tree / source).write_text(text[:start] + new + text[start + len(old):])
        begin = time.monotonic()
        seen = killer(in_order(tests, source, timer), tree, timer)
        (tree / source).write_text(text)
        if seen == '':
            continue
        done += 1
        line = text.count('\n', 0, start + len(old) - len(old.lstrip())) + 1
        was, now = lines_of(text, fault)
        report = f'{source}:{line}\n  - {was}\n  + {now}'
        if seen is None:
            alive.append(report)
        print(f'{"killed  " if seen else "SURVIVED"} {report}\n  {seen or "no test"}, {time.monotonic() - begin:.0f} s',
              flush=True)
    if alive:
        print('\nsurvivors:\n' + '\n'.join(alive))
    print(f'{options.room}: {done - len(alive)} of {done} killed (seed {options.seed})')
    sys.exit(1 if alive else 0)


main()
