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

function frame(now: number): void {
  asked = false;
  for (const listener of lasting) listener(now);
  // two lists take turns, so that no frame makes one
  const due = once;
  once = running;
  running = due;
  for (let i = 0; i < due.length; i++) due[i](now);
  due.length = 0;
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
