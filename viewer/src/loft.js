// Surfaces of bodies: lofts of elliptic rings, tubes, and patches of points.

import * as THREE from "three";

// A smooth curve through stations [{ x, z, wide, up, down, ... }], given at the same share of the way: monotone between
// neighbours, so that nothing bulges that was not asked for.
export function smooth(stations, count) {
  const names = Object.keys(stations[0]);
  const slopes = stations.map((_, i) => {
    const [before, here, after] = [stations[i - 1], stations[i], stations[i + 1]];
    return Object.fromEntries(
      names.map((name) => {
        if (!before || !after) return [name, 0];
        const [left, right] = [here[name] - before[name], after[name] - here[name]];
        return [name, left * right <= 0 ? 0 : (2 * left * right) / (left + right)];
      }),
    );
  });
  return Array.from({ length: count }, (_, n) => {
    const place = (n / (count - 1)) * (stations.length - 1);
    const i = Math.min(Math.floor(place), stations.length - 2);
    const t = place - i;
    const [h00, h10, h01, h11] = [(1 + 2 * t) * (1 - t) ** 2, t * (1 - t) ** 2, t * t * (3 - 2 * t), t * t * (t - 1)];
    return Object.fromEntries(
      names.map((name) => [
        name,
        h00 * stations[i][name] + h10 * slopes[i][name] + h01 * stations[i + 1][name] + h11 * slopes[i + 1][name],
      ]),
    );
  });
}

// Elliptic rings around a spine: `wide` to both sides, `up` and `down` across it. `tint(ring, height)` with height from
// -1 (below) to 1 (above) gives the colour.
export function loft(rings, tint, around = 20) {
  const [place, colours, index] = [[], [], []];
  rings.forEach((ring, i) => {
    const [before, after] = [rings[Math.max(i - 1, 0)], rings[Math.min(i + 1, rings.length - 1)]];
    const [dx, dz] = [after.x - before.x, after.z - before.z];
    const length = Math.hypot(dx, dz) || 1;
    for (let j = 0; j < around; j++) {
      const [cos, sin] = [Math.cos((2 * Math.PI * j) / around), Math.sin((2 * Math.PI * j) / around)];
      const high = sin * (sin > 0 ? ring.up : ring.down);
      // Rings run from head to tail, so across the spine, upwards, is (dz, -dx).
      place.push(ring.x + (dz / length) * high, cos * ring.wide, ring.z - (dx / length) * high);
      const tone = tint(ring, sin);
      colours.push(tone.r, tone.g, tone.b);
    }
  });
  hoops(rings.length, around, index);
  return surfaceOf(place, colours, index);
}

// A tube through points [x, y, z] with a radius at each.
export function tube(points, radii, tone, around = 7) {
  const [place, colours, index] = [[], [], []];
  const [way, side, up] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  points.forEach((point, i) => {
    const [before, after] = [points[Math.max(i - 1, 0)], points[Math.min(i + 1, points.length - 1)]];
    way.set(after[0] - before[0], after[1] - before[1], after[2] - before[2]).normalize();
    side.set(0, 0, 1).cross(way);
    if (side.lengthSq() < 1e-6) side.set(0, 1, 0);
    side.normalize();
    up.copy(way).cross(side);
    for (let j = 0; j < around; j++) {
      const [cos, sin] = [Math.cos((2 * Math.PI * j) / around), Math.sin((2 * Math.PI * j) / around)];
      ["x", "y", "z"].forEach((axis, k) => place.push(point[k] + radii[i] * (cos * side[axis] + sin * up[axis])));
      colours.push(tone.r, tone.g, tone.b);
    }
  });
  hoops(points.length, around, index);
  return surfaceOf(place, colours, index);
}

// A sheet through rows of points [x, y, z], a colour for each.
export function patch(rows, tint) {
  const [place, colours, index] = [[], [], []];
  const wide = rows[0].length;
  rows.forEach((row, i) =>
    row.forEach((point, j) => {
      place.push(...point);
      const tone = tint(i / (rows.length - 1), j / (wide - 1));
      colours.push(tone.r, tone.g, tone.b);
    }),
  );
  for (let i = 1; i < rows.length; i++) {
    for (let j = 1; j < wide; j++) {
      const [a, b, c, d] = [(i - 1) * wide + j - 1, (i - 1) * wide + j, i * wide + j, i * wide + j - 1];
      index.push(a, b, c, a, c, d);
    }
  }
  return surfaceOf(place, colours, index);
}

function hoops(count, around, index) {
  for (let i = 1; i < count; i++) {
    for (let j = 0; j < around; j++) {
      const [here, next] = [j, (j + 1) % around];
      const [a, b, c, d] = [(i - 1) * around + here, (i - 1) * around + next, i * around + next, i * around + here];
      index.push(a, b, c, a, c, d);
    }
  }
}

function surfaceOf(place, colours, index) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(place, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}

// A simple solid of three.js in one colour.
export function painted(geometry, tone) {
  const count = geometry.getAttribute("position").count;
  const colours = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) tone.toArray(colours, 3 * i);
  geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  return geometry.deleteAttribute("uv");
}
