// What must hold of a report in a browser, check by check. Each takes a page and throws where it does not hold, so that the checks
// themselves can be tried on pages that are broken on purpose.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { distance, framesInWorld, log } from "./log.mjs";
import { frames, PATIENCE_MS } from "./waiting.mjs";

const axeSource = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

/** Nothing was said in the console, asked for, or opened; nothing of the submission's ran. */
export async function quiet(page) {
  assert.deepEqual(page.said, []);
  assert.equal(await page.evaluate(() => window.harmed), undefined, "a text of the submission ran as a script");
}

/** Tasks with a replay, in order: `{ task, replay }`. A run that ended before its first row has a place, and nothing to replay. */
export const places = (page) =>
  page.$$eval("[data-replay]", (list) => {
    const all = list.map(({ dataset }) => ({ task: dataset.task, replay: dataset.replay }));
    return all.filter(({ replay }) => JSON.parse(document.getElementById(replay).textContent).tcp.count > 0);
  });

/** What replay `index` shows. */
export const shown = (page, index) => page.evaluate((i) => window.kinemark.replays[i].shown(), index);
export const seek = (page, index, t) => page.evaluate(([i, t]) => window.kinemark.replays[i].seek(t), [index, t]);

/** Every place has its replay, at its start and paused. */
export async function startsPaused(page) {
  const wanted = await places(page);
  // where there is nothing to replay, it says so
  const silent = await page.$$eval("[data-replay]", (list) => list.filter((place) => place.innerText.trim() === "").map(({ dataset }) => dataset.task));
  assert.deepEqual(silent, []);
  const found = await page.evaluate(() => window.kinemark?.replays.map(({ task }) => task));
  assert.deepEqual(found, wanted.map(({ task }) => task));
  const times = () => page.evaluate(() => window.kinemark.replays.map((replay) => replay.shown().t));
  const before = await times();
  assert.ok(before.every((t) => t === 0), `starts at ${before}`);
  await page.waitForTimeout(250);
  assert.deepEqual(await times(), before, "it moves by itself");
}

/** A few instants in [0, n): the same ones each time, with the first and the last among them. */
function instants(n, count) {
  const picked = new Set([0, n - 1]);
  for (let state = 12345; picked.size < Math.min(n, count); ) {
    state = (Math.imul(state, 1103515245) + 12345) >>> 0;
    picked.add(Math.floor((state / 2 ** 32) * n));
  }
  return [...picked].sort((a, b) => a - b);
}

/** As the page shows names that hold what is not seen. */
const plain = (name) => name.replace(/[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff]/g, (c) => `⟨U+${c.codePointAt(0).toString(16).toUpperCase().padStart(4, "0")}⟩`);

