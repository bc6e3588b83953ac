"""Reads MCAP logs with the Python reader, every CRC checked, and says what does not hold: read_log.py LOG...

Exit code 0 if all is well, 1 if something is not; each finding is one line. Written without a look at the writer: from the MCAP
specification and the schemas that Foxglove and Lichtblick know. Messages in protobuf are read by the descriptors of their log, and by
Foxglove's own classes from `foxglove-schemas-protobuf`: both must know the same fields.
"""

import importlib
import json
import math
import pathlib
import sys

import jsonschema
from google.protobuf import descriptor_pb2, descriptor_pool, json_format, message_factory
from mcap.reader import NonSeekingReader, SeekingReader

SCHEMAS = {
    "/tf": "foxglove.FrameTransforms",
    "/scene": "foxglove.SceneUpdate",
    "/reference/tf": "foxglove.FrameTransforms",
    "/reference/scene": "foxglove.SceneUpdate",
    "/joint_states": "foxglove.JointStates",
    "/log": "foxglove.Log",
    "/tcp": "foxglove.PoseInFrame",
}
# positions in a log are rounded to a billionth of a metre, so are the elements of rotations; arms are metres long
TOLERANCE_M = 1e-6


def product(a, b):
    """a_from_c of a_from_b and b_from_c: each a 3x4 matrix."""
    return [
        [sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0.0) for j in range(4)]
        for i in range(3)
    ]


def matrix(p, q):
    """A pose of a message as a 3x4 matrix."""
    w, x, y, z = q["w"], q["x"], q["y"], q["z"]
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), p["x"]],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), p["y"]],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), p["z"]],
    ]


def world_from(transforms):
    """The pose of every frame in the world, by name."""
    branches = {t["child_frame_id"]: t for t in transforms}
    if len(branches) != len(transforms):
        raise ValueError("a frame hangs twice")
    poses = {"world": matrix({"x": 0, "y": 0, "z": 0}, {"w": 1, "x": 0, "y": 0, "z": 0})}

    def find(name, above=()):
        if name not in poses:
            if name not in branches or name in above:
                raise ValueError(f"frame {name} does not hang on the world")
            branch = branches[name]
            parent = find(branch["parent_frame_id"], (*above, name))
            poses[name] = product(parent, matrix(branch["translation"], branch["rotation"]))
        return poses[name]

    for name in branches:
        find(name)
    return poses


def messages_of(schema):
    """The class of a schema's messages, made from its descriptors."""
    files = descriptor_pb2.FileDescriptorSet.FromString(schema.data)
    pool = descriptor_pool.DescriptorPool()
    for file in files.file:
        pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(schema.name))


def fields_of(descriptor, seen=()):
    """Every field of a message with those of the messages in it."""
    if descriptor.full_name in seen:
        return {}
    seen = (*seen, descriptor.full_name)
    return {
        (field.name, field.number, field.type, field.is_repeated): field.message_type and fields_of(field.message_type, seen)
        for field in descriptor.fields
    }


def official(name):
    """Foxglove's own class of a message."""
    module = importlib.import_module(f"foxglove_schemas_protobuf.{name}_pb2")
    return getattr(module, name)


def content_of(message):
    """A message as JSON has it."""
    return json_format.MessageToDict(
        message,
        always_print_fields_with_no_presence=True,
        preserving_proto_field_name=True,
        use_integers_for_enums=True,
    )


def place(pose):
    return [row[3] for row in pose]


