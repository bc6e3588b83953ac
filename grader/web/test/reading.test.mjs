// Reading a run: what is written comes back, and what is broken is said in a sentence.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { armAt, encode, encodeColumns, replay, truth } from "./fixture.mjs";
import { load } from "./modules.mjs";

const { column, track } = await load("track.ts");
const { read } = await load("data.ts");
const { World } = await load("world.ts");
const { Way } = await load("between.ts");
const { parse, format, meant, shareable } = await load("links.ts");
const { lanes } = await load("lanes.ts");
const { contactMarks, coverAt } = await load("contacts.ts");
// it asks the browser which theme is wanted
globalThis.matchMedia = () => ({ matches: false, addEventListener() {} });
const { LIGHT, DARK } = await load("theme.ts");
const { hull } = await load("hull.ts");
const { pitchFor } = await load("pitch.ts");
const { moment, fixed } = await load("words.ts");
const { pieces, inside, ofLine, spanAt } = await load("curve.ts");
const { words, rounded } = await load("reading.ts");
const { bones } = await load("bones.ts");
const { hidden } = await load("ghosts.ts");
const { balls } = await load("balls.ts");

test("a column worked by hand", () => {
  // 5, 7, 8 are 5, then +2, then +1: a difference of differences of -1; zigzag 10, 4, 1
  assert.equal(encodeColumns([[5, 7, 8]]), Buffer.from([10, 4, 1]).toString("base64"));
  assert.deepEqual([...column(Buffer.from([10, 4, 1]).toString("base64"))], [5, 7, 8]);
});

test("whole numbers of every size come back", () => {
  const numbers = [0, -1, 1, 63, -64, 64, 127, 128, -129, 2 ** 20, -(2 ** 31), 2 ** 31, 2 ** 40, -(2 ** 45), 0, 0, 0];
  assert.deepEqual([...column(encodeColumns([numbers]))], numbers);
});

test("a track comes back row by row", () => {
  const rows = Array.from({ length: 50 }, (_, i) => [Math.sin(i / 5), Math.cos(i / 7), i]);
  const coded = encode(rows, [1e-5, 1e-5, 1]);
  const { values } = track(coded.data, coded.quanta, coded.count, null);
  rows.flat().forEach((value, i) => assert.ok(Math.abs(values[i] - value) <= 0.51e-5, `${i}: ${values[i]} and ${value}`));
});

test("at uneven ticks a number is read from where the two before it lead, by their ticks", () => {
  // as in the maker's own test: after 0 and 10 the line leads to 15 at tick 3, and after 10 and 16 to 40 at tick 7
  const ticks = [0, 2, 3, 7];
  const coded = encode([[0], [10], [16], [39]], [1], ticks);
  assert.equal(coded.data, Buffer.from([0, 20, 2, 1]).toString("base64"));
  assert.deepEqual([...track(coded.data, [1], 4, Float64Array.from(ticks)).values], [0, 10, 16, 39]);
  const half = encode([[0], [-1], [-5]], [1], [0, 2, 3]);
  assert.deepEqual([...track(half.data, [1], 3, Float64Array.from([0, 2, 3])).values], [0, -1, -5]);
});

test("bytes that are too few or too many are refused", () => {
  const coded = encode([[1], [2], [3]], [1]);
  assert.throws(() => track(coded.data, [1], 4, null), /hold no 1 columns of 4|ends after/);
  assert.throws(() => track(coded.data, [1], 2, null), /more than/);
  assert.throws(() => column(Buffer.from([0x80]).toString("base64")), /ends before/);
  assert.throws(() => column(Buffer.from(Array(12).fill(0xff)).toString("base64")), /longer|ends/);
});

test("a false count costs no memory", () => {
  assert.throws(() => track("AA==", Array(7).fill(1), 1e9, null), /bytes hold no/);
});