/** What is shown is what the log holds, at twenty instants: nodes, TCP and joints within 1e-3. */
export async function poseOfTheTrace(page, index, path) {
  const { topics } = await log(path);
  const [tf, tcp, states] = ["/tf", "/tcp", "/joint_states"].map((topic) => topics.get(topic));
  // what never moves stands in the log's scene, not among its frames
  const data = await page.evaluate((i) => document.getElementById([...document.querySelectorAll("[data-replay]")][i].dataset.replay).textContent, index);
  const standing = new Set(JSON.parse(data).nodes.filter(({ track }) => track === undefined).map(({ name }) => name));
  let compared = 0;
  for (const i of instants(tf.length, 20)) {
    const t = tf[i].ns / 1e9;
    await seek(page, index, t);
    const now = await shown(page, index);
    // the last row of a run that stopped may be beyond the last frame by less than a tick
    assert.ok(Math.abs(now.t - t) < 1.1e-3, `sought ${t} s, shown is ${now.t} s`);
    const frames = new Map([...framesInWorld(tf[i].content)].map(([name, pose]) => [plain(name), pose]));
    for (const [name, [x, y, z, ...q]] of Object.entries(now.nodes)) {
      // long names are cut on the page
      const begins = (found) => name.endsWith("…") && [name, `body/${name}`].some((one) => found.startsWith(one.slice(0, -1)));
      const frame = frames.get(name) ?? frames.get(`body/${name}`) ?? [...frames].find(([found]) => begins(found))?.[1];
      assert.ok(frame || standing.has(name), `the log has no frame ${name}`);
      if (!frame) continue;
      compared += 1;
      assert.ok(distance([x, y, z], frame.p) <= 1e-3, `${name} at ${t} s is ${distance([x, y, z], frame.p)} m off`);
      const same = Math.abs(q.reduce((sum, value, axis) => sum + value * frame.q[axis], 0));
      // the angle between the two turns: 2 acos(same), for small angles sqrt(8 (1 - same))
      assert.ok(Math.sqrt(8 * Math.max(0, 1 - same)) <= 1e-3, `${name} at ${t} s is turned`);
    }
    const at = tcp[i].content.pose.position;
    assert.ok(distance(now.tcp, [at.x, at.y, at.z]) <= 1e-3, `the TCP at ${t} s is at ${now.tcp}`);
    states[i].content.joints.forEach(({ name, position }, joint) => {
      assert.ok(Math.abs(now.q[joint] - position) <= 1e-3, `${name} at ${t} s is at ${now.q[joint]}, not ${position}`);
    });
  }
  const links = [...framesInWorld(tf[0].content).keys()].length;
  assert.ok(compared >= instants(tf.length, 20).length * Math.min(3, links), `only ${compared} poses were compared`);
}

/** Opens every folded part: what earned all its points is folded. */
async function unfold(page) {
  await page.$$eval("details", (list) => list.forEach((one) => (one.open = true)));
}

/** A click on any plot over time puts the cursor where it was clicked. */
export async function plotsSeek(page) {
  await unfold(page);
  const tasks = (await places(page)).map(({ task }) => task);
  const figures = await page.$$("figure[data-panels]");
  let clicked = 0;
  for (const figure of figures) {
    const { task, panels, view, labels } = await figure.evaluate((element) => ({
      task: element.dataset.task,
      panels: JSON.parse(element.dataset.panels),
      view: element.querySelector("svg").viewBox.baseVal.width,
      // numbers below the lowest panel, as a person reads them: [x, number]
      labels: [...element.querySelectorAll("text")]
        .map((text) => ({ value: Number(text.textContent.replace("−", "-") || NaN), box: text.getBBox() }))
        .filter(({ value, box }) => Number.isFinite(value) && box.y >= Math.max(...JSON.parse(element.dataset.panels).map((panel) => panel.box[3])))
        .map(({ value, box }) => [box.x + box.width / 2, value])
        .sort((a, b) => a[0] - b[0]),
    }));
    const panel = panels.find(({ kind }) => kind === "time");
    const index = tasks.indexOf(task);
    if (!panel || index < 0 || !(await figure.isVisible())) continue;
    const svg = await figure.$("svg");
    const [left, top, right, bottom] = panel.box;
    // a plot of many joints may be taller than the window
    await svg.evaluate((element, [share]) => {
      const { top, height } = element.getBoundingClientRect();
      scrollBy(0, top + share * height - innerHeight / 2);
    }, [(top + bottom) / 2 / (await svg.evaluate((element) => element.viewBox.baseVal.height))]);
    const box = await svg.boundingBox();
    const scale = box.width / view;
    assert.ok(labels.length >= 2, `${task}: the time axis has ${labels.length} numbers`);
    const [[x0, first], [x1, last]] = [labels[0], labels.at(-1)];
    const [t0, t1] = [left, right].map((x) => first + ((x - x0) / (x1 - x0)) * (last - first));
    for (const share of [0.3, 0.8]) {
      const x = box.x + (left + share * (right - left)) * scale;
      const y = box.y + ((top + bottom) / 2) * scale;
      await page.mouse.click(x, y);
      const { t } = await shown(page, index);
      const wanted = t0 + share * (t1 - t0);
      // a plot may reach beyond the run; a click is a pixel wide
      const end = await lastTime(page, index);
      const pixel = (t1 - t0) / ((right - left) * scale);
      assert.ok(Math.abs(t - Math.max(0, Math.min(wanted, end))) <= 2 * pixel + 0.0105, `${task}: a click at ${wanted} s shows ${t} s`);
      clicked += 1;
    }
  }
  return clicked;
}

