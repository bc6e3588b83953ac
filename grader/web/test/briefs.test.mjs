// The brief of every lab, opened from disk: its arm moves by its sliders, its numbers are the engine's, and the page asks for nothing.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import * as arm from "./arm_checks.mjs";
import { courseBriefs, ownBrief, temporary } from "./arms.mjs";
import { launch } from "./browser.mjs";
import { open } from "./opened.mjs";
import * as check from "./page_checks.mjs";

const folder = temporary();
const briefs = courseBriefs(folder);
const [browser, flat] = [await launch(), await launch({ webgl: false })];
after(async () => {
  await browser.close();
  await flat.close();
});

/** Opens a brief, does what is asked, and finds it quiet. */
async function visit(brief, options, does, from = browser) {
  const page = await open(from, brief, { width: 1100, height: 900, reducedMotion: "reduce", ...options });
  try {
    await does(page);
    arm.quiet(page, brief);
  } finally {
    await page.close();
  }
}

for (const [name, { brief, robot, frame }] of Object.entries(briefs)) {
  test(`${name}: sliders move the arm, and its numbers are the engine's`, () => visit(brief, {}, (page) => arm.slidersMove(page, robot, frame)));

  test(`${name}: light, dark and on a phone it fits, and axe finds nothing`, () =>
    visit(brief, { width: 390, height: 844 }, async (page) => {
      for (const colorScheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme });
        await check.fits(page);
        await check.accessible(page);
      }
    }));
}

const { brief, robot } = briefs["02-jacobian-velocity"];
const pressed = (page) => page.$$eval("[data-switch]", (list) => list.map((one) => [one.dataset.switch, one.ariaPressed === "true"]));

test("switches are off at first, but for what the lab is about", async () => {
  const wanted = { "01-kinematics": "branches", "02-jacobian-velocity": "jacobian", "04-knock-with-velocity": "jacobian", "05-rppr": "branches", "06-typed-robots": "jacobian" };
  for (const [name, { brief }] of Object.entries(briefs)) {
    await visit(brief, {}, async (page) => {
      assert.deepEqual(await pressed(page), ["branches", "jacobian", "ellipse"].map((one) => [one, wanted[name] === one]), name);
    });
  }
});

test("switches show branches, columns of the Jacobian and the ellipse, and say what they are", () =>
  visit(brief, {}, async (page) => {
    await arm.switchShows(page, "jacobian", ".arm-arrow", /1 rad\/s/);
    await arm.switchShows(page, "ellipse", ".arm-ring", /not singular/);
    await page.click("[data-switch=branches]");
    await arm.put(page, [0.4, -1.1]);
    const { q, others, poses } = await arm.shown(page);
    assert.equal(others.length, 1);
    assert.ok(Math.abs(others[0][1] + q[1]) < 1e-9 && poses.forearm.length === 7);
    await arm.put(page, [0.4, 0]);
    assert.match(await page.locator("[data-arm-words=branches]").innerText(), /none/);
    await page.click("[data-switch=ellipse]");
    assert.match(await page.locator("[data-arm-words=ellipse]").innerText(), /= 0\.0000, singular/);
  }));

test("the picture follows the joints", () => visit(brief, {}, arm.draws));

test("everything is reached by Tab, seen and named", () =>
  visit(brief, {}, async (page) => {
    assert.ok((await check.keyboardWalk(page)) >= 9);
  }));

test("without WebGL the arm is drawn flat, says so, and moves", () =>
  visit(brief, {}, async (page) => {
    assert.match(await page.locator("[data-arm] .replay-note").innerText(), /WebGL/);
    await arm.slidersMove(page, robot);
    await arm.switchShows(page, "ellipse", ".arm-ring", /singular/);
    const outline = () => page.$eval("[data-arm] .replay-side", (svg) => svg.outerHTML);
    const before = await outline();
    await arm.put(page, [1.5, 0.2]);
    await page.waitForFunction((before) => document.querySelector("[data-arm] .replay-side").outerHTML !== before, before);
  }, flat));

test("without scripts the picture and the text remain, and nothing else takes room", () =>
  visit(brief, { javaScriptEnabled: false }, async (page) => {
    assert.ok((await page.locator("main img").first().boundingBox()).height > 100);
    assert.equal((await page.locator("[data-arm]").boundingBox())?.height ?? 0, 0);
  }));

