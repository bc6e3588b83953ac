// The run in 3D: a context while it is near the screen, and a picture only when something changed.

import { PCFShadowMap, Vector3, WebGLRenderer } from "three";
import { element } from "./dom";
import type { Replay } from "./data";
import type { Extent } from "./extent";
import { nextFrame } from "./frames";
import { listen } from "./gestures";
import { place } from "./pose";
import { Orbit, type Preset } from "./orbit";
import { RunScene } from "./scene";
import { LIGHT, onTheme, theme } from "./theme";
import type { Part, View } from "./view";
import type { World } from "./world";

/** Pixels of the picture in a pixel of the page, at most and at least. */
const MOST_PIXELS = 2;
const LEAST_PIXELS = 0.6;
/** Frames whose axes have letters; of more one would see letters only. */
const MOST_LETTERED = 6;
/** A picture that comes later than this after the one before is late \[ms\]. */
const LATE_MS = 45;
/** So many late pictures in a row make the next ones coarser, until it rests. */
const MOST_LATE = 10;
const COARSER = 2;

export class Stage implements View {
  readonly element: HTMLElement;
  readonly camera: { view(preset: Preset): void; turn(azimuth: number, elevation: number): void; zoom(factor: number): void };
  private readonly orbit: Orbit;
  private readonly scene: RunScene;
  private readonly labels = element("div", { class: "replay-labels", "aria-hidden": "true" });
  private readonly names: Array<{ label: HTMLElement; frame: number; tip: number }> = [];
  private renderer: WebGLRenderer | null = null;
  private last = 0;
  private late = 0;
  private coarse = false;
  private width = 0;
  private height = 0;
  private readonly point = new Vector3();
  private readonly spot = new Float64Array(7);
  private readonly tip = new Float64Array(3);
  private readonly parts: Record<Part, boolean> = { shadows: true, frames: false, ghost: true };

  constructor(
    replay: Replay,
    private readonly world: World,
    extent: Extent,
    label: string,
    /** Told when the context is gone and cannot be had again. */
    private readonly lost: () => void,
  ) {
    this.element = element("div", { class: "replay-stage", tabindex: "0", role: "application", "aria-roledescription": "3D view", "aria-label": label });
    this.scene = new RunScene(replay, world, extent, theme());
    this.scene.frames.forEach((frame, i) => {
      this.name(frame.name, i, -1);
      // letters tell the axes apart without their colours
      if (this.scene.frames.length <= MOST_LETTERED) ["x", "y", "z"].forEach((axis, c) => this.name(axis, i, c));
    });
    this.labels.hidden = true;
    this.element.append(this.labels);
    this.orbit = new Orbit(extent, () => this.invalidate());
    this.camera = {
      view: (preset) => this.orbit.view(preset),
      turn: (azimuth, elevation) => this.orbit.turn(azimuth, elevation),
      zoom: (factor) => this.orbit.zoom(factor),
    };
    listen(this.element, this.orbit);
    onTheme(() => {
      this.scene.colour(theme());
      this.invalidate();
    });
    new ResizeObserver(() => this.resize()).observe(this.element);
    new IntersectionObserver(([seen]) => seen.isIntersecting && this.open(), { rootMargin: "300px" }).observe(this.element);
    new IntersectionObserver(([seen]) => !seen.isIntersecting && this.release(), { rootMargin: "2500px" }).observe(this.element);
  }

  private name(text: string, frame: number, tip: number): void {
    const label = element("span", tip < 0 ? {} : { class: "replay-axis" }, text);
    this.labels.append(label);
    this.names.push({ label, frame, tip });
  }

  private open(): void {
    if (this.renderer) return;
    let renderer: WebGLRenderer;
    try {
      renderer = new WebGLRenderer({ antialias: true, alpha: true, powerPreference: "low-power" });
    } catch {
      this.lost();
      return;
    }
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = PCFShadowMap;
    renderer.setClearAlpha(0);
    renderer.domElement.addEventListener("webglcontextlost", () => {
      // the one that was given back tells of its end, too
      if (this.renderer === renderer) this.lost();
    });
    renderer.domElement.setAttribute("aria-hidden", "true");
    this.element.prepend(renderer.domElement);
    this.renderer = renderer;
    this.resize();
  }