/** The time of the last frame. */
export async function lastTime(page, index) {
  const before = await shown(page, index);
  await seek(page, index, 1e9);
  const { t } = await shown(page, index);
  await seek(page, index, before.t);
  return t;
}

/** A click on a linked moment shows it, and brings the replay into view; the address is its link. */
export async function momentsSeek(page, most = 12) {
  const all = await places(page);
  const links = await page.$$("a.seek");
  const step = Math.max(1, Math.ceil(links.length / most));
  let clicked = 0;
  for (let i = 0; i < links.length; i += step) {
    const link = links[i];
    // one in a folded part is reached by unfolding it
    await link.evaluate((element) => {
      for (let at = element; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
    });
    const href = await link.getAttribute("href");
    const wanted = new URLSearchParams(href.slice(1));
    const index = all.findIndex(({ task }) => task === wanted.get("task"));
    // a link to a run without a row leads to its place
    if (index < 0) {
      assert.ok(await page.$(`[data-task="${wanted.get("task")}"]`), `${href} leads nowhere`);
      continue;
    }
    await link.scrollIntoViewIfNeeded();
    const { x, y } = await link.evaluate((element) => {
      const [{ left, top, width, height }] = element.getClientRects();
      const [x, y] = [left + width / 2, top + height / 2];
      if (!element.contains(document.elementFromPoint(x, y))) throw new Error(`${element.href} is covered`);
      return { x, y };
    });
    await page.mouse.click(x, y);
    const now = await shown(page, index);
    const t = Math.min(Number(wanted.get("t")), await lastTime(page, index));
    assert.ok(Math.abs(now.t - t) <= 1.1e-3, `${href} shows ${now.t} s`);
    await page.waitForFunction((replay) => {
      const { top, bottom } = document.querySelector(`[data-replay="${replay}"]`).getBoundingClientRect();
      return top < innerHeight && bottom > 0;
    }, all[index].replay);
    clicked += 1;
  }
  return clicked;
}

/** Clicks on the first linked moment; one in a folded part is reached by unfolding it. */
export async function clickMoment(page) {
  await unfold(page);
  await page.locator("a.seek").first().click();
}

/** Opened by the link of a moment, the page shows it, paused and in view. */
export async function opensAt(page, index, t) {
  // the page goes there once it has its size
  const there = ([i, t]) => Math.abs(window.kinemark.replays[i].shown().t - t) <= 1.1e-3;
  await page.waitForFunction(there, [index, t]).catch(() => {});
  const now = await shown(page, index);
  assert.ok(Math.abs(now.t - t) <= 1.1e-3, `shows ${now.t} s, not ${t} s`);
  const { replay } = (await places(page))[index];
  await page.waitForFunction((replay) => {
    const { top, bottom } = document.querySelector(`[data-replay="${replay}"]`).getBoundingClientRect();
    return top < innerHeight && bottom > 0;
  }, replay);
  await page.waitForTimeout(250);
  assert.equal((await shown(page, index)).t, now.t, "it plays");
}

/** What can be used by the keyboard, as a person without a mouse meets it: everything is reached, seen and named. */
export async function keyboardWalk(page) {
  const all = await page.evaluate(() => {
    const wanted = "a[href], button, input, select, textarea, summary, [tabindex]";
    const list = [...document.querySelectorAll(wanted)].filter((element) => {
      if (element.tabIndex < 0 || element.disabled || element.type === "radio") return false;
      return element.checkVisibility({ visibilityProperty: true }) && element.getClientRects().length > 0;
    });
    list.forEach((element, i) => element.setAttribute("data-walk", i));
    document.activeElement?.blur();
    window.scrollTo(0, 0);
    return list.length;
  });
  const visited = new Set();
  const faults = [];
  // a place without a stop of its own may take the first Tab; a scroller without content to focus takes one, too
  for (let press = 0; press < 2 * all + 10 && visited.size < all; press++) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const element = document.activeElement;
      if (!element || element === document.body) return null;
      const { outlineStyle, outlineWidth, boxShadow } = getComputedStyle(element);
      const { width, height, top, bottom } = element.getBoundingClientRect();
      return {
        id: element.dataset.walk ?? element.closest("[data-walk]")?.dataset.walk,
        what: `${element.tagName.toLowerCase()} "${(element.ariaLabel ?? element.textContent).trim().slice(0, 40)}"`,
        ringed: (outlineStyle !== "none" && parseFloat(outlineWidth) >= 1) || boxShadow !== "none",
        named: Boolean((element.ariaLabel ?? "") || element.textContent.trim() || element.title || element.labels?.length || element.getAttribute("aria-labelledby")),
        small: width < 1 || height < 1,
        outside: bottom < 0 || top > innerHeight,
        control: ["BUTTON", "INPUT", "SELECT"].includes(element.tagName) ? [width, height] : null,
      };
    });
    if (!at) continue;
    visited.add(at.id);
    if (!at.ringed) faults.push(`${at.what}: the focus is not seen`);
    if (!at.named) faults.push(`${at.what}: has no name`);
    if (at.small || at.outside) faults.push(`${at.what}: is not seen where it has the focus`);
    if (at.control && Math.min(...at.control) < 24) faults.push(`${at.what}: is ${at.control.map((x) => x.toFixed(0)).join(" by ")} pixels`);
  }
  const missed = await page.$$eval("[data-walk]", (list, seen) => list.filter((e) => !seen.includes(e.dataset.walk)).map((e) => `${e.tagName} ${e.textContent.slice(0, 30)}`), [...visited]);
  assert.deepEqual(missed, [], "not reached by Tab");
  assert.deepEqual([...new Set(faults)], []);
  return all;
}

