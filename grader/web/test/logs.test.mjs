// Every log, read by an implementation that is not ours: whole, indexed, valid by its schemas, and fit to be replayed from /tf alone.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import foxglove from "@foxglove/schemas/jsonschema.js";
import Ajv from "ajv";
import { courseLabs, grade, hardLabs, logsOf, reports, root } from "./graded.mjs";
import { composed, distance, framesInWorld, inverse, log, poseOf, records } from "./log.mjs";

const folder = reports();
const logs = [...courseLabs, ...hardLabs].flatMap((lab) => logsOf(join(folder, lab)).map((one) => ({ ...one, lab, report: join(folder, lab) })));
const each = (title, check) => {
  for (const one of logs) test(`${one.lab}, ${one.task}: ${title}`, () => check(one));
};

// where they are not those of the course's arm
const joints = { humanoid: 25, "05-rppr": 4, "06-typed-robots": 3 };
const steps = { "05-rppr": 0.002 };

test("every lab has logs", () => {
  for (const lab of [...courseLabs, ...hardLabs]) assert.ok(logs.some((one) => one.lab === lab), lab);
});

each("the summary agrees with what is in the file", async ({ path }) => {
  const all = records(path);
  const of = (type) => all.filter((record) => record.type === type);
  const [header] = of("Header");
  assert.equal(header.profile, "");
  assert.equal(header.library, "kinemark");
  const messages = of("Message");
  const chunks = of("Chunk");
  const { reader } = await log(path);
  const { statistics } = reader;
  assert.equal(statistics.messageCount, BigInt(messages.length));
  assert.equal(statistics.chunkCount, chunks.length);
  assert.equal(reader.chunkIndexes.length, chunks.length);
  assert.equal(statistics.channelCount, reader.channelsById.size);
  assert.equal(statistics.schemaCount, reader.schemasById.size);
  assert.equal(statistics.attachmentCount, of("Attachment").length);
  assert.equal(reader.attachmentIndexes.length, of("Attachment").length);
  assert.equal(statistics.metadataCount, of("Metadata").length);
  for (const [channel, count] of statistics.channelMessageCounts) {
    assert.equal(BigInt(messages.filter((message) => message.channelId === channel).length), count);
  }
  assert.equal(statistics.messageStartTime, messages[0].logTime);
  assert.equal(statistics.messageEndTime, messages.at(-1).logTime);
  chunks.forEach((chunk, i) => {
    assert.equal(chunk.compression, "zstd");
    assert.notEqual(chunk.uncompressedCrc, 0, "a chunk without a CRC");
    assert.equal(chunk.messageStartTime, reader.chunkIndexes[i].messageStartTime);
    assert.equal(chunk.messageEndTime, reader.chunkIndexes[i].messageEndTime);
  });
  assert.notEqual(of("DataEnd")[0].dataSectionCrc, 0, "no CRC of the data");
  assert.notEqual(reader.footer.summaryCrc, 0, "no CRC of the summary");
  // a chunk's own records come right after it: a message before the first chunk would be outside of all
  assert.ok(all.findIndex((record) => record.type === "Chunk") < all.findIndex((record) => record.type === "Message"));
});

each("times begin at zero, do not go back, and are those in the messages", async ({ path }) => {
  let last = 0n;
  const messages = records(path).filter((record) => record.type === "Message");
  assert.equal(messages[0].logTime, 0n);
  for (const message of messages) {
    assert.ok(message.logTime >= last, `${message.logTime} after ${last}`);
    assert.equal(message.publishTime, message.logTime);
    last = message.logTime;
  }
  const { topics } = await log(path);
  for (const [topic, list] of topics) {
    for (const { ns, content } of list) {
      const stamps = [content.timestamp, ...(content.transforms ?? content.entities ?? []).map((part) => part.timestamp)].filter(Boolean);
      for (const { sec, nsec } of stamps) assert.equal(sec * 1e9 + nsec, ns, topic);
    }
  }
});

const known = {
  "/tf": "foxglove.FrameTransforms",
  "/scene": "foxglove.SceneUpdate",
  "/reference/tf": "foxglove.FrameTransforms",
  "/reference/scene": "foxglove.SceneUpdate",
  "/joint_states": "foxglove.JointStates",
  "/log": "foxglove.Log",
  "/tcp": "foxglove.PoseInFrame",
};
const described = (schema) => JSON.parse(new TextDecoder().decode(schema.data));
const official = (name) => JSON.parse(JSON.stringify(foxglove[name.replace("foxglove.", "")]));

