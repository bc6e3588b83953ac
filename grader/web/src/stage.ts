// The run in 3D: a context while it is near the screen, and a picture only when something changed.

import { PCFShadowMap, Vector3, WebGLRenderer } from "three";
import { element } from "./dom";
import type { Replay } from "./data";
import type { Extent } from "./extent";
import { nextFrame } from "./frames";
import { listen } from "./gestures";
import { Orbit, type Preset } from "./orbit";
import { RunScene } from "./scene";
import { LIGHT, onTheme, theme } from "./theme";
import type { Part, View } from "./view";
import type { World } from "./world";

/** Frames whose time is remembered. */
const REMEMBERED = 600;
const MOST_PIXELS = 2;

export class Stage implements View {
  readonly element: HTMLElement;
  readonly camera: { view(preset: Preset): void; turn(azimuth: number, elevation: number): void; zoom(factor: number): void };
  private readonly orbit: Orbit;
  private readonly scene: RunScene;
  private readonly labels = element("div", { class: "replay-labels", "aria-hidden": "true" });
  private readonly names: HTMLElement[];
  private renderer: WebGLRenderer | null = null;
  private readonly times = new Float64Array(REMEMBERED);
  private drawn = 0;
  private last = 0;
  private width = 0;
  private height = 0;
  private releasing = false;
  private readonly point = new Vector3();
  private readonly spot = new Float64Array(7);
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
    this.names = this.scene.frames().map((frame) => element("span", {}, frame.name));
    this.labels.append(...this.names);
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

  /** Times of the last pictures: what this code took, in ms. */
  frameTimes(): number[] {
    const count = Math.min(this.drawn, REMEMBERED);
    return Array.from({ length: count }, (_, i) => this.times[(this.drawn - count + i) % REMEMBERED]);
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
      if (!this.releasing) this.lost();
    });
    renderer.domElement.setAttribute("aria-hidden", "true");
    this.element.prepend(renderer.domElement);
    this.renderer = renderer;
    this.resize();
  }

  private release(): void {
    const renderer = this.renderer;
    if (!renderer) return;
    this.releasing = true;
    this.renderer = null;
    this.scene.forget();
    renderer.dispose();
    renderer.forceContextLoss();
    renderer.domElement.remove();
    this.releasing = false;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (!this.renderer || clientWidth === 0 || clientHeight === 0) return;
    this.width = clientWidth;
    this.height = clientHeight;
    this.renderer.setPixelRatio(Math.min(MOST_PIXELS, devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight);
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

  invalidate(): void {
    if (this.renderer) nextFrame(this.draw);
  }

  private readonly draw = (now: number): void => {
    if (!this.renderer) return;
    const began = performance.now();
    if (this.orbit.ease(Math.min(50, now - this.last))) nextFrame(this.draw);
    this.last = now;
    this.scene.pose();
    this.renderer.render(this.scene.scene, this.orbit.camera);
    if (this.parts.frames) this.label();
    this.times[this.drawn++ % REMEMBERED] = performance.now() - began;
  };

  private label(): void {
    const frames = this.scene.frames();
    for (let i = 0; i < frames.length; i++) {
      this.world.frame(this.spot, frames[i].node, frames[i].pose);
      this.point.set(this.spot[0], this.spot[1], this.spot[2]).project(this.orbit.camera);
      const style = this.names[i].style;
      if (this.point.z > 1) style.visibility = "hidden";
      else {
        style.visibility = "visible";
        const x = 0.5 * (1 + this.point.x) * this.width;
        const y = 0.5 * (1 - this.point.y) * this.height;
        style.transform = `translate(${x.toFixed(1)}px,${y.toFixed(1)}px)`;
      }
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
