// What a reader does with the viewer: pointer, keys, links, and the page that is loaded anew.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { test } from "node:test";
import { page as html, replay } from "./fixture.mjs";
import { browser, menu, near, one, open, seek, shown, write } from "./made.mjs";
import { frames, PATIENCE_MS, soon } from "./waiting.mjs";

const two = write("two.html", html([replay({ seconds: 2 }), replay({ task: "again", seconds: 3 })], { more: '<section class="task" id="task-9" data-task="fk"><h2>A task that only calculates</h2></section>' }));
const button = (page, name, i = 0) => page.getByRole("button", { name, exact: true }).nth(i);
const notice = (page) => page.locator(".replay-notice p");

test("a click on the slider seeks while it plays", async () => {
  const { page, close } = await open(one);
  await button(page, "Play").click();
  await page.waitForFunction(() => window.kinemark.replays[0].shown().tick > 0);
  const { x, y, width, height } = await page.locator(".replay-slider").boundingBox();
  await page.mouse.click(x + 0.75 * width, y + height / 2);
  near((await shown(page)).t, 3, 0.06, "the moment that was clicked");
  assert.equal(await button(page, "Play").count(), 1, "it plays on");
  await close();
});

test("one run plays at a time, and a single moment cannot be played", async () => {
  const { page, close } = await open(two);
  // both in one task, so that the first does not end before the second begins
  const labels = await page.locator(".replay-play").evaluateAll((all) => {
    for (const one of all) one.click();
    return all.map((one) => one.ariaLabel);
  });
  assert.deepEqual(labels, ["Play", "Pause"]);
  await close();
  const run = replay({ seconds: 0.5 });
  const cut = (track) => ({ ...track, count: 1, ticks: "AA==" });
  const zeros = (track) => ({ ...cut(track), data: Buffer.alloc(track.width).toString("base64") });
  const still = { ...run, ticks: "AA==", events: [], contacts: [] };
  still.tcp = zeros(run.tcp);
  still.q = run.q.map(zeros);
  still.tracks = run.tracks.map((track) => ({ ...cut(track), data: Buffer.from([0, 0, 0, 2, 0, 0, 0]).toString("base64") }));
  const single = await open(write("single.html", html([{ ...still, events: [{ tick: 500, kind: "stop", text: "stopped at once" }] }])));
  assert.ok(await button(single.page, "Play").isDisabled());
  assert.ok(await single.page.locator(".replay-slider").isDisabled());
  assert.deepEqual(single.wrong, []);
  await single.close();
});

test("a key that is held steps on, and does not play and pause in turn", async () => {
  const { page, close } = await open(one);
  await page.locator(".replay").focus();
  // a run that begins again does not end while the keys come
  await page.keyboard.press("l");
  await page.keyboard.down(" ");
  for (let i = 0; i < 3; i++) await page.keyboard.down(" ");
  assert.equal(await button(page, "Pause").count(), 1);
  await page.keyboard.up(" ");
  await page.keyboard.press("Home");
  for (let i = 0; i < 3; i++) await page.keyboard.down("ArrowRight");
  assert.equal((await shown(page)).tick, 30);
  await close();
});

test("the wheel scrolls the page, and zooms with Ctrl", async () => {
  const { page, close } = await open(one, { height: 600 });
  const stage = page.locator(".replay-stage");
  await stage.click();
  const box = await stage.boundingBox();
  await page.mouse.move(box.x + 50, box.y + 50);
  // first with Ctrl: a browser that scrolls already goes on, whatever comes
  const before = await page.evaluate(() => scrollY);
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, 120);
  await page.keyboard.up("Control");
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  assert.equal(await page.evaluate(() => scrollY), before);
  await page.mouse.wheel(0, 120);
  await page.waitForFunction((before) => scrollY > before, before);
  await close();
});