/** Every message of a log against the schemas: its own where it is JSON, Foxglove's where it is protobuf. */
async function valid(path, encodings) {
  const { reader, topics } = await log(path);
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    const isKnown = channel.topic in known;
    assert.deepEqual([schema.encoding, channel.messageEncoding], isKnown ? encodings : ["jsonschema", "json"], channel.topic);
    if (isKnown) assert.equal(schema.name, known[channel.topic]);
    else assert.match(schema.name, /^kinemark\./);
    // of Foxglove's schemas every word is theirs: a viewer may refuse another one
    if (isKnown && schema.encoding === "jsonschema") assert.deepEqual(described(schema), official(schema.name));
    const rules = isKnown ? official(schema.name) : described(schema);
    assert.equal(rules.title, schema.name);
    // a message with a field that its schema does not know is no message of it
    const closed = JSON.stringify(rules, (_, value) => (value?.properties ? { ...value, additionalProperties: false } : value));
    const valid = new Ajv({ strict: false }).compile(JSON.parse(closed));
    for (const { content, ns } of topics.get(channel.topic)) {
      assert.ok(valid(content), `${channel.topic} at ${ns}: ${JSON.stringify(valid.errors)}`);
    }
    if (!channel.topic.startsWith("/scene") && schema.name.startsWith("kinemark.")) {
      for (const { content } of topics.get(channel.topic)) {
        for (const value of Object.values(content)) assert.equal(typeof value, "number", `${channel.topic} is not flat`);
      }
    }
  }
}

each("every message is valid by Foxglove's schemas, or by its own", ({ path }) => valid(path, ["protobuf", "protobuf"]));

test("a log in JSON has Foxglove's own schemas, and says the same", async () => {
  const again = mkdtempSync(join(tmpdir(), "kinemark-json-"));
  try {
    const lab = "04-knock-with-velocity";
    grade(lab, join(root, "tests/submissions", lab, "good/submission.rhai"), join(again, lab), "--log", "json");
    for (const { path, task } of logsOf(join(again, lab))) {
      await valid(path, ["jsonschema", "json"]);
      const [text, binary] = await Promise.all([log(path), log(join(folder, lab, task, "run.mcap"))]);
      assert.deepEqual([...text.topics.keys()], [...binary.topics.keys()]);
      for (const [topic, messages] of text.topics) assert.deepEqual(messages, binary.topics.get(topic), topic);
    }
  } finally {
    rmSync(again, { recursive: true, force: true });
  }
});

each("/tf alone draws the arm that moves", async ({ path, lab, task }) => {
  const { topics } = await log(path);
  const tf = topics.get("/tf");
  const tcp = topics.get("/tcp");
  const states = topics.get("/joint_states");
  assert.deepEqual(tf.map(({ ns }) => ns), tcp.map(({ ns }) => ns));
  assert.deepEqual(tf.map(({ ns }) => ns), states.map(({ ns }) => ns));
  const names = (message) => message.content.transforms.map((branch) => branch.child_frame_id);
  let travelled = 0;
  // the frame that commands refer to: `tcp`, and where a robot has none the last of its links
  let candidates;
  const seen = tf.map(({ content }) => framesInWorld(content));
  seen.forEach((frames, i) => {
    assert.deepEqual(names(tf[i]), names(tf[0]), "a frame comes or goes");
    for (const name of ["base_link", "odom", "map", "earth"]) {
      assert.ok(!frames.has(name) || distance(frames.get(name).p, seen[0].get(name).p) === 0, `${name} moves`);
    }
    const { frame_id, pose } = tcp[i].content;
    const logged = composed(frames.get(frame_id), poseOf(pose.position, pose.orientation));
    candidates = (candidates ?? [...frames.keys()]).filter((name) => {
      const here = frames.get(name);
      const same = Math.abs(here.q.reduce((sum, value, axis) => sum + value * logged.q[axis], 0));
      // elements are rounded to a billionth, and a chain of them may be five long
      return distance(here.p, logged.p) <= 1e-6 && 1 - same <= 1e-6;
    });
    for (const [name, here] of frames) if (!name.startsWith("body/")) travelled = Math.max(travelled, distance(here.p, seen[0].get(name).p));
  });
  // a run that stops before its first row has no motion
  if (task === "at-once") return assert.equal(tf.length, 0);
  assert.ok(candidates.length > 0, "no frame of /tf is where /tcp says");
  if (lab !== "humanoid") assert.ok(candidates.includes("tcp"), candidates.join());
  // without a command the arm stays where it is
  if (task === "at-rest") return assert.ok(travelled < 1e-3, `the arm moved by ${travelled} m`);
  assert.ok(travelled > 0.01, `the arm moved by ${travelled} m`);
});

