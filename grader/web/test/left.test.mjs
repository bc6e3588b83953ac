// Where the path to follow was left: found in the run, drawn, and pointed at.

import assert from "node:assert/strict";
import { test } from "node:test";
import { page as html, replay } from "./fixture.mjs";
import { menu, near, open, seek, write } from "./made.mjs";
import { load } from "./modules.mjs";
import { soon } from "./waiting.mjs";

const [{ left, nearest, offAt }, { read }] = await Promise.all(["left.ts", "data.ts"].map(load));

test("the path counts as left after the TCP came onto it and before it came to its end", () => {
  const heights = [0.3, 0, 0, 0.1, 0.1, 0, 0, 0.5, 0.5];
  const across = [0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1];
  const values = new Float64Array(heights.flatMap((z, i) => [across[i], 0, z]));
  const path = { name: "line", points: [[0, 0, 0], [1, 0, 0]], full: 0.02, zero: 0.05 };
  const found = left({ paths: [path, { ...path, full: null }], tcp: { values, count: 9, width: 3 } });
  assert.equal(found.length, 1);
  assert.deepEqual([...found[0].off], [0, 0, 0, 1, 1, 0, 0, 0, 0]);
  assert.equal(offAt(found, 3.2), found[0]);
  assert.equal(offAt(found, 5.4), null);
  const spot = new Float64Array(3);
  near(nearest(spot, path, values, 9), 0.1, 1e-12, "how far");
  near(spot[0], 0.4, 1e-12, "where");
});

test("who never leaves the path, or never comes onto it, left none", () => {
  const path = { name: "line", points: [[0, 0, 0], [1, 0, 0]], full: 0.02, zero: 0.05 };
  for (const z of [0.01, 0.5]) assert.deepEqual(left({ paths: [path], tcp: { values: new Float64Array([0, 0, z, 0.5, 0, z, 1, 0, z]), count: 3, width: 3 } }), []);
});

test("the trail is marked where the path was left, and an arrow leads to it, in space and flat", async () => {
  const run = replay();
  // the run's own way, but aside from its second quarter on
  const data = read(JSON.stringify(run));
  const { values, count } = data.tcp;
  const at = (share) => [...values.subarray(3 * Math.round(share * (count - 1)), 3 * Math.round(share * (count - 1)) + 3)];
  const [first, second] = [at(0.1), at(0.2)];
  run.paths = [{ name: "line", points: [first, second, second.map((x, c) => x + 3 * (second[c] - first[c]))], full: 0.01, zero: 0.05 }];
  const expected = left(read(JSON.stringify(run)));
  assert.equal(expected.length, 1, "the made-up path is not left");
  const step = expected[0].off.lastIndexOf(1);
  const { page, wrong, close } = await open(write("left.html", html([run])));
  await page.waitForSelector(".replay canvas");
  assert.match(await page.locator(".replay-legend").textContent(), /farther from the path than earns all points/);
  await menu(page);
  await page.getByRole("button", { name: "2D", exact: true }).click();
  await seek(page, data.ticks[step] * data.stepS);
  await soon(async () => assert.match(await page.locator(".side-left").getAttribute("d"), /^M.*L/), 20_000);
  assert.equal(await page.locator(".side-arrow").evaluate((arrow) => arrow.style.display), "");
  await seek(page, 0);
  await soon(async () => assert.equal(await page.locator(".side-arrow").evaluate((arrow) => arrow.style.display), "none"), 20_000);
  assert.equal(await page.locator(".side-left").getAttribute("d"), "");
  assert.deepEqual(wrong, []);
  await close();
});