test("everything bad in a replay is a sentence", () => {
  const broken = (change) => {
    const data = replay({ seconds: 0.5 });
    change(data);
    return JSON.stringify(data);
  };
  const cases = [
    [(d) => (d.format = "kinemark-replay/9"), /kinemark-replay\/9/],
    [(d) => (d.stepS = 0), /stepS is not a positive number/],
    [(d) => (d.ticks = ""), /no frame/],
    [(d) => (d.ticks = encodeColumns([[3, 2, 1]])), /order of time/],
    [(d) => (d.nodes[1].track = 99), /nodes\[1\]\.track is not one of/],
    [(d) => (d.nodes[0].pose = [0, 0, 0, 0, 0, 0, 0]), /nodes\[0\]\.pose is not a pose/],
    [(d) => (d.tcp.count = 3), /tcp is not a track of/],
    [(d) => (d.meshes[0].triangles = Buffer.from(new Uint32Array([0, 1, 9]).buffer).toString("base64")), /vertex that is not there/],
    [(d) => (d.q = null), /q/],
    [(d) => d.q.pop(), /1 tracks of 2 joints/],
    [(d) => (d.tracks[0].ticks = ""), /tracks\[0\]\.ticks is not a list of ticks/],
    [(d) => delete d.tracks[0].within, /within is not a number/],
    [(d) => delete d.nodes, /nodes is not a list/],
  ];
  for (const [change, says] of cases) assert.throws(() => read(broken(change)), says);
  assert.throws(() => read("{"), SyntaxError);
});

test("the world at a tick is the run's, between ticks near it", () => {
  const data = read(JSON.stringify(replay()));
  const world = new World(data);
  for (const tick of [0, 1, 10, 505, 812, 2350, 2355, 3999, 4000]) {
    world.at(tick / 1000);
    const { q, tcp } = truth(tick);
    // frames every 10 ms of a motion of some 5 rad/s^2: 5 * 0.01^2 / 8 and the quanta
    q.forEach((value, j) => assert.ok(Math.abs(world.q[j] - value) < 1e-4, `q${j} at ${tick}: ${world.q[j]}, not ${value}`));
    tcp.forEach((value, c) => assert.ok(Math.abs(world.tcpInWorld[c] - value) < 2e-4, `tcp ${c} at ${tick}`));
  }
  // backwards and far, as a reader jumps
  world.at(4);
  world.at(0);
  assert.ok(Math.abs(world.q[1] - truth(0).q[1]) < 2e-5);
});

test("the way between frames is a parabola's where the frames are on one, however far apart they are", () => {
  const ticks = Float64Array.from([0, 10, 12, 40, 43]);
  const parabola = (x) => 3 - 0.5 * x + 0.07 * x * x;
  const way = new Way(ticks, { width: 1, count: 5, values: ticks.map(parabola) }, 1e-3);
  const at = (tick) => {
    way.at(tick);
    return way.number(0);
  };
  // not before the second frame and not after the last but one, where a slope is that of one line only
  for (const tick of [10, 11, 12, 13, 26, 39, 40]) assert.ok(Math.abs(at(tick) - parabola(tick)) < 1e-12, `${tick}`);
  for (const tick of [43, 0, 12, 10, 40]) {
    assert.ok(Math.abs(at(tick) - parabola(tick)) < 1e-12, `frame ${tick}`);
    assert.ok(way.isFrame);
  }
  at(11);
  assert.ok(!way.isFrame);
  // beyond the ends is at the ends; one frame is all there is
  assert.deepEqual([at(-5), at(99)], [parabola(0), parabola(43)]);
  const one = new Way(Float64Array.from([7]), { width: 1, count: 1, values: [4] }, 1e-3);
  for (const tick of [0, 7, 9]) {
    one.at(tick);
    assert.equal(one.number(0), 4);
  }
});

test("frames 80 ms apart show smooth motion within 1 mm and 1 mrad", () => {
  const world = new World(read(JSON.stringify(replay({ period: 0.08 }))));
  for (let tick = 0; tick <= 4000; tick += 7) {
    world.at(tick / 1000);
    const { q, tcp } = truth(tick);
    q.forEach((value, j) => assert.ok(Math.abs(world.q[j] - value) < 1e-3, `q${j} at ${tick}`));
    tcp.forEach((value, c) => assert.ok(Math.abs(world.tcpInWorld[c] - value) < 1e-3, `tcp ${c} at ${tick}`));
    const forearm = world.poses.subarray(14, 21);
    const { elbow, second } = armAt(q);
    for (let c = 0; c < 3; c++) assert.ok(Math.abs(forearm[c] - elbow[c]) < 1e-3, `elbow ${c} at ${tick}`);
    const same = Math.abs(second.reduce((sum, x, c) => sum + x * forearm[3 + c], 0));
    assert.ok(2 * Math.acos(Math.min(1, same)) < 1e-3, `forearm at ${tick}`);
  }
});

