// The viewer in a browser, from disk, on a made-up run.

import assert from "node:assert/strict";
import { test } from "node:test";
import { launch } from "./browser.mjs";
import { page as html, replay, truth } from "./fixture.mjs";
import { menu, near, one, open, shown, three, write } from "./made.mjs";
import { violations } from "./page_checks.mjs";
import { frames, soon } from "./waiting.mjs";

test("starts at the beginning, paused, and complains of nothing", async () => {
  const { page, wrong, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await page.waitForTimeout(300);
  const first = await shown(page);
  assert.equal(first.t, 0);
  assert.equal(await page.getByRole("button", { name: "Play", exact: true }).count(), 1);
  assert.deepEqual(wrong, []);
  await close();
});

test("what is shown at a moment is the run's", async () => {
  const { page, close } = await open(one);
  for (const t of [0, 0.812, 2.35, 3.9995, 4, 99, -1]) {
    await page.evaluate((t) => window.kinemark.replays[0].seek(t), t);
    const got = await shown(page);
    const { q, tcp } = truth(got.tick);
    near(got.t, Math.min(4, Math.max(0, t)), 6e-4, "t");
    q.forEach((value, j) => near(got.q[j], value, 1e-3, `q${j}`));
    near(got.tcp[0], tcp[0], 1e-3, "x");
    near(got.tcp[2] + 1.1, tcp[2], 1e-3, "z");
    assert.equal(got.nodes.forearm.length, 7);
  }
  await page.evaluate(() => window.kinemark.replays[0].seek(2.35));
  assert.equal((await page.locator("[data-readout=t]").textContent()).trim(), "2.350 s");
  assert.equal(await page.locator("[data-readout=tick]").textContent(), "2350");
  assert.match(await page.locator("[data-readout=tcp]").textContent(), /1\.3600/);
  assert.match(await page.locator("[data-readout=q]").textContent(), /shoulder.*rad.*°/);
  await close();
});

test("a link opens its moment, and the moment writes its link", async () => {
  const { page, close } = await open(`${one}#task=knock&t=2.35`);
  const at = (tick) => page.waitForFunction((tick) => window.kinemark.replays[0].shown().tick === tick, tick);
  await at(2350);
  assert.ok(await page.locator(".replay").evaluate((root) => root.getBoundingClientRect().top < innerHeight && document.activeElement === root));
  await page.keyboard.press("ArrowRight");
  await page.waitForURL(/#task=knock&t=2\.36$/);
  await page.evaluate(() => (location.hash = "#task=knock&t=1"));
  await at(1000);
  await page.evaluate(() => (location.hash = "#task=nobody&t=2"));
  await page.locator(".replay-notice p").waitFor();
  assert.equal((await shown(page)).tick, 1000);
  await page.locator("a.seek").nth(2).click();
  assert.equal((await shown(page)).tick, 2350);
  // the same link again, after the time has moved on
  await page.keyboard.press("End");
  await page.locator("a.seek").nth(2).click();
  assert.equal((await shown(page)).tick, 2350);
  await close();
});

test("the keys do what they say, and only while the replay has focus", async () => {
  const { page, close } = await open(one);
  const tick = async () => (await shown(page)).tick;
  await page.keyboard.press("]");
  assert.equal(await tick(), 0);
  await page.locator(".replay").focus();
  const walk = [["ArrowRight", 10], ["Shift+ArrowRight", 110], ["ArrowLeft", 100], ["Shift+ArrowLeft", 0], ["]", 800], ["]", 812], ["[", 800], ["End", 4000], ["[", 3280], ["Home", 0]];
  for (const [key, wanted] of walk) {
    await page.keyboard.press(key);
    assert.equal(await tick(), wanted, key);
  }
  await page.keyboard.press("l");
  assert.equal(await page.getByRole("button", { name: "Loop" }).getAttribute("aria-pressed"), "true");
  await page.keyboard.press(" ");
  assert.equal(await page.getByRole("button", { name: "Pause" }).count(), 1);
  await page.waitForFunction(() => window.kinemark.replays[0].shown().tick > 0);
  await page.keyboard.press(" ");
  const rested = await shown(page);
  assert.ok(rested.tick > 0 && rested.t === rested.tick / 1000, JSON.stringify(rested.t));
  // the stage's arrows turn the view and leave the time
  await page.locator(".replay-stage").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await tick(), rested.tick);
  // the slider's arrows step by frames
  await page.locator(".replay-slider").focus();
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowUp");
  assert.equal(await tick(), 10);
  await page.keyboard.press("]");
  assert.equal(await page.locator(".replay-slider").getAttribute("aria-valuetext"), "0.8 s, shoulder at its greatest effort");
  await page.waitForFunction(() => /^0\.8 s, saturation: shoulder/.test(document.querySelector(".replay [role=status]").textContent));
  await close();
});

test("it plays to the end at the speed that is set, and stops there", async () => {
  const { page, close } = await open(write("short.html", html([replay({ seconds: 0.5 })])));
  await page.getByLabel("Speed").selectOption("4");
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(() => window.kinemark.replays[0].shown().tick === 500);
  await page.waitForSelector("button[aria-label=Play]");
  // from its start again; looked at in the same task, before a frame goes on
  const tick = await page.evaluate(() => {
    document.querySelector("button[aria-label=Play]").click();
    return window.kinemark.replays[0].shown().tick;
  });
  assert.equal(tick, 0);
  await close();
});

test("nothing is drawn while nothing moves", async () => {
  const { page, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await page.evaluate(() => {
    window.asked = 0;
    const real = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (f) => (window.asked++, real(f));
  });
  // a page that was just opened may have a few frames to come
  await soon(async () => {
    const asked = await page.evaluate(() => new Promise((done) => {
      window.asked = 0;
      setTimeout(() => done(window.asked), 1000);
    }));
    assert.equal(asked, 0);
  });
  await close();
});

test("a plot shows the cursor, seeks, and shows values beside the pointer", async () => {
  for (const width of [1440, 390]) {
    const { page, close } = await open(one, { viewport: { width, height: 900 } });
    const figure = page.locator("figure[data-panels]").first();
    await figure.scrollIntoViewIfNeeded();
    const at = await figure.locator("svg").first().evaluate((svg) => {
      const box = svg.getBoundingClientRect();
      const scale = box.width / 6400;
      return { x: box.left + (680 + 0.5 * (6200 - 680)) * scale, quarter: box.left + (680 + 0.25 * (6200 - 680)) * scale, y: box.top + 1200 * scale };
    });
    for (const x of [at.x, at.quarter]) {
      await page.mouse.move(x, at.y);
      const values = figure.locator(".replay-values");
      await values.waitFor();
      const text = await values.textContent();
      assert.match(text, /s.*shoulder.*rad.*elbow.*rad|s.*elbow.*rad.*shoulder.*rad/);
      const [box, frame] = [await values.boundingBox(), await figure.boundingBox()];
      assert.ok(x < box.x || x > box.x + box.width, `covers the pointer at ${width}`);
      assert.ok(box.x >= frame.x - 1 && box.x + box.width <= frame.x + frame.width + 1, `leaves the figure at ${width}: ${JSON.stringify({ box, frame })}`);
      assert.ok(box.y >= frame.y - 1 && box.y + box.height <= frame.y + frame.height + 1);
    }
    const read = Number(/elbow(-?[\d.]+)/.exec(await figure.locator(".replay-values").textContent())[1]);
    near(read, truth(1000).q[1], 0.02, "elbow at 1 s");
    await page.mouse.click(at.x, at.y);
    near((await shown(page)).t, 2, 0.01, "sought");
    await page.keyboard.press("Escape");
    assert.ok(!(await figure.locator(".replay-values").isVisible()), "Escape hides the values wherever the focus is");
    const line = await figure.locator(".replay-cursor").evaluate((line) => line.getBoundingClientRect().left);
    near(line, at.x, 1.5, "cursor");
    const dot = await page.locator(".replay-dot").evaluate((dot) => {
      const [box, svg] = [dot.getBoundingClientRect(), dot.ownerSVGElement.getBoundingClientRect()];
      return [(box.left + box.width / 2 - svg.left) / (svg.width / 6400), (box.top + box.height / 2 - svg.top) / (svg.width / 6400)];
    });
    const { tcp } = truth(2000);
    near(dot[0], 3200 + 1200 * tcp[0], 25, "dot across");
    near(dot[1], 2600 - 1200 * (tcp[2] - 1.1), 25, "dot up");
    await close();
  }
});

test("a plot is read by keys, and its values are read out", async () => {
  const { page, close } = await open(one);
  const figure = page.locator("figure[data-panels]").first();
  await page.locator("figure[data-panels] svg").first().waitFor();
  await figure.focus();
  await page.keyboard.press("End");
  await page.keyboard.press("Shift+ArrowLeft");
  const { t, q } = await shown(page);
  near(t, 3.9, 1e-9, "ten frames before the end");
  const values = figure.locator(".replay-values");
  assert.ok(await values.isVisible());
  near(Number(/elbow(-?[\d.]+)/.exec(await values.textContent())[1]), q[1], 0.02, "elbow");
  await page.waitForFunction(() => /^3\.9 s; shoulder -?[\d.]+\u00a0rad, elbow/.test(document.querySelector(".replay [role=status]").textContent));
  await page.keyboard.press("Escape");
  assert.ok(!(await values.isVisible()));
  await close();
});

test("the link of the moment can be copied", async () => {
  const { page, close } = await open(one);
  await page.locator(".replay").focus();
  await page.keyboard.press("]");
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.waitForSelector(".replay-shared code");
  assert.equal(await page.locator(".replay-shared code").textContent(), "one.html#task=knock&t=0.8");
  await page.waitForURL(/#task=knock&t=0\.8$/);
  await close();
});

test("two runs are identified by their names", async () => {
  const { page, close } = await open(write("two.html", html([{ ...replay({ seconds: 0.5 }), mainLabel: "A", ghostLabel: "B" }])));
  assert.match(await page.locator(".replay-legend").textContent(), /run A.*run B.*path of run B/);
  await menu(page);
  await page.getByRole("button", { name: "Run B" }).click();
  assert.equal(await page.getByRole("button", { name: "Run B" }).getAttribute("aria-pressed"), "false");
  await close();
});

test("the whole run is in the picture from every side", async () => {
  const { page, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await menu(page);
  for (const view of ["Fit", "Side", "Top"]) {
    await page.getByRole("button", { name: view, exact: true }).click();
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    // the edge of the picture is ground and grid, which are grey; arm, path and goal have colours
    const touched = await page.locator(".replay-print").evaluate(async (image) => {
      await image.decode();
      const canvas = document.createElement("canvas");
      const [w, h] = [(canvas.width = image.naturalWidth), (canvas.height = image.naturalHeight)];
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, w, h);
      let edge = 0;
      let inside = 0;
      for (let y = 0; y < h; y++) {
        for (let x = 0; x < w; x++) {
          const i = 4 * (y * w + x);
          const colourful = Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 60;
          if (!colourful) continue;
          if (x < 4 || y < 4 || x > w - 5 || y > h - 5) edge++;
          else inside++;
        }
      }
      return { edge, inside };
    });
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    assert.ok(touched.edge === 0 && touched.inside > 300, `${view}: ${JSON.stringify(touched)}`);
  }
  await close();
});

test("an event's mark is named, pressed, and recognised by shape", async () => {
  const { page, close } = await open(one);
  const marks = page.getByRole("group", { name: "Events" }).getByRole("button");
  const names = await marks.evaluateAll((all) => all.map((mark) => mark.getAttribute("aria-label")));
  assert.equal(names.length, 5);
  assert.match(names[0], /^0\.8 s, saturation: shoulder .*; 0\.812 s, /);
  await marks.nth(1).hover();
  assert.equal(await page.getByRole("tooltip").textContent(), "2.35 s, contact: forearm touches can");
  await marks.nth(1).click();
  assert.equal((await shown(page)).tick, 2350);
  const shapes = await page.locator(".replay-events .replay-mark path").evaluateAll((all) => new Set(all.map((path) => path.getAttribute("d"))).size);
  assert.equal(shapes, 6);
  await close();
});

test("no serious barrier is found, light, dark and narrow", async () => {
  for (const options of [{}, { colorScheme: "dark" }, { viewport: { width: 390, height: 844 } }]) {
    const { page, close } = await open(`${one}#task=knock&t=2.35`, options);
    await page.waitForFunction(() => window.kinemark.replays[0].shown().tick === 2350);
    await frames(page, 3);
    assert.deepEqual((await violations(page, ".replay")).map(({ message }) => message), []);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} px too wide`);
    const small = await page.locator(".replay :is(button, select, input)").evaluateAll((all) =>
      all.filter((one) => one.getClientRects().length && (one.offsetWidth < 24 || one.offsetHeight < 24)).map((one) => one.outerHTML.slice(0, 80)));
    assert.deepEqual(small, []);
    await close();
  }
});

test("a bad replay leaves the others alone", async () => {
  const { page, close } = await open(three);
  assert.deepEqual(await page.evaluate(() => window.kinemark.replays.map((one) => one.task)), ["knock", "long"]);
  assert.match(await page.locator(".replay.off").textContent(), /^This replay cannot be shown: stepS is not a number\.$/);
  await close();
});

test("words from outside stay words", async () => {
  const run = replay({ seconds: 0.5 });
  const bad = '</script><img src=x onerror="window.hit=1"><!--';
  Object.assign(run, { title: bad, ended: bad });
  run.events.forEach((event) => (event.text = bad));
  run.nodes.forEach((node) => (node.name = bad));
  run.frames.forEach((frame) => (frame.name = bad));
  run.joints.forEach((joint) => (joint.name = bad));
  const { page, wrong, close } = await open(write("hostile.html", html([run])));
  await menu(page);
  await page.getByRole("button", { name: "Frames" }).click();
  // the menu lies over the marks
  await page.keyboard.press("Escape");
  await page.locator(".replay-targets button").first().hover();
  await page.waitForTimeout(200);
  assert.equal(await page.evaluate(() => [window.hit, document.querySelectorAll(".replay img").length].join()), ",0");
  assert.deepEqual(wrong, []);
  await close();
});

test("without WebGL the run is drawn flat, with the same cursor and controls", async () => {
  const flat = await launch({ webgl: false });
  try {
    const { page, wrong, close } = await open(`${one}#task=knock&t=2.35`, {}, flat);
    assert.match(await page.locator(".replay-note").textContent(), /no WebGL, so the run is drawn flat/);
    await menu(page);
    assert.equal(await page.getByRole("button", { name: "Side" }).isVisible(), false);
    const dot = () => page.locator(".side-tcp").evaluate((dot) => [Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy"))]);
    const { tcp } = truth(2350);
    await soon(async () => {
      const [x, y] = await dot();
      near(x, tcp[0], 1e-3, "x");
      near(-y, tcp[2], 1e-3, "z");
    });
    await page.locator(".replay").focus();
    await page.keyboard.press("Home");
    await soon(async () => near((await dot())[0], truth(0).tcp[0], 1e-3, "x at the start"));
    assert.deepEqual(wrong.filter((text) => !/WebGL/.test(text)), []);
    await close();
  } finally {
    await flat.close();
  }
});

test("contexts are made near the screen and given back far from it", async () => {
  const { page, wrong, close } = await open(three);
  await page.addStyleTag({ content: "section{margin-bottom:6000px!important}" }).catch(() => {});
  const canvases = () => page.locator(".replay canvas").count();
  await page.waitForSelector(".replay canvas");
  assert.equal(await canvases(), 1);
  await page.locator(".replay.on").nth(1).scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelectorAll(".replay.on")[1].querySelector("canvas"));
  await page.waitForFunction(() => !document.querySelectorAll(".replay.on")[0].querySelector("canvas"));
  await page.locator(".replay.on").first().scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelectorAll(".replay.on")[0].querySelector("canvas"));
  assert.equal(await page.locator(".replay-note:visible").count(), 1, "only the bad one has a note");
  assert.deepEqual(wrong.filter((text) => !/style/i.test(text)), []);
  await close();
});

test("on paper a picture stands in for the canvas", async () => {
  const { page, close } = await open(`${one}#task=knock&t=2.35`);
  await page.waitForSelector(".replay canvas");
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const picture = page.locator(".replay-print");
  assert.match(await picture.getAttribute("src"), /^data:image\/png/);
  assert.match(await picture.getAttribute("alt"), /2\.35 s, contact/);
  const painted = await picture.evaluate(async (image) => {
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    const colours = new Set();
    for (let i = 0; i < data.length; i += 40) colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return colours.size;
  });
  assert.ok(painted > 50, `${painted} colours`);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await picture.count(), 0);
  await close();
});

test("the time of its own code per frame is measured", async () => {
  const { page, close } = await open(write("many.html", html([replay({ seconds: 10, joints: 25 })])), { viewport: { width: 900, height: 700 } });
  await page.waitForSelector(".replay canvas");
  await page.getByRole("button", { name: "Loop" }).click();
  const began = Date.now();
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(() => window.kinemark.replays[0].frameTimes().length > 25);
  const times = (await page.evaluate(() => window.kinemark.replays[0].frameTimes())).sort((a, b) => a - b);
  const passed = Date.now() - began;
  const median = times[times.length >> 1];
  console.log(`frames: median ${median.toFixed(2)} ms of own code (aim: 4 ms), ${times.length} frames`);
  assert.ok(times.every((ms) => ms >= 0) && times.reduce((sum, ms) => sum + ms, 0) <= passed, `${times} in ${passed} ms`);
  await close();
});