// robots that are no arm of two links: more joints, slides, axes of all directions, a mimic
for (const [name, wanted] of Object.entries({ puma560: ["branches", "jacobian", "ellipse"], rppr: ["branches", "jacobian", "ellipse"], mimic: ["jacobian", "ellipse"], redundant: ["jacobian", "ellipse"] })) {
  test(`${name}: its own sliders, and the switches that make sense for it`, () => {
    const { brief, robot, frame, info } = ownBrief(folder, name);
    return visit(brief, { width: 390 }, async (page) => {
      assert.deepEqual((await pressed(page)).map(([one]) => one), wanted);
      assert.equal(await page.locator("[data-arm] input[type=range]").count(), info.joints.length);
      await arm.slidersMove(page, robot, frame);
      await check.fits(page);
      await arm.switchShows(page, "jacobian", ".arm-arrow", /velocit|moves/);
    });
  });
}

const whole = readFileSync(brief, "utf8");
const broken = join(brief, "../broken.html");
const changed = (before, after) => {
  assert.notEqual(before, after, "nothing was broken");
  return after;
};
const inData = (change) => changed(whole, whole.replace(/(<script type="application\/json" id="arm">)([^<]*)/, (_, open, json) => {
  const data = JSON.parse(json);
  change(data);
  return open + JSON.stringify(data);
}));
/** The page with more code behind the viewer's, let in by its policy. */
const withScript = (more) => {
  const begin = whole.lastIndexOf("<script>") + "<script>".length;
  const end = whole.indexOf("</script>", begin);
  const code = `${whole.slice(begin, end)}\n${more}`;
  const hash = createHash("sha256").update(code).digest("base64");
  return changed(whole, (whole.slice(0, begin) + code + whole.slice(end)).replace(/sha256-[^']*'/, () => `sha256-${hash}'`));
};

for (const [what, text, does] of [
  ["a link that is a micrometre too long", inData((data) => (data.tcp.pose[2] += 1e-6)), (page) => arm.slidersMove(page, robot)],
  ["a read-out that is a digit off", withScript("new MutationObserver((_, one) => { one.disconnect(); const cell = document.querySelector('[data-readout=tcp] td:nth-child(2) span'); cell.textContent = Number(cell.textContent) + 0.001; one.observe(document.querySelector('[data-arm]'), { subtree: true, childList: true, characterData: true }); }).observe(document.querySelector('[data-arm]'), { subtree: true, childList: true, characterData: true })"), (page) => arm.slidersMove(page, robot)],
  ["keys that do nothing", withScript("addEventListener('keydown', (event) => { event.preventDefault(); event.stopImmediatePropagation(); }, true)"), (page) => arm.slidersMove(page, robot)],
  ["a warning in the console", withScript("console.warn('careful')"), (page) => arm.quiet(page, broken)],
  ["a picture from elsewhere", changed(whole, whole.replace("</main>", "<img alt='' src='../elsewhere.svg'></main>")), (page) => arm.quiet(page, broken)],
  ["code that the policy does not name", changed(whole, whole.replace("</main>", "</main><script>window.harmed = true</script>")), (page) => arm.quiet(page, broken)],
  ["a picture that stands still", changed(whole, whole.replace("</style>", "[data-arm] canvas{opacity:0}[data-arm] svg,.replay-labels{display:none}</style>")), arm.draws],
  ["arrows that are not drawn", withScript("document.querySelectorAll('.arm-arrow').forEach((one) => one.remove())"), (page) => arm.switchShows(page, "jacobian", ".arm-arrow", /rad/)],
]) {
  test(`${what} is found`, async () => {
    writeFileSync(broken, text);
    const page = await open(browser, broken, { width: 1100, height: 900, reducedMotion: "reduce", patience: 20_000 });
    await assert.rejects(async () => {
      await page.waitForTimeout(100);
      await does(page);
    }, { name: "AssertionError" });
    await page.close();
  });
}

test("data that cannot be read leave the page's picture, and a sentence", async () => {
  for (const text of [inData((data) => (data.joints[1].parent = 9)), inData((data) => (data.q = null)), changed(whole, whole.replace('id="arm">{', 'id="arm">['))]) {
    writeFileSync(broken, text);
    const page = await open(browser, broken, { reducedMotion: "reduce" });
    assert.match(await page.locator("[data-arm]").innerText(), /cannot be moved here/);
    assert.ok(await page.locator("main img").first().isVisible());
    arm.quiet(page, broken);
    await page.close();
  }
});
