// Where the camera stands: turned about a point, moved by pointer, touch and keys, or put to a view that shows the whole run.

import { Matrix4, PerspectiveCamera, Vector3 } from "three";
import type { Extent } from "./extent";
import { reducedMotion } from "./motion";
import type { Camera } from "./view";

export type Preset = "fit" | "side" | "top";

/** The last fraction of the picture's half width and height that stays free. */
const MARGIN = 0.9;
const EASE_MS = 260;

/** Target, azimuth and elevation in rad, and distance in m. */
interface Place {
  x: number;
  y: number;
  z: number;
  azimuth: number;
  elevation: number;
  distance: number;
}

const KEYS = ["x", "y", "z", "azimuth", "elevation", "distance"] as const;

export class Orbit implements Camera {
  readonly camera = new PerspectiveCamera(30, 1, 0.01, 100);
  panning = false;
  /** The view the camera was put to, until it is moved by hand. */
  private preset: Preset | null = "fit";
  private readonly now: Place = { x: 0, y: 0, z: 0, azimuth: 0, elevation: 0, distance: 1 };
  private readonly from: Place = { ...this.now };
  private readonly to: Place = { ...this.now };
  private eased = -1;
  /** Where what is followed was. */
  private followed: readonly [number, number, number] | null = null;
  private follows = false;
  private readonly right = new Vector3();
  private readonly up = new Vector3();
  private readonly back = new Vector3();
  private readonly basis = new Matrix4();

  constructor(
    private readonly extent: Extent,
    private readonly changed: () => void,
    preset: Preset = "fit",
  ) {
    this.camera.matrixAutoUpdate = false;
    this.put(preset, false);
  }