test("a lab frame that is turned changes what is shown, not where things are", () => {
  const turned = [0.3, -0.2, 1, Math.SQRT1_2, 0, Math.SQRT1_2, 0];
  const world = new World(read(JSON.stringify(replay({ lab: turned }))));
  world.at(1);
  truth(1000).tcp.forEach((value, c) => assert.ok(Math.abs(world.tcpInWorld[c] - value) < 1e-4));
});

test("25 joints over 60 s are read whole", () => {
  const text = JSON.stringify(replay({ seconds: 60, joints: 25 }));
  // reported, not asserted: meant are 50 ms; time of this process alone, so that others that run do not count
  const times = Array.from({ length: 6 }, () => {
    const began = process.cpuUsage();
    const { moves, joints } = read(text);
    assert.equal(moves.q.length, joints.length);
    return process.cpuUsage(began).user / 1000;
  });
  console.log(`${(text.length / 1e6).toFixed(2)} MB read in ${Math.min(...times).toFixed(1)} ms`);
});

test("links to a moment", () => {
  const cases = [
    ["#task=move&t=2.35", "move", 2.35, null],
    ["#task=a%26b&t=0", "a&b", 0, null],
    ["#task=move", "move", null, null],
    // in any order, and as they come out of a sentence
    ["#t=2.2&task=knock", "knock", 2.2, null],
    ["#task=move&t=2.2.", "move", 2.2, null],
    ["#task=move&t=2.2)", "move", 2.2, null],
    ["#task=move&t=2.2).", "move", 2.2, null],
    ["#task=move&t=2,2", "move", 2.2, null],
    ["#task=move&t=2,", "move", 2, null],
    ["#task=move&t=.5%E2%80%9D", "move", 0.5, null],
    ["#task=move&t=-3", "move", -3, null],
    // what is no time is returned as it is
    ["#task=move&t=soon", "move", null, "soon"],
    ["#task=move&t=0x2", "move", null, "0x2"],
    ["#task=move&t=1e1", "move", null, "1e1"],
    ["#task=move&t=1.2.3", "move", null, "1.2.3"],
    ["#task=move&t=Infinity", "move", null, "Infinity"],
    ["#task=move&t=...", "move", null, "..."],
    ["#task=%E0%A4%A", "%E0%A4%A", null, null],
  ];
  for (const [hash, task, t, unread] of cases) assert.deepEqual(parse(hash), { task, t, unread }, hash);
  for (const hash of ["#task-3", "", "#t=1", "#task=&t=1"]) assert.equal(parse(hash), null, hash);
  assert.deepEqual(parse(format("a&b=c", "1")), { task: "a&b=c", t: 1, unread: null });
  assert.equal(meant("move.", ["move", "hold"]), "move");
  assert.equal(meant("move.", ["move", "move."]), "move.");
  assert.equal(meant("mo", ["move"]), undefined);
});

test("a link that is copied is of use elsewhere", () => {
  const at = (href) => shareable(new URL(href), "#task=move&t=1");
  assert.equal(at("file:///C:/my%20lab/out/report.html#task=hold&t=2"), "report.html#task=move&t=1");
  assert.equal(at("https://example.org/lab/report.html?a=1#x"), "https://example.org/lab/report.html?a=1#task=move&t=1");
});

test("every kind of event at a moment has its mark, the worse where there is no room", () => {
  const lay = (...events) => lanes(events.map(([kind, x]) => ({ kind, x }))).map(({ kind, x, lane }) => `${kind} ${x} ${lane}`);
  assert.deepEqual(lay(["contact", 50], ["breach", 50]), ["breach 50 0", "contact 50 1"]);
  assert.deepEqual(lay(["contact", 50], ["contact", 52], ["contact", 56], ["contact", 90]), ["contact 50 0", "contact 56 0", "contact 90 0"]);
  assert.deepEqual(lay(["saturation", 0], ["limit", 5], ["other", 8], ["breach", 9]), ["saturation 0 0", "limit 5 1", "breach 9 2"]);
  const many = Array.from({ length: 10_000 }, (_, i) => [["contact", "saturation"][i % 2], (800 * i) / 10_000]);
  assert.ok(lay(...many, ["stop", 800]).length < 800 && lay(...many, ["stop", 800]).some((mark) => mark.startsWith("stop 800")));
});

