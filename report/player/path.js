// The tool path: one set of line segments, coloured by feed, deviation or time, drawn up to a point; the rest of it
// faintly. Deviations are magnified where the lines are drawn, so that this costs nothing. While it plays or turns, long
// paths are drawn by fewer segments, which are within half a pixel of them.
import * as three from 'three';

const SCALE = [[0.16, 0.36, 0.78], [0.09, 0.55, 0.75], [0.16, 0.62, 0.47], [0.66, 0.62, 0.13], [0.87, 0.45, 0.1], [0.76, 0.15, 0.15]];
const RAPID = [0.56, 0.6, 0.65];

// 1, 2 or 5 times a power of ten, at or above.
function roundedUp(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => step * power).find((limit) => limit >= value * (1 - 1e-9));
}

function colourInto(colours, at, share) {
  const place = Math.min(Math.max(share, 0), 1) * (SCALE.length - 1);
  const below = Math.min(Math.floor(place), SCALE.length - 2), part = place - below;
  for (let i = 0; i < 3; ++i) {
    colours[at + i] = Math.round(255 * (SCALE[below][i] + part * (SCALE[below + 1][i] - SCALE[below][i])));
  }
}

export const css = (colour) => `rgb(${colour.map((c) => Math.round(255 * c)).join(' ')})`;
export const scaleColours = () => SCALE.map(css);
export const rapidColour = () => css(RAPID);

// What a colouring shows: values at the two ends of each motion, the end of the scale, and the unit there.
function colouring(model, kind) {
  const {count, times, deviations, reached, starts, blocks, block} = model;
  if (kind === 'time') {
    const isLong = model.duration > 600;
    return {limit: model.duration, unit: isLong ? 'min' : 's', factor: isLong ? 1 / 60 : 1, at: (k) => times[k]};
  }
  if (kind === 'deviation') {
    const size = (k) => 1000 * Math.hypot(deviations[3 * k], deviations[3 * k + 1], deviations[3 * k + 2]);
    let largest = 0;
    for (let k = 0; k < count; ++k) largest = Math.max(largest, size(k));
    const limit = roundedUp(largest);
    return {limit, unit: limit < 0.5 ? 'nm' : 'µm', factor: limit < 0.5 ? 1000 : 1, at: size, none: largest < 5e-6};
  }
  let largest = 0;
  for (let k = 1; k < count; ++k) {
    if (!blocks.rapid[block[k]] && !starts[k]) largest = Math.max(largest, reached[k]);
  }
  return {limit: roundedUp(largest), unit: 'mm/min', factor: 1, ofMotion: (k) => reached[k]};
}

const MOST_DRAWN = 12000;  // segments that are drawn in full while it plays
const SKIPPED = 48;        // points at most from one of the fewer segments' ends to the next

// Points whose chords leave no point between them farther off than `tolerance`.
function fewerPoints({count, tips, starts}, tolerance) {
  const points = [0];
  const near = (a, b) => {
    const ax = tips[3 * a], ay = tips[3 * a + 1], az = tips[3 * a + 2];
    const dx = tips[3 * b] - ax, dy = tips[3 * b + 1] - ay, dz = tips[3 * b + 2] - az;
    const length2 = dx * dx + dy * dy + dz * dz;
    for (let k = a + 1; k < b; ++k) {
      const x = tips[3 * k] - ax, y = tips[3 * k + 1] - ay, z = tips[3 * k + 2] - az;
      const t = length2 > 0 ? Math.min(Math.max((x * dx + y * dy + z * dz) / length2, 0), 1) : 0;
      if ((x - t * dx) ** 2 + (y - t * dy) ** 2 + (z - t * dz) ** 2 > tolerance * tolerance) return false;
    }
    return true;
  };
  for (let a = 0; a + 1 < count;) {
    let b = a + 1;
    if (!starts[b]) {
      while (b + 1 < count && !starts[b + 1] && b - a < SKIPPED && near(a, b + 1)) ++b;
    }
    points.push(b);
    a = b;
  }
  return Uint32Array.from(points);
}

// Lines that share their vertices: what is done, and what is still ahead.
class Lines {
  constructor(places, shifts, colours, materials) {
    this.colours = new three.BufferAttribute(colours, 3, true);
    const place = new three.BufferAttribute(places, 3), shift = new three.BufferAttribute(shifts, 3);
    this.objects = materials.map((material) => {
      const geometry = new three.BufferGeometry();
      geometry.setAttribute('position', place);
      geometry.setAttribute('deviation', shift);
      geometry.setAttribute('color', this.colours);
      const object = new three.LineSegments(geometry, material);
      object.frustumCulled = false;
      return object;
    });
  }
  // Segments [begin, now) as done, [now, end) as ahead.
  show(begin, now, end) {
    this.objects[0].geometry.setDrawRange(2 * begin, 2 * (now - begin));
    this.objects[1].geometry.setDrawRange(2 * now, 2 * (end - now));
  }
}

