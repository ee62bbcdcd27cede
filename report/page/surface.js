// The finished workpiece, coloured by deviation, to be turned with the mouse.
import * as three from 'three';
import {creaseNormals} from './crease_normals.js';
import {unpack} from './packed_array.js';
import {viewIn} from './view.js';

const CREASE = 25 * Math.PI / 180;

const css = (colour) => `rgb(${colour.map((c) => Math.round(255 * c)).join(' ')})`;

// Linear-light colours of the scale in 1024 steps.
function colourTable(stops) {
  const table = [];
  const colour = new three.Color();
  for (let k = 0; k < 1024; ++k) {
    const place = k / 1023 * (stops.length - 1);
    const below = Math.min(Math.floor(place), stops.length - 2);
    const mix = (i) => stops[below][i] + (place - below) * (stops[below + 1][i] - stops[below][i]);
    colour.setRGB(mix(0), mix(1), mix(2), three.SRGBColorSpace);
    table.push([colour.r, colour.g, colour.b]);
  }
  return table;
}

// With the decimal sign of the page.
const localised = (text, words) => words.language === 'de' ? text.replace('.', ',') : text;

function deviationText(um, words) {
  const {unit, per_um} = words.deviation;
  const digits = localised(Math.abs(um * per_um).toFixed(per_um > 1 ? 1 : 3), words);
  return `${um > 0 ? '+' : um < 0 ? '−' : ''}${digits} ${unit}`;
}

function drawLegend(legend, surface, words) {
  const span = surface.span_um;
  const {unit, per_um} = span < 0.5 ? words.small_deviation : words.deviation;
  const shown = span * per_um;
  const text = (share) => (share > 0 ? '+' : share < 0 ? '−' : '') +
      localised(String(Number(Math.abs(share * shown).toPrecision(4))), words);
  const strip = document.createElement('div');
  strip.className = 'strip';
  strip.style.background = `linear-gradient(to top, ${surface.stops.map(css).join(', ')})`;
  const labels = [1, 0.5, 0, -0.5, -1].map((share) => {
    const label = document.createElement('span');
    label.textContent = text(share);
    label.style.top = `${50 * (1 - share)}%`;
    return label;
  });
  const heading = document.createElement('b');
  heading.textContent = unit;
  strip.append(...labels);
  legend.append(heading, strip);
  legend.hidden = false;
}

// Corner positions, colours and normals; `deviation` in um for each vertex, NaN where there is none.
async function geometryOf(surface) {
  const grid = await unpack(surface.positions, 3 * surface.vertices, 3);
  const corners = await unpack(surface.corners, 3 * surface.triangles, 3);
  const levels = surface.deviation ? await unpack(surface.deviation, surface.vertices, 1) : null;
  const positions = Float32Array.from(grid, (g, k) => surface.origin[k % 3] + g * surface.step);
  const deviation = new Float32Array(surface.vertices).fill(NaN);
  if (levels) {
    levels.forEach((level, v) => {
      if (level > 0) deviation[v] = ((level - 1) / 65534 * 2 - 1) * surface.limit_um;
    });
  }
  const table = colourTable(surface.stops);
  const none = new three.Color().setRGB(...surface.no_nominal, three.SRGBColorSpace).toArray();
  const place = new Float32Array(3 * corners.length);
  const colour = new Float32Array(3 * corners.length);
  for (let t = 0; t < corners.length; t += 3) {
    const isKnown = [0, 1, 2].every((k) => !Number.isNaN(deviation[corners[t + k]]));
    for (let k = 0; k < 3; ++k) {
      const v = corners[t + k];
      place.set(positions.subarray(3 * v, 3 * v + 3), 3 * (t + k));
      const share = Math.min(Math.max(deviation[v] / surface.span_um, -1), 1);
      colour.set(isKnown ? table[Math.round((share + 1) / 2 * 1023)] : none, 3 * (t + k));
    }
  }
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(place, 3));
  geometry.setAttribute('color', new three.BufferAttribute(colour, 3));
  geometry.setAttribute('normal',
                        new three.BufferAttribute(creaseNormals(positions, corners, CREASE), 3));
  geometry.computeBoundingBox();
  return {geometry, corners, deviation};
}

export function addLights(scene, camera) {
  scene.add(new three.HemisphereLight(0xffffff, 0x9aa2ad, 1.75));
  const key = new three.DirectionalLight(0xffffff, 1.55);
  key.position.set(-0.6, 0.9, 1);
  const fill = new three.DirectionalLight(0xffffff, 0.35);
  fill.position.set(1, 0.1, 0.5);
  camera.add(key, fill, key.target, fill.target);
  key.target.position.set(0, 0, -1);
  fill.target.position.set(0, 0, -1);
  scene.add(camera);
}

// Says in `reading` what is under a click: nearest corner of the triangle that was hit.
function readDeviations(element, camera, mesh, model, reading, words) {
  let pressed = null;
  element.addEventListener('pointerdown', (event) => pressed = [event.clientX, event.clientY]);
  element.addEventListener('pointerup', (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 3) return;
    const box = element.getBoundingClientRect();
    const at = new three.Vector2((event.clientX - box.left) / box.width * 2 - 1,
                                 1 - (event.clientY - box.top) / box.height * 2);
    const ray = new three.Raycaster();
    ray.setFromCamera(at, camera);
    const [hit] = ray.intersectObject(mesh);
    if (!hit) {
      reading.textContent = '';
      return;
    }
    const weights = new three.Vector3();
    const ends = [hit.face.a, hit.face.b, hit.face.c];
    const place = mesh.geometry.attributes.position;
    const [a, b, c] = ends.map((k) => new three.Vector3().fromBufferAttribute(place, k));
    three.Triangle.getBarycoord(hit.point, a, b, c, weights);
    const value = ends.reduce(
        (sum, k, i) => sum + weights.getComponent(i) * model.deviation[model.corners[k]], 0);
    const {unit, per_mm} = words.length;
    const where = hit.point.toArray()
        .map((x) => localised((x * per_mm).toFixed(per_mm < 1 ? 4 : 2), words))
        .join(words.language === 'de' ? '; ' : ', ');
    reading.textContent =
        `(${where}) ${unit}: ${Number.isNaN(value) ? words.no_nominal : deviationText(value, words)}`;
  });
}

export async function drawSurface(element, surface, words) {
  const figure = element.closest('figure');
  const view = viewIn(element);
  if (!view) return;
  const model = await geometryOf(surface);
  addLights(view.scene, view.camera);
  const mesh = new three.Mesh(model.geometry, new three.MeshStandardMaterial(
      {vertexColors: true, roughness: 0.62, metalness: 0, side: three.DoubleSide}));
  view.scene.add(mesh);
  readDeviations(view.canvas, view.camera, mesh, model, figure.querySelector('.reading'), words);
  if (surface.deviation) drawLegend(figure.querySelector('.legend'), surface, words);
  view.show(model.geometry.boundingBox, 1.06);
}
