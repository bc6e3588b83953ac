// Arrows of a replay: the velocity of the TCP and what was commanded, and the force on what the arm touches.

import assert from "node:assert/strict";
import { test } from "node:test";
import { encode, page as html, replay } from "./fixture.mjs";
import { menu, near, open, seek, write } from "./made.mjs";
import { load } from "./modules.mjs";
import { soon } from "./waiting.mjs";

const [{ contactMarks }, { read }, { Velocity }] = await Promise.all(["contacts.ts", "data.ts", "velocity.ts"].map(load));

test("a velocity is the way around a step in its time, and a command is held", () => {
  const tcp = { width: 3, count: 4, values: new Float64Array([0, 0, 0, 0.1, 0, 0, 0.3, 0, 0, 0.3, 0, 0.4]) };
  const wanted = { width: 3, count: 4, values: new Float64Array([5, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0]) };
  const made = new Velocity({ tcp, wanted, ticks: new Float64Array([0, 10, 30, 40]), stepS: 0.01 }, 2);
  const v = new Float64Array(3);
  made.actual(v, 1);
  near(v[0], 1, 1e-12, "0.3 m in 0.3 s");
  made.actual(v, 0);
  near(v[0], 1, 1e-12, "from the first step on");
  made.actual(v, 2.6);
  near(v[2], 4, 1e-12, "to the last");
  assert.equal(made.wanted(v, 2.9), true);
  assert.deepEqual([...v], [0, 2, 0]);
  // the greatest, of 5 m/s, is 0.45 of the size long
  made.wanted(v, 0);
  made.tip(v, [1, 1, 1]);
  near(v[0], 1 + 0.45 * 2, 1e-12, "the tip");
  assert.equal(new Velocity({ tcp, wanted: null, ticks: new Float64Array([0, 10, 30, 40]), stepS: 0.01 }, 2).wanted(v, 0), false);
});

test("a force is as long as its root is of the greatest of the arm, and of other contacts none", () => {
  const nodes = [{ kind: "link", name: "forearm" }, { kind: "free", name: "can" }];
  const contact = (first, force, normal) => ({ first, second: "can", point: [0, 0, 0], from: 0, to: 1, impulse: 1, force, normal });
  const marks = contactMarks({ nodes, contacts: [contact("forearm", 4, [0, 0, 1]), contact("forearm", 1, [1, 0, 0]), contact("forearm", 2, null), contact("shelf", 100, [0, 1, 0])] }, 9);
  assert.deepEqual(marks.map(({ force }) => force), [[0, 0, 1], [0.5, 0, 0], null, null]);
});

test("what was commanded is drawn from the start, and the force while it lasts", async () => {
  const run = replay();
  const data = read(JSON.stringify(run));
  run.wanted = encode([...data.ticks].map((_, k) => [0.2 + 0.001 * k, 0, 0.1]), [1e-3, 1e-3, 1e-3], [...data.ticks]);
  delete run.wanted.ticks;
  delete run.wanted.within;
  const touch = run.contacts[0];
  Object.assign(touch, { force: 12, normal: [0.6, 0, 0.8] });
  const { page, wrong, close } = await open(write("arrows.html", html([run])));
  await page.waitForSelector(".replay canvas");
  assert.match(await page.locator(".replay-legend").textContent(), /velocity that was commanded.*force of the arm/s);
  await menu(page);
  await page.getByRole("button", { name: "2D", exact: true }).click();
  const velocity = page.getByRole("button", { name: "Velocity", exact: true });
  assert.equal(await velocity.getAttribute("aria-pressed"), "true");
  await seek(page, touch.from * data.stepS);
  const arrow = (name) => page.locator(`.side-${name}`);
  for (const name of ["velocity", "wanted"]) await soon(async () => assert.match((await arrow(name).getAttribute("d")) ?? "", /^M.*L.*M/), 20_000);
  await soon(async () => assert.equal(await arrow("force").evaluate((made) => made.style.display), ""), 20_000);
  await seek(page, 0);
  await soon(async () => assert.equal(await arrow("force").evaluate((made) => made.style.display), "none"), 20_000);
  await velocity.click();
  for (const name of ["velocity", "wanted"]) await soon(async () => assert.equal(await arrow(name).getAttribute("d"), ""), 20_000);
  assert.deepEqual(wrong, []);
  await close();
});

test("a task that commands no velocity shows it when it is asked for", async () => {
  const { page, wrong, close } = await open(write("asked.html", html([replay()])));
  await page.waitForSelector(".replay canvas");
  await menu(page);
  await page.getByRole("button", { name: "2D", exact: true }).click();
  const velocity = page.getByRole("button", { name: "Velocity", exact: true });
  assert.equal(await velocity.getAttribute("aria-pressed"), "false");
  await velocity.click();
  await seek(page, 1);
  await soon(async () => assert.match((await page.locator(".side-velocity").getAttribute("d")) ?? "", /^M.*L.*M/), 20_000);
  assert.equal((await page.locator(".side-wanted").getAttribute("d")) ?? "", "");
  assert.deepEqual(wrong, []);
  await close();
});
