// Materials of the picture: faces coloured by a field or by their parts, and things of one colour.
import {
  DataTexture,
  DoubleSide,
  GLSL3,
  NearestFilter,
  NoColorSpace,
  RGBAFormat,
  RawShaderMaterial,
  UnsignedByteType,
  Vector2,
  Vector3,
  Vector4,
} from "three";
import type { Look, Range } from "../data/fields";
import { colorTable, type ColorMap } from "./colormap";
import { COLORS, faceFragment, faceVertex, plainFragment, plainVertex } from "./shaders";

/** How the quanta of a displacement become positions; everything that moves with the mesh shares one. */
export interface Displacement {
  uLow: { value: Vector3 };
  uRange: { value: Vector3 };
  uDeform: { value: number };
}
export function displacement(scale: number): Displacement {
  return { uLow: { value: new Vector3() }, uRange: { value: new Vector3() }, uDeform: { value: scale } };
}

/** What the colours of a picture say. */
export interface Coloring {
  quanta: Uint16Array;
  /** Of the quanta. */
  range: Range;
  /** Of the colours. */
  shown: Range;
  on: "node" | "element";
  look: Look;
}

/** One material per way of colouring, compiled when it is first wanted; they share their uniforms. */
export class FaceMaterials {
  private readonly made = new Map<string, RawShaderMaterial>();
  private readonly value = new Vector2();
  private readonly shown = new Vector2(0, 1);
  private readonly colors = { value: null as DataTexture | null };

  constructor(private readonly moves: Displacement) {}

  /** @param coloring undefined: the colours of the parts */
  of(coloring: Coloring | undefined): RawShaderMaterial {
    if (coloring) {
      this.value.set(coloring.range.low, coloring.range.high - coloring.range.low);
      this.setShown(coloring.shown);
    }
    const key = coloring ? `${coloring.look} ${coloring.on}` : "parts";
    let material = this.made.get(key);
    if (!material) {
      const defines: Record<string, string> = {};
      if (coloring) defines[coloring.look.toUpperCase()] = "";
      if (coloring?.on === "element") defines["ELEMENT"] = "";
      material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: faceVertex,
        fragmentShader: faceFragment,
        defines,
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
        uniforms: { ...this.moves, uValue: { value: this.value }, uShown: { value: this.shown }, uColors: this.colors },
      });
      this.made.set(key, material);
    }
    return material;
  }

  setShown(shown: Range): void {
    this.shown.set(shown.low, shown.high);
  }

  setColorMap(map: ColorMap): void {
    const texture = new DataTexture(colorTable(map, COLORS), COLORS, 1, RGBAFormat, UnsignedByteType);
    texture.minFilter = texture.magFilter = NearestFilter;
    texture.colorSpace = NoColorSpace;
    texture.needsUpdate = true;
    this.colors.value?.dispose();
    this.colors.value = texture;
  }
}

/**
 * One colour.
 * @param size of points, in pixels of the screen
 * @param forward towards the eye, of the depth's range: what lies on the mesh is seen
 */
export function plainMaterial(moves: Displacement, color: Vector4, { size = 1, forward = 0, round = false } = {}): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: plainVertex,
    fragmentShader: plainFragment,
    side: DoubleSide,
    transparent: color.w < 1,
    uniforms: { ...moves, uColor: { value: color }, uSize: { value: size }, uForward: { value: forward }, uRound: { value: round } },
  });
}
