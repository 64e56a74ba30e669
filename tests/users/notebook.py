"""Runs the cells of a notebook, one after the other. Argument: the notebook."""

import json
import sys


def main():
    names = {"__name__": "__main__"}
    with open(sys.argv[1], encoding="utf-8") as file:
        cells = json.load(file)["cells"]
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), sys.argv[1], "exec"), names)


if __name__ == "__main__":
    main()
