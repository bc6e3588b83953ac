// The run in 3D: a context while it is near the screen, and a picture only when something changed.

import { PCFShadowMap, Vector3, WebGLRenderer } from "three";
import { element } from "./dom";
import type { Scenery } from "./data";
import type { Extent } from "./extent";
import { nextFrame } from "./frames";
import { listen } from "./gestures";
import { Labels } from "./labels";
import { Orbit, type Preset } from "./orbit";
import { onPixels } from "./pixels";
import { RunScene } from "./scene";
import { LIGHT, onTheme, theme } from "./theme";
import type { Part, Project, View } from "./view";
import type { Placed } from "./world";

/** Pixels of the picture in a pixel of the page, at most and at least. */
const MOST_PIXELS = 2;
const LEAST_PIXELS = 0.6;
/** A frame that comes later than this after a picture says that the picture was too much for the machine \[ms\]. */
const LATE_MS = 45;
/** A frame this late says that nobody looked \[ms\]. */
const ASLEEP_MS = 1000;
/** So many late pictures in a row, each in the frame after the one before, make the next ones coarser. */
const MOST_LATE = 10;
const COARSER = 2;
/** So many pictures in a row with less than twenty a second are too much with shadows. */
const SLOW_MS = 50;
const MOST_SLOW = 12;
/** A picture for paper is at least so wide \[px\], however narrow its place on the screen is. */
const PAPER_PIXELS = 640;
/** What moved coarsely is sharp again this long after it stopped \[ms\]. */
const SETTLE_MS = 250;
/** How long a context that was lost is waited for \[ms\], and how often; losses this far apart are each the first. */
const PATIENCE_MS = 4000;
const MOST_LOSSES = 4;
const CALM_MS = 60_000;

/** The one context of a stage, with the listeners of its canvas. */
interface Drawn {
  readonly renderer: WebGLRenderer;
  readonly canvas: HTMLCanvasElement;
  readonly heard: AbortController;
}

export class Stage implements View {
  readonly element: HTMLElement;
  readonly camera: Orbit;
  private readonly scene: RunScene;
  private readonly labels: Labels;
  private drawn: Drawn | null = null;
  /** The timer while a lost context is waited for. */
  private waits = 0;
  private losses = 0;
  private lossAt = 0;
  private near = false;
  /** When the last picture was drawn, and the frame after it came. */
  private last = 0;
  private beaten = 0;
  private late = 0;
  private slow = 0;
  private coarse = false;
  private settles = 0;
  /** Pixels of the screen in a pixel of the page, as the canvas was sized for them. */
  private pixels = 0;
  private width = 0;
  private height = 0;
  private readonly parts: Record<Part, boolean> = { shadows: true, frames: false, ghost: true, velocity: false };
  private readonly undo: Array<() => void> = [];
  private readonly point = new Vector3();
  drawnOver?: (project: Project) => void;
  /** Called once, when pictures with shadows come too slowly. */
  tooSlow?: (() => void) | undefined;

  constructor(
    replay: Scenery,
    private readonly world: Placed,
    extent: Extent,
    label: string,
    /** Called when the context is gone and cannot be restored. */
    private readonly lost: () => void,
    preset: Preset = "fit",
  ) {
    this.element = element("div", { class: "replay-stage", tabindex: "0", role: "application", "aria-roledescription": "3D view", "aria-label": label });
    this.scene = new RunScene(replay, world, extent, theme());
    this.labels = new Labels(this.scene.frames, 1.1 * this.scene.axis, world);
    this.element.append(this.labels.element);
    this.camera = new Orbit(extent, () => this.invalidate(), preset);
    listen(this.element, this.camera);
    const sizes = new ResizeObserver(() => this.resize());
    sizes.observe(this.element);
    const near = new IntersectionObserver((all) => this.approach(all[all.length - 1].isIntersecting), { rootMargin: "300px" });
    near.observe(this.element);
    const far = new IntersectionObserver((all) => !all[all.length - 1].isIntersecting && this.release(), { rootMargin: "2500px" });
    far.observe(this.element);
    this.undo.push(
      () => sizes.disconnect(),
      () => near.disconnect(),
      () => far.disconnect(),
      onPixels(this.element, () => this.resize()),
      onTheme(() => {
        this.scene.colour(theme());
        this.invalidate();
      }),
    );
  }

  private approach(near: boolean): void {
    this.near = near;
    if (near) this.open();
  }

  private open(): void {
    if (this.drawn) return;
    const canvas = element("canvas", { "aria-hidden": "true" });
    const heard = new AbortController();
    const options = { signal: heard.signal };
    canvas.addEventListener("webglcontextlost", (event) => this.waitFor(event), options);
    canvas.addEventListener("webglcontextrestored", (event) => this.regain(event), options);
    // asked for here, since three logs an error to the console where there is none
    const context = canvas.getContext("webgl2", { alpha: true, antialias: true, depth: true, stencil: false, powerPreference: "low-power" });
    if (!context) {
      this.giveUp();
      return;
    }
    const renderer = new WebGLRenderer({ canvas, context });
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = PCFShadowMap;
    renderer.setClearAlpha(0);
    this.element.prepend(canvas);
    this.drawn = { renderer, canvas, heard };
    this.resize();
  }

  private release(): void {
    if (!this.drawn) return;
    const { renderer, canvas, heard } = this.drawn;
    this.drawn = null;
    clearTimeout(this.waits);
    this.waits = 0;
    heard.abort();
    this.end(renderer);
    // the context itself, at once: a browser has few
    const context = renderer.getContext();
    if (!context.isContextLost()) context.getExtension("WEBGL_lose_context")?.loseContext();
    canvas.remove();
  }