/** Space, arrows, Home, End and brackets, while a control of the replay has the focus. */
export async function keysSteer(page, index) {
  const { replay } = (await places(page))[index];
  // the first thing in the replay that takes the focus and is no field of its own
  await page.$eval(`[data-replay="${replay}"]`, (element) => {
    const stage = [...element.querySelectorAll("[tabindex='0'], button")].find((one) => one.checkVisibility());
    stage.focus();
  });
  const time = async () => (await shown(page, index)).t;
  const last = await lastTime(page, index);
  await page.keyboard.press("End");
  assert.ok(Math.abs((await time()) - last) < 1e-9, "End");
  await page.keyboard.press("Home");
  assert.equal(await time(), 0, "Home");
  const slider = await page.$(`[data-replay="${replay}"] input[type="range"], [data-replay="${replay}"] [role="slider"]`);
  assert.ok(slider, "no scrubber");
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  const one = await time();
  assert.ok(one > 0 && one < 0.1, `an arrow leads to ${one} s`);
  await page.keyboard.press("Shift+ArrowRight");
  const eleven = await time();
  assert.ok(eleven > one + 2 * one, `shift and an arrow lead from ${one} s to ${eleven} s`);
  await page.keyboard.press("ArrowLeft");
  assert.ok((await time()) < eleven, "an arrow to the left");
  await page.keyboard.press("Home");
  // a run that begins again does not end between the two keys
  await page.keyboard.press("l");
  await page.keyboard.press(" ");
  await page.waitForFunction((i) => window.kinemark.replays[i].shown().t > 0, index);
  await page.keyboard.press(" ");
  await page.keyboard.press("l");
  const paused = await time();
  await page.waitForTimeout(200);
  assert.equal(await time(), paused, "space does not pause");
  const events = await page.$eval(`script#${replay}`, (script) => JSON.parse(script.textContent).events.map(({ tick }) => tick));
  await seek(page, index, last);
  const end = (await shown(page, index)).tick;
  await page.keyboard.press("Home");
  // a run may be stopped a tick after its last row
  const later = [...new Set(events.map((tick) => Math.min(tick, end)))].filter((tick) => tick > 0).sort((a, b) => a - b);
  if (later.length > 0) {
    await page.keyboard.press("]");
    assert.equal((await shown(page, index)).tick, later[0], "] leads to the next event");
    if (later.length > 1) {
      await page.keyboard.press("]");
      await page.keyboard.press("[");
      assert.equal((await shown(page, index)).tick, later[0], "[ leads back");
    }
  }
}

