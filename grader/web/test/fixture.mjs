// A report page by the contract, with a made-up run: an arm of two joints that knocks a can off a shelf.
//
// `node test/fixture.mjs FOLDER` writes it, to look at.

import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..");

function varint(out, integer) {
  let rest = integer < 0 ? -integer * 2 - 1 : integer * 2;
  while (rest >= 128) {
    out.push((rest % 128) | 128);
    rest = Math.floor(rest / 128);
  }
  out.push(rest);
}

/** The bytes of columns of integers, each given by how far it is from where the two before it lead. */
export function encodeColumns(columns, ticks = null) {
  const out = [];
  for (const column of columns) {
    column.forEach((value, i) => {
      if (i < 2) return varint(out, i === 0 ? value : value - column[0]);
      const ratio = ticks === null ? 1 : (ticks[i] - ticks[i - 1]) / (ticks[i - 1] - ticks[i - 2]);
      varint(out, value - column[i - 1] - Math.floor((column[i - 1] - column[i - 2]) * ratio + 0.5));
    });
  }
  return Buffer.from(out).toString("base64");
}

/** A track of rows, at ticks or at a fixed period. */
export function encode(rows, quanta, ticks = null) {
  const columns = quanta.map((quantum, c) => rows.map((row) => Math.round(row[c] / quantum)));
  const coded = { width: quanta.length, count: rows.length, quanta, data: encodeColumns(columns, ticks) };
  return ticks === null ? coded : { ...coded, ticks: encodeColumns([ticks]), within: 3e-4 };
}

const POSITION = [1e-5, 1e-5, 1e-5];
const POSE = [...POSITION, 2e-5, 2e-5, 2e-5, 2e-5];

const multiply = ([aw, ax, ay, az], [bw, bx, by, bz]) => [
  aw * bw - ax * bx - ay * by - az * bz,
  aw * bx + ax * bw + ay * bz - az * by,
  aw * by - ax * bz + ay * bw + az * bx,
  aw * bz + ax * by - ay * bx + az * bw,
];
const about = (axis, angle) => {
  const out = [Math.cos(angle / 2), 0, 0, 0];
  out[1 + axis] = Math.sin(angle / 2);
  return out;
};
const rotate = (q, p) => multiply(multiply(q, [0, ...p]), [q[0], -q[1], -q[2], -q[3]]).slice(1);
const plus = (a, b) => a.map((v, i) => v + b[i]);

/** Angles of the arm at a moment. */
const angles = (t, end) => {
  const s = Math.min(1, t / (0.8 * end));
  const smooth = s * s * (3 - 2 * s);
  return [0.9 * smooth, -1.2 + 1.9 * smooth + 0.15 * Math.sin(5 * t) * (1 - s)];
};

const L1 = 0.9;
const L2 = 0.85;
const BASE = 1.1;

export function armAt([q1, q2]) {
  // turned about y, so that the arm at zero points up
  const first = about(1, q1);
  const elbow = plus([0, 0, BASE], rotate(first, [0, 0, L1]));
  const second = about(1, q1 + q2);
  const tcp = plus(elbow, rotate(second, [0, 0, L2]));
  return { first, elbow, second, tcp };
}

