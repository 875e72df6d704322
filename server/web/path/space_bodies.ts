/** Bodies of a scene as objects of three. */
import {
  BufferAttribute, BufferGeometry, Color, CylinderBufferGeometry, DoubleSide, ExtrudeBufferGeometry, Group, LineBasicMaterial, LineSegments, Material,
  Matrix4, Mesh, MeshLambertMaterial, Object3D, Path, Points, PointsMaterial, Shape, SphereBufferGeometry, Vector2, Vector3,
} from "three";
import type { Body, Point } from "../base/scene";

export interface BodyColours {
  solid: string;
  edge: string;
  moving: string;
}

const vector = (p: Point): Vector3 => new Vector3(...p);

function frameOf(body: Body): Object3D {
  const group = new Group(), frame = body.frame;
  if (frame) {
    group.matrixAutoUpdate = false;
    group.matrix = new Matrix4().makeBasis(vector(frame.x), vector(frame.y), vector(frame.z)).setPosition(...frame.origin);
  }
  return group;
}

const sharpTurn = Math.cos((30 * Math.PI) / 180);

/** Returns the ends of a prism's edges: the rings of both faces, and the lines between them where a ring turns sharply. */
export function prismEdges(rings: readonly (readonly [number, number])[][], from: number, to: number): Point[] {
  const ends: Point[] = [];
  for (const ring of rings)
    ring.forEach(([x, y], k) => {
      const [x0, y0] = ring[(k + ring.length - 1) % ring.length]!, [x1, y1] = ring[(k + 1) % ring.length]!;
      for (const z of [from, to]) ends.push([x, y, z], [x1, y1, z]);
      const before = Math.hypot(x - x0, y - y0), after = Math.hypot(x1 - x, y1 - y);
      if ((x - x0) * (x1 - x) + (y - y0) * (y1 - y) < sharpTurn * before * after) ends.push([x, y, from], [x, y, to]);
    });
  return ends;
}

/** A cylinder about the line from a to b, with round ends where asked for. */
function rod(a: Point, b: Point, radius: number, round: "none" | "end" | "both", material: Material, radial: number): Object3D {
  const group = new Group(), along = [0, 1, 2].map((k) => b[k]! - a[k]!), length = Math.hypot(...along);
  if (length > 0) {
    const mesh = new Mesh(new CylinderBufferGeometry(radius, radius, length, radial, 1, round === "both"), material);
    mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(along[0]! / length, along[1]! / length, along[2]! / length));
    mesh.position.set((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2);
    group.add(mesh);
  }
  const ends = round === "both" ? [a, b] : round === "end" ? [b] : [];
  for (const end of ends) {
    const ball = new Mesh(new SphereBufferGeometry(radius, radial, Math.ceil(radial / 2)), material);
    ball.position.set(...end);
    group.add(ball);
  }
  return group;
}

export function polylineGeometry(points: readonly Point[]): BufferGeometry {
  const ends = new Float32Array(Math.max(0, points.length - 1) * 6);
  for (let i = 1; i < points.length; ++i) ends.set([...points[i - 1]!, ...points[i]!], 6 * (i - 1));
  return new BufferGeometry().setAttribute("position", new BufferAttribute(ends, 3));
}

/** Returns a body other than a wire as an object. Bodies through which the path leads are translucent. */
export function bodyObject(body: Body, colours: BodyColours): Object3D {
  const moves = body.moves === "tool", frame = frameOf(body);
  const translucent = !moves;
  const surface = (opacity: number): Material =>
    new MeshLambertMaterial({
      color: new Color(moves ? colours.moving : colours.solid), transparent: translucent, opacity: translucent ? opacity : 1, depthWrite: !translucent, side: DoubleSide,
    });
  const edge = (opacity: number): Material => new LineBasicMaterial({ color: new Color(colours.edge), transparent: true, opacity });
  const points = body.points ?? [], radius = body.radius ?? 0;
  if (body.kind === "extrusion" && body.outline) {
    const plane = (list: [number, number][]): Vector2[] => list.map(([x, y]) => new Vector2(x, y));
    const shape = new Shape(plane(body.outline));
    shape.holes = (body.holes ?? []).map((hole) => new Path().setFromPoints(plane(hole)));
    const from = body.from ?? 0, to = body.to ?? from, geometry = new ExtrudeBufferGeometry(shape, { depth: to - from, bevelEnabled: false });
    const ends = new Float32Array(prismEdges([body.outline, ...(body.holes ?? [])], from, to).flat());
    frame.add(new Mesh(geometry.translate(0, 0, from), surface(0.16)), new LineSegments(new BufferGeometry().setAttribute("position", new BufferAttribute(ends, 3)), edge(0.45)));
  } else if (body.kind === "cylinder" && points.length > 1) {
    frame.add(rod(points[0]!, points[points.length - 1]!, radius, body.round_end ? "end" : "none", surface(0.3), 20));
  } else if (body.kind === "tube") {
    for (let i = 1; i < points.length; ++i) frame.add(rod(points[i - 1]!, points[i]!, radius, "both", surface(0.12), 14));
  } else if (body.kind === "points") {
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points.flat()), 3));
    frame.add(new Points(geometry, new PointsMaterial({ color: new Color(colours.moving), size: 7, sizeAttenuation: false })));
  } else if (points.length > 1) {
    frame.add(new LineSegments(polylineGeometry(points), edge(0.9)));
  }
  return frame;
}
