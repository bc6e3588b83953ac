"""Runs the programs in real numpy and writes what they give: `python expected.py` makes every .json file, `python expected.py X.py` prints one.

A program is a list of cases, one a line: statements separated by `;`, then an expression. Lines that start with `| ` before it are a block of
statements. `# sentence` at the end of a line asks for the same sentence of the exception too.
"""

import json
import pathlib
import sys
import warnings

import numpy

HERE = pathlib.Path(__file__).parent
warnings.simplefilter("ignore")
driver = {}
exec((HERE / "driver.py").read_text(), driver)


def cases(text):
    block = []
    for line in text.splitlines():
        if line.startswith("| "):
            block.append(line[2:])
        elif line.strip() and not line.startswith("#"):
            line = line.split("  # ")[0].strip()
            *statements, expression = line.split(";")
            yield "\n".join(block + [statement.strip() for statement in statements]), expression.strip()
            block = []


def expected(path):
    results = []
    for block, expression in cases(path.read_text()):
        structure, numbers, sentence = driver["run"](block, expression)
        results.append({"structure": structure, "numbers": [repr(x) for x in numbers], "sentence": sentence})
    return {"numpy": numpy.__version__, "results": results}


def lines(found):
    inner = ",\n".join(json.dumps(result) for result in found["results"])
    return '{"numpy": %s, "results": [\n%s\n]}\n' % (json.dumps(found["numpy"]), inner)


if len(sys.argv) > 1:
    print(lines(expected(pathlib.Path(sys.argv[1]))))
else:
    for path in sorted(HERE.glob("*.py")):
        if path.name not in ("driver.py", "expected.py"):
            path.with_suffix(".json").write_text(lines(expected(path)))
