// The kinematics of a brief's arm are the engine's: forward kinematics, Jacobian, manipulability and branches, held against
// `kinemark robot eval` to 1e-9 at many postures of many robots, at limits and at singular postures among them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { armOf, asked, ownBrief, robotFiles, temporary } from "./arms.mjs";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "./graded.mjs";
import { load } from "./modules.mjs";

const [{ readArm }, { Posture, postures, range }, { columnsInLab }, { motionSpace }, { ellipse, verdict }, { BranchFinder, hasBranches }] = await Promise.all(
  ["arm_data.ts", "chain.ts", "jacobian.ts", "motion_space.ts", "ellipse.ts", "branches.ts"].map(load),
);
const folder = temporary();
const WITHIN = 1e-9;

/** Postures of a chain: all over, at every limit, and where joints are straight, folded or nearly so. */
function looked(chain) {
  const all = postures(chain, 60);
  const corners = Array.from({ length: 2 ** Math.min(6, chain.q.length) }, (_, k) => chain.q.map((_, i) => range(chain, i)[(k >> i % 6) & 1]));
  for (const bend of [0, 1e-7, -1e-4, Math.PI, Math.PI - 1e-6, Math.PI / 2]) {
    for (const first of [0, 0.7, -2]) all.push(chain.q.map(({ unit }, i) => (unit === "rad" ? (i === 0 ? first : bend) : range(chain, i)[0] + 0.3)));
  }
  return [...all, ...corners];
}

/** How far the arm of a page is from what the engine says; `arm` is its JSON. */
export function off(arm, robot, frame) {
  const { chain } = readArm(arm);
  const posture = new Posture(chain);
  const space = motionSpace(chain);
  const found = looked(chain);
  const answers = asked(robot, found.flatMap((q) => [{ op: "fk", q, in: frame }, { op: "jacobian", q, in: frame }, { op: "manipulability", q, in: frame, rows: "linear" }]));
  const most = { position: 0, jacobian: 0, manipulability: 0 };
  found.forEach((q, i) => {
    const [fk, jacobian, manipulability] = answers.slice(3 * i, 3 * i + 3);
    assert.ok(fk.position_m, JSON.stringify(fk));
    posture.put(q);
    const columns = columnsInLab(posture);
    const scale = 1 + Math.max(0, ...manipulability.singular_values);
    posture.tcpInLab().forEach((x, c) => (most.position = Math.max(most.position, Math.abs(x - fk.position_m[c]))));
    columns.forEach((column, j) => column.forEach((x, c) => (most.jacobian = Math.max(most.jacobian, Math.abs(x - jacobian.jacobian[c][j])))));
    const mine = ellipse(columns, space);
    // the engine's values in all three directions, without those in which the arm never moves
    const theirs = manipulability.singular_values.slice(0, space.basis.length);
    mine.lengths.slice(0, theirs.length).forEach((length, k) => (most.manipulability = Math.max(most.manipulability, Math.abs(length - theirs[k]))));
    const product = theirs.length < space.basis.length ? 0 : theirs.reduce((all, one) => all * one, 1);
    most.manipulability = Math.max(most.manipulability, Math.abs(mine.manipulability - product) / scale ** (space.basis.length - 1));
  });
  return { ...most, postures: found.length };
}

const made = Object.fromEntries(Object.keys(robotFiles).map((name) => [name, ownBrief(folder, name)]));