each("the scene hangs on frames of /tf", async ({ path }) => {
  const { topics } = await log(path);
  const scenes = topics.get("/scene");
  assert.equal(scenes.length, 1);
  assert.equal(scenes[0].ns, 0);
  const frames = topics.get("/tf")[0] ? framesInWorld(topics.get("/tf")[0].content) : new Map();
  const ids = scenes[0].content.entities.map(({ id }) => id);
  assert.equal(new Set(ids).size, ids.length, "ids are not stable");
  for (const entity of [...scenes[0].content.entities, ...(topics.get("/reference/scene") ?? []).flatMap(({ content }) => content.entities)]) {
    assert.equal(entity.frame_locked, true);
    assert.deepEqual(entity.lifetime, { sec: 0, nsec: 0 });
    const ghost = entity.frame_id.startsWith("reference/");
    assert.ok(ghost || frames.size === 0 || frames.has(entity.frame_id), `${entity.id} hangs on ${entity.frame_id}`);
  }
});

each("joint states name every joint, finite, in SI units", async ({ path, lab }) => {
  const { topics } = await log(path);
  for (const { content } of topics.get("/joint_states")) {
    assert.equal(content.joints.length, joints[lab] ?? 2);
    for (const joint of content.joints) {
      assert.ok([joint.position, joint.velocity, joint.effort].every(Number.isFinite), JSON.stringify(joint));
    }
  }
});

each("what a run rests on travels with it, and its layout lies beside it", async ({ path, lab, task, report }) => {
  const { attachments, metadata, topics } = await log(path);
  assert.deepEqual([...attachments.keys()].sort(), ["grade.json", "lab.toml", "robot.toml", "run.layout.json"]);
  const same = (name, file) => assert.ok(readFileSync(file).equals(Buffer.from(attachments.get(name).data)), `${name} is not ${file}`);
  same("grade.json", join(report, "grade.json"));
  same("lab.toml", join(report, "lab", lab, "lab.toml"));
  const files = join(report, "lab/robots");
  // a row of joints stands in the lab itself
  const robots = existsSync(files) ? readdirSync(files).filter((name) => name.endsWith(".toml")) : [];
  if (robots.length > 0) same("robot.toml", join(files, robots[0]));
  else assert.match(new TextDecoder().decode(attachments.get("robot.toml").data), /([RTP][xyz])+/);
  same("run.layout.json", join(dirname(path), "run.layout.json"));
  const facts = metadata.get("kinemark");
  const record = JSON.parse(readFileSync(join(report, "grade.json"), "utf8"));
  assert.equal(facts.get("submission_digest"), record.submission.digest);
  assert.equal(facts.get("lab_digest"), record.lab.digest);
  assert.equal(facts.get("robot_digest"), record.robot.digest);
  assert.equal(facts.get("engine"), record.engine);
  assert.equal(facts.get("task"), task);
  assert.equal(Number(facts.get("step_s")), steps[lab] ?? 0.001);
  assert.ok(facts.has("seeds"), "no seeds");
  const layout = JSON.parse(readFileSync(join(dirname(path), "run.layout.json"), "utf8"));
  assert.deepEqual(Object.keys(layout).sort(), ["configById", "globalVariables", "layout", "playbackConfig", "userNodes"]);
  // what the plots of the layout show is in the log; what is only now and then in a log may be missing
  for (const panel of Object.values(layout.configById)) {
    for (const { value } of panel.paths ?? []) {
      const [topic, field] = value.split(".");
      if (topic === "/errors" && !topics.has(topic)) continue;
      const list = topics.get(topic);
      assert.ok(list, `${topic} is not in the log`);
      assert.ok(list.length === 0 || list.some(({ content }) => field in content), value);
    }
  }
});

each("no text in it commands a terminal or turns the reading direction", async ({ path }) => {
  const { topics } = await log(path);
  for (const { content } of topics.get("/log")) {
    // eslint-disable-next-line no-control-regex
    assert.doesNotMatch(content.message, /[\u0000-\u001f\u007f-\u009f\u2028-\u202e\u2066-\u2069\ufeff]/);
  }
});

test("of ten thousand printed lines the first thousand are kept, and it says so", async () => {
  const { topics } = await log(logsOf(join(folder, "hostile")).find(({ task }) => task === "move").path);
  const printed = topics.get("/log").filter(({ content }) => content.name === "submission");
  assert.equal(printed.length, 1001);
  assert.equal(printed.at(-1).content.message, "more than 1000 lines are printed: the rest is not kept");
});

test("two runs give the same log, layout and page", () => {
  const again = mkdtempSync(join(tmpdir(), "kinemark-again-"));
  try {
    for (const lab of courseLabs) {
      grade(lab, join(root, "tests/submissions", lab, "good/submission.rhai"), join(again, lab));
      const files = ["report.html", ...logsOf(join(folder, lab)).flatMap(({ task }) => [join(task, "run.mcap"), join(task, "run.layout.json")])];
      for (const file of files) {
        assert.ok(existsSync(join(again, lab, file)), file);
        assert.ok(readFileSync(join(again, lab, file)).equals(readFileSync(join(folder, lab, file))), `${lab}/${file} differs`);
      }
    }
  } finally {
    rmSync(again, { recursive: true, force: true });
  }
});
