// The slider of one joint, with its value in words.

import { COLOURS } from "./arm_marks";
import { range, type Chain } from "./chain";
import { element } from "./dom";
import { breakable, fixed } from "./words";

const DEGREES = 180 / Math.PI;
/** What a key changes, small and large [rad, or parts of a slide's way]. */
const STEP = { rad: [0.01, 0.1], m: [0.005, 0.05] } as const;

let made = 0;

export class ArmJoint {
  readonly element: HTMLElement;
  private readonly input: HTMLInputElement;
  private readonly output: HTMLElement;
  private readonly turns: boolean;

  constructor(
    chain: Chain,
    index: number,
    moved: (value: number) => void,
  ) {
    const { name, unit } = chain.q[index];
    this.turns = unit === "rad";
    const [low, high] = range(chain, index);
    const id = `arm-joint-${++made}`;
    this.input = element("input", { type: "range", class: "replay-slider", id, min: String(low), max: String(high), step: "any" });
    this.output = element("span", { class: "arm-value" });
    const swatch = element("i", { class: `arm-swatch arm-colour-${index % COLOURS}`, "aria-hidden": "true" });
    this.element = element("div", { class: "arm-joint" }, element("label", { for: id }, swatch, element("bdi", {}, ...breakable(name))), this.input, this.output);
    const [small, large] = this.turns ? STEP.rad : STEP.m.map((part) => part * (high - low));
    const move = (value: number): void => moved(Math.min(high, Math.max(low, value)));
    // by hand to thousandths, which can be read; the ends stay what they are
    this.input.addEventListener("input", () => {
      const value = this.input.valueAsNumber;
      move(value <= low || value >= high ? value : Math.round(1000 * value) / 1000);
    });
    const steps: Record<string, number> = { ArrowLeft: -small, ArrowDown: -small, ArrowRight: small, ArrowUp: small, PageDown: -large, PageUp: large, Home: -Infinity, End: Infinity };
    this.input.addEventListener("keydown", (event) => {
      const step = steps[event.key];
      if (step === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      const next = this.input.valueAsNumber + step;
      move(Number.isFinite(next) ? Number(next.toFixed(6)) : next);
    });
  }

  /** Shows a value. */
  show(value: number): void {
    const { input } = this;
    input.value = String(value);
    const [low, high] = [Number(input.min), Number(input.max)];
    input.style.setProperty("--done", `${((100 * (value - low)) / (high - low || 1)).toFixed(2)}%`);
    const words = this.turns ? `${fixed(value, 3)} rad, ${fixed(DEGREES * value, 1)} degrees` : `${fixed(value, 3)} m`;
    input.setAttribute("aria-valuetext", words);
    this.output.textContent = this.turns ? `${fixed(value, 3)} rad  ${fixed(DEGREES * value, 1)}°` : `${fixed(value, 3)} m`;
  }
}
