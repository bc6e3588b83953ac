// What a page can show, without the page: the data of every replay against the log, at every instant that is logged.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { courseLabs, hardLabs, logsOf, reports } from "./graded.mjs";
import { framesInWorld, log } from "./log.mjs";
import { load } from "./modules.mjs";

const { read } = await load("data.ts");
const { World } = await load("world.ts");
const folder = reports();

const distance = (a, b) => Math.hypot(...a.map((value, axis) => value - b[axis]));

/** The replays of a report's page, as its viewer reads them. */
function replaysOf(report) {
  const page = readFileSync(join(report, "report.html"), "utf8");
  const data = [...page.matchAll(/<script type="application\/json" id="replay-\d+">(.*?)<\/script>/gs)].map(([, json]) => json);
  return data.filter((json) => JSON.parse(json).ticks !== "").map(read);
}

for (const lab of [...courseLabs, ...hardLabs]) {
  test(`${lab}: at every logged instant each frame, the TCP and the joints are the log's within 1 mm and 1 mrad`, async (t) => {
    const report = join(folder, lab);
    const replays = replaysOf(report);
    const logs = logsOf(report);
    let worst = { place: 0, turn: 0, joint: 0 };
    let compared = 0;
    for (const [i, replay] of replays.entries()) {
      // tasks are folders by their names, where these can be; else there is one
      const path = (logs.find(({ task }) => task === replay.task) ?? logs[i]).path;
      const { topics } = await log(path);
      const [tf, tcp, states] = ["/tf", "/tcp", "/joint_states"].map((topic) => topics.get(topic));
      const world = new World(replay);
      for (let n = 0; n < tf.length; n++) {
        world.at(Math.min(tf[n].ns / 1e9, replay.ticks.at(-1) * replay.stepS));
        const frames = [...framesInWorld(tf[n].content).values()];
        replay.nodes.forEach((node, k) => {
          if (node.track < 0) return;
          const [x, y, z, ...q] = world.poses.subarray(7 * k, 7 * k + 7);
          // names that hold what is not seen are other words here, so a frame is found by where it is
          const near = frames.map(({ p, q: turn }) => {
            const same = Math.abs(q.reduce((sum, value, axis) => sum + value * turn[axis], 0));
            return { place: distance([x, y, z], p), turn: Math.sqrt(8 * Math.max(0, 1 - same)) };
          });
          const best = near.reduce((a, b) => (Math.max(b.place, b.turn) < Math.max(a.place, a.turn) ? b : a));
          worst.place = Math.max(worst.place, best.place);
          worst.turn = Math.max(worst.turn, best.turn);
          compared++;
        });
        const at = tcp[n].content.pose.position;
        worst.place = Math.max(worst.place, distance([...world.tcp], [at.x, at.y, at.z]));
        states[n].content.joints.forEach(({ position }, joint) => (worst.joint = Math.max(worst.joint, Math.abs(world.q[joint] - position))));
      }
    }
    t.diagnostic(`${compared} poses: at most ${(1e3 * worst.place).toFixed(3)} mm, ${(1e3 * worst.turn).toFixed(3)} mrad, joints ${(1e3 * worst.joint).toFixed(3)} mrad off`);
    assert.ok(compared > 0 || replays.length === 0);
    for (const [what, off] of Object.entries(worst)) assert.ok(off <= 1e-3, `${what}: ${off}`);
  });
}
