// A thin dark (or light) edge around what is drawn, so that a pale shape stands out from the paper and from the next one.

import { BackSide, Color, EdgesGeometry, LineBasicMaterial, LineSegments, Mesh, ShaderMaterial, Vector2, type BufferGeometry } from "three";

/** Width \[px\]. */
const WIDTH = 1.4;
/** Of what one sees through, an edge is drawn where faces meet at more than this \[degrees\]. */
const SHARP_DEG = 30;
/** Corners of a shape whose edges are looked for. */
const MOST_CORNERS = 30_000;

// the far side of the shape, a little larger: what of it is seen is its edge
const VERTEX = `
uniform vec2 size;
uniform float width;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec4 out4 = projectionMatrix * vec4(normalMatrix * normal, 0.0);
  vec2 way = (out4.xy * gl_Position.w - gl_Position.xy * out4.w) * size;
  float far = length(way);
  if (far > 1.0e-9) gl_Position.xy += 2.0 * width * way / far / size * gl_Position.w;
}`;

const FRAGMENT = `
uniform vec3 colour;
void main() {
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
}`;

/** The material of all edges of a scene. */
export class Edges {
  private readonly material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    side: BackSide,
    uniforms: { size: { value: new Vector2(1, 1) }, width: { value: WIDTH }, colour: { value: new Color() } },
  });

  private readonly lines = new LineBasicMaterial({ transparent: true, depthWrite: false });

  /** Puts edges on a mesh that one sees through, of which the far side would be seen whole. */
  on(mesh: Mesh<BufferGeometry>): void {
    if (mesh.geometry.getAttribute("position").count > MOST_CORNERS) return;
    const edge = new LineSegments(new EdgesGeometry(mesh.geometry, SHARP_DEG), this.lines);
    edge.matrixAutoUpdate = false;
    edge.renderOrder = mesh.renderOrder;
    mesh.add(edge);
  }

  /** Puts an edge around a mesh. */
  around(mesh: Mesh<BufferGeometry>): void {
    const edge = new Mesh(mesh.geometry, this.material);
    edge.matrixAutoUpdate = false;
    mesh.add(edge);
  }

  /** Colours of what is around shapes, and of the lines on what one sees through. */
  colour(around: string, on: string): void {
    this.material.uniforms.colour.value.set(around);
    this.lines.color.set(on);
  }

  /** Size of the picture \[px\]. */
  resize(width: number, height: number): void {
    this.material.uniforms.size.value.set(width, height);
  }
}