for (const name of Object.keys(robotFiles)) {
  const { brief, robot, frame } = made[name];
  const arm = armOf(brief);

  test(`${name}: the TCP, the Jacobian and the manipulability are the engine's`, () => {
    const most = off(arm, robot, frame);
    for (const what of ["position", "jacobian", "manipulability"]) assert.ok(most[what] <= WITHIN, `${what}: ${most[what]} off`);
    assert.ok(most.postures > 70);
  });

  test(`${name}: other branches have the same TCP, are within the limits, and are all there are`, () => {
    const { chain } = readArm(arm);
    const space = motionSpace(chain);
    if (!hasBranches(chain, space)) return assert.ok(name === "mimic" || space.active.length > space.rank);
    const finder = new BranchFinder(chain, space);
    const requests = [];
    const wanted = [];
    for (const q of postures(chain, 12)) {
      const { others, endless } = finder.find(q);
      assert.equal(endless, false);
      const target = asked(robot, [{ op: "fk", q }])[0].position_m;
      for (const other of others) {
        for (const [i, { lower, upper }] of chain.q.entries()) assert.ok(other[i] >= (lower ?? -Infinity) - 1e-9 && other[i] <= (upper ?? Infinity) + 1e-9);
        requests.push({ op: "fk", q: other });
        wanted.push({ target });
      }
      // from other starts the engine comes to no posture that is not among them
      for (const start of postures(chain, 10)) {
        requests.push({ op: "ik", target: { position_m: target }, q0: start.map((x, i) => (space.active.includes(i) ? x : q[i])), tolerance_m: 1e-10, method: "damped-least-squares", max_iterations: 300 });
        wanted.push({ q, others });
      }
    }
    let solved = 0;
    asked(robot, requests).forEach((answer, k) => {
      const { target, q, others } = wanted[k];
      if (target) return answer.position_m.forEach((x, c) => assert.ok(Math.abs(x - target[c]) <= WITHIN, `${x}, not ${target[c]}`));
      if (!answer.reached) return;
      solved += 1;
      const near = (a) => space.active.every((i) => {
        const d = a[i] - answer.q[i];
        return Math.abs(chain.q[i].unit === "rad" ? d - 2 * Math.PI * Math.round(d / (2 * Math.PI)) : d) < 1e-3;
      });
      assert.ok([q, ...others].some(near), `the engine found ${answer.q}, which is neither ${q} nor ${JSON.stringify(others)}`);
    });
    assert.ok(solved > 20, `the engine reached ${solved}`);
  });
}

/** A two-link arm has two branches wherever it is bent, one where it is straight, and a whole turn of them where it is folded over its shoulder. */
test("branches of the two-link arm are those of the textbook", () => {
  const { chain } = readArm(armOf(made.rrbot.brief));
  const space = motionSpace(chain);
  assert.deepEqual([space.basis, space.active, space.rank], [[[1, 0, 0], [0, 1, 0]], [0, 1], 2]);
  const finder = new BranchFinder(chain, space);
  for (const q of [[0.3, -1.2], [6, 0.01], [-2, 3.1], [0.775397496610753, 1.5907976603682872]]) {
    const { others } = finder.find(q);
    assert.equal(others.length, 1, `${q}`);
    // links of the same length: the other elbow, and the shoulder turned by the elbow's angle
    for (const [i, x] of [q[0] + q[1], -q[1]].entries()) assert.ok(Math.abs(Math.sin((others[0][i] - x) / 2)) < 1e-9, `${others[0]} of ${q}`);
  }
  for (const q of [[0, 0], [1.5, 0], [-4, 2 * Math.PI]]) assert.deepEqual(finder.find(q), { others: [], endless: false }, `${q}`);
  assert.equal(finder.find([0.4, Math.PI]).endless, true);
});

test("singular postures have a plain word", () => {
  const { chain } = readArm(armOf(made.rrbot.brief));
  const space = motionSpace(chain);
  const posture = new Posture(chain);
  const word = (q) => verdict(ellipse(columnsInLab(posture.put(q)), space));
  assert.deepEqual([[0, 0], [1, Math.PI], [1, 0.1], [0.3, -1.2]].map(word), ["singular", "singular", "nearly singular", "not singular"]);
});

test("a robot with closed loops has no arm to move, since its joints do not move one by one", () => {
  const { brief } = ownBrief(folder, "uarm", readFileSync(join(root, "labs/robots/uarm.toml"), "utf8"));
  assert.equal(armOf(brief), null);
  assert.doesNotMatch(readFileSync(brief, "utf8"), /<script/);
});

for (const [what, breaks] of [
  ["a link that is longer by a hundred-millionth", (arm) => (arm.joints[1].pose[2] += 1e-8)],
  ["a joint that turns the other way", (arm) => (arm.joints[1].axis[1] *= -1)],
  ["a lab frame that is turned", (arm) => ([arm.lab.pose[4], arm.lab.pose[5]] = [arm.lab.pose[5], -arm.lab.pose[4]])],
  ["a TCP on another link", (arm) => (arm.tcp.node = 1)],
]) {
  test(`${what} is found`, () => {
    const { brief, robot, frame } = made.rrbot;
    const arm = JSON.parse(armOf(brief));
    breaks(arm);
    const most = off(JSON.stringify(arm), robot, frame);
    assert.ok(Math.max(most.position, most.jacobian) > WITHIN);
  });
}
