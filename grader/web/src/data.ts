// What the page says of a run: the replay's JSON, checked once, so that nothing behind it meets a missing number.

import { Way } from "./between";
import { bytes, column, track, type Track } from "./track";

export type Vector = readonly number[];
/** Position in m and quaternion: x, y, z, w, qx, qy, qz. */
export type Pose = readonly number[];

export type Solid =
  | { readonly kind: "box"; readonly size: Vector }
  | { readonly kind: "cylinder" | "capsule"; readonly radius: number; readonly length: number }
  | { readonly kind: "sphere"; readonly radius: number }
  | { readonly kind: "mesh"; readonly mesh: number };

export interface Shape {
  readonly solid: Solid;
  readonly pose: Pose;
}

export const NODE_KINDS = ["link", "fixed", "driven", "free", "ghost"] as const;
export type NodeKind = (typeof NODE_KINDS)[number];

export interface SceneNode {
  readonly name: string;
  readonly kind: NodeKind;
  readonly shapes: readonly Shape[];
  /** Where it stands in the world if it never moves. */
  readonly pose: Pose | null;
  /** The node its joint hangs on, where the data have it. */
  readonly parent: number | null;
  /** Index of its track where it moves. */
  readonly track: number;
}

export interface Mesh {
  readonly vertices: Float32Array;
  readonly triangles: Uint32Array;
}

export interface Frame {
  readonly name: string;
  readonly node: number | null;
  readonly pose: Pose;
}

/** Radii in m within which all points and some points are earned. */
export interface Tolerance {
  readonly full: number | null;
  readonly zero: number | null;
}

export interface Goal extends Tolerance {
  readonly position: Vector;
}

export interface Path extends Tolerance {
  readonly name: string;
  readonly points: readonly Vector[];
}

export interface Contact {
  readonly from: number;
  readonly to: number;
  readonly first: string;
  readonly second: string;
  readonly point: Vector;
  readonly impulse: number;
  /** The greatest normal force \[N\], and its direction: on the second party, in the world. */
  readonly force: number;
  readonly normal: Vector | null;
}

export const EVENT_KINDS = ["contact", "limit", "saturation", "breach", "fell", "stop", "other"] as const;
export type EventKind = (typeof EVENT_KINDS)[number];

export interface RunEvent {
  readonly tick: number;
  readonly kind: EventKind;
  readonly text: string;
}

export interface Joint {
  readonly name: string;
  readonly unit: string;
}

export interface Replay {
  readonly task: string;
  readonly title: string;
  readonly stepS: number;
  /** The ticks stepped through. */
  readonly ticks: Float64Array;
  readonly lab: Frame;
  readonly nodes: readonly SceneNode[];
  readonly meshes: readonly Mesh[];
  readonly frames: readonly Frame[];
  /** How everything moved, to the tick. */
  readonly moves: { readonly tcp: Way; readonly q: readonly Way[]; readonly nodes: readonly Way[] };
  /** The TCP in the lab frame at every step. */
  readonly tcp: Track;
  /** The velocity of the TCP that was commanded at every step, in the lab frame \[m/s\]; null where velocities are not what is commanded. */
  readonly wanted: Track | null;
  readonly joints: readonly Joint[];
  /** The numbers of another run beside this one, at every step. */
  readonly other: { readonly tcp: Track; readonly q: ReadonlyArray<{ readonly name: string; readonly track: Track }> } | null;
  readonly reference: { readonly periodS: number; readonly path: Track } | null;
  readonly goals: readonly Goal[];
  readonly paths: readonly Path[];
  readonly contacts: readonly Contact[];
  readonly events: readonly RunEvent[];
  readonly ghostLabel: string | null;
  readonly mainLabel: string | null;
  readonly ended: string | null;
}

/** What is drawn, without how it moved. */
export type Scenery = Omit<Replay, "moves" | "task" | "title" | "joints" | "other">;

const MOST_NODES = 1e6;

/** Whether what is translucent is the reference's motion, and not another run's. */
export function isReference(replay: Scenery): boolean {
  return replay.ghostLabel === null || replay.ghostLabel === "reference";
}

/** A value of the JSON with the way to it, for what is said when it is not what it should be. */
export class Value {
  constructor(
    private readonly value: unknown,
    private readonly where: string,
  ) {}

  private wrong(expected: string): Error {
    return new Error(`${this.where || "the data"} is not ${expected}`);
  }

  get missing(): boolean {
    return this.value === null || this.value === undefined;
  }

