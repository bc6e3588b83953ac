// An arrow in space, from one point to another: a line as wide as other lines, and a cone for its head.

import { ConeGeometry, Mesh, MeshBasicMaterial, Vector3, type BufferGeometry, type Object3D } from "three";
import { Line } from "./line";

/** What the scene does with the parts: it colours them and lays them over each other. */
export interface Drawing {
  line(line: Line, layer: number): Line;
  glass(): MeshBasicMaterial;
}

export class Arrow {
  private readonly shaft: Line;
  private readonly head: Mesh<BufferGeometry, MeshBasicMaterial>;
  private readonly along = new Vector3();
  private readonly across = new Vector3();
  private readonly beside = new Vector3();

  /** `unit` is the size of the scene \[m\]; where `over`, nothing hides it. */
  constructor(parent: Object3D, drawing: Drawing, layer: number, unit: number, over = false) {
    this.shaft = drawing.line(new Line([0, 0, 0, 0, 0, 1], { width: 3 }), layer);
    // it is put where it is at every moment
    this.shaft.frustumCulled = false;
    // its tip in the origin, its foot along -z
    const cone = new ConeGeometry(0.014 * unit, 0.036 * unit, 14).rotateX(Math.PI / 2).translate(0, 0, -0.018 * unit);
    this.head = new Mesh(cone, drawing.glass());
    this.head.matrixAutoUpdate = false;
    this.head.renderOrder = layer;
    if (over) this.shaft.material.depthTest = this.head.material.depthTest = false;
    parent.add(this.shaft, this.head);
    this.visible = false;
  }

  set visible(on: boolean) {
    this.shaft.visible = this.head.visible = on;
  }

  /** Leads from one point to another; an arrow without a length is not there. */
  aim(from: ArrayLike<number>, to: ArrayLike<number>): void {
    const { along, across, beside, head } = this;
    along.set(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    const length = along.length();
    this.visible = length > 0;
    if (!(length > 0)) return;
    this.shaft.between(from, to);
    along.divideScalar(length);
    across.set(Math.abs(along.z) < 0.9 ? 0 : 1, 0, Math.abs(along.z) < 0.9 ? 1 : 0);
    beside.crossVectors(along, across).normalize();
    across.crossVectors(beside, along).normalize();
    head.matrix.makeBasis(across, beside, along).setPosition(to[0], to[1], to[2]);
    head.matrixWorldNeedsUpdate = true;
  }
}