def findings(path):
    """What does not hold in a log."""
    with open(path, "rb") as file:
        summary = SeekingReader(file, validate_crcs=True).get_summary()
    if summary is None or summary.statistics is None:
        yield "no summary"
        return
    with open(path, "rb") as file:
        by_index = [(c.topic, m.log_time, m.data) for _, c, m in SeekingReader(file, validate_crcs=True).iter_messages()]
    with open(path, "rb") as file:
        reader = NonSeekingReader(file, validate_crcs=True)
        in_order = [(c.topic, m.log_time, m.data) for _, c, m in reader.iter_messages(log_time_order=False)]
    with open(path, "rb") as file:
        header = SeekingReader(file, validate_crcs=True).get_header()
    with open(path, "rb") as file:
        attachments = {a.name for a in SeekingReader(file, validate_crcs=True).iter_attachments()}
    with open(path, "rb") as file:
        facts = {m.name: m.metadata for m in SeekingReader(file, validate_crcs=True).iter_metadata()}

    if header.profile:
        yield f"profile is {header.profile!r}"
    statistics = summary.statistics
    if not len(by_index) == len(in_order) == statistics.message_count:
        yield f"{len(by_index)} messages by the index, {len(in_order)} in the file, {statistics.message_count} in the statistics"
    if statistics.chunk_count != len(summary.chunk_indexes) or (by_index and not summary.chunk_indexes):
        yield "the chunk indexes do not agree with the statistics"
    if any(later[1] < earlier[1] for earlier, later in zip(in_order, in_order[1:])):
        yield "times go back"
    if in_order[0][1] != 0:
        yield f"the log begins at {in_order[0][1]} ns"
    if missing := {"robot.toml", "lab.toml", "grade.json", "run.layout.json"} - attachments:
        yield f"not attached: {sorted(missing)}"
    if missing := {"engine", "step_s", "submission_digest", "lab_digest", "seeds"} - facts.get("kinemark", {}).keys():
        yield f"metadata lacks {sorted(missing)}"

    validators = {}
    classes = {}
    for channel in summary.channels.values():
        schema = summary.schemas.get(channel.schema_id)
        if SCHEMAS.get(channel.topic, schema.name) != schema.name:
            yield f"{channel.topic} is a {schema.name}"
        if schema.encoding == "protobuf" and channel.message_encoding == "protobuf":
            own, theirs = messages_of(schema), official(schema.name.removeprefix("foxglove."))
            if fields_of(own.DESCRIPTOR) != fields_of(theirs.DESCRIPTOR):
                yield f"{channel.topic}: its fields are not those of {schema.name}"
            classes[channel.topic] = (own, theirs)
            continue
        if schema.encoding != "jsonschema" or channel.message_encoding != "json":
            yield f"{channel.topic} is {channel.message_encoding} with a schema in {schema.encoding}"
            continue
        described = json.loads(schema.data)
        jsonschema.Draft202012Validator.check_schema(described)
        validators[channel.topic] = jsonschema.Draft202012Validator(described)
    seen = {}
    messages = {}
    for topic, time_ns, data in in_order:
        if topic in classes:
            own, theirs = (content_of(kind.FromString(data)) for kind in classes[topic])
            if own != theirs:
                yield f"{topic} at {time_ns} ns: Foxglove's own class reads another message"
            content = own
        else:
            content = json.loads(data)
        messages.setdefault(topic, []).append((time_ns, content))
        seen[topic] = seen.get(topic, 0) + 1
        # the reader of the other language validates them all; here every twentieth does
        if topic in validators and seen[topic] % 20 == 1 and (error := next(validators[topic].iter_errors(content), None)):
            yield f"{topic} at {time_ns} ns: {error.message}"

    furthest = 0.0
    first = None
    tcp = dict(messages.get("/tcp", []))
    for time_ns, content in messages.get("/tf", []):
        try:
            poses = world_from(content["transforms"])
        except ValueError as error:
            yield f"/tf at {time_ns} ns: {error}"
            return
        first = first or poses
        if poses.keys() != first.keys():
            yield f"/tf at {time_ns} ns: frames come or go"
            return
        robot = [name for name in poses if not name.startswith("body/")]
        furthest = max(furthest, *(math.dist(place(poses[name]), place(first[name])) for name in robot))
        if time_ns not in tcp:
            yield f"no /tcp at {time_ns} ns"
            return
        logged = tcp[time_ns]
        at = place(product(poses[logged["frame_id"]], matrix(logged["pose"]["position"], logged["pose"]["orientation"])))
        nearest = min(math.dist(place(poses[name]), at) for name in robot)
        if not nearest <= TOLERANCE_M:
            yield f"/tf at {time_ns} ns: the TCP is {nearest} m from every frame"
            return
    # without a command the arm stays where it is
    if len(messages.get("/tf", [])) > 1 and furthest < 0.01 and "at-rest" not in pathlib.Path(path).parts:
        yield f"nothing moves by more than {furthest} m"


def main(paths):
    found = 0
    for path in paths:
        try:
            for finding in findings(path):
                print(f"{path}: {finding}")
                found += 1
        except Exception as error:  # whatever a reader says of a file is a finding
            print(f"{path}: cannot be read: {error!r}")
            found += 1
    print(f"read {len(paths)} logs with Python: {found} findings")
    return 1 if found or not paths else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