test("what a drag does, buttons do: turn, tilt and move", async () => {
  const { page, close } = await open(one);
  await page.waitForSelector(".replay canvas");
  await menu(page);
  await button(page, "Frames").click();
  const spot = () => page.locator(".replay-axis").first().evaluate((label) => label.style.transform);
  const moved = async (name) => {
    await frames(page, 3);
    const before = await spot();
    await button(page, name).click();
    await page.waitForFunction((before) => document.querySelector(".replay-axis").style.transform !== before, before);
  };
  for (const name of ["Turn left", "Turn up", "Turn down"]) await moved(name);
  await button(page, "Move").click();
  assert.equal(await button(page, "Move").getAttribute("aria-pressed"), "true");
  for (const name of ["Move left", "Move up", "Move right", "Move down"]) await moved(name);
  await close();
});

test("a mark's tip can be pointed at, and Escape takes it away from anywhere", async () => {
  // a hand takes its time from the mark to the tip: here it has four times as long, since each step of the pointer comes late on a busy machine
  const first = "{ const real = window.setTimeout; window.setTimeout = (act, ms, ...more) => real.call(window, act, ms === 250 ? 1000 : ms, ...more); }";
  const { page, close } = await open(one, { first });
  const tip = page.getByRole("tooltip");
  const mark = page.locator(".replay-targets button").nth(1);
  await mark.hover();
  await tip.waitFor();
  const box = await tip.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 2 });
  await page.waitForTimeout(1500);
  assert.ok(await tip.isVisible(), "it goes away under the pointer");
  await page.mouse.move(5, 5);
  await tip.waitFor({ state: "hidden" });
  await mark.hover();
  await tip.waitFor();
  // the focus is on the page itself
  assert.equal(await page.evaluate(() => document.activeElement === document.body), true);
  await page.keyboard.press("Escape");
  assert.ok(!(await tip.isVisible()));
  await close();
});

test("events at one moment have a mark each, and the marks are one stop of the tabulator", async () => {
  const run = replay();
  run.events.push({ tick: 2350, kind: "breach", text: "too far from the path" });
  const { page, close } = await open(write("same.html", html([run])));
  const marks = await page.locator(".replay-marks svg").evaluateAll((all) =>
    all.map((mark) => ({ kind: mark.classList[1], ...(({ left, top, width, height }) => ({ left, top, width, height }))(mark.getBoundingClientRect()) })));
  assert.ok(["contact", "breach"].every((kind) => marks.some((mark) => mark.kind === kind)));
  for (const a of marks) {
    for (const b of marks) {
      if (a !== b) assert.ok(Math.abs(a.left - b.left) >= a.width - 1 || Math.abs(a.top - b.top) >= a.height, `${a.kind} lies on ${b.kind}`);
    }
  }
  await page.locator(".replay-targets button").nth(2).click();
  const stops = () => page.locator(".replay-targets button").evaluateAll((all) => all.map((one) => one.tabIndex));
  assert.deepEqual(await stops(), [-1, -1, 0, -1, -1]);
  await page.keyboard.press("ArrowLeft");
  assert.deepEqual(await stops(), [-1, 0, -1, -1, -1]);
  await close();
});

test("where the run is, is said after a command, once for many", async () => {
  const { page, close } = await open(one);
  await page.evaluate(() => {
    window.said = [];
    new MutationObserver(() => {
      const text = document.querySelector(".replay [role=status]").textContent;
      if (text) window.said.push(text);
    }).observe(document.querySelector(".replay [role=status]"), { childList: true, characterData: true, subtree: true });
  });
  const said = async (some = true) => {
    if (some) await page.waitForFunction(() => window.said.length > 0);
    await page.waitForTimeout(600);
    return page.evaluate(() => window.said.splice(0));
  };
  await page.locator(".replay").focus();
  // five at once, as of a key that is held
  await page.locator(".replay").evaluate((root) => {
    for (let i = 0; i < 5; i++) root.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", repeat: i > 0, bubbles: true }));
  });
  assert.deepEqual(await said(), ["0.05 s"]);
  await button(page, "One frame on").click();
  assert.deepEqual(await said(), ["0.06 s"]);
  await page.keyboard.press("End");
  assert.deepEqual(await said(), ["4 s, stop: the time is over"]);
  await page.keyboard.press("Home");
  assert.deepEqual(await said(), ["0 s"]);
  // the slider announces it by itself
  const slider = page.locator(".replay-slider");
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  assert.deepEqual(await said(false), []);
  assert.equal(await slider.getAttribute("aria-valuetext"), "0.01 s");
  // a run that plays says nothing until it ends or stops
  await page.getByLabel("Speed").selectOption("4");
  await seek(page, 3.5);
  await button(page, "Play").click();
  await page.waitForFunction(() => window.kinemark.replays[0].shown().tick === 4000);
  assert.deepEqual(await said(), ["4 s, stop: the time is over, the end"]);
  assert.equal(await slider.getAttribute("aria-valuetext"), "4 s, the time is over");
  await close();
});

