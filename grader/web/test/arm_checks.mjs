// What must hold of a brief's arm in a browser, check by check, so that the checks themselves can be tried on pages that are broken.
import assert from "node:assert/strict";
import { basename, dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { asked } from "./arms.mjs";
import { frames, soon } from "./waiting.mjs";

export const shown = (page) => page.evaluate(() => window.kinemark.arms[0].shown());
export const put = (page, q) => page.evaluate((q) => window.kinemark.arms[0].put(q), q);

/** Nothing was said in the console, opened, or asked for but the pictures beside the page. */
export function quiet(page, brief) {
  const beside = (line) => {
    const file = line.startsWith("request: file:") && fileURLToPath(line.slice("request: ".length));
    return file && dirname(file) === dirname(brief) && /^[\w-]+\.svg$/.test(basename(file));
  };
  assert.deepEqual(page.said.filter((line) => !beside(line)), []);
}

/** The numbers in a table of the page. */
const readout = (page, name) => page.$$eval(`[data-arm] [data-readout=${name}] td:nth-child(2)`, (cells) => cells.map((cell) => Number(cell.textContent)));

/** Where the engine has the TCP. */
const engine = (robot, q, frame = "lab") => asked(robot, [{ op: "fk", q, in: frame }])[0].position_m;

/** Every slider moves its joint by keys, the arm and all numbers with it, and the TCP is where the engine has it. */
export async function slidersMove(page, robot, frame = "lab") {
  const sliders = page.locator("[data-arm] input[type=range]");
  const count = await sliders.count();
  assert.ok(count > 0, "no slider");
  for (let i = 0; i < count; i++) {
    const before = await shown(page);
    await sliders.nth(i).focus();
    for (const key of ["PageUp", "PageUp", "ArrowRight", "ArrowDown", "ArrowRight"]) await page.keyboard.press(key);
    const after = await shown(page);
    assert.ok(after.q[i] > before.q[i], `slider ${i} does not move its joint`);
    after.q.forEach((value, k) => k === i || assert.equal(value, before.q[k], `slider ${i} moves joint ${k}`));
    assert.notDeepEqual(after.poses, before.poses);
    engine(robot, after.q, frame).forEach((x, c) => assert.ok(Math.abs(x - after.tcp[c]) <= 1e-9, `the TCP is at ${after.tcp}, the engine's ${x}`));
    (await readout(page, "tcp")).forEach((x, c) => assert.ok(Math.abs(x - after.tcp[c]) <= 5.1e-5, `the page says ${x}, not ${after.tcp[c]}`));
    (await readout(page, "q")).forEach((x, k) => assert.ok(Math.abs(x - after.q[k]) <= 5.1e-5, `the page says ${x}, not ${after.q[k]}`));
    const words = await sliders.nth(i).getAttribute("aria-valuetext");
    assert.match(words, /^-?[\d.]+ (rad, -?[\d.]+ degrees|m)$/);
    // the ends are the joint's limits, and to the hundredth
    await page.keyboard.press("End");
    assert.equal((await shown(page)).q[i], Number(await sliders.nth(i).getAttribute("max")));
    await put(page, before.q);
  }
}

/** The picture follows the joints. */
export async function draws(page) {
  const stage = page.locator("[data-arm] .replay-stage");
  await stage.scrollIntoViewIfNeeded();
  const picture = async (q) => {
    await put(page, q);
    await frames(page, 3);
    // on a busy machine a picture is coarse at first: the one that stays
    let before = await stage.screenshot();
    await soon(async () => {
      await page.waitForTimeout(400);
      const now = await stage.screenshot();
      const same = now.equals(before);
      before = now;
      assert.ok(same, "the picture moves by itself");
    });
    return before;
  };
  const { q } = await shown(page);
  const [a, b, again] = [await picture(q), await picture(q.map((x) => x + 0.3)), await picture(q)];
  assert.ok(!a.equals(b), "the picture does not move");
  assert.ok(a.equals(again), "the same posture is another picture");
}

/** A switch shows what it names, says so in words, and is off again. */
export async function switchShows(page, name, selector, words) {
  const button = page.locator(`[data-arm] [data-switch=${name}]`);
  const marks = () => page.$$eval(`[data-arm] ${selector}`, (list) => list.filter((mark) => mark.style.display !== "none").length);
  if ((await button.getAttribute("aria-pressed")) === "true") await button.click();
  await soon(async () => assert.equal(await marks(), 0, `${name} is off and shows`), 20_000);
  await button.click();
  assert.equal(await button.getAttribute("aria-pressed"), "true");
  assert.match(await page.locator(`[data-arm-words=${name}]`).innerText(), words);
  await page.locator("[data-arm] .replay-stage").scrollIntoViewIfNeeded();
  await soon(async () => assert.ok((await marks()) > 0, `${name} shows nothing`), 20_000);
  await button.click();
  assert.equal(await page.locator(`[data-arm-words=${name}]`).isVisible(), false);
}