export class Path {
  group = new three.Group();
  magnify = {value: 1};

  #model;
  #all;
  #few = null;
  #points = null;   // ends of the fewer segments
  #isBrief = false;
  #shown = 1;
  #current;
  #projected;
  #projection = new three.Matrix4();

  constructor(model) {
    this.#model = model;
    const materials = [{}, {transparent: true, opacity: 0.28, depthWrite: false}].map((options) => {
      const made = new three.LineBasicMaterial({vertexColors: true, ...options});
      made.onBeforeCompile = (shader) => {
        shader.uniforms.magnify = this.magnify;
        shader.vertexShader = 'attribute vec3 deviation;\nuniform float magnify;\n' +
            shader.vertexShader.replace('#include <begin_vertex>', 'vec3 transformed = position + magnify * deviation;');
      };
      return made;
    });
    const {count, tips, starts} = model;
    this.#all = this.#linesOf(count, (k) => k === 0 || starts[k] ? k : k - 1, (k) => k, materials);
    this.group.add(...this.#all.objects);
    if (count > MOST_DRAWN) {
      let low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      tips.forEach((x, i) => {
        low[i % 3] = Math.min(low[i % 3], x);
        high[i % 3] = Math.max(high[i % 3], x);
      });
      const points = fewerPoints(model, Math.hypot(...high.map((x, i) => x - low[i])) / 2000);
      this.#points = points;
      this.#few = this.#linesOf(points.length, (k) => k === 0 || starts[points[k]] ? points[k] : points[k - 1],
                                (k) => points[k], materials);
      this.group.add(...this.#few.objects);
      this.#few.objects.forEach((object) => object.visible = false);
    }
    const two = new three.BufferGeometry();
    two.setAttribute('position', new three.BufferAttribute(new Float32Array(6), 3).setUsage(three.DynamicDrawUsage));
    this.#current = new three.LineSegments(two, new three.LineBasicMaterial());
    this.#current.frustumCulled = false;
    this.group.add(this.#current);
    this.#projected = new Float32Array(3 * count);
  }

  // Segment k from point begin(k) to point end(k).
  #linesOf(count, begin, end, materials) {
    const {tips, deviations} = this.#model;
    const places = new Float32Array(6 * count), shifts = new Float32Array(6 * count);
    for (let k = 0; k < count; ++k) {
      const from = 3 * begin(k), to = 3 * end(k);
      for (let i = 0; i < 3; ++i) {
        places[6 * k + i] = tips[from + i];
        places[6 * k + 3 + i] = tips[to + i];
        shifts[6 * k + i] = deviations[from + i];
        shifts[6 * k + 3 + i] = deviations[to + i];
      }
    }
    return new Lines(places, shifts, new Uint8Array(6 * count), materials);
  }

  get drawnBriefly() { return this.#points?.length ?? this.#model.count; }

  // Fewer segments while the picture moves, where there are many.
  brief(isBrief) {
    if (!this.#few || isBrief === this.#isBrief) return;
    this.#isBrief = isBrief;
    this.#few.objects.forEach((object) => object.visible = isBrief);
    this.#divide();
  }

  #divide() {
    const k = this.#shown, {count} = this.#model;
    if (!this.#isBrief) {
      this.#all.show(0, k, count);
      return;
    }
    // The one of the fewer segments that is under way is drawn in full.
    const points = this.#points;
    let low = 1, high = points.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (points[middle] < k) low = middle + 1;
      else high = middle;
    }
    this.#all.show(points[low - 1] + 1, k, points[low] + 1);
    this.#few.show(0, low, low);
    this.#few.objects[1].geometry.setDrawRange(2 * (low + 1), 2 * (points.length - low - 1));
  }

  // Returns the legend: the limit of the scale, the unit, what a value is multiplied with.
  colour(kind) {
    const {count, block, blocks} = this.#model;
    const shown = colouring(this.#model, kind);
    const colours = this.#all.colours.array;
    for (let k = 0; k < count; ++k) {
      if (shown.ofMotion && blocks.rapid[block[k]]) {
        for (let i = 0; i < 6; ++i) colours[6 * k + i] = Math.round(255 * RAPID[i % 3]);
        continue;
      }
      const end = shown.ofMotion ? shown.ofMotion(k) : shown.at(k);
      const begin = shown.ofMotion || k === 0 ? end : shown.at(k - 1);
      colourInto(colours, 6 * k, begin / shown.limit);
      colourInto(colours, 6 * k + 3, end / shown.limit);
    }
    this.#all.colours.needsUpdate = true;
    if (this.#few) {
      // From the colour with which the first of its motions begins to that with which the last one ends.
      const few = this.#few.colours.array, points = this.#points;
      for (let k = 0; k < points.length; ++k) {
        const first = 6 * (k === 0 ? 0 : points[k - 1] + 1), last = 6 * points[k] + 3;
        for (let i = 0; i < 3; ++i) {
          few[6 * k + i] = colours[first + i];
          few[6 * k + 3 + i] = colours[last + i];
        }
      }
      this.#few.colours.needsUpdate = true;
    }
    return shown;
  }

  setInk(colour) { this.#current.material.color.set(colour); }

  // All motions before point k are done; that to it is under way and has reached x, y, z.
  showTo(k, x, y, z) {
    this.#shown = k;
    this.#divide();
    const {tips, deviations, starts} = this.#model;
    const position = this.#current.geometry.attributes.position, magnify = this.magnify.value;
    const from = starts[k] ? 3 * k : 3 * k - 3;
    position.array[0] = tips[from] + magnify * deviations[from];
    position.array[1] = tips[from + 1] + magnify * deviations[from + 1];
    position.array[2] = tips[from + 2] + magnify * deviations[from + 2];
    position.array[3] = x;
    position.array[4] = y;
    position.array[5] = z;
    position.needsUpdate = true;
  }

  // Places of all points on a canvas of width x height, px, and their depths.
  #project(camera, width, height) {
    const m = this.#projection.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse)
                  .multiply(this.group.matrixWorld).elements;
    const {count, tips, deviations} = this.#model;
    const places = this.#projected, magnify = this.magnify.value;
    for (let i = 0; i < 3 * count; i += 3) {
      const x = tips[i] + magnify * deviations[i], y = tips[i + 1] + magnify * deviations[i + 1],
            z = tips[i + 2] + magnify * deviations[i + 2];
      const w = m[3] * x + m[7] * y + m[11] * z + m[15];
      const scale = w > 0 ? 1 / w : NaN;  // behind the camera nothing is near
      places[i] = (0.5 + 0.5 * scale * (m[0] * x + m[4] * y + m[8] * z + m[12])) * width;
      places[i + 1] = (0.5 - 0.5 * scale * (m[1] * x + m[5] * y + m[9] * z + m[13])) * height;
      places[i + 2] = w;
    }
    return places;
  }

  placeOf(point, camera, width, height) {
    const places = this.#project(camera, width, height);
    return {x: places[3 * point], y: places[3 * point + 1]};
  }

  // The motion that is nearest to a place of the canvas: its point and how far along it is, within `reach` px. Of
  // motions on one line of sight that in front counts, as if it were up to half of the reach nearer.
  pick(camera, width, height, px, py, reach) {
    const places = this.#project(camera, width, height);
    const {count, starts} = this.#model;
    let near = Infinity, far = -Infinity;
    for (let k = 2; k < places.length; k += 3) {
      near = Math.min(near, places[k]);
      far = Math.max(far, places[k]);
    }
    const depth = Math.max(far - near, 1e-6);
    let best = Infinity, point = 0, share = 1;
    for (let k = 1; k < count; ++k) {
      if (starts[k]) continue;
      const i = 3 * k, ax = places[i - 3], ay = places[i - 2];
      const dx = places[i] - ax, dy = places[i + 1] - ay;
      const length2 = dx * dx + dy * dy;
      let t = length2 > 0 ? ((px - ax) * dx + (py - ay) * dy) / length2 : 1;
      t = t < 0 ? 0 : t > 1 ? 1 : t;
      const ex = ax + t * dx - px, ey = ay + t * dy - py;
      const distance = Math.sqrt(ex * ex + ey * ey);
      if (!(distance <= reach)) continue;
      const behind = Math.floor(8 * (places[i + 2] - near) / depth) / 8;
      const score = distance + 0.5 * reach * behind;
      if (score < best) {
        best = score;
        point = k;
        share = t;
      }
    }
    return point === 0 ? null : {point, share};
  }
}
