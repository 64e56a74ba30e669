#!/usr/bin/env python3
"""coverage.py BUILD [FILE...]: what a test run of a --coverage build reached of src/.

Lines and branches (of every condition, both ways), by room, and the files below 80 % of either. Text in a
header counts once, however many files include it. With files of src/: their branches that no test took.
"""
import collections
import json
import pathlib
import re
import subprocess
import sys

LINES, BRANCHES = {}, collections.defaultdict(dict)  # file -> {line: count}, {(line, block, k): count}


def read(data):
    report = subprocess.run(['gcov', '--json-format', '--stdout', '--branch-probabilities', *map(str, data)],
                            capture_output=True, text=True, check=False).stdout
    for unit in report.splitlines():
        for file in json.loads(unit)['files']:
            if re.match(r'src/.*/\w+\.[ch]$', file['file']):
                add(file)


def add(file):
    lines = LINES.setdefault(file['file'], collections.Counter())
    branches = BRANCHES[file['file']]
    for line in file['lines']:
        number = line['line_number']
        lines[number] += line['count']
        for k, branch in enumerate(line['branches']):
            branches[number, k] = branches.get((number, k), 0) + branch['count']


def share(counts):
    return 100.0 * sum(1 for count in counts if count) / max(1, len(counts))


def show_rooms():
    rooms = collections.defaultdict(lambda: ([], []))
    low = []
    for file, lines in sorted(LINES.items()):
        counts = list(lines.values()), list(BRANCHES[file].values())
        for room in (pathlib.Path(file).parent.name, 'all'):
            rooms[room][0].extend(counts[0])
            rooms[room][1].extend(counts[1])
        if share(counts[0]) < 80 or len(counts[1]) and share(counts[1]) < 80:
            low.append(f'  {file}: {share(counts[0]):.0f} % of {len(counts[0])} lines, '
                       f'{share(counts[1]):.0f} % of {len(counts[1])} branches')
    rooms['all'] = rooms.pop('all')
    for room, (lines, branches) in rooms.items():
        print(f'{room:12} {share(lines):5.1f} % of {len(lines):5} lines, '
              f'{share(branches):5.1f} % of {len(branches):5} branches')
    if low:
        print('below 80 %:', *low, sep='\n')


def show_missed(file):
    text = pathlib.Path(file).read_text().splitlines()
    missed = collections.Counter(key[0] for key, count in BRANCHES[file].items() if not count)
    for number, count in sorted(missed.items()):
        reached = '' if LINES[file][number] else ', line not reached'
        print(f'{file}:{number}: {count}{reached}: {text[number - 1].strip()}')


build, files = pathlib.Path(sys.argv[1]), sys.argv[2:]
read(sorted((build / 'obj/src').glob('**/*.gcda')))
for name in files:
    show_missed(name)
if not files:
    show_rooms()