  of(key: string): Value {
    if (typeof this.value !== "object" || this.value === null) throw this.wrong("a record");
    return new Value((this.value as Record<string, unknown>)[key], this.where ? `${this.where}.${key}` : key);
  }

  number(): number {
    if (typeof this.value !== "number" || !Number.isFinite(this.value)) throw this.wrong("a number");
    return this.value;
  }

  yes(): boolean {
    if (typeof this.value !== "boolean") throw this.wrong("yes or no");
    return this.value;
  }

  positive(): number {
    const value = this.number();
    if (!(value > 0)) throw this.wrong("a positive number");
    return value;
  }

  index(length: number): number {
    const value = this.number();
    if (!Number.isInteger(value) || value < 0 || value >= length) throw this.wrong(`one of ${length}`);
    return value;
  }

  text(): string {
    if (typeof this.value !== "string") throw this.wrong("a text");
    return this.value;
  }

  list<T>(read: (value: Value) => T): T[] {
    if (!Array.isArray(this.value)) throw this.wrong("a list");
    return this.value.map((item, i) => read(new Value(item, `${this.where}[${i}]`)));
  }

  numbers(length: number): number[] {
    const values = this.list((value) => value.number());
    if (values.length !== length) throw this.wrong(`${length} numbers`);
    return values;
  }

  pose(): Pose {
    const values = this.numbers(7);
    if (!(Math.hypot(values[3], values[4], values[5], values[6]) > 1e-6)) throw this.wrong("a pose");
    return values;
  }

  /** Reads what may be missing. */
  maybe<T>(read: (value: Value) => T): T | null {
    return this.missing ? null : read(this);
  }

  one<T extends string>(names: readonly T[], otherwise: T): T {
    const found = names.find((name) => name === this.value);
    return found ?? otherwise;
  }

  /** Rows of `width` numbers: at their ticks, or at a fixed period. */
  track(width: number, ticks: Float64Array | null): Track {
    const quanta = this.of("quanta").numbers(this.of("width").number());
    if (quanta.length !== width) throw this.wrong(`${width} columns`);
    const count = this.of("count").number();
    if (!Number.isInteger(count) || count < 0) throw this.wrong("a track: its count is no count");
    if (ticks !== null && count !== ticks.length) throw this.wrong(`a track of ${ticks.length} frames`);
    return this.decoded(() => track(this.of("data").text(), quanta, count, ticks));
  }

  /** Ticks in order, one at least. */
  ticks(): Float64Array {
    const ticks = this.decoded(() => column(this.text()));
    if (ticks.length === 0) throw this.wrong("a list of ticks: there is none");
    for (let i = 1; i < ticks.length; i++) if (!(ticks[i] > ticks[i - 1])) throw this.wrong("in order of time");
    return ticks;
  }

  way(width: number): Way {
    const ticks = this.of("ticks").ticks();
    const within = this.of("within").positive();
    return new Way(ticks, this.track(width, ticks), within);
  }

  decoded<T>(read: () => T): T {
    try {
      return read();
    } catch (error) {
      throw new Error(`${this.where}: ${error instanceof Error ? error.message : "unreadable"}`);
    }
  }
}

export function solid(value: Value, meshes: number): Solid {
  const box = value.of("box");
  if (!box.missing) return { kind: "box", size: box.numbers(3) };
  for (const kind of ["cylinder", "capsule"] as const) {
    const round = value.of(kind);
    if (!round.missing) return { kind, radius: round.of("radius").number(), length: round.of("length").number() };
  }
  const sphere = value.of("sphere");
  if (!sphere.missing) return { kind: "sphere", radius: sphere.of("radius").number() };
  return { kind: "mesh", mesh: value.of("mesh").index(meshes) };
}

export function mesh(value: Value): Mesh {
  const raw = (key: string): ArrayBuffer => {
    const part = value.of(key);
    const data = part.decoded(() => bytes(part.text()));
    if (data.length % 12 !== 0) throw new Error(`a mesh's ${key} do not come in threes`);
    return data.slice().buffer;
  };
  const vertices = new Float32Array(raw("vertices"));
  const triangles = new Uint32Array(raw("triangles"));
  const count = vertices.length / 3;
  for (const corner of triangles) if (corner >= count) throw new Error("a mesh's triangle names a vertex that is not there");
  for (const coordinate of vertices) if (!Number.isFinite(coordinate)) throw new Error("a mesh's vertex is not a number");
  return { vertices, triangles };
}