/** A run by the contract. */
export function replay({ task = "knock", seconds = 4, joints = 2, ghost = true, lab = null, period = 0.01, bare = false } = {}) {
  const stepS = 0.001;
  const last = Math.round(seconds / stepS);
  const events = [
    { tick: Math.round(0.2 * last), kind: "saturation", text: "shoulder at its greatest effort" },
    { tick: Math.round(0.203 * last), kind: "limit", text: "elbow reaches its limit" },
    { tick: Math.round(0.5875 * last), kind: "contact", text: "forearm touches can" },
    { tick: Math.round(0.64 * last), kind: "breach", text: "further than 20 mm from the path" },
    { tick: Math.round(0.82 * last), kind: "fell", text: "can falls" },
    { tick: last, kind: "stop", text: "the time is over" },
  ];
  const every = Math.round(period / stepS);
  const ticks = [...new Set([...Array.from({ length: Math.floor(last / every) + 1 }, (_, i) => i * every), ...events.map((e) => e.tick), last])].sort((a, b) => a - b);
  const at = (tick) => armAt(angles(tick * stepS, seconds));
  const reference = (tick) => armAt(angles(Math.max(0, tick * stepS * 1.06), seconds).map((q) => 0.97 * q));
  const hit = events[2].tick;
  const canStart = [1.2, 0, 1.05];
  const canAt = (tick) => {
    const t = Math.max(0, (tick - hit) * stepS);
    const drop = Math.max(0, t - 0.25);
    return [[canStart[0] + 0.5 * t, 0, Math.max(0.08, canStart[2] - 4.9 * drop * drop)], about(1, Math.min(Math.PI / 2, 3 * t))];
  };
  const pose = (p, q) => [...p, ...q];
  const identity = [1, 0, 0, 0];
  const origin = [0, 0, 0, ...identity];
  const labPose = lab ?? [0, 0, BASE, ...identity];
  const labTurn = labPose.slice(3);
  const inLab = (p) => rotate([labTurn[0], -labTurn[1], -labTurn[2], -labTurn[3]], p.map((v, i) => v - labPose[i]));
  const tracks = [];
  const track = (f) => tracks.push(encode(ticks.map(f), POSE, ticks)) - 1;
  const bar = (length, width) => [
    { solid: { box: [width, width, length] }, pose: [0, 0, length / 2, ...identity] },
    { solid: { cylinder: { radius: 0.75 * width, length: 1.3 * width } }, pose: [0, 0, 0, ...about(0, Math.PI / 2)] },
  ];
  const tetrahedron = new Float32Array([0.12, 0, 0, -0.12, 0.1, 0, -0.12, -0.1, 0, 0, 0, 0.25]);
  const faces = new Uint32Array([0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1]);
  const raw = (array) => Buffer.from(array.buffer).toString("base64");
  const nodes = [
    { name: "base", kind: "link", shapes: [{ solid: { cylinder: { radius: 0.09, length: BASE } }, pose: [0, 0, BASE / 2, ...identity] }, { solid: { box: [0.5, 0.5, 0.04] }, pose: [0, 0, 0.02, ...identity] }], pose: origin },
    { name: "upper arm", kind: "link", shapes: bar(L1, 0.1), track: track((k) => pose([0, 0, BASE], at(k).first)) },
    { name: "forearm", kind: "link", shapes: [...bar(L2 - 0.05, 0.08), { solid: { sphere: { radius: 0.06 } }, pose: [0, 0, L2 - 0.05, ...identity] }], track: track((k) => pose(at(k).elbow, at(k).second)) },
    { name: "shelf", kind: "fixed", shapes: [{ solid: { box: [0.5, 0.6, 0.04] }, pose: origin }, { solid: { box: [0.04, 0.6, 0.95] }, pose: [0.23, 0, -0.47, ...identity] }], pose: [1.35, 0, 0.95, ...identity] },
    { name: "marker", kind: "fixed", shapes: [{ solid: { mesh: 0 }, pose: origin }], pose: [0.6, 0.5, 0, ...identity] },
    { name: "can", kind: "free", shapes: [{ solid: { cylinder: { radius: 0.05, length: 0.16 } }, pose: origin }], track: track((k) => pose(...canAt(k))) },
    { name: "pusher", kind: "driven", shapes: [{ solid: { capsule: { radius: 0.03, length: 0.2 } }, pose: [0, 0, 0, ...about(1, Math.PI / 2)] }], track: track((k) => pose([0.6 + 0.1 * Math.sin(0.002 * k), -0.4, 0.2], identity)) },
  ];
  for (let j = 2; j < joints; j++) {
    nodes.push({ name: `link ${j + 1}`, kind: "link", shapes: [{ solid: { capsule: { radius: 0.03, length: 0.1 } }, pose: [0, 0, 0.05, ...identity] }], track: track((k) => pose(plus(at(k).tcp, [0.05 * Math.sin(j), 0.12 * (j - 1), 0.02 * j]), about(2, 0.001 * k + j))) });
  }
  if (ghost) {
    nodes.push(
      { name: "upper arm", kind: "ghost", shapes: bar(L1, 0.1), track: track((k) => pose([0, 0, BASE], reference(k).first)) },
      { name: "forearm", kind: "ghost", shapes: bar(L2 - 0.05, 0.08), track: track((k) => pose(reference(k).elbow, reference(k).second)) },
    );
  }
  if (bare) {
    // an arm given by its joints alone
    nodes.forEach((node, n) => {
      if (node.kind === "link") Object.assign(node, { shapes: [], parent: n > 0 ? (n < 3 ? n - 1 : undefined) : undefined });
      else if (node.kind === "ghost") Object.assign(node, { shapes: [], parent: node.name === "forearm" ? n - 1 : undefined });
    });
  }
  const periods = Array.from({ length: Math.round(seconds / 0.01) + 1 }, (_, i) => i * 10);
  const path = Array.from({ length: 30 }, (_, i) => inLab(reference(Math.round((0.75 * last * i) / 29)).tcp));
  return {
    format: "kinemark-replay/2",
    task,
    title: "Knock the can off the shelf",
    stepS,
    ticks: encodeColumns([ticks]),
    lab: { name: "lab", node: null, pose: labPose },
    nodes,
    meshes: [{ vertices: raw(tetrahedron), triangles: raw(faces) }],
    frames: [{ name: "tcp", node: 2, pose: [0, 0, L2, ...identity] }, { name: "base", node: 0, pose: origin }],
    tcp: encode(ticks.map((k) => inLab(at(k).tcp)), POSITION, ticks),
    q: Array.from({ length: joints }, (_, j) => encode(ticks.map((k) => [angles(k * stepS, seconds)[j % 2] + (j > 1 ? 0.1 * j : 0)]), [1e-5], ticks)),
    joints: Array.from({ length: joints }, (_, j) => ({ name: ["shoulder", "elbow"][j] ?? `joint ${j + 1}`, unit: j === 2 ? "m" : "rad" })),
    tracks,
    reference: { periodS: 0.01, path: encode(periods.map((k) => inLab(reference(k).tcp)), POSITION) },
    goals: [{ position: inLab(armAt(angles(seconds, seconds)).tcp), full: 0.03, zero: 0.1 }],
    paths: [{ name: "sweep", points: path, full: 0.02, zero: 0.05 }],
    contacts: [{ from: hit, to: hit + 120, first: "forearm", second: "can", point: plus(canStart, [-0.05, 0, 0]), impulse: 0.2 }],
    events,
    ghostLabel: ghost ? "reference" : null,
    mainLabel: null,
    ended: null,
  };
}

