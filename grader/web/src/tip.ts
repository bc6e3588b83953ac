// What something is, shown beside it while it is pointed at or has focus: it stays while the pointer is on it, and Escape takes it away.

import { element } from "./dom";

/** So long a pointer may be between a thing and its tip \[ms\]. */
const WAY_MS = 250;

export class Tip {
  readonly element = element("div", { class: "replay-tip", role: "tooltip" });
  private timer = 0;

  constructor() {
    this.element.hidden = true;
    this.element.addEventListener("pointerleave", () => this.leave());
  }

  /** Shows lines above the middle of something \[px\], inside of what it is positioned in. */
  show(lines: readonly string[], middle: number): void {
    clearTimeout(this.timer);
    this.element.replaceChildren(...lines.map((line) => element("p", {}, line)));
    if (this.element.hidden) document.addEventListener("keydown", this.key, true);
    this.element.hidden = false;
    const room = (this.element.parentElement?.clientWidth ?? 0) - this.element.offsetWidth;
    this.element.style.left = `${Math.max(0, Math.min(room, middle - 0.5 * this.element.offsetWidth))}px`;
  }

  /** Hides it unless the pointer comes to it. */
  leave(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => !this.element.matches(":hover") && this.hide(), WAY_MS);
  }

  hide(): void {
    clearTimeout(this.timer);
    this.element.hidden = true;
    document.removeEventListener("keydown", this.key, true);
  }

  private readonly key = (event: KeyboardEvent): void => {
    if (event.key === "Escape") this.hide();
  };
}
