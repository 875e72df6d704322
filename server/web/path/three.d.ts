/** What views in space use of three r111, whose package has no types. */
declare module "three" {
  export class Vector3 {
    constructor(x?: number, y?: number, z?: number);
    set(x: number, y: number, z: number): this;
  }
  export class Vector2 {
    constructor(x?: number, y?: number);
    set(x: number, y: number): this;
  }
  export class Color {
    constructor(colour: string);
    r: number;
    g: number;
    b: number;
    set(colour: string): this;
  }
  export class Matrix4 {
    makeBasis(x: Vector3, y: Vector3, z: Vector3): this;
    setPosition(x: number, y: number, z: number): this;
  }
  export class Object3D {
    visible: boolean;
    frustumCulled: boolean;
    renderOrder: number;
    matrixAutoUpdate: boolean;
    matrix: Matrix4;
    position: Vector3;
    up: Vector3;
    rotation: { set(x: number, y: number, z: number, order?: string): void };
    quaternion: { setFromUnitVectors(from: Vector3, to: Vector3): void };
    add(...objects: Object3D[]): this;
    remove(...objects: Object3D[]): this;
    clear?(): void;
    lookAt(x: number, y: number, z: number): void;
    updateMatrixWorld(force?: boolean): void;
    children: Object3D[];
  }
  export class Group extends Object3D {}
  export class Scene extends Object3D {}
  export class OrthographicCamera extends Object3D {
    constructor(left: number, right: number, top: number, bottom: number, near: number, far: number);
    left: number;
    right: number;
    top: number;
    bottom: number;
    near: number;
    far: number;
    updateProjectionMatrix(): void;
  }
  export class BufferAttribute {
    constructor(array: Float32Array | Uint32Array, size: number);
    array: Float32Array | Uint32Array;
    needsUpdate: boolean;
  }
  export class BufferGeometry {
    setAttribute(name: string, attribute: BufferAttribute): this;
    setIndex(attribute: BufferAttribute): this;
    setDrawRange(first: number, count: number): void;
    translate(x: number, y: number, z: number): this;
    dispose(): void;
  }
  export class Path {
    setFromPoints(points: Vector2[]): this;
  }
  export class Shape extends Path {
    constructor(points: Vector2[]);
    holes: Path[];
  }
  export class ExtrudeBufferGeometry extends BufferGeometry {
    constructor(shape: Shape, options: { depth: number; bevelEnabled: boolean; curveSegments?: number });
  }
  export class CylinderBufferGeometry extends BufferGeometry {
    constructor(top: number, bottom: number, height: number, radial?: number, along?: number, open?: boolean);
  }
  export class SphereBufferGeometry extends BufferGeometry {
    constructor(radius: number, width?: number, height?: number);
  }
  export class Material {
    constructor(options?: Record<string, unknown>);
    color: Color;
    dispose(): void;
  }
  export class LineBasicMaterial extends Material {}
  export class ShaderMaterial extends Material {
    uniforms: Record<string, { value: any }>;
  }
  export class MeshLambertMaterial extends Material {}
  export class PointsMaterial extends Material {}
  export class Mesh extends Object3D {
    constructor(geometry: BufferGeometry, material: Material);
    geometry: BufferGeometry;
  }
  export class LineSegments extends Object3D {
    constructor(geometry: BufferGeometry, material: Material);
    geometry: BufferGeometry;
  }
  export class Points extends Object3D {
    constructor(geometry: BufferGeometry, material: Material);
  }
  export class AmbientLight extends Object3D {
    constructor(colour: number, intensity: number);
  }
  export class DirectionalLight extends Object3D {
    constructor(colour: number, intensity: number);
  }
  export class WebGLRenderer {
    constructor(options: Record<string, unknown>);
    setPixelRatio(ratio: number): void;
    setSize(width: number, height: number, style: boolean): void;
    setClearColor(colour: number, alpha: number): void;
    render(scene: Scene, camera: OrthographicCamera): void;
    dispose(): void;
  }
  export const VertexColors: number;
  export const DoubleSide: number;
}
