// What the page says of a link that it cannot follow, where it is seen, until it is closed or the next link is followed.

import { element } from "./dom";

export class Notice {
  private readonly words = element("p");
  // a region is announced only if it was there before its words
  private readonly region = element("div", { class: "replay-notice", role: "status" });
  private readonly box = element("div");

  constructor() {
    const close = element("button", { type: "button" }, "Close");
    close.addEventListener("click", () => this.clear());
    this.box.append(this.words, close);
    document.body.append(this.region);
  }

  say(text: string): void {
    this.words.textContent = text;
    this.region.replaceChildren(this.box);
  }

  clear(): void {
    this.region.replaceChildren();
  }
}