test("the arm's contacts are marked stronger than those of bodies among themselves", () => {
  const contact = (first, second, impulse) => ({ from: 10, to: 20, first, second, point: [0, 0, 0], impulse });
  const marks = contactMarks({ nodes: [{ kind: "link", name: "forearm" }, { kind: "free", name: "can" }], contacts: [contact("shelf", "can", 16), contact("forearm", "can", 0.6), contact("can", "forearm", 0.1)] }, 2);
  assert.deepEqual(marks.map(({ size }) => size), [1, 0.65 + 0.35 * Math.sqrt(1 / 6)]);
  const second = contactMarks({ ghostLabel: "B", nodes: [{ kind: "link", name: "forearm" }], contacts: [contact("B/shelf", "B/can", 16), contact("B/forearm", "B/can", 0.6)] }, 2);
  assert.deepEqual(second.map(({ lasting }) => lasting), [1, 0.45], "a second run's arm counts as one");
  const all = contactMarks({ nodes: [], contacts: [contact("shelf", "can", 16)] }, 9);
  assert.deepEqual([5, 10, 20, 30].map((tick) => coverAt(all[0], tick)), [0, 0.45, 0.45, 0]);
  assert.deepEqual([5, 10, 20, 30].map((tick) => coverAt(marks[0], tick)), [0, 1, 1, 0]);
});

test("what is drawn stands out from the paper, in light and in dark, and the styles have the same colours", () => {
  const css = readFileSync(new URL("../src/viewer.css", import.meta.url), "utf8");
  const page = readFileSync(new URL("../../report/src/html/page.css", import.meta.url), "utf8");
  const linear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  const luminance = (hex) => [1, 3, 5].reduce((sum, at, c) => sum + [0.2126, 0.7152, 0.0722][c] * linear(parseInt(hex.slice(at, at + 2), 16) / 255), 0);
  const contrast = (a, b) => {
    const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
    return (high + 0.05) / (low + 0.05);
  };
  const last = (text, name, i) => [...text.matchAll(new RegExp(`--${name}:(#[0-9a-f]{3,6})`, "g"))].map(([, hex]) => (hex.length === 4 ? hex.replace(/\w/g, "$&$&") : hex))[i];
  for (const [i, theme] of [LIGHT, DARK].entries()) {
    const papers = [last(page, "paper", i), last(page, "ground", i)];
    // shapes have an edge around them, so that a pale one is seen as well
    for (const name of ["edge", "trail", "future", "reference", "goal", "contact", "path", "ghost"]) {
      for (const paper of papers) assert.ok(contrast(theme[name], paper) >= 3, `${name} ${theme[name]} on ${paper}: ${contrast(theme[name], paper).toFixed(2)}`);
    }
    for (const axis of theme.axes) for (const paper of papers) assert.ok(contrast(axis, paper) >= 3, axis);
    const [base, odd, even] = theme.link;
    const [x, y, z] = theme.axes;
    const { edge, trail, future, reference, goal, contact, ghost, fixed, driven, free } = theme;
    for (const [name, colour] of Object.entries({ edge, trail, future, reference, goal, contact, ghost, base, odd, even, fixed, driven, free, "axis-x": x, "axis-y": y, "axis-z": z })) {
      assert.equal(last(css, name, i), colour, name);
    }
  }
});

test("numbers as they are shown", () => {
  assert.equal(moment(2.35, 0.001), "2.35");
  assert.equal(moment(0.1 + 0.2, 0.001), "0.3");
  assert.equal(fixed(-0.00001, 4), "0.0000");
});

