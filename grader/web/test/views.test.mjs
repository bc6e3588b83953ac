// Where a run is looked at from: at first from where nothing that counts is hidden, then as its reader chooses.

import assert from "node:assert/strict";
import { test } from "node:test";
import { encode, page as html, replay, truth } from "./fixture.mjs";
import { menu, near, one, open, seek, write } from "./made.mjs";
import { load } from "./modules.mjs";
import { frames, soon } from "./waiting.mjs";

const [{ read }, { extent }, { lookout }, { World }] = await Promise.all(["data.ts", "extent.ts", "lookout.ts", "world.ts"].map(load));
const button = (page, name) => page.getByRole("button", { name, exact: true });

test("a wall before the can moves the first view to the other side", () => {
  const look = (data) => {
    const world = new World(data);
    return { look: lookout(data, world, extent(data, world)), world };
  };
  const plain = replay();
  const { look: usual, world } = look(read(JSON.stringify(plain)));
  assert.equal(usual.turn, 0.5);
  world.at(4);
  const can = plain.nodes.findIndex(({ kind }) => kind === "free");
  const end = [...world.poses.subarray(7 * can, 7 * can + 3)];
  // half a metre from the can, on the way to the eye
  const [azimuth, raised] = [-Math.PI / 2 + usual.turn, usual.elevation];
  const back = [Math.cos(raised) * Math.cos(azimuth), Math.cos(raised) * Math.sin(azimuth), Math.sin(raised)];
  const wall = { name: "wall", kind: "fixed", shapes: [{ solid: { box: [0.3, 0.3, 0.3] }, pose: [0, 0, 0, 1, 0, 0, 0] }], pose: [...end.map((x, c) => x + 0.5 * back[c]), 1, 0, 0, 0] };
  const { look: other } = look(read(JSON.stringify({ ...plain, nodes: [...plain.nodes, wall] })));
  assert.notDeepEqual(other, usual);
});

test("a motion in a plane can be looked at flat, and in space again", async () => {
  const { page, wrong, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await seek(page, 2);
  await menu(page);
  await button(page, "2D").click();
  assert.equal(await button(page, "2D").getAttribute("aria-pressed"), "true");
  const dot = page.locator(".side-tcp");
  const { tcp } = truth(2000);
  await soon(async () => near(Number(await dot.getAttribute("cx")), tcp[0], 1e-3, "x"), 20_000);
  assert.equal(await page.locator(".replay canvas").count(), 0);
  assert.ok(!(await page.locator(".replay-note").isVisible()));
  await button(page, "Side").click();
  await page.waitForSelector(".replay canvas");
  assert.equal(await dot.count(), 0);
  assert.equal(await button(page, "2D").getAttribute("aria-pressed"), "false");
  assert.deepEqual(wrong, []);
  await close();
});

test("the picture follows the TCP where that is asked for", async () => {
  const { page, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await menu(page);
  await button(page, "Frames").click();
  await button(page, "Side").click();
  const place = async (t) => {
    await seek(page, t);
    await frames(page, 3);
    return page.locator(".replay-labels span", { hasText: /^tcp$/ }).evaluate((label) => (({ x, y }) => [x, y])(label.getBoundingClientRect()));
  };
  const moved = async () => {
    const [a, b] = [await place(0.5), await place(3)];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  const still = await moved();
  await place(0.5);
  await button(page, "Follow the TCP").click();
  const followed = await moved();
  // its name stands beside its axes, which turn
  assert.ok(followed < 0.5 * still, `${followed} px, ${still} px without`);
  await close();
});

test("a comparison has the numbers of both runs side by side", async () => {
  const run = { ...replay({ seconds: 0.5 }), mainLabel: "A", ghostLabel: "B" };
  const { ticks } = read(JSON.stringify(run));
  const steps = [...ticks];
  const coded = (row, quanta) => {
    const { within, ticks, ...rest } = encode(steps.map(row), quanta, steps);
    return rest;
  };
  run.other = { tcp: coded((tick) => [0.001 * tick, 1, -2], [1e-4, 1e-4, 1e-4]), q: [{ name: "elbow", track: coded((tick) => [1 + 0.002 * tick], [1e-4]) }] };
  const { page, wrong, close } = await open(write("both.html", html([run])));
  await page.waitForSelector(".replay.on");
  await seek(page, 0.25);
  const cells = (table) => page.locator(`[data-readout=${table}] tr`).evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  const [head, x, y] = await cells("tcp");
  assert.deepEqual(head, ["", "A", "B", ""]);
  assert.deepEqual([x[0], x[2], x[3]], ["x", "0.2500", "m"]);
  assert.equal(y[2], "1.0000");
  const [, shoulder, elbow] = await cells("q");
  assert.deepEqual([shoulder[0], shoulder[2], shoulder[3]], ["shoulder", "–", "rad"]);
  assert.deepEqual([elbow[0], elbow[2]], ["elbow", "1.5000"]);
  assert.deepEqual(wrong, []);
  await close();
});