/** Where the made-up arm is at a tick, for comparison: TCP in the world and angles. */
export function truth(tick, seconds = 4) {
  const q = angles(tick * 0.001, seconds);
  return { q, tcp: armAt(q).tcp };
}

const escape = (text) => text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

/** A line as reports draw it: a path of steps from point to point. */
function path(points, colour) {
  let at = [0, 0];
  const steps = points.map(([x, y]) => {
    const step = `${x - at[0]} ${y - at[1]}`;
    at = [x, y];
    return step;
  });
  return `<path fill="none" stroke="${colour}" stroke-width="20" d="m${steps.join(" ")}"/>`;
}

function figure(task, seconds) {
  const [left, top, right, bottom] = [680, 600, 6200, 2100];
  const series = [{ name: "shoulder", colour: "#006CAE" }, { name: "elbow", colour: "#C65200" }];
  const [low, high] = [-1.5, 1.5];
  const lines = series.map(({ colour }, j) => {
    const points = Array.from({ length: 201 }, (_, i) => {
      const value = angles((seconds * i) / 200, seconds)[j];
      return [Math.round(left + ((right - left) * i) / 200), Math.round(bottom - ((value - low) / (high - low)) * (bottom - top))];
    });
    const sample = [[700 + 1500 * j, 300], [900 + 1500 * j, 300]];
    return path(points, colour) + path(sample, colour);
  });
  const panels = [{ kind: "time", box: [left, top, right, bottom], t: [0, seconds], y: [low, high], unit: "rad", full: 0.5, zero: 1, series }];
  const numbers = [0, 1, 2, 3, 4].map((i) => `<text x="${left + (i * (right - left)) / 4}" y="2230" font-size="130" text-anchor="middle" fill="#545E6C">${(i * seconds) / 4}</text>`);
  return `<figure class="plot" tabindex="0" aria-label="Joints" data-task="${escape(task)}" data-panels="${escape(JSON.stringify(panels))}">
<svg xmlns="http://www.w3.org/2000/svg" class="plot" role="img" width="640" height="250" viewBox="0 0 6400 2500"><title>Joints</title>
<rect x="${left}" y="${top}" width="${right - left}" height="${bottom - top}" fill="none" stroke="#B0B9C5" stroke-width="10"/>${lines.join("")}${numbers.join("")}
<text x="3400" y="2400" font-size="130" text-anchor="middle" fill="#545E6C">time [s]</text></svg></figure>`;
}

