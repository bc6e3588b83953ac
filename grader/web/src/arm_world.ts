// An arm that its reader moves, as something to draw: its links, and ghosts of its other postures.

import type { ArmData } from "./arm_data";
import { BranchFinder, hasBranches, mostOthers, type Branches } from "./branches";
import { Posture, postures, range, sizeOf } from "./chain";
import { ellipse, type Ellipse } from "./ellipse";
import type { Scenery, SceneNode } from "./data";
import { columnsInLab, columnsInWorld } from "./jacobian";
import { motionSpace, type MotionSpace } from "./motion_space";
import { compose, normalize, place } from "./pose";
import type { Placed } from "./world";

/** Postures at which the arm is looked at, for how much room it takes. */
const SAMPLES = 22;
/** Directions of the first joint in which the arm is looked at with all others at zero, where many arms reach farthest. */
const DIRECTIONS = 8;
const NONE: Branches = { others: [], endless: false };

export class ArmWorld implements Placed {
  readonly scenery: Scenery;
  readonly space: MotionSpace;
  readonly poses: Float64Array;
  readonly lab: Float64Array;
  readonly tcp = new Float64Array(3);
  readonly tcpInWorld: Float64Array;
  readonly t = 0;
  readonly progress = 0;
  /** Whether other postures are sought, and those that there are. */
  readonly hasBranches: boolean;
  branches: Branches = NONE;
  private seeksBranches = false;
  private readonly posture: Posture;
  private readonly other: Posture;
  private readonly spot = new Float64Array(3);
  private readonly finder: BranchFinder;
  private readonly samples: readonly (readonly number[])[];

  constructor(readonly data: ArmData) {
    const { chain, nodes } = data;
    this.posture = new Posture(chain);
    this.other = new Posture(chain);
    this.space = motionSpace(chain);
    this.finder = new BranchFinder(chain, this.space);
    this.hasBranches = hasBranches(chain, this.space);
    this.samples = [this.start(), ...this.stretched(), ...postures(chain, SAMPLES)];
    this.lab = this.posture.lab;
    this.tcpInWorld = this.posture.tcp;
    const moving = movingNodes(data);
    const copies = this.hasBranches ? 1 + mostOthers(this.space) : 1;
    const all: SceneNode[] = [];
    for (let copy = 0; copy < copies; copy++) {
      nodes.forEach(({ name, shapes }, n) => {
        const joint = chain.joints.find(({ child }) => child === n);
        all.push({
          name: copy === 0 ? name : `posture ${copy + 1}/${name}`,
          kind: copy === 0 ? "link" : "ghost",
          shapes,
          pose: moving.has(n) ? null : [...this.posture.poses.subarray(7 * n, 7 * n + 7)],
          parent: joint ? copy * nodes.length + joint.parent : null,
          track: moving.has(n) ? 0 : -1,
        });
      });
    }
    this.poses = new Float64Array(7 * all.length);
    this.put(this.start());
    this.scenery = {
      stepS: 1,
      ticks: Float64Array.from(this.samples.keys()),
      lab: { name: data.labName, node: moving.has(chain.lab.node) ? chain.lab.node : null, pose: moving.has(chain.lab.node) ? chain.lab.pose : [...this.lab] },
      nodes: all,
      meshes: data.meshes,
      // without a name: it is where a stick ends, and has a dot
      frames: [{ name: "", ...chain.tcp }],
      tcp: { width: 3, count: 1, values: Float64Array.from(this.tcp) },
      reference: null,
      goals: [],
      paths: [],
      contacts: [],
      wanted: null,
      events: [],
      ghostLabel: null,
      mainLabel: null,
      ended: null,
    };
  }

  /** A posture in which every joint is bent, so that nothing hides behind anything and nothing is singular. */
  start(): number[] {
    const { chain } = this.data;
    return chain.q.map(({ unit }, i) => {
      const [low, high] = range(chain, i);
      const wanted = unit === "rad" ? 0.5 + 0.4 * (i % 2) : low + 0.6 * (high - low);
      return Math.min(high, Math.max(low, wanted));
    });
  }

  private stretched(): number[][] {
    const { chain } = this.data;
    return Array.from({ length: DIRECTIONS }, (_, k) =>
      chain.q.map(({ unit }, i) => {
        const [low, high] = range(chain, i);
        const wanted = unit === "rad" ? (i === 0 ? (2 * Math.PI * k) / DIRECTIONS - Math.PI : 0) : k % 2 ? low : high;
        return Math.min(high, Math.max(low, wanted));
      }),
    );
  }

  get q(): Float64Array {
    return this.posture.q;
  }

  put(q: ArrayLike<number>): void {
    this.posture.put(q);
    this.poses.set(this.posture.poses);
    this.tcp.set(this.posture.tcpInLab());
    this.branches = this.seeksBranches ? this.finder.find(this.q) : NONE;
    this.branches.others.forEach((other, i) => {
      this.poses.set(this.other.put(other).poses, (i + 1) * this.posture.poses.length);
    });
  }

  seekBranches(on: boolean): void {
    this.seeksBranches = on && this.hasBranches;
    this.put(this.q);
  }

  /** Puts it into one of the postures at which it is looked at. */
  at(t: number): void {
    this.put(this.samples[Math.round(t)] ?? this.start());
  }

  there(node: number): boolean {
    return node < this.data.nodes.length * (1 + this.branches.others.length);
  }

  frame(out: Float64Array, node: number | null, pose: readonly number[]): void {
    if (node === null) out.set(pose);
    else compose(out, 0, this.poses, 7 * node, pose, 0);
    normalize(out, 0);
  }

  /** Columns of the Jacobian of the TCP's position in the lab frame. */
  columns(): number[][] {
    return columnsInLab(this.posture);
  }

  /** The same in the axes of the world. */
  columnsInWorld(): number[][] {
    return columnsInWorld(this.posture);
  }

  /** A direction of the lab frame in the axes of the world. */
  directionInWorld(direction: readonly number[]): number[] {
    place(this.spot, 0, this.lab, 0, direction[0], direction[1], direction[2]);
    return [0, 1, 2].map((c) => this.spot[c] - this.lab[c]);
  }

  /** Velocities are drawn so long \[m for 1 m/s\]: a round number with which the longest stay in the picture. */
  velocityScale(): number {
    const at = new Posture(this.data.chain);
    const columns = this.samples.flatMap((q) => columnsInWorld(at.put(q)));
    const longest = Math.max(1e-9, ...columns.map((column) => Math.hypot(...column)));
    const most = (0.3 * sizeOf(this.data.chain)) / longest;
    const power = 10 ** Math.floor(Math.log10(most));
    return ([5, 2, 1].find((digit) => digit * power <= most) ?? 1) * power;
  }

  ellipse(): Ellipse {
    return ellipse(this.columns(), this.space);
  }

  /** Whether the ellipse is one in most postures. */
  get hasEllipse(): boolean {
    const { basis, rank } = this.space;
    return basis.length >= 2 && rank === basis.length;
  }
}

/** The nodes that some joint moves. */
function movingNodes({ chain }: ArmData): Set<number> {
  const moving = new Set<number>();
  for (const { parent, child, q } of chain.joints) if (q !== null || moving.has(parent)) moving.add(child);
  return moving;
}