  private release(): void {
    const renderer = this.renderer;
    if (!renderer) return;
    this.renderer = null;
    this.scene.forget();
    renderer.dispose();
    renderer.forceContextLoss();
    renderer.domElement.remove();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (!this.renderer || clientWidth === 0 || clientHeight === 0) return;
    this.width = clientWidth;
    this.height = clientHeight;
    this.sharpen(false);
    this.scene.resize(clientWidth, clientHeight);
    this.orbit.resize(clientWidth, clientHeight);
    // a canvas is empty once its size changed, so it is not left so until the next frame
    this.draw(performance.now());
  }

  show(part: Part, on: boolean): void {
    this.parts[part] = on;
    this.scene.show(part, on);
    this.labels.hidden = !this.parts.frames;
    this.invalidate();
  }

  /** Draws every so many pixels; a machine that cannot keep up moves coarsely rather than by jumps. */
  private sharpen(coarse: boolean): void {
    this.coarse = coarse;
    this.late = 0;
    const ratio = Math.max(LEAST_PIXELS, Math.min(MOST_PIXELS, devicePixelRatio) / (coarse ? COARSER : 1));
    this.renderer?.setPixelRatio(ratio);
    this.renderer?.setSize(this.width, this.height);
  }

  private pace(now: number): void {
    const passed = now - this.last;
    this.last = now;
    // a picture long after the last one is the first of a new motion, not a late one
    this.late = passed > LATE_MS && passed < 1000 ? this.late + 1 : 0;
    if (this.late < MOST_LATE || this.coarse) return;
    this.coarse = true;
    // a change of size waits for the graphics card, which no frame should
    setTimeout(() => {
      if (!this.coarse) return;
      this.sharpen(true);
      this.draw(performance.now());
    });
  }

  rest(): void {
    if (this.coarse) {
      this.sharpen(false);
      this.draw(performance.now());
    } else this.invalidate();
  }

  invalidate(): void {
    if (this.renderer) nextFrame(this.draw);
  }

  private readonly draw = (now: number): void => {
    if (!this.renderer) return;
    if (this.orbit.ease(Math.min(50, now - this.last))) nextFrame(this.draw);
    this.pace(now);
    this.scene.pose();
    this.renderer.render(this.scene.scene, this.orbit.camera);
    if (this.parts.frames) this.label();
  };

  private label(): void {
    const frames = this.scene.frames;
    const { spot, tip: end, point } = this;
    for (const { label, frame, tip } of this.names) {
      if (tip <= 0) this.world.frame(spot, frames[frame].node, frames[frame].pose);
      const reach = 1.1 * this.scene.axis;
      if (tip < 0) end.set(spot.subarray(0, 3));
      else place(end, 0, spot, 0, tip === 0 ? reach : 0, tip === 1 ? reach : 0, tip === 2 ? reach : 0);
      point.set(end[0], end[1], end[2]).project(this.orbit.camera);
      const style = label.style;
      style.visibility = point.z > 1 ? "hidden" : "visible";
      const x = 0.5 * (1 + point.x) * this.width;
      const y = 0.5 * (1 - point.y) * this.height;
      style.transform = `translate(${x.toFixed(1)}px,${y.toFixed(1)}px)`;
    }
  }

  /** The moment as a picture on white. */
  picture(): string | null {
    const away = this.renderer === null;
    if (away) this.open();
    const renderer = this.renderer;
    if (!renderer) return null;
    this.scene.colour(LIGHT);
    renderer.setClearColor(0xffffff, 1);
    this.draw(performance.now());
    const url = renderer.domElement.toDataURL("image/png");
    renderer.setClearColor(0xffffff, 0);
    this.scene.colour(theme());
    if (away) this.release();
    else this.draw(performance.now());
    return url;
  }
}
