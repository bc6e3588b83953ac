// What the viewer does with the screen: contexts of WebGL, pixels, frames that come late, and paper.

import assert from "node:assert/strict";
import { test } from "node:test";
import { page as html, replay } from "./fixture.mjs";
import { menu, one, open, seek, three, write } from "./made.mjs";
import { frames, soon } from "./waiting.mjs";

/** A screen of which every frame takes so many ms by its own clock, however long it takes here. */
const clock = (ms) => `{
  let [now, due] = [1000, []];
  const frame = () => {
    const acts = due;
    due = [];
    now += ${ms};
    for (const act of acts) act(now);
  };
  window.requestAnimationFrame = (act) => due.push(act) === 1 && setTimeout(frame, 4);
}`;
const wide = (page) => page.locator(".replay canvas").evaluate((canvas) => canvas.width / canvas.clientWidth);

test("a picture that turned coarse while it played is sharp again once it rests", async () => {
  const { page, close } = await open(one, { first: clock(80), width: 500, height: 500 });
  await page.waitForSelector(".replay canvas");
  assert.equal(await wide(page), 1);
  await page.getByRole("button", { name: "Loop" }).click();
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(() => document.querySelector(".replay canvas").width < 0.8 * document.querySelector(".replay canvas").clientWidth);
  await page.getByRole("button", { name: "Pause" }).click();
  await page.waitForFunction(() => document.querySelector(".replay canvas").width === document.querySelector(".replay canvas").clientWidth);
  // and so it is after a drag
  await page.locator(".replay-stage").evaluate((stage) => stage.scrollIntoView());
  const box = await page.locator(".replay-stage").boundingBox();
  await page.mouse.move(box.x + 100, box.y + 100);
  await page.evaluate(() => document.querySelector(".replay-stage").addEventListener("pointerdown", (event) => (window.held = event.pointerId)));
  await page.mouse.down();
  // as a browser reports a drag: once for each frame
  const least = await page.evaluate(async () => {
    const stage = document.querySelector(".replay-stage");
    const canvas = stage.querySelector("canvas");
    let least = 1;
    for (let i = 0; i < 40; i++) {
      await new Promise((next) => requestAnimationFrame(next));
      stage.dispatchEvent(new PointerEvent("pointermove", { pointerId: window.held, clientX: 150 + i, clientY: 150 }));
      least = Math.min(least, canvas.width / canvas.clientWidth);
    }
    return least;
  });
  assert.ok(least < 0.8, "a drag that is too much for the machine stays sharp");
  await page.mouse.up();
  await page.waitForFunction(() => document.querySelector(".replay canvas").width === document.querySelector(".replay canvas").clientWidth);
  await close();
});

test("steps one by one do not make it coarse", async () => {
  const { page, close } = await open(one, { first: clock(80), width: 500, height: 500 });
  await page.waitForSelector(".replay canvas");
  await page.locator(".replay").focus();
  for (let i = 0; i < 25; i++) {
    await page.keyboard.press("ArrowRight");
    // the step's own frame, the one that looks how late it was, and one in which nobody does anything
    await frames(page, 3);
    assert.equal(await wide(page), 1, `after ${i + 1} steps`);
  }
  await close();
});

test("no context is held by what was scrolled past", async () => {
  const { page, wrong, close } = await open(three, { width: 900, height: 600 });
  await page.addStyleTag({ content: "section{margin-bottom:6000px!important}" }).catch(() => {});
  const tools = await page.context().newCDPSession(page);
  const held = async () => {
    await tools.send("HeapProfiler.collectGarbage");
    const { result } = await tools.send("Runtime.evaluate", { expression: "WebGL2RenderingContext.prototype" });
    const { objects } = await tools.send("Runtime.queryObjects", { prototypeObjectId: result.objectId });
    const { result: count } = await tools.send("Runtime.callFunctionOn", { objectId: objects.objectId, functionDeclaration: "function () { return this.length; }" });
    await tools.send("Runtime.releaseObject", { objectId: objects.objectId });
    return count.value;
  };
  const visit = async (i) => {
    await page.evaluate((i) => document.querySelectorAll(".replay.on")[i].scrollIntoView(), i);
    await page.waitForFunction((i) => {
      const [a, b] = [...document.querySelectorAll(".replay.on")].map((root) => Boolean(root.querySelector("canvas")));
      return i === 0 ? a && !b : b && !a;
    }, i);
  };
  for (let round = 0; round < 4; round++) for (const i of [1, 0]) await visit(i);
  // the one in use, and perhaps the one that went last
  await soon(async () => {
    const count = await held();
    assert.ok(count <= 2, `${count} contexts`);
  });
  assert.deepEqual(wrong.filter((text) => !/style/i.test(text)), []);
  await close();
});

/** The browser's own words about a context that a test takes away. */
const own = /CONTEXT_LOST_WEBGL/;

/** A clock on which the four seconds that a lost context is waited for never pass. */
const patient = "{ const real = window.setTimeout; window.setTimeout = (act, ms, ...more) => real.call(window, act, ms === 4000 ? 2 ** 31 - 1 : ms, ...more); }";

