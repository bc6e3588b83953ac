"""Kinemark from Python: a robot to ask, and a report to read. The standard library is all it needs.

    with Robot("rrbot") as robot:
        pose = robot.ask("fk", q=[0.3, -1.2], **{"in": "lab"})
    report = Report("out")
    print(report.points, report.lost())

Every request and answer of a robot is in docs/robot-eval.md, every field of a grade in docs/grade-format.md.
"""

import csv
import io
import json
import os
import pathlib
import subprocess

PROGRAM = os.environ.get("KINEMARK", "kinemark")


class Robot:
    """A robot file, a URDF, the name of a robot of the labs, or a row of joints such as `RzTxRy`."""

    def __init__(self, robot, *options):
        command = [PROGRAM, "robot", "eval", robot, *options]
        self._eval = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, op, **fields):
        """The answer to one request, such as `ask("ik", target={"position_m": [3.5, -0.5, 0.05]})`; ValueError where it is refused."""
        self._eval.stdin.write(json.dumps({"op": op, **fields}) + "\n")
        self._eval.stdin.flush()
        line = self._eval.stdout.readline()
        if not line:
            raise ValueError("kinemark has ended: its message is above")
        answer = json.loads(line)
        if "error" in answer:
            raise ValueError(answer["error"])
        return answer

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._eval.stdin.close()
        self._eval.wait()
        self._eval.stdout.close()


class Report:
    """The folder that `kinemark grade` wrote."""

    def __init__(self, folder="out"):
        self.folder = pathlib.Path(folder)
        self.grade = json.loads((self.folder / "grade.json").read_text(encoding="utf-8"))

    @property
    def points(self):
        """Points, and how many there are."""
        return self.grade["points"], self.grade["max_points"]

    def lost(self):
        """Every check that lost points: the task, the check, points, and what was found."""
        for task in self.grade["tasks"]:
            for check in task["checks"]:
                if check["points"] < check["max_points"]:
                    found = [fact["message"] for fact in check.get("evidence", [])]
                    yield task["name"], check["name"], check["points"] - check["max_points"], found

    def signals(self, task, topic="/signals"):
        """What the log of a task has at each moment: columns by their names."""
        log = self.folder / task / "run.mcap"
        command = [PROGRAM, "log", "export", str(log), "--csv", "--topic", topic]
        table = subprocess.run(command, check=True, capture_output=True, text=True, encoding="utf-8").stdout
        rows = list(csv.DictReader(io.StringIO(table)))
        return {name: [_number(row[name]) for row in rows] for name in rows[0]} if rows else {}


def _number(text):
    try:
        return float(text)
    except ValueError:
        return text


def grade(lab, submission, out="out", *options):
    """Grades a submission and reads the report; lost points are no error, a broken lab or command is."""
    done = subprocess.run([PROGRAM, "grade", lab, str(submission), "--out", str(out), *options], stdout=subprocess.DEVNULL)
    if done.returncode > 1:
        raise RuntimeError(f"kinemark grade ended with code {done.returncode}")
    return Report(out)
