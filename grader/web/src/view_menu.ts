// The menu of the picture: where one looks from, what is drawn, and what a drag of the pointer does, as buttons.

import { isReference, type Replay } from "./data";
import { button, group } from "./button";
import { element } from "./dom";
import type { Sign } from "./icon";
import type { Preset } from "./orbit";
import type { Part, View } from "./view";

export interface ViewActions {
  view(): View;
  show(part: Part, on: boolean): void;
  /** Whether a part is shown. */
  shown(part: Part): boolean;
  /** Shows the run flat or in space; none where it is no plane motion, or there is no space. */
  readonly flatten: ((on: boolean) => void) | null;
}

/** What the four arrows of the camera do. */
const ARROWS = [
  { sign: "left", turn: [-1, 0], name: "left" },
  { sign: "right", turn: [1, 0], name: "right" },
  { sign: "up", turn: [0, 1], name: "up" },
  { sign: "down", turn: [0, -1], name: "down" },
] as const;
const TURN = Math.PI / 12;
const SHIFT = 0.1;

export class ViewMenu {
  readonly element: HTMLElement;
  private readonly opener = button("View", "down", () => this.open(Boolean(this.panel.hidden)), null);
  private readonly panel = element("div", { class: "replay-menu", role: "group", "aria-label": "View" });
  private readonly cameraOnly: HTMLElement[] = [];
  private readonly spatial: HTMLElement[] = [];
  private readonly plane: HTMLButtonElement;
  private readonly follow: HTMLButtonElement;
  private isFlat = false;
  private readonly toggles = new Map<Part, HTMLButtonElement>();

  constructor(
    replay: Replay,
    private readonly actions: ViewActions,
  ) {
    const toggle = (name: string, part: Part): HTMLButtonElement => {
      const made = button(name, null, () => this.show(part, !actions.shown(part)));
      made.setAttribute("aria-pressed", String(actions.shown(part)));
      this.toggles.set(part, made);
      return made;
    };
    const shadows = toggle("Shadows", "shadows");
    const shown = group("Show", toggle("Frames", "frames"), toggle("Velocity", "velocity"), shadows);
    if (replay.nodes.some((node) => node.kind === "ghost")) shown.append(toggle(isReference(replay) ? "Reference arm" : `Run ${replay.ghostLabel}`, "ghost"));
    const plane = button("2D", null, () => this.flatten(!this.isFlat));
    plane.setAttribute("aria-pressed", "false");
    const view = (name: string, preset: Preset): HTMLButtonElement =>
      button(name, null, () => {
        this.flatten(false);
        actions.view().camera?.view(preset);
        this.tell();
      });
    const from = group("Look from", view("Fit", "fit"), view("Side", "side"), view("Top", "top"), ...(actions.flatten ? [plane] : []));
    this.plane = plane;
    this.follow = button("Follow the TCP", null, () => {
      const at = actions.view().camera;
      at?.follow(!at.following);
      this.tell();
    });
    this.follow.setAttribute("aria-pressed", "false");
    const camera = this.camera();
    camera.append(this.follow);
    this.spatial.push(shadows, camera);
    this.cameraOnly.push(from, shadows, camera);
    this.panel.append(from, shown, camera);
    this.panel.hidden = true;
    this.opener.setAttribute("aria-expanded", "false");
    this.element = element("div", { class: "replay-group replay-view" }, this.opener, this.panel);
    this.element.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || this.panel.hidden) return;
      event.stopPropagation();
      this.open(false);
      this.opener.focus();
    });
    document.addEventListener("pointerdown", (event) => {
      // the picture may be turned while the menu is open
      const at = event.target instanceof Element ? event.target : null;
      if (!this.element.contains(at) && !at?.closest(".replay-stage")) this.open(false);
    });
  }

  private flatten(on: boolean): void {
    if (!this.actions.flatten || on === this.isFlat) return;
    this.isFlat = on;
    this.actions.flatten(on);
    this.plane.setAttribute("aria-pressed", String(on));
    for (const made of this.spatial) made.hidden = on;
  }

  /** Shows whether the picture follows. */
  private tell(): void {
    this.follow.setAttribute("aria-pressed", String(this.actions.view().camera?.following ?? false));
  }

  private open(on: boolean): void {
    this.panel.hidden = !on;
    this.opener.setAttribute("aria-expanded", String(on));
  }

  /** What a drag of the pointer does, as buttons. */
  private camera(): HTMLElement {
    const camera = () => this.actions.view().camera;
    const arrows = ARROWS.map(({ sign, turn: [x, y] }) =>
      button("", sign, () => (camera()?.panning ? camera()?.shift(SHIFT * x, SHIFT * y) : camera()?.turn(TURN * x, TURN * y))),
    );
    const move = button("Move", null, () => {
      const at = camera();
      if (!at) return;
      at.panning = !at.panning;
      name(at.panning);
    });
    move.title = "Whether the arrows, and a drag, move the view rather than turn it";
    const name = (panning: boolean): void => {
      move.setAttribute("aria-pressed", String(panning));
      arrows.forEach((arrow, i) => {
        arrow.title = `${panning ? "Move" : "Turn"} ${ARROWS[i].name}`;
        arrow.setAttribute("aria-label", arrow.title);
      });
    };
    name(false);
    const zoom = (name: string, sign: Sign, factor: number, keys: string): HTMLButtonElement => button(name, sign, () => camera()?.zoom(factor), keys);
    return group(
      "Camera",
      ...arrows,
      move,
      zoom("Farther", "farther", 1.25, "− in the 3D view, or Ctrl and the wheel"),
      zoom("Closer", "closer", 0.8, "+ in the 3D view, or Ctrl and the wheel"),
    );
  }

  /** Shows a part or leaves it out, as its button does. */
  show(part: Part, on: boolean): void {
    this.actions.show(part, on);
    this.toggles.get(part)?.setAttribute("aria-pressed", String(on));
  }

  /** Hides what only a camera can do. */
  flat(on: boolean): void {
    for (const made of this.cameraOnly) made.hidden = on;
  }
}
