// The stretch of time that all plots of a task show: the whole run, or a part of it.

/** Frames of the run in the narrowest stretch. */
const LEAST_TICKS = 20;

export class TimeWindow {
  /** From and to \[s\]; null where it is the whole run. */
  shown: readonly [number, number] | null = null;
  private readonly listeners: Array<() => void> = [];

  constructor(
    private readonly start: number,
    private readonly end: number,
    private readonly stepS: number,
  ) {}

  on(listener: () => void): void {
    this.listeners.push(listener);
  }

  private put(shown: readonly [number, number] | null): void {
    this.shown = shown;
    for (const listener of this.listeners) listener();
  }

  /** Shows from one moment to another \[s\], in any order. */
  show(a: number, b: number): void {
    const whole = this.end - this.start;
    const width = Math.max(LEAST_TICKS * this.stepS, Math.abs(b - a));
    if (width >= whole) return this.reset();
    const middle = 0.5 * (a + b);
    const from = Math.min(this.end - width, Math.max(this.start, middle - 0.5 * width));
    this.put([from, from + width]);
  }

  /** Makes the stretch longer or shorter by a factor; the moment stays where it is. */
  zoom(factor: number, about: number): void {
    const [from, to] = this.shown ?? [this.start, this.end];
    const at = Math.min(to, Math.max(from, about));
    this.show(at - factor * (at - from), at + factor * (to - at));
  }

  /** Moves the stretch so far that a moment is in it. */
  hold(t: number): void {
    if (!this.shown) return;
    const [from, to] = this.shown;
    const edge = 0.1 * (to - from);
    if (t < from) this.show(t - edge, t - edge + (to - from));
    else if (t > to) this.show(t + edge - (to - from), t + edge);
  }

  reset(): void {
    if (this.shown) this.put(null);
  }
}
