// Shapes as triangles: all of a node's in one piece, so that a node is drawn at once.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  CylinderGeometry,
  Matrix4,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import type { Mesh, SceneNode, Solid } from "./data";

function flat(mesh: Mesh): BufferGeometry {
  const { vertices, triangles } = mesh;
  const positions = new Float32Array(3 * triangles.length);
  for (let i = 0; i < triangles.length; i++) {
    for (let c = 0; c < 3; c++) positions[3 * i + c] = vertices[3 * triangles[i] + c];
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** A solid about its own origin; cylinders and capsules stand along z. */
function geometryOf(solid: Solid, meshes: readonly Mesh[]): BufferGeometry {
  switch (solid.kind) {
    case "box":
      return new BoxGeometry(solid.size[0], solid.size[1], solid.size[2]).toNonIndexed();
    case "cylinder":
      return new CylinderGeometry(solid.radius, solid.radius, solid.length, 32).rotateX(Math.PI / 2).toNonIndexed();
    case "capsule":
      return new CapsuleGeometry(solid.radius, solid.length, 8, 24).rotateX(Math.PI / 2).toNonIndexed();
    case "sphere":
      return new SphereGeometry(solid.radius, 28, 18).toNonIndexed();
    case "mesh":
      return flat(meshes[solid.mesh]);
  }
}

/** All shapes of a node in its frame, or nothing where it has none. */
export function geometry(node: SceneNode, meshes: readonly Mesh[]): BufferGeometry | null {
  const parts = node.shapes.map((shape) => {
    const [x, y, z, w, qx, qy, qz] = shape.pose;
    const turn = new Quaternion(qx, qy, qz, w).normalize();
    return geometryOf(shape.solid, meshes).applyMatrix4(new Matrix4().compose(new Vector3(x, y, z), turn, new Vector3(1, 1, 1)));
  });
  const count = parts.reduce((sum, part) => sum + part.getAttribute("position").array.length, 0);
  if (count === 0) return null;
  const out = new BufferGeometry();
  for (const name of ["position", "normal"]) {
    const values = new Float32Array(count);
    let at = 0;
    for (const part of parts) {
      values.set(part.getAttribute(name).array, at);
      at += part.getAttribute(name).array.length;
    }
    out.setAttribute(name, new BufferAttribute(values, 3));
  }
  for (const part of parts) part.dispose();
  out.computeBoundingSphere();
  return out;
}

/** A tube around points: rings across the line between each point's neighbours, and rounded ends. */
export function tube(points: ReadonlyArray<readonly number[]>, radius: number): BufferGeometry {
  const sides = 16;
  const kept = points.filter((p, i) => i === 0 || distance(p, points[i - 1]) > 1e-9);
  if (kept.length < 2) {
    const [x, y, z] = kept[0] ?? [0, 0, 0];
    return new SphereGeometry(radius, 24, 16).translate(x, y, z);
  }
  const ways = kept.slice(1).map((p, i) => new Vector3(p[0] - kept[i][0], p[1] - kept[i][1], p[2] - kept[i][2]).normalize());
  const positions: number[] = [];
  const across = new Vector3();
  const beside = new Vector3();
  const ring = (p: readonly number[], r: number, shift: number, way: Vector3): void => {
    // the ring is turned as little as possible from the one before, so that the tube is not wrung
    if (across.lengthSq() === 0) across.set(Math.abs(way.z) < 0.9 ? 0 : 1, 0, Math.abs(way.z) < 0.9 ? 1 : 0);
    across.addScaledVector(way, -across.dot(way));
    if (across.lengthSq() < 1e-12) across.set(way.y, way.z, way.x).addScaledVector(way, -(way.x * way.y + way.y * way.z + way.z * way.x));
    across.normalize();
    beside.crossVectors(way, across);
    for (let s = 0; s < sides; s++) {
      const c = r * Math.cos((2 * Math.PI * s) / sides);
      const d = r * Math.sin((2 * Math.PI * s) / sides);
      positions.push(
        p[0] + shift * way.x + c * across.x + d * beside.x,
        p[1] + shift * way.y + c * across.y + d * beside.y,
        p[2] + shift * way.z + c * across.z + d * beside.z,
      );
    }
  };
  const caps = [0, 0.25, 0.5, 0.75, 1];
  for (const c of caps) ring(kept[0], radius * Math.sin((c * Math.PI) / 2), -radius * Math.cos((c * Math.PI) / 2), ways[0]);
  for (let i = 1; i + 1 < kept.length; i++) {
    const way = new Vector3().addVectors(ways[i - 1], ways[i]);
    ring(kept[i], radius, 0, way.lengthSq() > 1e-6 ? way.normalize() : ways[i]);
  }
  const last = ways[ways.length - 1];
  for (const c of caps) ring(kept[kept.length - 1], radius * Math.cos((c * Math.PI) / 2), radius * Math.sin((c * Math.PI) / 2), last);
  const rings = positions.length / 3 / sides;
  const index: number[] = [];
  for (let r = 0; r + 1 < rings; r++) {
    for (let s = 0; s < sides; s++) {
      const a = r * sides + s;
      const b = r * sides + ((s + 1) % sides);
      index.push(a, b, a + sides, b, b + sides, a + sides);
    }
  }
  const out = new BufferGeometry();
  out.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  out.setIndex(index);
  out.computeVertexNormals();
  return out;
}

function distance(a: readonly number[], b: readonly number[]): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