const tolerance = (value: Value): Tolerance => ({
  full: value.of("full").maybe((v) => v.number()),
  zero: value.of("zero").maybe((v) => v.number()),
});

/** A way's rows at other ticks. */
function resampled(way: Way, ticks: Float64Array): Track {
  const { width } = way.track;
  const values = new Float64Array(width * ticks.length);
  ticks.forEach((tick, i) => {
    way.at(tick);
    for (let c = 0; c < width; c++) values[i * width + c] = way.number(c);
  });
  return { width, count: ticks.length, values };
}

/** Reads a replay. Throws with a sentence that says what is wrong with it. */
export function read(json: string): Replay {
  const root = new Value(JSON.parse(json), "");
  const format = root.of("format").text();
  if (format !== "kinemark-replay/2") throw new Error(`its format is ${format}, and this page shows kinemark-replay/2`);
  const stepS = root.of("stepS").positive();
  if (root.of("ticks").text() === "") throw new Error("it has no frame: the run ended before its first step");
  const ticks = root.of("ticks").ticks();
  const meshes = root.of("meshes").maybe((list) => list.list(mesh)) ?? [];
  const tracks = root.of("tracks").list((value) => value.way(7));
  const nodes = root.of("nodes").list((value): SceneNode => {
    const at = value.of("track").maybe((v) => v.index(tracks.length));
    return {
      name: value.of("name").text(),
      kind: value.of("kind").one(NODE_KINDS, "fixed"),
      shapes: value.of("shapes").list((shape) => ({ solid: solid(shape.of("solid"), meshes.length), pose: shape.of("pose").pose() })),
      pose: at === null ? value.of("pose").pose() : null,
      parent: value.of("parent").maybe((v) => v.index(MOST_NODES)),
      track: at ?? -1,
    };
  });
  for (const node of nodes) if (node.parent !== null && node.parent >= nodes.length) throw new Error(`${node.name} hangs on a node that is not there`);
  const frame = (value: Value): Frame => ({
    name: value.of("name").text(),
    node: value.of("node").maybe((v) => v.index(nodes.length)),
    pose: value.of("pose").pose(),
  });
  const joints = root.of("joints").list((value) => ({ name: value.of("name").text(), unit: value.of("unit").text() }));
  const tcp = root.of("tcp").way(3);
  const q = root.of("q").list((value) => value.way(1));
  if (q.length !== joints.length) throw new Error(`there are ${q.length} tracks of ${joints.length} joints`);
  const list = <T>(key: string, item: (value: Value) => T): T[] => root.of(key).maybe((value) => value.list(item)) ?? [];
  return {
    task: root.of("task").text(),
    title: root.of("title").text(),
    stepS,
    ticks,
    lab: frame(root.of("lab")),
    nodes,
    meshes,
    frames: list("frames", frame),
    moves: { tcp, q, nodes: tracks },
    tcp: resampled(tcp, ticks),
    wanted: root.of("wanted").maybe((value) => value.track(3, ticks)),
    joints,
    other: root.of("other").maybe((value) => ({
      tcp: value.of("tcp").track(3, ticks),
      q: value.of("q").list((one) => ({ name: one.of("name").text(), track: one.of("track").track(1, ticks) })),
    })),
    reference: root.of("reference").maybe((value) => ({ periodS: value.of("periodS").positive(), path: value.of("path").track(3, null) })),
    goals: list("goals", (value) => ({ position: value.of("position").numbers(3), ...tolerance(value) })),
    paths: list("paths", (value) => ({
      name: value.of("name").text(),
      points: value.of("points").list((point) => point.numbers(3)),
      ...tolerance(value),
    })),
    contacts: list("contacts", (value) => ({
      from: value.of("from").number(),
      to: value.of("to").number(),
      first: value.of("first").text(),
      second: value.of("second").text(),
      point: value.of("point").numbers(3),
      impulse: value.of("impulse").number(),
      force: value.of("force").maybe((v) => v.number()) ?? 0,
      normal: value.of("normal").maybe((v) => v.numbers(3)),
    })),
    events: list("events", (value) => ({
      tick: value.of("tick").number(),
      kind: value.of("kind").one(EVENT_KINDS, "other"),
      text: value.of("text").text(),
    })).sort((a, b) => a.tick - b.tick),
    ghostLabel: root.of("ghostLabel").maybe((value) => value.text()),
    mainLabel: root.of("mainLabel").maybe((value) => value.text()),
    ended: root.of("ended").maybe((value) => value.text()),
  };
}
