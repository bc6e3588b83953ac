// When the screen is drawn anew: one request for all replays of the page, and none while nothing moves.

type Listener = (now: number) => void;

/** Frames whose time is remembered. */
const REMEMBERED = 600;

/** What the last frames took while something played \[ms\]: all of this page's code in them. */
export class FrameTimes {
  private readonly times = new Float64Array(REMEMBERED);
  private counted = 0;

  add(ms: number): void {
    this.times[this.counted++ % REMEMBERED] = ms;
  }

  /** The oldest first. */
  list(): number[] {
    const count = Math.min(this.counted, REMEMBERED);
    return Array.from({ length: count }, (_, i) => this.times[(this.counted - count + i) % REMEMBERED]);
  }
}

const lasting = new Map<Listener, FrameTimes>();
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
  const began = performance.now();
  for (const listener of lasting.keys()) listener(now);
  // two lists take turns, so that no frame makes one
  const due = once;
  once = running;
  running = due;
  for (let i = 0; i < due.length; i++) due[i](now);
  due.length = 0;
  for (const times of lasting.values()) times.add(performance.now() - began);
  if (lasting.size > 0 || once.length > 0) ask();
}

/** Calls at every frame until it is stopped, and remembers what these frames take. */
export function onFrame(listener: Listener, times: FrameTimes): void {
  lasting.set(listener, times);
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
