// When the screen is drawn anew: one request for all replays of the page, and none while nothing moves.

type Listener = (now: number) => void;

const lasting = new Set<Listener>();
let once: Listener[] = [];
let running: Listener[] = [];
let asked = false;

function ask(): void {
  if (asked) return;
  asked = true;
  requestAnimationFrame(frame);
}

/** Frames whose time is remembered. */
const REMEMBERED = 600;
const times = new Float64Array(REMEMBERED);
let counted = 0;

/** What the last frames took while something played \[ms\]: all of this page's code in them. */
export function frameTimes(): number[] {
  const count = Math.min(counted, REMEMBERED);
  return Array.from({ length: count }, (_, i) => times[(counted - count + i) % REMEMBERED]);
}

function frame(now: number): void {
  asked = false;
  const began = performance.now();
  const plays = lasting.size > 0;
  for (const listener of lasting) listener(now);
  // two lists take turns, so that no frame makes one
  const due = once;
  once = running;
  running = due;
  for (let i = 0; i < due.length; i++) due[i](now);
  due.length = 0;
  if (plays) times[counted++ % REMEMBERED] = performance.now() - began;
  if (lasting.size > 0 || once.length > 0) ask();
}

/** Calls at every frame until it is stopped. */
export function onFrame(listener: Listener): void {
  lasting.add(listener);
  ask();
}

export function stopFrames(listener: Listener): void {
  lasting.delete(listener);
}

/** Calls at the next frame, once however often it is asked. */
export function nextFrame(listener: Listener): void {
  if (!once.includes(listener)) once.push(listener);
  ask();
}
