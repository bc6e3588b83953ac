// Every report in a browser, opened from disk: the labs of the course with a good submission, and labs that are hard on a page.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { launch } from "./browser.mjs";
import { courseLabs, hardLabs, logsOf, reports } from "./graded.mjs";
import { open } from "./opened.mjs";
import * as check from "./page_checks.mjs";
import { soon } from "./waiting.mjs";

const folder = reports();
const browser = await launch();
after(() => browser.close());
const labs = [...courseLabs, ...hardLabs];
const report = (lab) => join(folder, lab, "report.html");
const logOf = (lab, task) => logsOf(join(folder, lab)).find((one) => one.task === task).path;

/** Opens the report of a lab, does what is asked, and finds it quiet. Pages jump, so that a slow machine need not wait for them to glide. */
async function visit(lab, options, does) {
  const page = await open(browser, report(lab), { reducedMotion: "reduce", ...options });
  try {
    await does(page);
    await check.quiet(page);
  } finally {
    await page.close();
  }
}

for (const lab of labs) {
  test(`${lab}: starts paused, and shows the poses of the trace`, () =>
    visit(lab, {}, async (page) => {
      await check.startsPaused(page);
      const all = await check.places(page);
      assert.ok(all.length > 0, "no replay");
      for (const [index, { task }] of all.entries()) await check.poseOfTheTrace(page, index, logOf(lab, task));
    }));

  test(`${lab}: clicks on plots and on moments seek`, () =>
    visit(lab, {}, async (page) => {
      const clicked = (await check.plotsSeek(page)) + (await check.momentsSeek(page));
      assert.ok(clicked > 0, "nothing to click on");
    }));

  for (const width of [390, 1440]) {
    test(`${lab}, ${width} pixels, light and dark: fits, and axe finds nothing grave`, () =>
      visit(lab, { width, height: 844 }, async (page) => {
        for (const colorScheme of ["light", "dark"]) {
          await page.emulateMedia({ colorScheme });
          await check.fits(page);
          await check.accessible(page);
        }
      }));
  }

  test(`${lab}: everything is reached by Tab, seen and named`, () =>
    visit(lab, {}, async (page) => {
      assert.ok((await check.keyboardWalk(page)) > 5);
    }));

  test(`${lab}: code and data are small`, (t) =>
    visit(lab, { javaScriptEnabled: true }, async (page) => {
      const found = await check.sizes(page);
      const seconds = [];
      for (let i = 0; i < found.tasks.length; i++) seconds.push(await check.lastTime(page, i));
      const sizes = found.tasks.map(({ task, replay, plots, meshes }, i) => `${task} (${seconds[i]} s) ${replay} + plots ${plots} + meshes ${meshes}`);
      t.diagnostic(`${lab}: code ${found.code} bytes; ${sizes.join("; ")}`);
      check.small(found, seconds);
    }));
}

test("the link of a moment opens there, paused", async () => {
  for (const [lab, task, t] of [["01-kinematics", "move", 2.35], ["04-knock-with-velocity", "knock", 1.005], ["long-run", "wander", 59.999]]) {
    await visit(lab, { fragment: `#task=${task}&t=${t}` }, async (page) => {
      const index = (await check.places(page)).findIndex((place) => place.task === task);
      await check.opensAt(page, index, t);
      // an address that changes in the open page leads there, too
      await page.evaluate((task) => (location.hash = `#task=${task}&t=0.5`), task);
      await page.waitForFunction((i) => Math.abs(window.kinemark.replays[i].shown().t - 0.5) < 1e-9, index);
    });
  }
});

