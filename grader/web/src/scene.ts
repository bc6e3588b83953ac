// The run as things to draw: nodes, trail, reference, goals, tolerances, contacts and frames, all in the world with z up.

import {
  AmbientLight,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Object3D,
  PlaneGeometry,
  Scene,
  ShadowMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { Arrow, type Drawing } from "./arrow";
import { bones, reach, type Bone } from "./bones";
import { contactMarks, coverAt, type ContactMark } from "./contacts";
import type { Frame, Scenery } from "./data";
import type { Extent } from "./extent";
import { hidden } from "./ghosts";
import { Grid } from "./ground";
import { left, nearest, offAt, type Left } from "./left";
import { Line } from "./line";
import { namedFrames } from "./named";
import { Edges } from "./outline";
import { geometry, tube } from "./shapes";
import { colourOf, turn, turns, type Theme, type Turn } from "./theme";
import type { Part } from "./view";
import { Velocity } from "./velocity";
import type { Placed } from "./world";

/** Contacts that are marked. */
const MOST_CONTACTS = 200;
/** The arrow of the greatest force of a run is as long as this part of its size. */
const LONGEST_FORCE = 0.35;

type Glass = MeshBasicMaterial;

export class RunScene {
  readonly scene = new Scene();
  /** The named frames, the lab's among them. */
  readonly frames: readonly Frame[];
  /** Length of a frame's axes \[m\]. */
  readonly axis: number;
  private readonly lab = new Group();
  private readonly nodes: Array<{ mesh: Mesh<BufferGeometry, MeshLambertMaterial>; turn: Turn }> = [];
  private readonly edges = new Edges();
  private readonly moving: Array<{ object: Object3D; index: number }> = [];
  private readonly sticks: Array<{ bone: Bone; stick: Mesh; ball: Mesh }> = [];
  private readonly contacts: Array<{ mesh: Mesh<BufferGeometry, Glass>; mark: ContactMark; arrow: Arrow | null }> = [];
  private readonly lines: Array<{ line: Line; colour: keyof Theme }> = [];
  private readonly glasses: Array<{ material: Glass; colour: keyof Theme }> = [];
  private readonly trail: Line;
  private readonly dot: Mesh;
  /** Where the path to follow was left: what is drawn over the trail, and the arrow back to the path. */
  private readonly left: readonly Left[];
  private readonly off: Line[] = [];
  private readonly arrow: Arrow | null = null;
  /** The velocity of the TCP, and that which was commanded. */
  private readonly velocity: Velocity;
  private readonly moved: Arrow;
  private readonly wanted: Arrow;
  private moves = false;
  private readonly tip = new Float64Array(3);
  private readonly referenceDot: Mesh | null = null;
  private readonly axes: Array<{ line: Line; node: number | null }> = [];
  private readonly grid: Grid;
  private readonly sun = new DirectionalLight();
  private readonly sky = new HemisphereLight();
  private readonly fill = new AmbientLight();
  private readonly floor: Mesh<PlaneGeometry, ShadowMaterial>;
  private readonly spot = new Float64Array(7);
  private readonly along = new Vector3();
  private readonly across = new Vector3();
  private readonly beside = new Vector3();

  constructor(
    private readonly replay: Scenery,
    private readonly world: Placed,
    extent: Extent,
    theme: Theme,
  ) {
    const { scene, lab } = this;
    this.frames = namedFrames(replay);
    const unit = extent.radius;
    this.axis = 0.16 * unit;
    scene.matrixAutoUpdate = false;
    lab.matrixAutoUpdate = false;
    scene.add(lab);

    this.sun.position.set(extent.centre[0] - 0.9 * unit, extent.centre[1] - 1.6 * unit, extent.centre[2] + 2.6 * unit);
    this.sun.target.position.set(...extent.centre);
    this.sun.castShadow = true;
    const shadow = this.sun.shadow;
    shadow.mapSize.set(1536, 1536);
    const reach = 1.6 * unit;
    Object.assign(shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.5 * unit, far: 6.5 * unit });
    shadow.bias = -0.0004;
    shadow.normalBias = 0.004 * unit;
    this.sky.position.set(0, 0, 1);
    scene.add(this.sun, this.sun.target, this.sky, this.fill);

    this.grid = new Grid(extent.centre[0], extent.centre[1], extent.ground, unit);
    this.floor = new Mesh(new PlaneGeometry(8 * unit, 8 * unit), new ShadowMaterial({ depthWrite: false }));
    this.floor.position.set(extent.centre[0], extent.centre[1], extent.ground - 0.001 * unit);
    this.floor.receiveShadow = true;
    this.floor.renderOrder = -3;
    scene.add(this.grid, this.floor);

    const colours = turns(replay.nodes);
    let ghosts = 0;
    replay.nodes.forEach((node, index) => {
      const shape = hidden(replay, node) ? null : geometry(node, replay.meshes);
      if (!shape) return;
      const ghost = node.kind === "ghost";
      const material = new MeshLambertMaterial();
      if (ghost) Object.assign(material, { transparent: true, opacity: 0.34, depthWrite: false, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8 });
      const mesh = new Mesh(shape, material);
      mesh.castShadow = !ghost;
      mesh.receiveShadow = !ghost;
      mesh.matrixAutoUpdate = false;
      if (ghost) mesh.renderOrder = 5 + 0.01 * ghosts++;
      if (ghost) this.edges.on(mesh);
      else this.edges.around(mesh);
      this.nodes.push({ mesh, turn: colours[index] });
      if (node.track >= 0) this.moving.push({ object: mesh, index });
      this.put(mesh, index);
      scene.add(mesh);
    });

    const sticks = bones(replay);
    if (sticks.length > 0) {
      // from the origin to 1 along z, with a ball at its end
      const stick = new CylinderGeometry(0.014 * unit, 0.014 * unit, 1, 16).rotateX(Math.PI / 2).translate(0, 0, 0.5);
      const ball = new SphereGeometry(0.024 * unit, 18, 12);
      sticks.forEach((bone, i) => {
        const material = new MeshLambertMaterial(bone.ghost ? { transparent: true, opacity: 0.34, depthWrite: false } : {});
        const made = [stick, ball].map((shape) => {
          const mesh = new Mesh<BufferGeometry, MeshLambertMaterial>(shape, material);
          mesh.matrixAutoUpdate = false;
          mesh.castShadow = !bone.ghost;
          scene.add(mesh);
          if (bone.ghost) this.edges.on(mesh);
          else this.edges.around(mesh);
          this.nodes.push({ mesh, turn: bone.ghost ? "ghost" : turn(i) });
          return mesh;
        });
        this.sticks.push({ bone, stick: made[0], ball: made[1] });
      });
    }

    const glass = (colour: keyof Theme, opacity: number): Glass => {
      const material = new MeshBasicMaterial({ transparent: true, opacity, depthWrite: false });
      this.glasses.push({ material, colour });
      return material;
    };
    const add = (parent: Object3D, shape: BufferGeometry, material: Glass, layer: number): Mesh<BufferGeometry, Glass> => {
      const mesh = new Mesh(shape, material);
      mesh.renderOrder = layer;
      mesh.matrixAutoUpdate = false;
      parent.add(mesh);
      return mesh;
    };
    const draw = (line: Line, colour: keyof Theme, layer: number): Line => {
      line.renderOrder = layer;
      line.matrixAutoUpdate = false;
      this.lines.push({ line, colour });
      return line;
    };

    for (const path of replay.paths) {
      if (path.zero !== null && path.zero > 0) add(lab, tube(path.points, path.zero), glass("path", 0.07), 1);
      if (path.full !== null && path.full > 0) add(lab, tube(path.points, path.full), glass("path", 0.2), 2);
      if (path.points.length > 1) lab.add(draw(new Line(path.points.flat(), { width: 1.5 }), "path", 3));
    }
    const speck = new SphereGeometry(0.011 * unit, 16, 12);
    for (const goal of replay.goals) {
      const [x, y, z] = goal.position;
      if (goal.zero !== null && goal.zero > 0) add(lab, new SphereGeometry(goal.zero, 32, 24).translate(x, y, z), glass("goal", 0.1), 1);
      if (goal.full !== null && goal.full > 0) add(lab, new SphereGeometry(goal.full, 24, 18).translate(x, y, z), glass("goal", 0.35), 2);
      add(lab, speck.clone().translate(x, y, z), glass("goal", 0.9), 3);
    }
    const reference = replay.reference?.path;
    if (reference && reference.count > 1) {
      lab.add(draw(new Line(reference.values, { width: 2, dash: 0.035 * unit }), "reference", 5));
      this.referenceDot = add(lab, speck, glass("reference", 1), 6);
    }
    // in two, so that what has passed lies on top of what is to come; and pale rather than clear, which would show every joint
    lab.add(draw(new Line(replay.tcp.values, { width: 2 }), "future", 4));
    this.trail = draw(new Line(replay.tcp.values, { width: 3.5 }), "trail", 6);
    lab.add(this.trail);
    this.dot = add(lab, speck, glass("trail", 1), 7);
    this.left = left(replay);
    for (const { off } of this.left) {
      const line = draw(new Line(replay.tcp.values, { width: 6, dash: 0.02 * unit }), "left", 6.5);
      line.leaveOut((step) => !off[step]);
      lab.add(line);
      this.off.push(line);
    }
    const arrow = (parent: Object3D, colour: keyof Theme, layer: number, over = false): Arrow => {
      const drawing: Drawing = { line: (line, layer) => draw(line, colour, layer), glass: () => glass(colour, 1) };
      return new Arrow(parent, drawing, layer, unit, over);
    };
    if (this.left.length > 0) this.arrow = arrow(lab, "left", 7);
    this.velocity = new Velocity(replay, unit);
    this.wanted = arrow(lab, "wanted", 7.2);
    this.moved = arrow(lab, "velocity", 7.3);

    // round, as its mark on the time line
    const ball = new SphereGeometry(1, 20, 14);
    for (const mark of contactMarks(replay, MOST_CONTACTS)) {
      const material = glass("contact", 1);
      material.depthTest = false;
      const mesh = add(scene, ball, material, 8);
      const size = 0.014 * unit * mark.size;
      mesh.matrix.makeScale(size, size, size).setPosition(mark.point[0], mark.point[1], mark.point[2]);
      mesh.matrixWorldNeedsUpdate = true;
      const { force, point } = mark;
      const pressing = force ? arrow(scene, "contact", 8.5, true) : null;
      if (force) pressing?.aim(point, point.map((x, c) => x + LONGEST_FORCE * unit * force[c]));
      this.contacts.push({ mesh, mark, arrow: pressing });
    }

    const tips = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map((axis) => axis.multiplyScalar(this.axis));
    for (const frame of this.frames) {
      const points = tips.flatMap((tip) => [0, 0, 0, ...tip.toArray()]);
      const line = new Line(points, { width: 2.5 }, true, theme.axes.map((axis) => new Color(axis)));
      line.material.depthTest = false;
      line.renderOrder = 9;
      line.matrixAutoUpdate = false;
      line.visible = false;
      scene.add(line);
      this.axes.push({ line, node: frame.node });
    }
    this.colour(theme);
    this.pose();
  }

  private put(object: Object3D, index: number): void {
    this.write(object, this.world.poses, 7 * index);
  }

  private write(object: Object3D, p: Float64Array, o: number): void {
    const w = p[o + 3], x = p[o + 4], y = p[o + 5], z = p[o + 6];
    object.matrix.set(
      1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), p[o],
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), p[o + 1],
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), p[o + 2],
      0, 0, 0, 1,
    );
    object.matrixWorldNeedsUpdate = true;
  }

  /** Puts everything where the world has it. */
  pose(): void {
    const { world } = this;
    for (let i = 0; i < this.moving.length; i++) this.put(this.moving[i].object, this.moving[i].index);
    for (let i = 0; i < this.sticks.length; i++) this.stretch(this.sticks[i].bone, this.sticks[i].stick, this.sticks[i].ball);
    if (world.there) this.leaveOut(world);
    this.write(this.lab, world.lab, 0);
    this.trail.now = world.progress;
    for (const line of this.off) line.now = world.progress;
    this.dot.matrix.setPosition(world.tcp[0], world.tcp[1], world.tcp[2]);
    this.dot.matrixWorldNeedsUpdate = true;
    if (this.arrow) this.point(this.arrow);
    this.drawVelocities();
    const reference = this.replay.reference;
    if (reference && this.referenceDot) {
      const { values, count } = reference.path;
      const at = Math.min(count - 1, Math.max(0, world.t / reference.periodS));
      const i = Math.floor(at);
      const k = Math.min(count - 1, i + 1);
      const f = at - i;
      this.referenceDot.matrix.setPosition(
        values[3 * i] + f * (values[3 * k] - values[3 * i]),
        values[3 * i + 1] + f * (values[3 * k + 1] - values[3 * i + 1]),
        values[3 * i + 2] + f * (values[3 * k + 2] - values[3 * i + 2]),
      );
      this.referenceDot.matrixWorldNeedsUpdate = true;
    }
    const tick = world.t / this.replay.stepS;
    for (let i = 0; i < this.contacts.length; i++) {
      const { mesh, mark, arrow } = this.contacts[i];
      const cover = coverAt(mark, tick);
      mesh.visible = cover > 0;
      mesh.material.opacity = cover;
      if (arrow) arrow.visible = cover > 0;
    }
    if (this.axes.length && this.axes[0].line.visible) {
      const { frames } = this;
      for (let i = 0; i < this.axes.length; i++) {
        world.frame(this.spot, frames[i].node, frames[i].pose);
        this.write(this.axes[i].line, this.spot, 0);
      }
    }
  }

  /** Points from the TCP to where the path is, while it is off. */
  private point(arrow: Arrow): void {
    const { world, spot } = this;
    const off = offAt(this.left, world.progress);
    if (!off) {
      arrow.visible = false;
      return;
    }
    nearest(spot, off.path, world.tcp);
    arrow.aim(world.tcp, spot);
  }

  private drawVelocities(): void {
    const { moved, wanted, velocity, tip, world } = this;
    moved.visible = wanted.visible = false;
    if (!this.moves) return;
    velocity.actual(tip, world.progress);
    velocity.tip(tip, world.tcp);
    moved.aim(world.tcp, tip);
    if (!velocity.wanted(tip, world.progress)) return;
    velocity.tip(tip, world.tcp);
    wanted.aim(world.tcp, tip);
  }

  /** Shows of what moves only what is there. */
  private leaveOut(world: Placed): void {
    for (const { object, index } of this.moving) object.visible = world.there?.(index) ?? true;
    for (const { bone, stick, ball } of this.sticks) stick.visible = ball.visible = world.there?.(bone.to) ?? true;
  }

  /** Lays a stick from where it begins to where it ends. */
  private stretch(bone: Bone, stick: Mesh, ball: Mesh): void {
    const { poses } = this.world;
    const o = 7 * bone.from;
    reach(this.spot, this.world, bone);
    const { along, across, beside } = this;
    along.set(this.spot[0] - poses[o], this.spot[1] - poses[o + 1], this.spot[2] - poses[o + 2]);
    const length = along.length();
    across.set(Math.abs(along.z) < 0.9 * length ? 0 : 1, 0, Math.abs(along.z) < 0.9 * length ? 1 : 0);
    beside.crossVectors(along, across).normalize();
    across.crossVectors(beside, along).normalize();
    stick.matrix.makeBasis(across, beside, along).setPosition(poses[o], poses[o + 1], poses[o + 2]);
    stick.matrixWorldNeedsUpdate = true;
    ball.matrix.setPosition(this.spot[0], this.spot[1], this.spot[2]);
    ball.matrixWorldNeedsUpdate = true;
  }

  resize(width: number, height: number): void {
    for (const { line } of this.lines) line.resize(width, height);
    for (const { line } of this.axes) line.resize(width, height);
    this.edges.resize(width, height);
  }

  show(part: Part, on: boolean): void {
    if (part === "frames") for (const { line } of this.axes) line.visible = on;
    else if (part === "shadows") {
      this.sun.castShadow = on;
      this.floor.visible = on;
    } else if (part === "velocity") this.moves = on;
    else for (const { mesh, turn } of this.nodes) if (turn === "ghost") mesh.visible = on;
  }

  colour(theme: Theme): void {
    for (const { mesh, turn } of this.nodes) mesh.material.color.set(colourOf(theme, turn));
    this.edges.colour(theme.edge, theme.ghost);
    for (const { line, colour } of this.lines) line.colour = theme[colour] as string;
    for (const { material, colour } of this.glasses) material.color.set(theme[colour] as string);
    for (const { line } of this.axes) {
      const tint = line.geometry.getAttribute("tint");
      theme.axes.forEach((axis, i) => {
        const { r, g, b } = new Color(axis);
        tint.setXYZ(i, r, g, b);
      });
      tint.needsUpdate = true;
    }
    this.grid.colour = theme.grid;
    this.sky.color.set(theme.sky);
    this.sky.groundColor.set(theme.earth);
    this.sky.intensity = theme.light[0];
    this.fill.intensity = 0.25;
    this.sun.intensity = theme.light[1];
    this.floor.material.opacity = theme.shadow;
  }

  /** Gives back what a renderer holds of the scene, which else would hold the renderer: the next one makes it anew. */
  forget(): void {
    this.sun.shadow.map?.dispose();
    this.sun.shadow.map = null;
    this.scene.traverse((object) => {
      const { geometry, material } = object as Partial<Mesh>;
      geometry?.dispose();
      for (const one of [material ?? []].flat()) one.dispose();
    });
  }
}
