// Normals that round what is round and keep edges sharp (see report/picture/crease_normals.hpp), one for each
// corner of each triangle.

export function creaseNormals(positions, corners, creaseAngle) {
  const count = corners.length / 3;
  const area = new Float32Array(corners.length);
  const unit = new Float32Array(corners.length);
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]];
    const ux = positions[b] - positions[a];
    const uy = positions[b + 1] - positions[a + 1];
    const uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a];
    const vy = positions[c + 1] - positions[a + 1];
    const vz = positions[c + 2] - positions[a + 2];
    area[t] = uy * vz - uz * vy;
    area[t + 1] = uz * vx - ux * vz;
    area[t + 2] = ux * vy - uy * vx;
    const length = Math.hypot(area[t], area[t + 1], area[t + 2]) || 1;
    for (let k = 0; k < 3; ++k) unit[t + k] = area[t + k] / length;
  }

  const first = new Uint32Array(positions.length / 3 + 1);
  for (const corner of corners) ++first[corner + 1];
  for (let v = 1; v < first.length; ++v) first[v] += first[v - 1];
  const next = first.slice();
  const around = new Uint32Array(corners.length);
  for (let t = 0; t < count; ++t) {
    for (let k = 0; k < 3; ++k) around[next[corners[3 * t + k]]++] = 3 * t;
  }

  const limit = Math.cos(creaseAngle);
  const normals = new Float32Array(3 * corners.length);
  for (let i = 0; i < corners.length; ++i) {
    const own = i - i % 3;
    let [x, y, z] = [0, 0, 0];
    for (let j = first[corners[i]]; j < first[corners[i] + 1]; ++j) {
      const other = around[j];
      const lean = unit[own] * unit[other] + unit[own + 1] * unit[other + 1] +
          unit[own + 2] * unit[other + 2];
      if (lean < limit) continue;
      x += area[other];
      y += area[other + 1];
      z += area[other + 2];
    }
    const length = Math.hypot(x, y, z) || 1;
    normals.set([x / length, y / length, z / length], 3 * i);
  }
  return normals;
}
