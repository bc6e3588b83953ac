// What a picture of the run can do, whether in 3D or flat.

import type { Preset } from "./orbit";

/** What may be shown or left out. */
export type Part = "shadows" | "frames" | "ghost";

export interface View {
  readonly element: HTMLElement;
  /** Says that the moment or anything else changed; the picture is drawn at the next frame. */
  invalidate(): void;
  /** Says that nothing will move for a while. */
  rest(): void;
  show(part: Part, on: boolean): void;
  /** Puts the camera to a view, or turns and zooms it, where there is a camera. */
  camera?: { view(preset: Preset): void; turn(azimuth: number, elevation: number): void; zoom(factor: number): void };
  /** A picture of the moment for paper, where the element does not print by itself. */
  picture?(): string | null;
}
