// Where the page's replays begin: each is read for itself, so that a bad one does not stop the others.

import { read } from "./data";
import { element } from "./dom";
import { Address, parse, type Moment } from "./links";
import { Replay } from "./replay";

const replays: Replay[] = [];
const address = new Address();

function start(root: HTMLElement): void {
  const text = document.getElementById(root.dataset.replay ?? "")?.textContent;
  try {
    if (!text) throw new Error("its data is missing from this page");
    replays.push(new Replay(root, read(text), address));
  } catch (error) {
    const why = error instanceof Error ? error.message : "its data cannot be read";
    root.replaceChildren(element("p", { class: "replay-note" }, `This replay cannot be shown: ${why}.`));
    root.classList.add("off");
  }
}

function visit(moment: Moment | null, atOnce = false): boolean {
  const replay = moment && replays.find((one) => one.task === moment.task);
  if (!replay) return false;
  replay.visit(moment.t, atOnce);
  return true;
}

for (const root of document.querySelectorAll<HTMLElement>("[data-replay]")) start(root);

addEventListener("hashchange", () => visit(parse(location.hash)));
document.addEventListener("click", (event) => {
  const link = event.target instanceof Element ? event.target.closest("a.seek") : null;
  if (!(link instanceof HTMLAnchorElement) || event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
  const moment = parse(link.hash);
  if (!moment || !replays.some((one) => one.task === moment.task)) return;
  event.preventDefault();
  // the moment one came from stays behind the browser's button that leads back
  address.flush();
  if (location.hash !== link.hash) {
    try {
      history.pushState(null, "", link.hash);
    } catch {
      // without an address of its own the page still seeks
    }
  }
  visit(moment);
});
addEventListener("beforeprint", () => replays.forEach((replay) => replay.toPaper()));
addEventListener("afterprint", () => replays.forEach((replay) => replay.toScreen()));
addEventListener("pagehide", () => address.flush());
// once the page has its size, so that it scrolls to where the replay is
requestAnimationFrame(() => visit(parse(location.hash), true));

Object.assign(window, {
  kinemark: {
    replays: replays.map((replay) => ({
      task: replay.task,
      shown: () => replay.shown(),
      seek: (t: number) => {
        replay.cursor.pause();
        replay.cursor.seek(t);
      },
      frameTimes: () => replay.frameTimes(),
    })),
  },
});
