// The one time of a task: every picture of it looks here, and every control writes here.

import type { Replay, RunEvent } from "./data";
import { FrameTimes, onFrame, stopFrames } from "./frames";

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4] as const;

/** A frame this late says that the machine slept \[s\]. */
const ASLEEP_S = 3;

/** What happened: the time moved; it came to rest (paused or sought); it played to its end; play, speed or loop changed. */
export type Change = "moved" | "rested" | "ended" | "changed";

export class Cursor {
  /** Moment that is shown \[s\]. */
  t: number;
  readonly start: number;
  readonly end: number;
  playing = false;
  speed = 1;
  loop = false;
  /** What the frames took while it played. */
  readonly frameTimes = new FrameTimes();
  private readonly listeners: Record<Change, Array<() => void>> = { moved: [], rested: [], ended: [], changed: [] };
  private last = 0;
  /** The moment that is gone back to, while another one is only looked at. */
  private kept: number | null = null;

  constructor(private readonly replay: Replay) {
    const { ticks, stepS } = replay;
    this.start = ticks[0] * stepS;
    this.end = ticks[ticks.length - 1] * stepS;
    this.t = this.start;
    document.addEventListener("visibilitychange", () => (this.last = 0));
  }

  on(change: Change, listener: () => void): void {
    this.listeners[change].push(listener);
  }

  private notify(change: Change): void {
    for (const listener of this.listeners[change]) listener();
  }

  get tick(): number {
    return Math.round(this.t / this.replay.stepS);
  }

  /** Time of a tick \[s\]; a whole rate is divided by, so that the time is the nearest number to its decimal. */
  timeOf(tick: number): number {
    const rate = Math.round(1 / this.replay.stepS);
    return Math.abs(rate * this.replay.stepS - 1) < 1e-9 ? tick / rate : tick * this.replay.stepS;
  }

  private put(t: number): void {
    this.t = Math.min(this.end, Math.max(this.start, t));
    this.notify("moved");
  }

  /** The moment of the tick nearest to one \[s\], within the run. */
  private nearest(t: number): number {
    const inside = Math.min(this.end, Math.max(this.start, t));
    return this.timeOf(Math.round(inside / this.replay.stepS));
  }

  /** Stops, and goes to the tick nearest to a moment \[s\]; what is no number changes nothing. */
  seek(t: number): void {
    if (Number.isNaN(t)) return;
    this.kept = null;
    this.stop();
    this.put(this.nearest(t));
    this.notify("rested");
  }

  /** Shows the tick nearest to a moment \[s\] until `back` or `stay`; a run that plays plays on. */
  peek(t: number): void {
    if (this.playing || Number.isNaN(t)) return;
    this.kept ??= this.t;
    this.put(this.nearest(t));
  }

  /** Leaves what is only looked at, for the moment where the run rests. */
  back(): void {
    if (this.kept === null) return;
    const t = this.kept;
    this.kept = null;
    this.put(t);
  }

  /** Rests at what was only looked at. */
  stay(): void {
    if (this.kept !== null) this.seek(this.t);
  }

  /** Where the run rests, whatever is only looked at \[s\]. */
  get rest(): number {
    return this.kept ?? this.t;
  }

  /** Stops, and goes to a tick. */
  seekTick(tick: number): void {
    this.seek(this.timeOf(tick));
  }

  /** Stops and goes `frames` frames on, or back where negative. */
  step(frames: number): void {
    this.seek(this.stepped(frames));
  }

  /** The moment `frames` frames on, or back where negative \[s\]. */
  stepped(frames: number): number {
    const ticks = this.replay.ticks;
    const tick = this.tick;
    let low = 0;
    let high = ticks.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (ticks[middle] < tick) low = middle + 1;
      else high = middle;
    }
    // between two frames a step back leads to the one before, a step on to the one after
    const here = low < ticks.length && ticks[low] === tick ? low : frames < 0 ? low : low - 1;
    return this.timeOf(ticks[Math.min(ticks.length - 1, Math.max(0, here + frames))]);
  }

  /** The next event after this moment, or the last before it. */
  event(direction: 1 | -1): RunEvent | undefined {
    const { events } = this.replay;
    const tick = this.tick;
    if (direction > 0) return events.find((event) => event.tick > tick);
    for (let i = events.length - 1; i >= 0; i--) if (events[i].tick < tick) return events[i];
    return undefined;
  }

  /** What happens at this tick. */
  now(): readonly RunEvent[] {
    const tick = this.tick;
    return this.replay.events.filter((event) => event.tick === tick);
  }

  /** Whether there is more than one moment. */
  get moves(): boolean {
    return this.end > this.start;
  }

  play(): void {
    if (this.playing || !this.moves) return;
    this.back();
    if (this.t >= this.end) this.put(this.start);
    this.playing = true;
    this.last = 0;
    onFrame(this.advance, this.frameTimes);
    this.notify("changed");
  }

  private stop(): void {
    if (!this.playing) return;
    this.playing = false;
    stopFrames(this.advance);
    this.notify("changed");
  }

  pause(): void {
    // a run is recorded in whole ticks, so it rests on one
    if (this.playing) this.seek(this.t);
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.notify("changed");
  }

  setLoop(loop: boolean): void {
    this.loop = loop;
    this.notify("changed");
  }

  private readonly advance = (now: number): void => {
    // a slow machine shows fewer frames and keeps the time; a page that was hidden or asleep goes on where it was
    const since = this.last === 0 ? 0 : (now - this.last) / 1000;
    const passed = since > ASLEEP_S ? 0 : since;
    this.last = now;
    const t = this.t + passed * this.speed;
    if (t < this.end) this.put(t);
    else if (this.loop) this.put(this.start + ((t - this.end) % (this.end - this.start)));
    else {
      this.t = this.end;
      this.pause();
      this.notify("ended");
    }
  };
}
