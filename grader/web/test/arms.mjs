// Robots to move: a made-up lab for each, its brief written by the binary, and the binary's answers to questions about it.
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { courseLabs, kinemark, root } from "./graded.mjs";

const robots = join(root, "labs/robots");
const rrbot = readFileSync(join(robots, "rrbot.toml"), "utf8");
const lengths = (upper, forearm) => rrbot.replace("link_lengths = [1.0, 1.0]", `link_lengths = [${upper}, ${forearm}]`);

/** A chain of links named 0, 1, 2 ... that stand on each other, with a TCP behind the last; `joints` are the rest of their tables. */
const chain = (joints, more = "") =>
  `format = 1\nname = "made"\n\n${["base", ...joints.keys()].map((name) => `[[links]]\nname = "${name}"\ninertia = { mass_kg = 1, tensor_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0] }\n`).join("\n")}
${joints.map((rest, i) => `[[joints]]\nname = "joint ${i}"\nparent = "${i > 0 ? i - 1 : "base"}"\nchild = "${i}"\n${rest}\n`).join("\n")}
[[frames]]\nname = "tcp"\nlink = "${joints.length - 1}"\norigin = { xyz_m = [0.3, 0.02, -0.1] }\n${more}`;

/** The robot files by name. What is not among the course's has what those do not: slides, mimics, tilted bases, trees, axes of all directions. */
export const robotFiles = {
  rrbot,
  "rrbot-short-forearm": lengths(1.3, 0.6),
  "rrbot-long-forearm": lengths(0.55, 1.4),
  puma560: readFileSync(join(robots, "puma560.toml"), "utf8"),
  rppr: readFileSync(join(robots, "rppr.toml"), "utf8"),
  tilted: chain([
    'type = "revolute"\norigin = { xyz_m = [0.1, 0.2, 0.3], rpy_deg = [20, -35, 70] }\naxis = [0, 0, 1]\nlimit = { lower = -3, upper = 2 }',
    'type = "revolute"\norigin = { xyz_m = [0.7, 0, 0] }\naxis = [0, 0, -1]',
  ], '\n[[frames]]\nname = "lab"\nlink = "base"\norigin = { xyz_m = [1, 2, 3], rpy_deg = [10, 20, 30] }\n'),
  slide: chain([
    'type = "revolute"\naxis = [0, 1, 0]',
    'type = "prismatic"\norigin = { xyz_m = [0, 0, 0.4], rpy_deg = [0, 0, 15] }\naxis = [0, 0, 1]\nlimit = { lower = 0.05, upper = 0.9 }',
  ]),
  space: chain([
    'type = "revolute"\naxis = [0, 0, 1]\nlimit = { lower = -3, upper = 3 }',
    'type = "revolute"\norigin = { xyz_m = [0.1, 0, 0.5], rpy_deg = [90, 0, 0] }\naxis = [0, 0, 1]\nlimit = { lower = -3, upper = 3 }',
    'type = "fixed"\norigin = { xyz_m = [0.2, 0.1, 0] }',
    'type = "revolute"\norigin = { xyz_m = [0.5, 0, 0] }\naxis = [0, 0, 1]\nlimit = { lower = -3, upper = 3 }',
  ]),
  mimic: chain([
    'type = "revolute"\naxis = [0, 1, 0]',
    'type = "revolute"\norigin = { xyz_m = [0, 0, 0.6] }\naxis = [0, 1, 0]\nmimic = { joint = "joint 0", multiplier = -0.7, offset = 0.4 }',
    'type = "prismatic"\norigin = { xyz_m = [0, 0, 0.4] }\naxis = [0.6, 0, 0.8]\nlimit = { lower = -0.2, upper = 0.3 }',
  ]),
  redundant: chain(Array(4).fill('type = "continuous"\norigin = { xyz_m = [0.3, 0.1, 0] }\naxis = [0, 0, 1]')),
};

const lab = (name, robot, joint, frame) => `format = 1
name = "${name}"
title = "${name}"
robot = "${robot}"
frame = "${frame}"

[[tasks]]
name = "stand"
title = "Stand"

[tasks.motion]
mode = "effort"
duration_s = 1.0
control_period_ms = 10.0

[[tasks.checks]]
name = "calm"
title = "The efforts are calm"
points = 1.0
hints = ["Is it calm?", "Let it be calm."]
chatter = { joint = "${joint}", full_hz = 0.1, zero_hz = 0.2 }
`;