  /** Gives back what a renderer holds; where its context is lost already there is nothing to be deleted. */
  private end(renderer: WebGLRenderer): void {
    clearTimeout(this.settles);
    this.coarse = false;
    this.scene.forget();
    renderer.dispose();
  }

  /** The browser took the context, and is asked for it again: a machine that slept or changed its graphics card gives it back. */
  private waitFor(event: Event): void {
    event.preventDefault();
    // three would log it to the console
    event.stopImmediatePropagation();
    if (!this.drawn) return;
    const now = performance.now();
    this.losses = now - this.lossAt > CALM_MS ? 1 : this.losses + 1;
    this.lossAt = now;
    if (!this.near) this.release();
    else if (this.losses > MOST_LOSSES) this.giveUp();
    else {
      // what was made in the context does not come back with it
      this.end(this.drawn.renderer);
      this.waits = window.setTimeout(() => this.giveUp(), PATIENCE_MS);
    }
  }

  /** The context is there again, empty: a new renderer begins with one of its own. */
  private regain(event: Event): void {
    event.stopImmediatePropagation();
    if (!this.drawn || !this.waits) return;
    this.drawn.heard.abort();
    this.drawn.canvas.remove();
    const context = this.drawn.renderer.getContext();
    this.drawn = null;
    clearTimeout(this.waits);
    this.waits = 0;
    context.getExtension("WEBGL_lose_context")?.loseContext();
    this.open();
  }

  private giveUp(): void {
    this.dispose();
    this.lost();
  }

  /** Ends it: nothing calls it any more, and nothing of it is held. */
  private dispose(): void {
    this.release();
    for (const undo of this.undo) undo();
    this.undo.length = 0;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (!this.drawn || this.waits || clientWidth === 0 || clientHeight === 0) return;
    this.width = clientWidth;
    this.height = clientHeight;
    this.scene.resize(clientWidth, clientHeight);
    this.camera.resize(clientWidth, clientHeight);
    this.labels.resize(clientWidth, clientHeight);
    this.sharpen(false);
  }

  show(part: Part, on: boolean): void {
    this.parts[part] = on;
    this.scene.show(part, on);
    this.labels.element.hidden = !this.parts.frames;
    this.invalidate();
  }

  /** Draws every so many pixels, `least` of them in a row; a machine that cannot keep up moves coarsely rather than by jumps. */
  private sharpen(coarse: boolean, least = 0): void {
    if (!this.drawn || this.waits) return;
    const { renderer } = this.drawn;
    this.coarse = coarse;
    this.late = 0;
    this.pixels = devicePixelRatio;
    const ratio = Math.max(LEAST_PIXELS, Math.min(MOST_PIXELS, this.pixels) / (coarse ? COARSER : 1), least / this.width);
    renderer.setPixelRatio(ratio);
    renderer.setSize(this.width, this.height);
    // a canvas is empty once its size changed, so it is not left so until the next frame
    this.draw(performance.now());
  }

  invalidate(): void {
    if (this.drawn) nextFrame(this.draw);
  }

  private readonly draw = (now: number): void => {
    if (!this.drawn || this.waits || this.width === 0) return;
    // sizes the canvas and draws
    if (devicePixelRatio !== this.pixels) return this.sharpen(false);
    clearTimeout(this.settles);
    // only pictures in frame after frame show that a machine cannot keep up
    if (now !== this.beaten) this.late = this.slow = 0;
    const more = this.camera.ease(Math.min(50, now - this.last));
    this.last = now;
    nextFrame(this.beat);
    if (more) nextFrame(this.draw);
    this.scene.pose();
    this.camera.track(this.world.tcpInWorld);
    this.drawn.renderer.render(this.scene.scene, this.camera.camera);
    if (this.parts.frames) this.labels.place(this.camera.camera);
    this.drawnOver?.(this.project);
  };

  private readonly project: Project = (out, p) => {
    const { point } = this;
    point.set(p[0], p[1], p[2]).project(this.camera.camera);
    out[0] = 0.5 * (1 + point.x) * this.width;
    out[1] = 0.5 * (1 - point.y) * this.height;
    return point.z <= 1;
  };

  /** The frame after a picture: how late it comes shows what the picture took. */
  private readonly beat = (now: number): void => {
    const passed = now - this.last;
    this.beaten = now;
    this.late = passed > LATE_MS && passed < ASLEEP_MS ? this.late + 1 : 0;
    this.slow = passed > SLOW_MS && passed < ASLEEP_MS ? this.slow + 1 : 0;
    if (this.slow >= MOST_SLOW && this.parts.shadows) {
      const act = this.tooSlow;
      // who turns them on again has them
      this.tooSlow = undefined;
      act?.();
    }
    if (this.coarse) this.settles = window.setTimeout(() => this.sharpen(false), SETTLE_MS);
    else if (this.late >= MOST_LATE) {
      this.coarse = true;
      // a change of size waits for the graphics card, which no frame should
      setTimeout(() => this.coarse && this.sharpen(true));
    }
  };

  /** The moment as a picture on white. */
  picture(): string | null {
    const away = this.drawn === null;
    if (away) this.open();
    if (!this.drawn || this.waits || this.width === 0) {
      if (away) this.release();
      return null;
    }
    const { renderer, canvas } = this.drawn;
    this.scene.colour(LIGHT);
    renderer.setClearColor(0xffffff, 1);
    this.sharpen(false, PAPER_PIXELS);
    const url = this.parts.frames ? this.labels.onto(canvas) : canvas.toDataURL("image/png");
    renderer.setClearColor(0xffffff, 0);
    this.scene.colour(theme());
    if (away) this.release();
    else this.sharpen(false);
    return url;
  }
}