test("letters twice as large and narrow windows need no scrolling to the side", async () => {
  const run = replay({ joints: 7 });
  run.joints.forEach((joint, j) => (joint.name = `panda_joint${j + 1}`));
  const path = write("narrow.html", html([run]));
  for (const [width, size] of [[320, 100], [390, 200], [320, 200], [1280, 200]]) {
    const { page, close } = await open(path, { width, height: 800 });
    await page.evaluate((size) => (document.documentElement.style.fontSize = `${size}%`), size);
    await frames(page, 3);
    const wide = await page.locator(".replay").evaluate((root) => {
      const right = root.getBoundingClientRect().right;
      return [...root.querySelectorAll("*")]
        .filter((part) => part.checkVisibility() && !part.closest(".unseen,.replay-labels,.replay-side,.replay-events,svg") && (part.getBoundingClientRect().right > right + 1 || (part.clientWidth > 0 && part.scrollWidth > part.clientWidth + 1 && getComputedStyle(part).overflowX !== "visible")))
        .map((part) => `${part.tagName}.${part.className} ${part.textContent.slice(0, 30)}`);
    });
    assert.deepEqual(wide.filter((part) => !part.startsWith("SELECT")), [], `${width} px, ${size} %`);
    await close();
  }
});

test("names of joints are read whole", async () => {
  const run = replay({ joints: 7 });
  run.joints.forEach((joint, j) => (joint.name = `left_arm_panda_finger_joint${j + 1}`));
  const { page, close } = await open(write("names.html", html([run])));
  const cut = await page.locator(".replay-joints th").evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth || getComputedStyle(one).textOverflow === "ellipsis").map((one) => one.textContent));
  assert.deepEqual(cut, []);
  assert.equal(await page.locator(".replay-joints th").nth(3).getAttribute("title"), "left_arm_panda_finger_joint4");
  await close();
});

test("a link that cannot be followed is reported, and the rest of it is followed", async () => {
  const { page, wrong, close } = await open(`${two}#t=1.5&task=again`);
  await page.waitForFunction(() => window.kinemark.replays[1].shown().t === 1.5);
  assert.equal(await notice(page).count(), 0);
  const go = async (hash) => {
    // the page listens before this does
    await page.evaluate((hash) => new Promise((done) => {
      addEventListener("hashchange", done, { once: true });
      location.hash = hash;
    }), hash);
    return (await notice(page).allTextContents()).join("");
  };
  assert.match(await go("#task=nobody&t=1"), /no task “nobody”, which the link names\. It has: knock, again, fk\./);
  assert.equal(await go("#task=knock&t=0,7."), "");
  assert.equal((await shown(page)).t, 0.7);
  assert.match(await go("#task=knock&t=soon"), /“soon” of this link cannot be read/);
  assert.match(await go("#task=again&t=99"), /ends at 3 s, before the 99 s/);
  assert.equal((await shown(page, 1)).t, 3);
  assert.match(await go("#task=fk&t=1"), /fk has no replay/);
  assert.ok(await page.evaluate(() => document.activeElement.id === "task-9"));
  await page.locator(".replay-notice button").click();
  assert.equal(await notice(page).count(), 0);
  assert.equal(await go("#task=fk."), "");
  assert.deepEqual(wrong, []);
  await close();
});

test("the way back to the page as it was opened leads to the start", async () => {
  const { page, close } = await open(one);
  await page.locator("a.seek").nth(2).click();
  assert.equal((await shown(page)).tick, 2350);
  await page.waitForTimeout(600);
  await page.goBack();
  await page.waitForFunction(() => window.kinemark.replays[0].shown().t === 0);
  await page.waitForTimeout(600);
  assert.equal(await page.evaluate(() => location.hash), "");
  await page.goForward();
  await page.waitForFunction(() => window.kinemark.replays[0].shown().tick === 2350);
  await close();
});

