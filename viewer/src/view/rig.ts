// The camera and who moves it: turning, zooming, bringing things into the frame.
import { Box3, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Vec } from "./pick";

/** Width that the legend takes, in pixels. */
const LEGEND = 170;

/** Points to be seen: planar positions (all x, all y, all z), and which of them. */
export interface Framed {
  positions: Float32Array;
  nodes: readonly number[];
}

function bounds({ positions, nodes }: Framed): Box3 {
  const n = positions.length / 3;
  const box = new Box3();
  const x = new Vector3();
  for (const i of nodes) box.expandByPoint(x.set(positions[i]!, positions[n + i]!, positions[2 * n + i]!));
  if (box.isEmpty()) box.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  return box;
}

export class Rig {
  readonly camera = new PerspectiveCamera(28, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private size = 1;
  private covered = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly moved: () => void,
  ) {
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", moved);
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / height;
    // The legend stands at the right: the middle of the picture moves to the middle of what is left.
    this.covered = width > 3 * LEGEND ? LEGEND / width : 0;
    this.camera.setViewOffset(width, height, (this.covered * width) / 2, 0, width, height);
    this.camera.updateProjectionMatrix();
  }

  /**
   * Brings points into the frame.
   * @param all  of everything that is seen
   * @param some what is to fill the frame, with something around it; undefined: all
   */
  fit(all: Framed, some?: Framed): void {
    this.size = Math.max(bounds(all).getSize(new Vector3()).length() / 2, 1e-12);
    const { positions, nodes } = some ?? all;
    const centre = bounds(some ?? all).getCenter(new Vector3());
    const back = this.camera.position.clone().sub(this.controls.target).normalize();
    const right = this.camera.up.clone().cross(back).normalize();
    const up = back.clone().cross(right);
    const vertical = Math.tan(((this.camera.fov / 2) * Math.PI) / 180);
    const horizontal = vertical * this.camera.aspect * (1 - this.covered);
    // The nearest place from which every node is seen: depth + side/tan for each. Perspective makes what is near larger: the middle of
    // the picture is found in a few rounds.
    const n = positions.length / 3;
    const x = new Vector3();
    let distance = 0;
    for (let round = 0; round < 4; round++) {
      distance = 0;
      for (const i of nodes) {
        x.set(positions[i]!, positions[n + i]!, positions[2 * n + i]!).sub(centre);
        distance = Math.max(distance, x.dot(back) + Math.max(Math.abs(x.dot(right)) / horizontal, Math.abs(x.dot(up)) / vertical));
      }
      if (round === 3 || !(distance > 0)) break;
      const extent = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };
      for (const i of nodes) {
        x.set(positions[i]!, positions[n + i]!, positions[2 * n + i]!).sub(centre);
        const depth = distance - x.dot(back);
        if (!(depth > 0)) continue;
        extent.left = Math.min(extent.left, x.dot(right) / depth);
        extent.right = Math.max(extent.right, x.dot(right) / depth);
        extent.low = Math.min(extent.low, x.dot(up) / depth);
        extent.high = Math.max(extent.high, x.dot(up) / depth);
      }
      if (!Number.isFinite(extent.left)) break;
      centre.addScaledVector(right, (distance * (extent.left + extent.right)) / 2);
      centre.addScaledVector(up, (distance * (extent.low + extent.high)) / 2);
    }
    distance = Math.max(1.08 * distance, some ? (0.16 * this.size) / vertical : 1e-9 * this.size);
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(back, distance);
    this.updateDepth();
    this.controls.update();
    this.moved();
  }

  /** Pixels of the window that a length where the camera looks at takes. */
  get pixelsPerLength(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return this.canvas.clientHeight / (2 * distance * Math.tan(((this.camera.fov / 2) * Math.PI) / 180));
  }

  /** Looks from this direction at where it looked before. */
  look(direction: Vec): void {
    this.camera.position.copy(this.controls.target).add(new Vector3(...direction).normalize());
  }

  /** Near and far plane for where the camera is. */
  updateDepth(): void {
    const distance = this.camera.position.distanceTo(this.controls.target) + this.controls.target.length();
    this.camera.near = Math.max(1e-3 * this.size, 1e-3 * distance);
    this.camera.far = distance + 12 * this.size;
    this.camera.updateProjectionMatrix();
  }

  turn(azimuth: number, polar: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, azimuth);
    const right = offset.clone().cross(this.camera.up).normalize();
    const turned = offset.clone().applyAxisAngle(right, polar);
    if (Math.abs(turned.clone().normalize().dot(this.camera.up)) < 0.995) offset.copy(turned);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.moved();
  }
  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.moved();
  }

  /** The line of sight through a point of the window. */
  ray(x: number, y: number): { origin: Vec; direction: Vec } {
    const box = this.canvas.getBoundingClientRect();
    const from = this.camera.position.clone();
    const to = new Vector3(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2, 0.5).unproject(this.camera);
    return { origin: from.toArray() as Vec, direction: to.sub(from).normalize().toArray() as Vec };
  }

  /** Where a point is drawn, in pixels of the window. */
  project(point: Vec): { x: number; y: number } {
    const v = new Vector3(...point).project(this.camera);
    const box = this.canvas.getBoundingClientRect();
    return { x: box.left + ((v.x + 1) / 2) * box.width, y: box.top + ((1 - v.y) / 2) * box.height };
  }
}
