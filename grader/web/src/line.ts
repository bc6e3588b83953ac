// Lines as wide as one likes \[px\]: each piece is a strip that the graphics card turns towards the eye.

import {
  Color,
  DoubleSide,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Float32BufferAttribute,
  Mesh,
  ShaderMaterial,
  Sphere,
  Vector2,
  Vector3,
} from "three";

const VERTEX = `
attribute vec3 from;
attribute vec3 to;
attribute vec2 along;
attribute vec2 order;
attribute vec3 tint;
uniform vec2 size;
uniform float width;
varying float vAlong;
varying float vOrder;
varying vec3 vTint;
void main() {
  vec4 a = modelViewMatrix * vec4(from, 1.0);
  vec4 b = modelViewMatrix * vec4(to, 1.0);
  float near = -1.0e-3;
  if (a.z > near && b.z < near) a.xyz = mix(a.xyz, b.xyz, (a.z - near) / (a.z - b.z));
  if (b.z > near && a.z < near) b.xyz = mix(b.xyz, a.xyz, (b.z - near) / (b.z - a.z));
  vec4 p = projectionMatrix * a;
  vec4 q = projectionMatrix * b;
  vec2 way = (q.xy / q.w - p.xy / p.w) * size;
  float length = max(length(way), 1.0e-4);
  way = length > 1.0e-3 ? way / length : vec2(1.0, 0.0);
  vec2 off = vec2(-way.y, way.x) * position.y + way * (2.0 * position.x - 1.0) * 0.5;
  gl_Position = position.x < 0.5 ? p : q;
  gl_Position.xy += off * width / size * gl_Position.w;
  vAlong = position.x < 0.5 ? along.x : along.y;
  vOrder = position.x < 0.5 ? order.x : order.y;
  vTint = tint;
}`;

const FRAGMENT = `
uniform vec3 colour;
uniform float tinted;
uniform float now;
uniform float dash;
varying float vAlong;
varying float vOrder;
varying vec3 vTint;
void main() {
  if (vOrder > now || (dash > 0.0 && fract(vAlong / dash) > 0.55)) discard;
  gl_FragColor = vec4(mix(colour, vTint, tinted), 1.0);
  #include <colorspace_fragment>
}`;

/** More points than any line has. */
const EVER = 1e9;

export interface LineStyle {
  /** Width \[px\]. */
  readonly width: number;
  /** Length of a dash and its gap \[m\]. */
  readonly dash?: number;
}

/** A line through points, or pieces of two points each where `pieces`. */
export class Line extends Mesh<InstancedBufferGeometry, ShaderMaterial> {
  constructor(points: ArrayLike<number>, style: LineStyle, pieces = false, tints: readonly Color[] | null = null) {
    const count = points.length / 3;
    const segments = Math.max(0, pieces ? count / 2 : count - 1);
    const ends = new Float32Array(6 * segments);
    const along = new Float32Array(2 * segments);
    const order = new Float32Array(2 * segments);
    const tint = new Float32Array(3 * segments);
    const middle = new Vector3();
    let length = 0;
    for (let s = 0; s < segments; s++) {
      const a = 3 * (pieces ? 2 * s : s);
      for (let c = 0; c < 6; c++) ends[6 * s + c] = points[a + c];
      along[2 * s] = length;
      length += Math.hypot(points[a + 3] - points[a], points[a + 4] - points[a + 1], points[a + 5] - points[a + 2]);
      along[2 * s + 1] = length;
      order[2 * s] = s;
      order[2 * s + 1] = s + 1;
      tints?.[s]?.toArray(tint, 3 * s);
    }
    for (let i = 0; i < count; i++) middle.set(middle.x + points[3 * i] / count, middle.y + points[3 * i + 1] / count, middle.z + points[3 * i + 2] / count);
    let radius = 0;
    for (let i = 0; i < count; i++) {
      radius = Math.max(radius, Math.hypot(points[3 * i] - middle.x, points[3 * i + 1] - middle.y, points[3 * i + 2] - middle.z));
    }
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const split = (o: number): Float32Array => {
      const out = new Float32Array(3 * segments);
      for (let s = 0; s < segments; s++) for (let c = 0; c < 3; c++) out[3 * s + c] = ends[6 * s + o + c];
      return out;
    };
    geometry.setAttribute("from", new InstancedBufferAttribute(split(0), 3));
    geometry.setAttribute("to", new InstancedBufferAttribute(split(3), 3));
    geometry.setAttribute("along", new InstancedBufferAttribute(along, 2));
    geometry.setAttribute("order", new InstancedBufferAttribute(order, 2));
    geometry.setAttribute("tint", new InstancedBufferAttribute(tint, 3));
    geometry.instanceCount = segments;
    geometry.boundingSphere = new Sphere(middle, radius);
    super(
      geometry,
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        transparent: true,
        depthWrite: false,
        side: DoubleSide,
        uniforms: {
          size: { value: new Vector2(1, 1) },
          width: { value: style.width },
          colour: { value: new Color() },
          tinted: { value: tints ? 1 : 0 },
          now: { value: EVER },
          dash: { value: style.dash ?? 0 },
        },
      }),
    );
  }

  set colour(colour: string) {
    this.material.uniforms.colour.value.set(colour);
  }

  /** Leaves out the pieces that begin at these steps. */
  leaveOut(at: (step: number) => boolean): void {
    const order = this.geometry.getAttribute("order");
    for (let s = 0; s < order.count; s++) if (at(s)) order.setXY(s, 2 * EVER, 2 * EVER);
    order.needsUpdate = true;
  }

  /** Puts a line of two points elsewhere. */
  between(a: ArrayLike<number>, b: ArrayLike<number>): void {
    for (const [name, p] of [["from", a], ["to", b]] as const) {
      const ends = this.geometry.getAttribute(name);
      ends.setXYZ(0, p[0], p[1], p[2]);
      ends.needsUpdate = true;
    }
  }

  /** How far along the points it is drawn. */
  set now(order: number) {
    this.material.uniforms.now.value = order;
  }

  /** Size of the picture \[px\]. */
  resize(width: number, height: number): void {
    this.material.uniforms.size.value.set(width, height);
  }
}