/** What axe finds in a part of the page: `{ id, impact, message }`. */
export async function violations(page, part = "html") {
  if (!(await page.evaluate(() => "axe" in window))) {
    // the page's policy lets no script in: axe comes through the debugger
    await page.evaluate((await import("node:fs")).readFileSync(axeSource, "utf8"));
  }
  const found = await page.evaluate(
    async (part) => {
      const { violations } = await window.axe.run(part === "html" ? document : document.querySelector(part), {
        runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
        resultTypes: ["violations"],
      });
      return violations;
    },
    part,
  );
  return found.map(({ id, impact, nodes }) => ({
    id,
    impact,
    message: `${id} (${impact}): ${nodes.slice(0, 3).map(({ html, failureSummary }) => `${html.slice(0, 160)} ${failureSummary}`).join(" | ")}`,
  }));
}

/** No violation of a rule that axe calls serious or critical. */
export async function accessible(page) {
  const found = await violations(page);
  assert.deepEqual(found.filter(({ impact }) => ["serious", "critical"].includes(impact)).map(({ message }) => message), []);
  return found.map(({ id }) => id);
}

/** The page is no wider than the window. */
export async function fits(page) {
  const { wide, wider } = await page.evaluate(() => {
    const width = document.documentElement.clientWidth;
    const out = [...document.querySelectorAll("body *")].filter((element) => element.getBoundingClientRect().right > width + 1);
    // what is in something that scrolls by itself does not widen the page
    const free = out.filter((element) => {
      for (let at = element.parentElement; at && at !== document.body; at = at.parentElement) if (getComputedStyle(at).overflowX !== "visible") return false;
      return true;
    });
    return { wide: document.documentElement.scrollWidth - width, wider: free.slice(0, 5).map((e) => `${e.tagName}.${e.className}`) };
  });
  assert.ok(wide <= 0, `${wide} pixels too wide: ${wider}`);
}

/** Without WebGL there is a view from the side, with the same cursor, and a sentence that says so. */
export async function sideView(page, index) {
  const { replay } = (await places(page))[index];
  await page.$eval(`[data-replay="${replay}"]`, (element) => element.scrollIntoView());
  const last = await lastTime(page, index);
  const drawing = () => page.$$eval(`[data-replay="${replay}"] svg`, (list) => list.map((svg) => svg.outerHTML).sort((a, b) => b.length - a.length)[0] ?? "");
  await seek(page, index, 0);
  await frames(page, 3);
  const first = await drawing();
  assert.match(first, /<(path|polygon|polyline|line|circle)/, "no side view");
  await seek(page, index, last);
  await frames(page, 3);
  if (last > 0.2) assert.notEqual(await drawing(), first, "the side view does not move");
  assert.match(await page.$eval(`[data-replay="${replay}"]`, (element) => element.innerText), /WebGL|3D|3-D/, "it does not say why");
}

/** The picture on the stage follows time. */
export async function drawsMotion(page, index) {
  const { replay } = (await places(page))[index];
  await page.$eval(`[data-replay="${replay}"]`, (element) => element.scrollIntoView());
  const canvas = await page.waitForSelector(`[data-replay="${replay}"] canvas`);
  const last = await lastTime(page, index);
  const picture = async (t) => {
    await seek(page, index, t);
    // the viewer has drawn; a software renderer takes its time to show it, and is done when two pictures look the same
    await frames(page, 3);
    let before = await canvas.screenshot();
    for (const began = Date.now(); Date.now() - began < PATIENCE_MS; ) {
      await page.waitForTimeout(200);
      const now = await canvas.screenshot();
      if (await lookTheSame(page, now, before)) return now;
      before = now;
    }
    throw new assert.AssertionError({ message: "the picture does not come to rest" });
  };
  const start = await picture(0);
  if (last > 0.2) assert.ok(!(await lookTheSame(page, start, await picture(last / 2))), "the picture stands still");
  assert.ok(await lookTheSame(page, start, await picture(0)), "the same moment has two pictures");
  return start;
}

