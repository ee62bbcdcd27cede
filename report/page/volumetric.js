// Error vectors over a working volume: the nominal grid, the grid as the errors deform it, and an arrow at
// each point, magnified.
import * as three from 'three';
import {onTheme, theme} from './theme.js';
import {viewIn} from './view.js';

// Pairs of neighbours along the three directions of the grid.
function neighbours([nx, ny, nz]) {
  const pairs = [];
  const at = (i, j, k) => i + nx * (j + ny * k);
  for (let k = 0; k < nz; ++k) {
    for (let j = 0; j < ny; ++j) {
      for (let i = 0; i < nx; ++i) {
        if (i + 1 < nx) pairs.push([at(i, j, k), at(i + 1, j, k)]);
        if (j + 1 < ny) pairs.push([at(i, j, k), at(i, j + 1, k)]);
        if (k + 1 < nz) pairs.push([at(i, j, k), at(i, j, k + 1)]);
      }
    }
  }
  return pairs;
}

function segments(points, pairs) {
  const place = new Float32Array(6 * pairs.length);
  pairs.forEach(([a, b], n) => place.set([...points[a], ...points[b]], 6 * n));
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(place, 3));
  return geometry;
}

export function drawVolume(element, volume) {
  const figure = element.closest('figure');
  const view = viewIn(element);
  if (!view) return;
  const box = new three.Box3().setFromPoints(volume.places.map((p) => new three.Vector3(...p)));
  const radius = Math.max(box.getSize(new three.Vector3()).length() / 2, 1);
  const pairs = neighbours(volume.counts);
  const lines = (opacity) =>
      new three.LineSegments(new three.BufferGeometry(),
                             new three.LineBasicMaterial({transparent: true, opacity}));
  const nominal = lines(0.45), deformed = lines(0.9), shafts = lines(1);
  nominal.geometry = segments(volume.places, pairs);
  const heads = new three.InstancedMesh(new three.ConeGeometry(1, 3, 12).translate(0, -1.5, 0),
                                        new three.MeshBasicMaterial(), volume.places.length);
  view.scene.add(nominal, deformed, shafts, heads);
  const shown = {side: 'relative', position: 0, factor: volume.factor};

  const update = () => {
    const vectors = volume.positions[shown.position][shown.side];
    const mm = shown.factor / 1000;  // um to magnified mm
    const ends = volume.places.map((p, n) => p.map((x, i) => x + mm * vectors[n][i]));
    for (const object of [deformed, shafts]) object.geometry.dispose();
    deformed.geometry = segments(ends, pairs);
    const both = [...volume.places, ...ends];
    shafts.geometry = segments(both, volume.places.map((_, n) => [n, n + volume.places.length]));
    const turn = new three.Quaternion();
    const up = new three.Vector3(0, 1, 0);
    const matrix = new three.Matrix4();
    volume.places.forEach((_, n) => {
      const along = new three.Vector3(...vectors[n]).multiplyScalar(mm);
      const length = along.length();
      const size = Math.min(radius * 0.009, length / 6);
      turn.setFromUnitVectors(up, length > 0 ? along.normalize() : up);
      matrix.compose(new three.Vector3(...ends[n]), turn,
                     new three.Vector3(size, size, size));
      heads.setMatrixAt(n, matrix);
    });
    heads.instanceMatrix.needsUpdate = true;
    heads.computeBoundingSphere();
    const largest = Math.max(...vectors.map((v) => Math.hypot(...v)));
    figure.querySelector('.reading').textContent =
        `errors drawn ${shown.factor.toLocaleString('en')} times as large; longest arrow ` +
        `${largest.toFixed(2)} µm`;
    for (const button of figure.querySelectorAll('[data-side]')) {
      button.setAttribute('aria-pressed', String(button.dataset.side === shown.side));
    }
    view.render();
  };
  for (const button of figure.querySelectorAll('[data-side]')) {
    button.addEventListener('click', () => {
      shown.side = button.dataset.side;
      update();
    });
  }
  for (const button of figure.querySelectorAll('[data-scale]')) {
    button.addEventListener('click', () => {
      shown.factor *= Number(button.dataset.scale);
      update();
    });
  }
  figure.querySelector('select')?.addEventListener('change', (event) => {
    shown.position = Number(event.target.value);
    update();
  });
  onTheme(() => {
    const colours = theme();
    nominal.material.color.set(colours.faint);
    deformed.material.color.set(colours.series[0]);
    shafts.material.color.set(colours.series[1]);
    heads.material.color.set(colours.series[1]);
    view.render();
  });
  update();
  view.show(box, 1.2);
}