function plane(task, seconds) {
  const zero = [3200, 2600];
  const scale = 1200;
  const points = Array.from({ length: 101 }, (_, i) => {
    const p = armAt(angles((seconds * i) / 100, seconds)).tcp;
    return [Math.round(zero[0] + scale * p[0]), Math.round(zero[1] - scale * (p[2] - BASE))];
  });
  const panels = [{ kind: "plane", box: [400, 300, 6200, 3000], axes: [0, 2], signs: [1, 1], zero, pixelsPerM: scale }];
  return `<figure class="plot" tabindex="0" aria-label="Path" data-task="${escape(task)}" data-panels="${escape(JSON.stringify(panels))}">
<svg xmlns="http://www.w3.org/2000/svg" class="plot" role="img" width="640" height="320" viewBox="0 0 6400 3200"><title>Path</title>${path(points, "#006CAE")}</svg></figure>`;
}

/** The page of some runs; a text in place of a run is put in as its data, and `more` stands at the end. */
export function page(replays, { bundle = join(root, "dist"), more = "" } = {}) {
  const style = readFileSync(join(root, "../report/src/html/page.css"), "utf8");
  const viewer = readFileSync(join(bundle, "viewer.css"), "utf8");
  const script = readFileSync(join(bundle, "viewer.js"), "utf8");
  const digest = createHash("sha256").update(script).digest("base64");
  const sections = replays.map((run, i) => {
    const { task, title, events = [] } = typeof run === "string" ? { task: `bad-${i}`, title: "A task whose replay is bad" } : run;
    const seconds = typeof run === "string" ? 4 : run.events.at(-1).tick * run.stepS;
    const moments = events.map((e) => `<li><a class="seek" href="#task=${task}&amp;t=${e.tick / 1000}">${e.tick / 1000} s</a> ${escape(e.text)}</li>`);
    return `<section class="task" id="task-${i + 1}" data-task="${escape(task)}"><div class="title"><h2>${escape(title)}</h2></div><p class="lead">What it is about.</p>
<div class="replay" data-replay="replay-${i + 1}" data-task="${escape(task)}"></div><h3>Plots</h3><div class="plots">${figure(task, seconds)}${plane(task, seconds)}</div><ul>${moments.join("")}</ul></section>`;
  });
  const data = replays.map((run, i) => `<script type="application/json" id="replay-${i + 1}">${(typeof run === "string" ? run : JSON.stringify(run)).replace(/</g, "\\u003c")}</script>`);
  return `<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'sha256-${digest}'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" content="light dark"><title>A report</title><style>${style}${viewer}</style></head>
<body><main><h1>A report</h1>${sections.join("\n")}${more}</main>${data.join("\n")}<script>${script}</script></body></html>`;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const folder = process.argv[2] ?? "out";
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, "one.html"), page([replay()]));
  writeFileSync(join(folder, "three.html"), page([replay(), '{"format":"kinemark-replay/2"}', replay({ task: "long", seconds: 60, joints: 25 })]));
}
