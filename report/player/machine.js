// The machine: two chains of joints from the bed, the bodies that hang on them, the tools and the workpiece.
import * as three from 'three';
import {creaseNormals} from '../page/crease_normals.js';
import {unpack} from '../page/packed_array.js';

const CREASE = 25 * Math.PI / 180;
const AROUND = 48;  // faces of bodies of revolution

// three.js turns about Y; our bodies turn about Z.
function turnedGeometry(meridian) {
  const points = meridian.map(([r, z]) => new three.Vector2(r, z));
  const geometry = new three.LatheGeometry(points, AROUND).toNonIndexed();
  geometry.rotateX(Math.PI / 2);
  const position = geometry.attributes.position.array;
  turnOutwards(position);
  const corners = Uint32Array.from({length: position.length / 3}, (_, k) => k);
  geometry.setAttribute('normal', new three.BufferAttribute(facetNormals(position, corners), 3));
  return geometry;
}

// A meridian may run upwards or downwards.
function turnOutwards(position) {
  let volume = 0;
  for (let k = 0; k < position.length; k += 9) {
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = position.subarray(k, k + 9);
    volume += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  if (volume >= 0) return;
  for (let k = 0; k < position.length; k += 9) {
    for (let i = 3; i < 6; ++i) [position[k + i], position[k + i + 3]] = [position[k + i + 3], position[k + i]];
  }
}

// Round about the axis, sharp along the meridian: normals of facets, averaged where they are alike at one place.
function facetNormals(position, corners) {
  const places = new Map(), merged = [], index = new Uint32Array(corners.length);
  for (let k = 0; k < corners.length; ++k) {
    const key = [0, 1, 2].map((i) => Math.round(position[3 * k + i] * 1e4)).join();
    if (!places.has(key)) {
      places.set(key, merged.length / 3);
      merged.push(position[3 * k], position[3 * k + 1], position[3 * k + 2]);
    }
    index[k] = places.get(key);
  }
  return creaseNormals(Float32Array.from(merged), index, CREASE);
}

export async function meshGeometry(mesh) {
  const [grid, corners] = await Promise.all(
      [unpack(mesh.positions, 3 * mesh.vertices, 3), unpack(mesh.corners, 3 * mesh.triangles, 3)]);
  const positions = Float32Array.from(grid, (g, k) => mesh.origin[k % 3] + g * mesh.step);
  const place = new Float32Array(3 * corners.length);
  corners.forEach((corner, k) => place.set(positions.subarray(3 * corner, 3 * corner + 3), 3 * k));
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(place, 3));
  geometry.setAttribute('normal', new three.BufferAttribute(creaseNormals(positions, corners, CREASE), 3));
  return geometry;
}

async function geometryOf(shape) {
  if (shape.box) {
    const [x, y, z] = shape.box;
    return new three.BoxGeometry(x, y, z).translate(0, 0, z / 2);
  }
  return shape.meridian ? turnedGeometry(shape.meridian) : meshGeometry(shape.mesh);
}

const still = (object) => {
  object.matrixAutoUpdate = false;
  return object;
};

// Bodies of one kind share a material; edges make translucent ones legible. What fills the screen is shaded as cheaply
// as it can be: without a graphics card, translucent bodies of a costly material would take most of a frame.
export const materials = {
  machine: new three.MeshLambertMaterial(),
  glass: new three.MeshBasicMaterial({transparent: true, opacity: 0.15, depthWrite: false}),
  fixture: new three.MeshLambertMaterial(),
  cutter: new three.MeshLambertMaterial({transparent: true, opacity: 0.82}),
  shank: new three.MeshLambertMaterial(),
  holder: new three.MeshLambertMaterial(),
  // Behind what is drawn on it.
  part: new three.MeshLambertMaterial(
      {side: three.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2}),
  edges: new three.LineBasicMaterial({transparent: true, opacity: 0.55}),
};

export class Machine {
  // Root of the scene: the bed, unless the workpiece is at rest.
  root = still(new three.Group());
  workpiece = still(new three.Group());
  tool = still(new three.Group());
  bodies = [];  // of the machine, with their edges

  #joints;
  #parts = [];     // group, joint, and whether a chain begins with it
  #spindle = still(new three.Group());
  #spindleOffset = new three.Matrix4();
  #workpieceFromLast = new three.Matrix4();
  #tools = new Map();
  #shown = null;
  #turn = new three.Matrix4();
  #along = new three.Matrix4();
  #workpieceFromBed = new three.Matrix4();
  #axis = new three.Vector3();

  static async of(data, tools) {
    const machine = new Machine(data);
    await machine.#add(data, tools);
    return machine;
  }

