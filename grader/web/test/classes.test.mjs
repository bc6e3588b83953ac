// The pages of a class, and the list of its book, in a browser: they fit, axe finds nothing grave, everything is reached by Tab; the list
// sorts and filters, and is a plain list without scripts.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { launch } from "./browser.mjs";
import { course, lab, served } from "./classes.mjs";
import { open } from "./opened.mjs";
import * as check from "./page_checks.mjs";

const folder = course();
const { address, close } = await served(join(folder, "book"));
const browser = await launch();
after(async () => {
  await browser.close();
  close();
});
const pages = Object.fromEntries(["class", "students", "similar"].map((name) => [name, join(folder, "book/pages", lab, `${name}.html`)]));
pages.list = address;

/** Opens a page, does what is asked, and finds it quiet. */
async function visit(name, options, does) {
  const page = await open(browser, pages[name], { reducedMotion: "reduce", ...options });
  try {
    await does(page);
    await check.quiet(page);
  } finally {
    await page.close();
  }
}

for (const name of Object.keys(pages)) {
  // 640 pixels are a window of 1280 at 200 %
  for (const [width, deviceScaleFactor] of [[390, 1], [640, 2], [1440, 1]]) {
    test(`${name}, ${width} pixels, light and dark: fits, and axe finds nothing grave`, () =>
      visit(name, { width, height: 844, deviceScaleFactor }, async (page) => {
        for (const colorScheme of ["light", "dark"]) {
          await page.emulateMedia({ colorScheme });
          await check.fits(page);
          await check.accessible(page);
        }
      }));
  }

  test(`${name}: everything is reached by Tab, seen and named`, () =>
    visit(name, {}, async (page) => {
      assert.ok((await check.keyboardWalk(page)) >= 5);
    }));
}

const ids = (page) => page.$$eval(".students tbody tr", (rows) => rows.filter((row) => row.checkVisibility()).map((row) => row.cells[1].textContent));
const points = (page) => page.$$eval(".students tbody tr", (rows) => rows.map((row) => Number(row.querySelector("[data-label=Points]").dataset.key)));

for (const name of ["students", "list"]) {
  test(`${name}: sorted by a click or a key, filtered by what is typed and chosen`, () =>
    visit(name, {}, async (page) => {
      assert.equal((await ids(page)).length, 24);
      const head = page.locator(".students thead th").filter({ hasText: "Points" });
      await head.getByRole("button").click();
      assert.equal(await head.getAttribute("aria-sort"), "ascending");
      const up = await points(page);
      assert.deepEqual(up, up.toSorted((a, b) => a - b));
      await head.getByRole("button").focus();
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), "descending");
      assert.deepEqual(await points(page), up.toSorted((a, b) => b - a));
      await page.getByLabel("Find").fill("jorg muller");
      assert.deepEqual((await ids(page)).sort(), ["s100", "s110", "s120"]);
      assert.equal(await page.getByRole("status").textContent(), "3 of 24");
      // Enter sends nothing anywhere
      await page.keyboard.press("Enter");
      await page.getByLabel("Find").fill("");
      await page.getByLabel("Status").selectOption({ label: "missing" });
      assert.deepEqual((await ids(page)).sort(), ["s110", "s121"]);
    }));
}

test("the list is a plain list without scripts, and its links lead to pages that work", async () => {
  const still = await open(browser, address, { javaScriptEnabled: false });
  assert.equal(await still.locator(".students tbody tr").count(), 24);
  assert.equal(await still.locator("#filters").isVisible(), false);
  assert.deepEqual(still.said, []);
  await still.close();
  const page = await open(browser, address, { width: 1200 });
  for (const link of ["the class, without names", "with names", "worth a conversation"]) {
    await page.getByRole("link", { name: link }).click();
    await page.waitForURL(/\/pages\//);
    assert.ok((await page.locator("h1").textContent()).length > 0);
    await page.goBack();
  }
  // from the page with names on to a report, whose replays run
  await page.getByRole("link", { name: "with names" }).click();
  await page.getByRole("link", { name: "Report of s100" }).click();
  await page.waitForURL(/\/reports\//);
  await page.waitForFunction(() => window.kinemark?.replays.length > 0);
  assert.deepEqual(page.said.filter((line) => !line.startsWith("request: ")), []);
  await page.close();
});
