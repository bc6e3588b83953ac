"""Runs the code of a notebook, cell after cell, as Jupyter does without its pictures: `run_notebook.py NOTEBOOK`.

The last expression of a cell is shown. An error says in which cell it happened.
"""

import ast
import json
import os
import pathlib
import sys

notebook = pathlib.Path(sys.argv[1])
cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
os.chdir(notebook.parent)
sys.path.insert(0, "")
sys.dont_write_bytecode = True
names = {"__name__": "__main__"}
ran = 0
for number, cell in enumerate(cells, 1):
    if cell["cell_type"] != "code":
        continue
    tree = ast.parse("".join(cell["source"]), filename=f"cell {number}")
    shown = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, f"cell {number}", "exec"), names)
    if shown is not None:
        value = eval(compile(ast.Expression(shown.value), f"cell {number}", "eval"), names)
        if value is not None:
            print(repr(value))
    ran += 1
assert ran > 0, "the notebook has no code"
print(f"{notebook.name}: {ran} cells ran")