  constructor(data) {
    this.#joints = data.joints.map((joint) => ({
      ...joint, direction: new three.Vector3(...joint.direction), offset: new three.Vector3(...joint.offset),
    }));
    let linear = 0, rotary = 0, side = 0;
    for (const joint of this.#joints) {
      joint.column = joint.rotary ? rotary++ : linear++;
      this.#parts.push({group: still(new three.Group()), joint, isFirst: joint.side !== side});
      side = joint.side;
    }
    this.linearCount = linear;
    this.rotaryCount = rotary;
    this.root.add(...this.#parts.map(({group}) => group), this.#spindle, this.workpiece);
    this.workpiece.add(this.tool);
    this.#spindleOffset.makeTranslation(...data.spindle);
    this.#workpieceFromLast.makeTranslation(...data.table).multiply(new three.Matrix4().fromArray(data.workpiece));
  }

  async #add(data, tools) {
    for (const body of data.bodies) {
      const geometry = await geometryOf(body.shape);
      const mesh = still(new three.Mesh(geometry, body.fixture ? materials.fixture : materials.machine));
      mesh.matrix.fromArray(body.pose);
      const edges = still(new three.LineSegments(new three.EdgesGeometry(geometry, 30), materials.edges));
      edges.matrix.fromArray(body.pose);
      this.#group(body.side, body.joints).add(mesh, edges);
      if (!body.fixture) this.bodies.push(mesh, edges);
    }
    for (const {number, bodies} of tools) {
      const group = still(new three.Group());
      for (const {name, meridian} of bodies) {
        group.add(still(new three.Mesh(turnedGeometry(meridian), materials[name])));
      }
      group.visible = false;
      this.#tools.set(number, group);
      this.tool.add(group);
    }
  }

  #group(side, joints) {
    if (side === 0) return this.root;
    const chain = this.#parts.filter(({joint}) => joint.side === side);
    return chain[joints - 1].group;
  }

  // X, Y, Z, then the rotary axes.
  get letters() {
    return this.#joints.map(({letter, rotary, column}) => ({letter, rotary, column}))
        .sort((a, b) => a.rotary - b.rotary || (a.letter < b.letter ? -1 : 1));
  }

  // Frames of all parts where the axes are; `linear` and `rotary` by their columns, mm and rad.
  pose(linear, rotary) {
    let last = null;
    let spindle = null, table = null;
    for (const part of this.#parts) {
      const {joint, group, isFirst} = part;
      const matrix = group.matrix;
      if (isFirst) matrix.identity();
      else matrix.copy(last);
      const {offset} = joint;
      const q = joint.side * (joint.rotary ? rotary[joint.column] : linear[joint.column]);
      if (joint.rotary) {
        this.#turn.makeRotationAxis(joint.direction, q);
        this.#turn.setPosition(offset);
      } else {
        this.#axis.copy(joint.direction).multiplyScalar(q).add(offset);
        this.#turn.makeTranslation(this.#axis.x, this.#axis.y, this.#axis.z);
      }
      matrix.multiply(this.#turn);
      group.matrixWorldNeedsUpdate = true;
      last = matrix;
      if (joint.side > 0) spindle = matrix;
      else table = matrix;
    }
    if (spindle) this.#spindle.matrix.copy(spindle).multiply(this.#spindleOffset);
    else this.#spindle.matrix.copy(this.#spindleOffset);
    if (table) this.workpiece.matrix.copy(table).multiply(this.#workpieceFromLast);
    else this.workpiece.matrix.copy(this.#workpieceFromLast);
    this.workpiece.matrixWorldNeedsUpdate = true;
    this.#workpieceFromBed.copy(this.workpiece.matrix).invert();
  }

  // The tool is where the path has its tip, and leans as the axes hold it.
  placeTool(x, y, z) {
    this.#along.multiplyMatrices(this.#workpieceFromBed, this.#spindle.matrix);
    this.#along.setPosition(x, y, z);
    this.tool.matrix.copy(this.#along);
    this.tool.matrixWorldNeedsUpdate = true;
  }

  // Where the axes alone put the tip of a tool of this length, in the workpiece frame.
  tipOfAxes(length, tip) {
    this.#along.multiplyMatrices(this.#workpieceFromBed, this.#spindle.matrix);
    return tip.set(0, 0, -length).applyMatrix4(this.#along);
  }

  showTool(number) {
    if (this.#shown === number) return;
    if (this.#tools.has(this.#shown)) this.#tools.get(this.#shown).visible = false;
    if (this.#tools.has(number)) this.#tools.get(number).visible = true;
    this.#shown = number;
  }

  // 'translucent', 'solid' or 'hidden'.
  drawBodies(how) {
    for (const body of this.bodies) {
      body.visible = how !== 'hidden';
      if (body.isMesh) body.material = how === 'solid' ? materials.machine : materials.glass;
    }
  }

  // The bed at rest, or the workpiece.
  hold(what) {
    if (what === 'workpiece') this.root.matrix.copy(this.#workpieceFromBed);
    else this.root.matrix.identity();
    this.root.matrixWorldNeedsUpdate = true;
  }
}