test("a link to nowhere does no harm, and anchors of tasks keep working", async () => {
  // what the second task shows, and what the page says of the link
  const wrong = [
    ["#task=nowhere&t=1", 0, /no task “nowhere”.*It has: .*line/],
    ["#task=through-the-shoulder", 0, /^$/],
    ["#task=through-the-shoulder&t=NaN", 0, /“NaN” of this link cannot be read/],
    ["#task=through-the-shoulder&t=-3", 0, /^$/],
    ["#task=through-the-shoulder&t=1e99", 0, /“1e99” of this link cannot be read/],
    ["#task=%E0%A4%A&t=1", 0, /no task/],
    ["#t=1", 0, /^$/],
    ["#%%%", 0, /^$/],
    ["#task=__proto__&t=1", 0, /no task “__proto__”/],
    ["#task=through-the-shoulder&t=1&t=2", 2, /^$/],
  ];
  for (const [fragment, t, says] of wrong) {
    await visit("02-jacobian-velocity", { fragment }, async (page) => {
      await soon(async () => {
        assert.deepEqual(await page.evaluate(() => window.kinemark.replays.map((replay) => [replay.task, replay.shown().t])), [["line", 0], ["through-the-shoulder", t]], fragment);
        assert.match(await page.locator(".replay-notice p").allTextContents().then((all) => all.join("")), says, fragment);
      });
    });
  }
  await visit("02-jacobian-velocity", { fragment: "#task-3" }, async (page) => {
    await page.waitForFunction(() => document.getElementById("task-3").getBoundingClientRect().top < innerHeight && scrollY > 0);
  });
});

test("the keyboard steers the replay", async () => {
  for (const lab of ["01-kinematics", "03-knock-with-position", "humanoid"]) {
    await visit(lab, {}, async (page) => {
      for (const [index] of (await check.places(page)).entries()) await check.keysSteer(page, index);
    });
  }
});

test("the stage draws the motion, in light and in dark", async () => {
  for (const lab of ["03-knock-with-position", "meshes", "humanoid"]) {
    // the path of the TCP, so that more than the paper is of the other kind
    const paths = { light: ["006cae", "4a90c2"], dark: ["62b8f0", "487a9b"] };
    for (const colorScheme of ["light", "dark"]) {
      await visit(lab, { colorScheme }, async (page) => {
        const picture = await check.drawsMotion(page, 0);
        for (const [scheme, colours] of Object.entries(paths)) {
          const found = await check.coloured(page, picture, colours);
          assert.ok(scheme === colorScheme ? found > 5 : found === 0, `${lab}, ${colorScheme}: ${found} pixels of the ${scheme} path`);
        }
      });
    }
  }
});

test("a click on a moment glides to the replay", () =>
  visit("01-kinematics", { reducedMotion: "no-preference" }, async (page) => {
    await check.clickMoment(page);
    await page.waitForFunction(() =>
      [...document.querySelectorAll("[data-replay]")].some((place) => {
        const { top, bottom } = place.getBoundingClientRect();
        return top >= 0 && bottom <= innerHeight;
      }),
    );
  }));

test("who prefers less motion gets none that is not asked for", async () => {
  await visit("01-kinematics", {}, async (page) => {
    await check.startsPaused(page);
    await check.clickMoment(page);
    const [before, later] = await page.evaluate(
      () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
        const first = scrollY;
        setTimeout(() => done([first, scrollY]), 400);
      }))),
    );
    assert.equal(before, later, "the page glides");
    assert.deepEqual(await page.evaluate(() => document.getAnimations().map((animation) => animation.effect?.target?.className)), []);
  });
});

test("without WebGL a view from the side takes its place", async () => {
  const flat = await launch({ webgl: false });
  try {
    for (const lab of ["01-kinematics", "03-knock-with-position", "meshes", "humanoid", "hostile", "stopped"]) {
      const page = await open(flat, report(lab), { reducedMotion: "reduce" });
      assert.equal(await page.evaluate(() => Boolean(document.createElement("canvas").getContext("webgl2"))), false);
      const all = await check.places(page);
      for (const [index, { task }] of all.entries()) {
        await check.sideView(page, index);
        await check.poseOfTheTrace(page, index, logOf(lab, task));
      }
      await check.plotsSeek(page);
      // the browser itself says in its console that it was asked for what it does not have
      page.said = page.said.filter((line) => !/WebGL/.test(line));
      await check.quiet(page);
      await page.close();
    }
  } finally {
    await flat.close();
  }
});

