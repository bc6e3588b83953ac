// What a picture of the run can do, whether in 3D or flat.

import type { Preset } from "./orbit";

/** What may be shown or left out. */
export type Part = "shadows" | "frames" | "ghost" | "velocity";

/** Where one looks from. */
export interface Camera {
  /** Whether what turns by a drag moves the picture instead. */
  panning: boolean;
  view(preset: Preset): void;
  /** Whether the picture moves along with the TCP. */
  readonly following: boolean;
  follow(on: boolean): void;
  /** Turns by angles \[rad\]. */
  turn(azimuth: number, elevation: number): void;
  /** Moves by fractions of the picture's height. */
  shift(across: number, up: number): void;
  zoom(factor: number): void;
}

/** Writes where a point of the world lies in the picture \[px\]; false where it is behind the eye. */
export type Project = (out: [number, number], p: ArrayLike<number>) => boolean;

export interface View {
  readonly element: HTMLElement;
  /** Says that the moment or anything else changed; the picture is drawn at the next frame. */
  invalidate(): void;
  show(part: Part, on: boolean): void;
  readonly camera?: Camera;
  /** Called after each picture, for what lies over it. */
  drawnOver?: (project: Project) => void;
  /** Called once, when pictures with shadows come too slowly. */
  tooSlow?: (() => void) | undefined;
  /** A picture of the moment for paper, where the element does not print by itself. */
  picture?(): string | null;
}