function run(folder, ...args) {
  const ran = spawnSync(kinemark, args, { encoding: "utf8", cwd: folder });
  if (ran.status !== 0) throw new Error(`${args.join(" ")}: ${ran.stderr || ran.error}`);
}

/** The folder of a lab as a student has it. */
function begun(folder, name, ...options) {
  const out = mkdtempSync(join(folder, "begun", `${name}-`));
  run(folder, "new", name, out, ...options);
  return join(out, "brief.html");
}

/** A folder that goes away with this process. */
export function temporary() {
  const folder = mkdtempSync(join(tmpdir(), "kinemark-arms-"));
  process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

/** The briefs of the course's labs by name, and of one a student's own: `{ brief, robot }` each. */
export function courseBriefs(folder = temporary()) {
  mkdirSync(join(folder, "begun"), { recursive: true });
  const labs = join(root, "labs");
  const others = { "05-rppr": { robot: "rppr", frame: "base" }, "06-typed-robots": { robot: typedRow(folder, join(labs, "06-typed-robots/lab.toml")), frame: "base" } };
  const briefs = courseLabs.map((name) => [name, { brief: begun(folder, name, "--labs", labs), robot: "rrbot", ...others[name] }]);
  // links as the student's variant has them, read from where the numbers are and not from the page
  const brief = begun(folder, "03-knock-with-position", "--labs", labs, "--student", "ann", "--salt", "a line of a test");
  const variant = readFileSync(join(brief, "../variant.toml"), "utf8");
  const [upper, forearm] = ["l1", "l2"].map((name) => variant.match(new RegExp(`^${name} = (.*)$`, "m"))[1]);
  const robot = join(folder, "ann.toml");
  writeFileSync(robot, lengths(upper, forearm));
  return Object.fromEntries([...briefs, ["a student's own", { brief, robot }]]);
}

/** The robot file of the row of joints and the sizes that a lab has for everybody. */
function typedRow(folder, path) {
  const text = readFileSync(path, "utf8");
  const value = (name) => JSON.parse(text.match(new RegExp(`^${name} = ([^#\\n]*)`, "m"))[1]);
  const file = join(folder, "row.toml");
  const links = ["link1", "link2", "link3"].map((name) => value(name).join(",")).join(";");
  const args = ["robot", "convert", value("row"), "--base", value("base"), "--links", links, "--out", file].map(String);
  const ran = spawnSync(kinemark, args, { encoding: "utf8", cwd: root });
  if (ran.error || ran.status !== 0) throw new Error(`${args.join(" ")}: ${ran.stderr || ran.error}`);
  return file;
}

/** A brief with a robot of its own, and the robot's file: `{ brief, robot }`. */
export function ownBrief(folder, name, text = robotFiles[name]) {
  const labs = join(folder, "labs");
  mkdirSync(join(labs, "robots"), { recursive: true });
  mkdirSync(join(folder, "begun"), { recursive: true });
  const robot = join(labs, "robots", `${name}.toml`);
  writeFileSync(robot, text.replace(/^name = .*$/m, `name = "${name}"`));
  mkdirSync(join(labs, name), { recursive: true });
  const [info] = asked(robot, [{ op: "info" }]);
  const frame = info.frames.includes("lab") ? "lab" : info.frames[0];
  writeFileSync(join(labs, name, "lab.toml"), lab(name, name, info.joints[0].name, frame));
  writeFileSync(join(labs, name, "brief.md"), "# A robot\n\nText.\n\n## A task\n\nMore.\n");
  writeFileSync(join(labs, name, "starter.rhai"), "fn control(observation) { observation.q * 0 }\n");
  return { brief: begun(folder, name, "--labs", labs), robot, info, frame };
}

/** The JSON of a brief's arm, or nothing where it has none. */
export function armOf(brief) {
  return readFileSync(brief, "utf8").match(/<script type="application\/json" id="arm">([^<]*)<\/script>/)?.[1] ?? null;
}

/** What `kinemark robot eval` answers to requests, in order. */
export function asked(robot, requests) {
  const ran = spawnSync(kinemark, ["robot", "eval", robot], { encoding: "utf8", input: requests.map((one) => `${JSON.stringify(one)}\n`).join(""), maxBuffer: 1 << 28, cwd: root });
  if (ran.error || ran.status > 1) throw new Error(`robot eval ${robot}: ${ran.stderr || ran.error}`);
  return ran.stdout.trim().split("\n").map((line) => JSON.parse(line));
}
