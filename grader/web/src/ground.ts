// The ground: a grid that fades into the distance.

import { Color, DoubleSide, Mesh, PlaneGeometry, ShaderMaterial, Vector2 } from "three";
import { pitchFor } from "./pitch";

const VERTEX = `
varying vec2 place;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  place = world.xy;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

const FRAGMENT = `
uniform vec3 colour;
uniform float pitch;
uniform vec2 middle;
uniform float reach;
varying vec2 place;
float lines(float every) {
  vec2 p = place / every;
  vec2 wide = fwidth(p);
  vec2 near = abs(fract(p - 0.5) - 0.5) / max(wide, vec2(1.0e-6));
  float fine = 1.0 - smoothstep(0.2, 0.6, max(wide.x, wide.y));
  return (1.0 - min(min(near.x, near.y), 1.0)) * fine;
}
void main() {
  float fade = 1.0 - smoothstep(0.35, 1.0, length(place - middle) / reach);
  float alpha = max(0.22 * lines(pitch), 0.5 * lines(5.0 * pitch)) * fade;
  if (alpha < 0.004) discard;
  gl_FragColor = vec4(colour, alpha);
  #include <colorspace_fragment>
}`;

export class Grid extends Mesh<PlaneGeometry, ShaderMaterial> {
  constructor(x: number, y: number, z: number, radius: number) {
    const reach = 4 * radius;
    super(
      new PlaneGeometry(2 * reach, 2 * reach),
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        transparent: true,
        depthWrite: false,
        side: DoubleSide,
        uniforms: {
          colour: { value: new Color() },
          pitch: { value: pitchFor(radius) },
          middle: { value: new Vector2(x, y) },
          reach: { value: reach },
        },
      }),
    );
    this.position.set(x, y, z);
    this.renderOrder = -2;
  }

  set colour(colour: string) {
    this.material.uniforms.colour.value.set(colour);
  }
}