  /** Fits the picture to a shape \[px\]. */
  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    if (this.preset) this.put(this.preset, false);
    else this.apply();
  }

  /** Puts the camera to a view. */
  view(preset: Preset): void {
    this.follows = false;
    this.put(preset, !reducedMotion());
    this.changed();
  }

  private put(preset: Preset, ease: boolean): void {
    this.preset = preset;
    const { side, flipped } = this.extent;
    const along = side === 0 ? 0 : -Math.PI / 2;
    const azimuth = along + (flipped ? Math.PI : 0);
    let turn = 0;
    let elevation = 0;
    if (preset === "top") {
      elevation = Math.PI / 2;
      turn = -azimuth - Math.PI / 2;
    } else if (preset === "fit") {
      turn = this.extent.look?.turn ?? (side === 2 ? -0.5 : 0.5);
      elevation = this.extent.look?.elevation ?? (side === 2 ? 0.65 : 0.36);
    } else if (side === 2) elevation = Math.PI / 2;
    Object.assign(this.from, this.now);
    const to = this.to;
    to.azimuth = azimuth + turn;
    // the shorter way round
    to.azimuth += 2 * Math.PI * Math.round((this.now.azimuth - to.azimuth) / (2 * Math.PI));
    to.elevation = elevation;
    this.frame(to);
    if (ease) this.eased = 0;
    else {
      this.eased = -1;
      Object.assign(this.now, to);
    }
    this.apply();
  }

  /** Moves the target and the distance so that the whole run is in the picture. */
  private frame(place: Place): void {
    this.axes(place);
    const { hull, centre } = this.extent;
    const ty = MARGIN * Math.tan((this.camera.fov * Math.PI) / 360);
    const tx = ty * this.camera.aspect;
    const most = [-Infinity, -Infinity, -Infinity, -Infinity];
    for (let i = 0; i < hull.length; i += 4) {
      const px = hull[i] - centre[0], py = hull[i + 1] - centre[1], pz = hull[i + 2] - centre[2];
      const x = px * this.right.x + py * this.right.y + pz * this.right.z;
      const y = px * this.up.x + py * this.up.y + pz * this.up.z;
      const z = px * this.back.x + py * this.back.y + pz * this.back.z + hull[i + 3];
      const r = hull[i + 3];
      most[0] = Math.max(most[0], x + r + z * tx);
      most[1] = Math.max(most[1], -x + r + z * tx);
      most[2] = Math.max(most[2], y + r + z * ty);
      most[3] = Math.max(most[3], -y + r + z * ty);
    }
    const x = 0.5 * (most[0] - most[1]);
    const y = 0.5 * (most[2] - most[3]);
    place.distance = Math.max(0.5 * (most[0] + most[1]) / tx, 0.5 * (most[2] + most[3]) / ty, 0.2 * this.extent.radius);
    place.x = centre[0] + x * this.right.x + y * this.up.x;
    place.y = centre[1] + x * this.right.y + y * this.up.y;
    place.z = centre[2] + x * this.right.z + y * this.up.z;
  }

  private axes(place: Place): void {
    const { azimuth: a, elevation: e } = place;
    this.back.set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
    this.right.set(-Math.sin(a), Math.cos(a), 0);
    this.up.crossVectors(this.back, this.right);
  }

  /** Goes on with an eased move; says whether there is more to come. */
  ease(passedMs: number): boolean {
    if (this.eased < 0) return false;
    this.eased = Math.min(1, this.eased + passedMs / EASE_MS);
    const s = this.eased * this.eased * (3 - 2 * this.eased);
    for (const key of KEYS) this.now[key] = this.from[key] + s * (this.to[key] - this.from[key]);
    if (this.eased >= 1) this.eased = -1;
    this.apply();
    return this.eased >= 0;
  }

  private byHand(): void {
    this.preset = null;
    this.eased = -1;
  }

  turn(azimuth: number, elevation: number): void {
    this.byHand();
    this.now.azimuth += azimuth;
    this.now.elevation = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.now.elevation + elevation));
    this.apply();
    this.changed();
  }

  zoom(factor: number): void {
    this.byHand();
    const { radius } = this.extent;
    this.now.distance = Math.min(40 * radius, Math.max(0.1 * radius, this.now.distance * factor));
    this.apply();
    this.changed();
  }

  /** Moves the target by fractions of the picture's height. */
  shift(across: number, up: number): void {
    this.byHand();
    this.axes(this.now);
    const height = 2 * this.now.distance * Math.tan((this.camera.fov * Math.PI) / 360);
    const { right, up: upward } = this;
    const limit = 3 * this.extent.radius;
    const keys = ["x", "y", "z"] as const;
    keys.forEach((key, c) => {
      const value = this.now[key] + height * (across * right[key] + up * upward[key]);
      const middle = this.extent.centre[c];
      this.now[key] = Math.min(middle + limit, Math.max(middle - limit, value));
    });
    this.apply();
    this.changed();
  }

  get following(): boolean {
    return this.follows;
  }

  follow(on: boolean): void {
    this.follows = on;
    this.followed = null;
    if (on) this.byHand();
    this.changed();
  }

  /** Moves along with what is followed. */
  track(p: ArrayLike<number>): void {
    if (!this.follows) return;
    const { followed, now } = this;
    this.followed = [p[0], p[1], p[2]];
    // what jumps out of sight is not run after
    if (!followed || !(Math.hypot(p[0] - followed[0], p[1] - followed[1], p[2] - followed[2]) < 20 * this.extent.radius)) return;
    now.x += p[0] - followed[0];
    now.y += p[1] - followed[1];
    now.z += p[2] - followed[2];
    this.apply();
  }

  private apply(): void {
    const { camera, now, right, up, back, basis } = this;
    this.axes(now);
    basis.makeBasis(right, up, back);
    basis.setPosition(now.x + now.distance * back.x, now.y + now.distance * back.y, now.z + now.distance * back.z);
    camera.matrix.copy(basis);
    camera.matrixWorldNeedsUpdate = true;
    camera.updateMatrixWorld(true);
    const near = Math.max(0.02 * now.distance, now.distance - 6 * this.extent.radius);
    const far = now.distance + 30 * this.extent.radius;
    if (camera.near !== near || camera.far !== far) {
      camera.near = near;
      camera.far = far;
      camera.updateProjectionMatrix();
    }
  }
}