test("a context that was lost and comes back is drawn with again", async () => {
  const { page, wrong, close } = await open(one, { first: patient });
  await page.waitForSelector(".replay canvas");
  await page.evaluate(() => {
    window.first = document.querySelector(".replay canvas");
    window.taken = window.first.getContext("webgl2").getExtension("WEBGL_lose_context");
    window.taken.loseContext();
  });
  await page.waitForFunction(() => window.first.getContext("webgl2").isContextLost());
  await frames(page, 3);
  await seek(page, 2);
  await page.evaluate(() => window.taken.restoreContext());
  await page.waitForFunction(() => {
    const canvas = document.querySelector(".replay canvas");
    return canvas && canvas !== window.first && !canvas.getContext("webgl2").isContextLost();
  });
  await seek(page, 2.35);
  await frames(page, 3);
  assert.equal(await page.locator(".replay-note:visible").count(), 0);
  const painted = await page.evaluate(() => {
    dispatchEvent(new Event("beforeprint"));
    return document.querySelector(".replay-print").src.length;
  });
  assert.ok(painted > 10_000, `a picture of ${painted} characters`);
  assert.deepEqual(wrong.filter((text) => !own.test(text)), []);
  await close();
});

test("a context that stays lost gives way to the flat picture, without a word in the console", async () => {
  const { page, wrong, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await menu(page);
  await page.getByRole("button", { name: "Frames" }).click();
  await page.evaluate(() => document.querySelector(".replay canvas").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext());
  await page.waitForSelector(".replay-side");
  assert.match(await page.locator(".replay-note").textContent(), /was lost/);
  await page.waitForFunction(() => document.querySelector(".side-axis.x").hasAttribute("x2"));
  await seek(page, 1);
  await page.setViewportSize({ width: 700, height: 700 });
  await page.emulateMedia({ colorScheme: "dark" });
  await frames(page, 5);
  assert.deepEqual(wrong.filter((text) => !own.test(text)), []);
  await close();
});

/** Gives the screen other pixels, one ratio after another, and waits each time until the canvas has them. */
async function changePixels(page, act = async () => {}) {
  const tools = await page.context().newCDPSession(page);
  for (const ratio of [2, 1.5, 1]) {
    await tools.send("Emulation.setDeviceMetricsOverride", { width: 600, height: 600, deviceScaleFactor: ratio, mobile: false });
    await page.waitForFunction((ratio) => devicePixelRatio === ratio, ratio);
    await act();
    await page.waitForFunction((ratio) => {
      const canvas = document.querySelector(".replay canvas");
      return Math.abs(canvas.width / canvas.clientWidth - ratio) < 0.01;
    }, ratio);
  }
}

test("a window that moves to a screen of other pixels is drawn in these", async () => {
  const { page, close } = await open(one, { width: 600, height: 600 });
  await page.waitForSelector(".replay canvas");
  await changePixels(page);
  await close();
});

test("a picture is drawn in the pixels of its moment, also where no event and no timer says that they changed", async () => {
  const first = "window.ResizeObserver = class { constructor(act) { this.act = act; } observe() { setTimeout(this.act); } disconnect() {} }; window.setInterval = () => 0;";
  const { page, close } = await open(one, { width: 600, height: 600, first });
  await page.waitForSelector(".replay canvas");
  let t = 0;
  await changePixels(page, () => seek(page, ++t));
  await close();
});

test("names of frames are in the picture on paper, and not over it", async () => {
  const run = replay();
  // full blocks: how many pixels of a letter have the full colour is a matter of the font
  run.frames[0].name = "█".repeat(30);
  const { page, close } = await open(write("paper.html", html([run])));
  await page.waitForSelector(".replay canvas");
  const dark = () => page.evaluate(async () => {
    dispatchEvent(new Event("beforeprint"));
    const image = document.querySelector(".replay-print");
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    dispatchEvent(new Event("afterprint"));
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (Math.abs(data[i] - 0x1c) < 3 && Math.abs(data[i + 1] - 0x22) < 3 && Math.abs(data[i + 2] - 0x2c) < 3) count++;
    return count;
  });
  const before = await dark();
  await menu(page);
  await page.getByRole("button", { name: "Frames" }).click();
  await soon(async () => {
    const now = await dark();
    assert.ok(now > before + 100, `${now} dark pixels, ${before} without names`);
  });
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.locator(".replay-labels").isVisible(), false);
  await close();
});

test("a frame's name lies on none of its letters", async () => {
  const { page, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await menu(page);
  await page.getByRole("button", { name: "Frames" }).click();
  for (const view of ["Fit", "Side", "Top"]) {
    await page.getByRole("button", { name: view, exact: true }).click();
    await frames(page, 3);
    const meet = await page.evaluate(() => {
      const all = [...document.querySelectorAll(".replay-labels span")].map((label) => ({ text: label.textContent, letter: label.className !== "", box: label.getBoundingClientRect() }));
      // a name comes before its letters
      return all.flatMap((label, i) => (label.letter ? [] : all.slice(i + 1, i + 4).filter(({ box }) => box.left < label.box.right - 2 && box.right > label.box.left + 2 && box.top < label.box.bottom - 2 && box.bottom > label.box.top + 2).map((other) => `${label.text} on ${other.text}`)));
    });
    assert.deepEqual(meet, [], view);
  }
  await close();
});
