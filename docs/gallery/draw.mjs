// Draws pages as pictures: node docs/gallery/draw.mjs PAGE.html NAME WIDTH... writes docs/gallery/NAME-WIDTH-light.webp and -dark.webp.
// With the place of a check before the widths, such as `#task-2-check-down`, the picture is what a window shows of that check and of the replay at its moment.
//
// Needs Chromium (by its Debian name, or the one in CHROMIUM) and the packages of grader/web (`npm ci` there). `draw.sh` calls it for
// every lab. Replays show a telling moment: a little after the arm first meets something, else where two fifths of the run are over.
// A page that is too tall for a picture is drawn to where it is cut, and reported on standard output: `NAME-WIDTH shows the beginning`.
import { writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const { chromium } = createRequire(new URL("../../grader/web/package.json", import.meta.url))("playwright-core");
const [path, name, ...rest] = process.argv.slice(2);
const check = rest[0]?.startsWith("#") ? rest.shift() : undefined;
const widths = rest;
if (widths.length === 0) {
  console.error("usage: node draw.mjs PAGE.html NAME WIDTH...");
  process.exit(2);
}
const gallery = dirname(fileURLToPath(import.meta.url));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars"],
});

/** Runs in the page. */
function showTellingMoments() {
  for (const [i, place] of document.querySelectorAll("[data-replay]").entries()) {
    const replay = window.kinemark?.replays[i];
    if (!replay) continue;
    const { events, stepS } = JSON.parse(document.getElementById(place.dataset.replay).textContent);
    // bodies that stand on each other touch from the first tick on
    const met = events.find(({ kind, tick }) => kind === "contact" && tick * stepS > 0.1);
    replay.seek(1e9);
    replay.seek(met ? met.tick * stepS + 0.15 : 0.4 * replay.shown().t);
  }
}

/** Runs in an empty page: puts pieces of a page (PNG, each with its distance from the top) together as one WebP. */
async function joined({ pieces, width, height }) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  for (const { data, top } of pieces) {
    const piece = new Image();
    piece.src = `data:image/png;base64,${data}`;
    await piece.decode();
    canvas.getContext("2d").drawImage(piece, 0, top);
  }
  return canvas.toDataURL("image/webp", 0.6).split(",")[1];
}

/** Writes what a window shows of the check and of the replay at the check's first moment. */
async function drawCheck(page, file, width) {
  const height = Math.round(width * 0.66);
  await page.setViewportSize({ width, height });
  const at = page.locator(check);
  await at.locator("a.seek").first().click();
  await at.evaluate((element) => scrollTo(0, element.getBoundingClientRect().top + scrollY - 16));
  await page.mouse.move(0, 0);
  await page.waitForTimeout(1500);
  const data = (await page.screenshot()).toString("base64");
  const empty = await browser.newPage();
  writeFileSync(join(gallery, file), Buffer.from(await empty.evaluate(joined, { pieces: [{ data, top: 0 }], width, height }), "base64"));
  await empty.close();
}

// WebP knows no picture taller than 16383 pixels: a longer page is cut off. What draws WebGL in software knows no window taller than
// 8192, so a page is drawn in pieces. The window keeps its height: the page would be laid out anew in another, and the pieces would not
// fit; where the last one cannot be scrolled to its place it overlaps the one before, and what is too much is cut off.
const tallest = 16383;
const piece = 4000;
for (const width of widths.map(Number)) {
  for (const colorScheme of ["light", "dark"]) {
    const page = await browser.newPage({ viewport: { width, height: piece }, colorScheme, reducedMotion: "reduce" });
    await page.goto(pathToFileURL(resolve(path)).href);
    if (check) {
      await drawCheck(page, `${name}-${width}-${colorScheme}.webp`, width);
      await page.close();
      continue;
    }
    await page.evaluate(showTellingMoments);
    const whole = await page.evaluate(() => document.documentElement.getBoundingClientRect().height);
    const height = Math.min(tallest, Math.ceil(whole));
    if (height < whole && colorScheme === "light") console.log(`${name}-${width} shows the beginning`);
    const pieces = [];
    for (let top = 0; top < height; top += piece) {
      await page.evaluate((top) => scrollTo(0, top), top);
      await page.waitForTimeout(1000);
      const data = (await page.screenshot()).toString("base64");
      pieces.push({ data, top: await page.evaluate(() => scrollY) });
    }
    await page.close();
    const empty = await browser.newPage();
    writeFileSync(join(gallery, `${name}-${width}-${colorScheme}.webp`), Buffer.from(await empty.evaluate(joined, { pieces, width, height }), "base64"));
    await empty.close();
  }
}
await browser.close();
