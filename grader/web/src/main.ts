// Where the page's replays and arms begin: each is read for itself, so that a bad one does not stop the others.

import { LiveArm } from "./arm";
import { readArm } from "./arm_data";
import { read } from "./data";
import { element } from "./dom";
import { Address, meant, parse, type Moment } from "./links";
import { Notice } from "./notice";
import { Replay, type State } from "./replay";
import { bring, sections } from "./sections";

const replays: Replay[] = [];
const address = new Address();
const notice = new Notice();
/** Whether the moments are those of before the page was loaded anew. */
let restored = false;

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

const arms: LiveArm[] = [];

/** Where it fails, the page's own picture of the arm is still there. */
function startArm(root: HTMLElement): void {
  const text = document.getElementById(root.dataset.arm ?? "")?.textContent;
  try {
    if (!text) throw new Error("its data is missing from this page");
    arms.push(new LiveArm(root, readArm(text)));
  } catch (error) {
    const why = error instanceof Error ? error.message : "its data cannot be read";
    root.replaceChildren(element("p", { class: "replay-note" }, `The arm cannot be moved here: ${why}.`));
    root.classList.add("off");
  }
}

/** Goes where a link leads, and says what of it cannot be had. */
function visit(moment: Moment | null, atOnce = false): void {
  if (!moment) return;
  const said: string[] = [];
  if (moment.unread !== null) said.push(`The time “${moment.unread}” of this link cannot be read. Give the time in seconds, as in #task=${moment.task}&t=2.35.`);
  const places = sections();
  const task = meant(moment.task, [...replays.map((one) => one.task), ...places.keys()]);
  const replay = replays.find((one) => one.task === task);
  if (replay) {
    const { end } = replay.cursor;
    if (moment.t !== null && moment.t > end + 0.01) said.push(`The run of ${replay.task} ends at ${Number(end.toFixed(4))} s, before the ${moment.t} s of this link.`);
    replay.visit(moment.t, atOnce);
  } else if (task !== undefined) {
    if (moment.t !== null) said.push(`The task ${task} has no replay, so there is no ${moment.t} s to show.`);
    bring(places.get(task)!, atOnce);
  } else {
    const known = [...new Set([...replays.map((one) => one.task), ...places.keys()])];
    said.push(`This page has no task “${moment.task}”, which the link names. It has: ${known.join(", ")}.`);
  }
  if (said.length > 0) notice.say(said.join(" "));
  else notice.clear();
}

for (const root of document.querySelectorAll<HTMLElement>("[data-replay]")) start(root);
for (const root of document.querySelectorAll<HTMLElement>("[data-arm]")) startArm(root);
for (const replay of replays) {
  // one run is looked at at a time
  replay.cursor.on("changed", () => {
    if (replay.cursor.playing) for (const other of replays) if (other !== replay) other.cursor.pause();
  });
}

addEventListener("hashchange", () => {
  address.forget();
  if (location.hash !== "") visit(parse(location.hash));
  // back to where the page was opened: as it was then
  else for (const replay of replays) replay.quietly(() => replay.cursor.seek(replay.cursor.start));
});
document.addEventListener("click", (event) => {
  const link = event.target instanceof Element ? event.target.closest("a.seek") : null;
  if (!(link instanceof HTMLAnchorElement) || event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
  const moment = parse(link.hash);
  if (!moment) return;
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
requestAnimationFrame(() => restored || visit(parse(location.hash), true));

Object.assign(window, {
  kinemark: {
    replays: replays.map((replay) => ({
      task: replay.task,
      shown: () => replay.shown(),
      seek: (t: number) => replay.cursor.seek(t),
      frameTimes: () => replay.cursor.frameTimes.list(),
    })),
    arms: arms.map((arm) => ({ shown: () => arm.shown(), put: (q: number[]) => arm.put(q) })),
    /** How all replays stand, by task: for a page that loads itself anew. */
    state: (): Record<string, State> => {
      address.flush();
      return Object.fromEntries(replays.map((replay) => [replay.task, replay.state()]));
    },
    /** Puts them as they stood; the address stays, and so does the place on the page. */
    restore: (states: Record<string, State>) => {
      restored = true;
      for (const replay of replays) if (Object.hasOwn(states, replay.task)) replay.restore(states[replay.task]);
    },
  },
});