test("the address is written seldom enough for every browser", async () => {
  const { page, close } = await open(one, {
    first: () => {
      window.written = [];
      const real = history.replaceState.bind(history);
      history.replaceState = (...all) => (window.written.push(performance.now()), real(...all));
    },
  });
  const written = await page.evaluate(async () => {
    for (let i = 0; i < 60; i++) {
      window.kinemark.replays[0].seek(i / 20);
      await new Promise((done) => setTimeout(done, 20));
    }
    return window.written;
  });
  assert.ok(written.length >= 1, "never");
  // the strictest browser allows a hundred in thirty seconds
  written.slice(1).forEach((at, i) => assert.ok(at - written[i] >= 300, `${at - written[i]} ms apart`));
  await close();
});

test("a page that is loaded anew by the server stands as it stood, also after one without replays", async () => {
  const script = readFileSync(new URL("../../cli/src/serve/reload.js", import.meta.url), "utf8");
  const digest = `'sha256-${createHash("sha256").update(script).digest("base64")}'`;
  const more = '<section id="more"><details><summary>Events</summary><p>much</p></details></section><p style="height:3000px"></p>';
  const whole = html([replay({ seconds: 2 }), replay({ task: "again", seconds: 3 })], { more });
  const broken = html([], { more: "<p>It does not build.</p>" });
  let version = 1;
  let waiting = [];
  const next = () => {
    version++;
    for (const answer of waiting.splice(0)) answer();
  };
  const server = createServer((asked, answer) => {
    const { pathname, searchParams } = new URL(asked.url, "http://localhost");
    const reply = () => answer.end(JSON.stringify({ version }));
    if (pathname === "/token/kinemark/changes") {
      if (searchParams.get("seen") === String(version)) waiting.push(reply);
      else reply();
    } else if (pathname === "/token/report.html") {
      const page = version === 2 ? broken : whole;
      answer.setHeader("content-type", "text/html");
      answer.end(page.replace(/script-src [^;]*/, (policy) => `${policy} ${digest}; connect-src 'self'`).replace("</body>", () => `<script data-seen="${version}">${script}</script></body>`));
    } else answer.writeHead(204).end();
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const context = await browser.newContext({ reducedMotion: "reduce", viewport: { width: 1000, height: 700 } });
  try {
    const page = await context.newPage();
    page.setDefaultTimeout(PATIENCE_MS);
    await page.goto(`http://127.0.0.1:${server.address().port}/token/report.html`);
    await seek(page, 2.5, 1);
    await seek(page, 1.25, 0);
    await page.waitForURL(/#task=knock&t=1\.25$/);
    await page.getByLabel("Speed").nth(1).selectOption("0.25");
    await menu(page, 1);
    await button(page, "Frames").click();
    await page.locator("summary").click();
    await page.evaluate(() => scrollTo(0, 2000));
    const anew = async (act) => {
      const loaded = page.waitForEvent("load");
      act();
      await loaded;
      // it scrolls in the second frame
      await frames(page, 4);
    };
    await anew(next);
    assert.match(await page.textContent("main"), /does not build/);
    await anew(next);
    await soon(async () => assert.deepEqual([(await shown(page, 0)).t, (await shown(page, 1)).t], [1.25, 2.5]));
    assert.deepEqual(await page.getByLabel("Speed").evaluateAll((all) => all.map((one) => one.value)), ["1", "0.25"]);
    assert.deepEqual(await page.locator(".replay-menu button", { hasText: "Frames" }).evaluateAll((all) => all.map((one) => one.ariaPressed)), ["false", "true"]);
    assert.ok(await page.locator("details").evaluate((part) => part.open));
    await page.waitForFunction(() => scrollY === 2000);
    await page.waitForURL(/#task=knock&t=1\.25$/);
    // by hand it is loaded as any page
    await page.reload();
    await soon(async () => assert.deepEqual([(await shown(page, 0)).t, (await shown(page, 1)).t], [1.25, 0]));
  } finally {
    await context.close();
    server.closeAllConnections();
    server.close();
  }
});
