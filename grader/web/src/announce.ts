// What a screen reader announces: moments and events that were sought, never every frame.

import { element } from "./dom";

export class Announcer {
  readonly element = element("div", { class: "unseen", "aria-live": "polite", role: "status" });
  private timer = 0;

  say(text: string): void {
    // a region that was just emptied and filled again is read out even where the words are the same
    this.after(() => text, 60);
  }

  /** Says something once nothing else was said for a while: of keys that are held, the last. */
  soon(text: () => string): void {
    this.after(text, 400);
  }

  private after(text: () => string, ms: number): void {
    clearTimeout(this.timer);
    this.element.textContent = "";
    this.timer = window.setTimeout(() => {
      this.element.textContent = text();
    }, ms);
  }
}