test("without scripts the page is whole, and the replay takes no room", async () => {
  for (const lab of ["01-kinematics", "hostile"]) {
    await visit(lab, { javaScriptEnabled: false }, async (page) => {
      for (const place of await page.locator("[data-replay]").all()) assert.ok(((await place.boundingBox())?.height ?? 0) < 1);
      assert.ok((await page.locator("section").count()) > 0);
      // what is folded unfolds by itself
      for (const summary of await page.locator("details.more > summary").all()) await summary.click();
      assert.ok(await page.locator("figure svg").first().isVisible());
    });
  }
});

test("it prints, with a picture of the moment in place of the stage", async () => {
  await visit("03-knock-with-position", { fragment: "#task=knock&t=1.5" }, async (page) => {
    await page.waitForSelector("[data-replay] canvas");
    await page.evaluate(() => {
      window.printed = null;
      addEventListener("beforeprint", async () => {
        const pictures = [...document.querySelectorAll("[data-replay]")].map((place) => place.querySelector("img.replay-print"));
        window.printed = Promise.all(pictures.map(async (picture) => (await picture?.decode(), picture?.naturalWidth ?? 0)));
      });
    });
    const pdf = await page.pdf({ format: "A4" });
    assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
    assert.ok(pdf.length > 20_000, `${pdf.length} bytes`);
    const printed = await page.evaluate(() => window.printed);
    assert.ok(printed?.length === 2 && printed.every((width) => width > 300), `pictures as wide as ${JSON.stringify(printed)}`);
  });
});

// The aim is 4 ms. A machine under load may miss it, so the figure is printed and not asserted.
test("the time of its own code per frame is measured", async (t) => {
  for (const lab of ["03-knock-with-position", "humanoid", "long-run"]) {
    // a small stage: the software that stands in for a graphics card takes its time by the pixel
    await visit(lab, { width: 390, height: 500 }, async (page) => {
      const { median, p95, count } = await check.frameTimes(page, 0);
      t.diagnostic(`${lab}: median ${median.toFixed(2)} ms of own code per frame (aim: 4 ms), 95th percentile ${p95.toFixed(2)} ms, ${count} frames`);
      assert.ok(count > 0, `${lab}: nothing was measured`);
    });
  }
});

test("what a hostile submission says is shown, and does nothing", async () => {
  await visit("hostile", {}, async (page) => {
    const whole = await page.evaluate(() => document.body.textContent);
    for (const said of ["</script><script>window.harmed = 'script'</script>", "<img src=x onerror=\"window.harmed = 'onerror'\">", "⟨U+202E⟩", "⟨U+001B⟩[31m"]) {
      assert.ok(whole.includes(said), `${said} is not shown`);
    }
    assert.equal(await page.locator("iframe, img[src='x'], object, embed, [onerror], [onload]").count(), 0);
    assert.doesNotMatch(readFileSync(report("hostile"), "utf8"), /[\u0000-\u0008\u000b-\u001f\u202a-\u202e\u2066-\u2069]/);
    // everything that can be pressed is pressed
    for (const button of await page.locator("[data-replay] button").all()) {
      if (await button.isVisible()) await button.click();
      // a replay that fills the screen covers the next one
      await page.evaluate(() => document.fullscreenElement && document.exitFullscreen());
    }
    await check.plotsSeek(page);
    await check.momentsSeek(page, 40);
  });
});

test("the page's policy lets no other script in", async () => {
  const page = await open(browser, report("01-kinematics"));
  await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.harmed = 'inline'";
    document.body.append(script);
    document.body.insertAdjacentHTML("beforeend", "<img src='data:image/png;base64,AAAA' onerror=\"window.harmed = 'handler'\">");
  });
  await page.waitForTimeout(200);
  assert.equal(await page.evaluate(() => window.harmed), undefined);
  await page.close();
});