test("a drawn line is read where it is, a jump as from where to where, a band as from low to high", () => {
  // two lines in one path: up to (10, 10), upright to 50, on to (20, 60); then from (30, 5)
  const lines = pieces("m0 0 10 10 0 40 10 10m10-55 5 0", false);
  assert.deepEqual(lines.map(({ x, y }) => [[...x], [...y]]), [[[0, 10, 10, 20], [0, 10, 50, 60]], [[30, 35], [5, 5]]]);
  assert.deepEqual(spanAt(lines, 5, 0), [4.5, 5.5]);
  assert.deepEqual(spanAt(lines, 10, 0), [9.5, 50.5]);
  assert.deepEqual(spanAt(lines, 25, 0), null);
  assert.deepEqual(spanAt(lines, 33, 0), [5, 5]);
  // a band from 100 to 200, drawn 7 further up and down
  const band = pieces("m0 93 50 0 0 114-50 0z", true);
  assert.deepEqual(spanAt(band, 20, 7), [100, 200]);
  assert.deepEqual(inside(lines, [0, 0, 100, 100], 1).length, 2);
  assert.deepEqual(inside(band, [0, 0, 100, 50], 1), []);
  assert.deepEqual(pieces("M0 0L5 5", false), []);
  // a limit of the same colour is dashed, and no part of the line
  const limit = pieces("m0 5 40 0", false, "60 35");
  const all = new Map([["#C65200", [...lines, ...band, ...limit]]]);
  assert.deepEqual(ofLine(all, "#c65200", null), [...lines, ...band]);
  assert.deepEqual(ofLine(all, "#C65200", "60 35"), [...band, ...limit]);
  assert.deepEqual(ofLine(all, "#006CAE", null), []);
});

test("what is read claims no more than the drawing shows", () => {
  // 10 N m in 1000 units: a unit is 0.01
  const scale = { foot: 2000, top: 1000, low: 0, high: 10, log: false };
  assert.equal(words(scale, [1500, 1500], { off: 1.5 }), "5.0");
  assert.equal(words(scale, [1500, 1500], { off: 0.5 }), "5.00");
  assert.equal(words(scale, [1500, 1500], { off: 5.5 }), "5");
  assert.equal(words(scale, [1100, 1900], { off: 1.5 }), "1.0 … 9.0");
  assert.equal(words(scale, [1100, 1100], { off: 1.5, cut: 9 }), "at least 9");
  assert.equal(words({ ...scale, low: -10 }, [1100, 1950], { off: 1.5, cut: 9 }), "at most -9 … 8.0");
  assert.equal(words({ ...scale, low: 0.001, log: true }, [2000, 2000], { off: 1.5 }), "at most 0.001");
  assert.equal(rounded(12345, 60), "12000");
  assert.equal(rounded(-0.2, 0.4), "0");
  for (let n = 0; n < 200; n++) {
    const [value, off] = [37.1 * Math.sin(n), 10 ** (-3 + (n % 7) / 2)];
    const shown = rounded(value + off * Math.cos(3 * n), off);
    const digit = 10 ** -(shown.split(".")[1]?.length ?? 0);
    if (off < 0.5) assert.ok(Math.abs(Number(shown) - value) <= digit + 1e-9, `${value} shown as ${shown} with ${off}`);
  }
});

test("a box is hulled by its corners", () => {
  const own = balls({ solid: { kind: "box", size: [2, 4, 6] }, pose: [1, 0, 0, 1, 0, 0, 0] }, []);
  assert.equal(own.length, 32);
  assert.equal(Math.max(...own.filter((_, i) => i % 4 === 0)), 2);
});

test("the outline of a square with a point in it is the square", () => {
  assert.deepEqual(hull([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]]).length, 4);
});

test("an arm without shapes has sticks from joint to joint, and to its frames", () => {
  const data = read(JSON.stringify(replay({ bare: true })));
  const found = bones(data).map(({ from, to, tip }) => [from, to, ...tip]);
  assert.deepEqual(found.slice(0, 2), [[0, 1, 0, 0, 0], [1, 2, 0, 0, 0]]);
  assert.deepEqual(found.at(-1), [2, 2, 0, 0, 0.85]);
  assert.deepEqual(bones(read(JSON.stringify(replay()))), []);
});

test("a ghost's base that stands in the arm's is not drawn", () => {
  const run = replay();
  const base = run.nodes.find((node) => node.name === "base");
  run.nodes.push({ ...base, name: "reference/base", kind: "ghost" });
  // of another shape it is another thing, which stands in the same place
  run.nodes.push({ ...base, shapes: base.shapes.slice(1), name: "reference/plinth", kind: "ghost" });
  const data = read(JSON.stringify(run));
  assert.deepEqual(data.nodes.filter((node) => hidden(data, node)).map((node) => node.name), ["reference/base"]);
});

test("a grid has round pitches", () => {
  for (const [radius, pitch] of [[1, 0.2], [0.3, 0.05], [6, 1], [12, 2]]) assert.ok(Math.abs(pitchFor(radius) - pitch) < 1e-12);
});