/** Whether no channel of a pixel differs by more than a browser's own: behind the stage is a gradient, which it draws in tiles, not
 * always with the same last bit. */
async function lookTheSame(page, one, other) {
  if (one.equals(other)) return true;
  const [a, b] = [await pixels(page, one), await pixels(page, other)];
  return a.length === b.length && a.every((value, i) => Math.abs(value - b[i]) <= 2);
}

/** How many pixels of a picture have one of some colours. */
export async function coloured(page, png, colours) {
  const data = await pixels(page, png);
  const wanted = colours.map((colour) => [0, 2, 4].map((at) => parseInt(colour.slice(at, at + 2), 16)));
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if (wanted.some((rgb) => rgb.every((value, c) => Math.abs(data[i + c] - value) <= 2))) count++;
  return count;
}

/** Red, green, blue and opacity of every pixel, decoded by the browser. */
async function pixels(page, png) {
  const text = await page.evaluate(async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let bytes = "";
    for (const byte of data) bytes += String.fromCharCode(byte);
    return btoa(bytes);
  }, `data:image/png;base64,${Buffer.from(png).toString("base64")}`);
  return Buffer.from(text, "base64");
}

/** Bytes of code, and bytes of each motion task without meshes, with its length [s]. */
export async function sizes(page) {
  return page.evaluate(() => {
    const bytes = (text) => new TextEncoder().encode(text).length;
    const scripts = [...document.scripts];
    const code = scripts.filter(({ type }) => type !== "application/json").reduce((sum, script) => sum + bytes(script.textContent), 0);
    const tasks = [...document.querySelectorAll("[data-replay]")].map((place) => {
      const text = document.getElementById(place.dataset.replay).textContent;
      const { meshes, ...rest } = JSON.parse(text);
      const section = place.closest("section") ?? place.parentElement;
      const replay = bytes(JSON.stringify(rest));
      const plots = [...section.querySelectorAll("figure")].reduce((sum, figure) => sum + bytes(figure.outerHTML), 0);
      // the viewer's own elements are not in the file
      return { task: place.dataset.task, replay, plots, meshes: bytes(JSON.stringify(meshes)) };
    });
    return { code, tasks };
  });
}

export function small({ code, tasks }, seconds) {
  assert.ok(code < 900_000, `${code} bytes of code`);
  for (const [i, { task, replay, plots }] of tasks.entries()) {
    const most = 300_000 * Math.max(1, seconds[i] / 10);
    assert.ok(replay + plots < most, `${task}: ${replay} + ${plots} bytes for ${seconds[i]} s`);
  }
}

/** Time of the viewer's own code per frame while it plays [ms]: median, 95th percentile, count. The first frames make shaders and do not count. */
export async function frameTimes(page, index, wanted = 20) {
  const { replay } = (await places(page))[index];
  const place = `[data-replay="${replay}"]`;
  await page.$eval(place, (element) => element.scrollIntoView());
  await page.waitForSelector(`${place} canvas`);
  await seek(page, index, 0);
  await (await page.$(`${place} input[type="range"], ${place} [role="slider"]`)).focus();
  await page.keyboard.press("l");
  await page.keyboard.press(" ");
  const first = 5;
  await page.waitForFunction(([i, count]) => window.kinemark.replays[i].frameTimes().length >= count, [index, first + wanted]);
  const all = (await page.evaluate((i) => Array.from(window.kinemark.replays[i].frameTimes()), index)).slice(first).sort((a, b) => a - b);
  await page.keyboard.press(" ");
  await page.keyboard.press("l");
  return { median: all[Math.floor(all.length / 2)], p95: all[Math.floor(all.length * 0.95)], count: all.length };
}
