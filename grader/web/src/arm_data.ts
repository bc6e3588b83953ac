// What the page says of a robot that its reader moves: joints, shapes and frames, checked once.

import type { Chain, Mount } from "./chain";
import { mesh, solid, Value, type Mesh, type Shape } from "./data";

export interface ArmData {
  readonly name: string;
  readonly chain: Chain;
  readonly nodes: ReadonlyArray<{ readonly name: string; readonly shapes: readonly Shape[] }>;
  readonly meshes: readonly Mesh[];
  readonly labName: string;
  /** What is shown from the start. */
  readonly branches: boolean;
  readonly jacobian: boolean;
}

const FORMAT = "kinemark-arm/1";

/** Reads an arm. Throws with a sentence that says what is wrong with it. */
export function readArm(json: string): ArmData {
  const root = new Value(JSON.parse(json), "");
  const format = root.of("format").text();
  if (format !== FORMAT) throw new Error(`its format is ${format}, and this page shows ${FORMAT}`);
  const meshes = root.of("meshes").list(mesh);
  const nodes = root.of("nodes").list((value) => ({
    name: value.of("name").text(),
    shapes: value.of("shapes").list((shape) => ({ solid: solid(shape.of("solid"), meshes.length), pose: shape.of("pose").pose() })),
  }));
  const q = root.of("q").list((value) => ({
    name: value.of("name").text(),
    unit: value.of("unit").text(),
    lower: value.of("lower").maybe((v) => v.number()),
    upper: value.of("upper").maybe((v) => v.number()),
  }));
  // the root stands; every other node hangs on one that is there
  const hung = new Set([0]);
  const joints = root.of("joints").list((value) => {
    const joint = {
      parent: value.of("parent").index(nodes.length),
      child: value.of("child").index(nodes.length),
      pose: value.of("pose").pose(),
      axis: value.of("axis").numbers(3),
      turns: value.of("turns").yes(),
      q: value.of("q").maybe((v) => v.index(q.length)),
      gear: value.of("gear").number(),
      offset: value.of("offset").number(),
    };
    if (!hung.has(joint.parent) || hung.has(joint.child)) throw new Error(`${nodes[joint.child].name} hangs on nothing`);
    hung.add(joint.child);
    return joint;
  });
  if (hung.size !== nodes.length) throw new Error("a link has no joint");
  const mount = (value: Value): Mount => ({ node: value.of("node").index(nodes.length), pose: value.of("pose").pose() });
  return {
    name: root.of("name").text(),
    chain: { count: nodes.length, joints, q, tcp: mount(root.of("tcp")), lab: mount(root.of("lab")) },
    nodes,
    meshes,
    labName: root.of("lab").of("name").text(),
    branches: root.of("branches").yes(),
    jacobian: root.of("jacobian").yes(),
  };
}
