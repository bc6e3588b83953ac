"""Converts MCAP logs with Rerun, and says what does not hold: read_in_rerun.py LOG...

Exit code 0 if all is well, 1 if something is not; each finding is one line. Rerun knows Foxglove's messages in protobuf: what it
makes of a log of a run has the transforms of the arm, poses of the TCP and lines of text (of shapes in a scene it makes nothing).
"""

import pathlib
import subprocess
import sys
import tempfile

# by topic, what Rerun makes of Foxglove's messages
EXPECTED = {
    "/tf": "Transform3D",
    "/tcp": "InstancePoses3D",
    "/log": "TextLog",
}


def findings(path, rerun):
    """What does not hold in a log."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "run.rrd")
        done = subprocess.run([rerun, "mcap", "convert", path, "-o", out], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            yield f"not converted: {done.stderr.strip()}"
            return
        printed = subprocess.run([rerun, "rrd", "print", out], capture_output=True, text=True, check=True).stdout
    for topic, component in EXPECTED.items():
        lines = [line for line in printed.splitlines() if f" {topic} " in line]
        if not any(component in line for line in lines):
            yield f"{topic} has no {component}: {lines[:3]}"


def main(paths):
    found = 0
    rerun = pathlib.Path(sys.executable).with_name("rerun")
    for path in paths:
        for finding in findings(path, rerun):
            print(f"{path}: {finding}")
            found += 1
    print(f"read {len(paths)} logs with Rerun: {found} findings")
    return 1 if found or not paths else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
