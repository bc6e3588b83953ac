// A page opened in a browser, from disk or from an address, while everything it says, asks for and opens is written down.
import { pathToFileURL } from "node:url";
import { PATIENCE_MS } from "./waiting.mjs";

/** What the driver says of a software renderer is not the page's. */
const isDriver = (text) => /GL Driver Message|GPU stall due to ReadPixels/.test(text);

/** Opens `path#fragment`, or an address; `first` runs in the page before its own code. `page.said` is what went wrong: messages, requests, dialogs, windows, errors. */
export async function open(browser, path, { fragment = "", width = 1000, height = 800, first, patience = PATIENCE_MS, ...context } = {}) {
  const own = await browser.newContext({ viewport: { width, height }, ...context });
  if (first) await own.addInitScript(first);
  const page = await own.newPage();
  page.said = [];
  page.setDefaultTimeout(patience);
  const url = /^http:/.test(path) ? path : pathToFileURL(path).href;
  page.on("console", (message) => {
    if (["error", "warning", "assert"].includes(message.type()) && !isDriver(message.text())) page.said.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => page.said.push(`error: ${error}`));
  page.on("dialog", (dialog) => {
    page.said.push(`dialog: ${dialog.message()}`);
    dialog.dismiss().catch(() => {});
  });
  page.on("popup", () => page.said.push("a window was opened"));
  page.on("download", () => page.said.push("a download was begun"));
  page.on("request", (request) => {
    if (!/^(data|blob):/.test(request.url()) && request.url().split("#")[0] !== url) page.said.push(`request: ${request.url()}`);
  });
  await page.goto(url + fragment);
  page.close = () => own.close();
  return page;
}
