// Each check of a report finds what it is there for: tried on reports that are broken on purpose, and on the same reports as they are.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { launch } from "./browser.mjs";
import { logsOf, reports } from "./graded.mjs";
import { open } from "./opened.mjs";
import * as check from "./page_checks.mjs";

const folder = reports();
const broken = mkdtempSync(join(tmpdir(), "kinemark-broken-"));
const browser = await launch();
after(async () => {
  await browser.close();
  rmSync(broken, { recursive: true, force: true });
});
const lab = "01-kinematics";
const whole = readFileSync(join(folder, lab, "report.html"), "utf8");
const changed = (before, after) => {
  assert.notEqual(before, after, "nothing was broken");
  return after;
};

/** The page with `first` before the viewer's code and `last` after it, let in by the page's policy. */
function withScript(page, { first = "", last = "" }) {
  const begin = page.lastIndexOf("<script>") + "<script>".length;
  const end = page.indexOf("</script>", begin);
  const code = `${first}\n${page.slice(begin, end)}\n${last}`;
  const hash = createHash("sha256").update(code).digest("base64");
  const policy = changed(page, page.replace(/script-src 'sha256-[^']*'/, () => `script-src 'sha256-${hash}'`));
  return policy.slice(0, policy.lastIndexOf("<script>") + "<script>".length) + code + policy.slice(policy.indexOf("</script>", policy.lastIndexOf("<script>")));
}
const script = (parts) => (page) => withScript(page, parts);
const style = (css) => (page) => changed(page, page.replace("</style>", () => `${css}</style>`));
const inBody = (markup) => (page) => changed(page, page.replace("</main>", () => `${markup}</main>`));
const withoutPolicy = (page) => changed(page, page.replace(/<meta http-equiv="Content-Security-Policy"[^>]*>/, ""));
const inData = (change) => (page) =>
  changed(page, page.replace(/(<script type="application\/json" id="replay-[^>]*>)([^<]*)(<\/script>)/g, (_, open, json, close) => {
    const data = JSON.parse(json);
    change(data);
    return open + JSON.stringify(data).replaceAll("<", "\\u003c") + close;
  }));

const moves = 0;
const log = logsOf(join(folder, lab)).find(({ task }) => task === "move").path;
const pose = (page) => check.poseOfTheTrace(page, moves, log);
// broken on purpose it takes more than 5 ms, however fast the machine
const slow = async (page) => assert.ok((await check.frameTimes(page, moves, 10)).median < 5, "slow frames");
/** What is broken never comes, so it is waited for only so long \[ms\]. */
const patience = 10_000;
const opens = (page) => check.opensAt(page, moves, 2.35);

const cases = [
  ["a warning in the console", check.quiet, script({ last: "console.warn('careful')" })],
  ["a picture that is asked for", check.quiet, (page) => inBody("<img alt='' src='https://example.org/x.png'>")(withoutPolicy(page))],
  ["a text that runs", check.quiet, (page) => inBody("<script>window.harmed = true</script>")(withoutPolicy(page))],
  ["a dialog", check.quiet, script({ last: "alert('hello')" })],
  ["a run that starts by itself", check.startsPaused, script({ last: "setInterval(() => { const [one] = window.kinemark.replays; one.seek(one.shown().t + 0.1); }, 50)" })],
  ["links a hundredth too far away", pose, inData(({ tracks }) => tracks.forEach(({ quanta }) => (quanta[2] *= 1.01)))],
  ["links turned the other way", pose, inData(({ tracks }) => tracks.forEach(({ quanta }) => (quanta[5] *= -1)))],
  ["a TCP that is two millimetres off", pose, inData(({ tcp }) => (tcp.quanta[0] *= 1.002))],
  ["a joint that is off", pose, inData(({ q }) => (q[1].quanta[0] *= 1.01))],
  ["a plot with the wrong time", check.plotsSeek, (page) => changed(page, page.replace(/(&quot;t&quot;:\[)([^,]*),([^\]]*)/g, (_, open, from, to) => `${open}${from},${1.2 * to}`))],
  ["moments that do not seek", check.momentsSeek, script({ last: "for (const kind of ['click', 'hashchange']) addEventListener(kind, (event) => { event.preventDefault(); event.stopImmediatePropagation(); }, true)" })],
  ["a link that opens at the start", opens, script({ last: "requestAnimationFrame(() => requestAnimationFrame(() => window.kinemark.replays.forEach((one) => one.seek(0))))" }), { fragment: "#task=move&t=2.35" }],
  ["a focus that is not seen", check.keyboardWalk, style("*:focus, *:focus-visible { outline: none !important; box-shadow: none !important }")],
  ["a button without a name", check.keyboardWalk, inBody("<button style='width:30px;height:30px'></button>")],
  ["a control that Tab does not reach", check.keyboardWalk, script({ last: "addEventListener('focusin', ({ target }) => { if (target.type === 'range') target.blur(); })" })],
  ["a button without a name, by axe", check.accessible, inBody("<button></button>")],
  ["grey on grey", check.accessible, style("p { color: #999 !important; background: #aaa !important }")],
  ["a page too wide for a phone", check.fits, inBody("<div style='width: 500px'>wide</div>"), { width: 390 }],
  ["keys that do nothing", (page) => check.keysSteer(page, moves), script({ last: "addEventListener('keydown', (event) => { event.preventDefault(); event.stopImmediatePropagation(); }, true)" })],
  ["a stage that stays empty", (page) => check.drawsMotion(page, moves), style("[data-replay] canvas { filter: opacity(0) }")],
  ["slow frames", slow, script({ first: "{ const draw = WebGL2RenderingContext.prototype.drawElements; WebGL2RenderingContext.prototype.drawElements = function (...all) { const begin = performance.now(); while (performance.now() - begin < 5); draw.apply(this, all); }; }" }), { width: 390, height: 500 }],
  ["too much code", async (page) => check.small(await check.sizes(page), [3, 8]), script({ first: `/* ${"x".repeat(500_000)} */` })],
  ["too much data", async (page) => check.small(await check.sizes(page), [3, 8]), inData((data) => (data.more = "x".repeat(300_000)))],
];

for (const [what, does, breaks, options] of cases) {
  test(`${what} is found`, async () => {
    const path = join(broken, "report.html");
    writeFileSync(path, breaks(whole));
    const page = await open(browser, path, { reducedMotion: "reduce", patience, ...options });
    await assert.rejects(async () => {
      await page.waitForTimeout(100);
      await does(page);
    }, (error) => {
      // a check that stumbles over something else has found nothing
      assert.match(error.name, /AssertionError|TimeoutError/, `${error}`);
      return true;
    });
    await page.close();
  });
}

test("a side view that is missing is found", async () => {
  const flat = await launch({ webgl: false });
  try {
    const path = join(broken, "report.html");
    for (const [breaks, fine] of [[(page) => page, true], [script({ last: "setInterval(() => document.querySelectorAll('[data-replay] svg').forEach((svg) => svg.remove()))" }), false]]) {
      writeFileSync(path, breaks(whole));
      const page = await open(flat, path, { reducedMotion: "reduce" });
      if (fine) await check.sideView(page, moves);
      else await assert.rejects(() => check.sideView(page, moves), { name: "AssertionError" });
      await page.close();
    }
  } finally {
    await flat.close();
  }
});
