// A path drawn as a ribbon that faces the camera. Each point has an age in beats: it fades, widens and drifts with it.

import * as THREE from "three";

const VERTEX = `
attribute vec3 along;
attribute vec3 shade;
attribute float shed, strength, side, slim;
uniform float now, life, width, spread, opacity, toned, floorHeight, floorDepth;
uniform vec3 drift, tone;
varying vec4 colour;
varying float age, across;
void main() {
  age = now - shed;
  across = side;
  float share = clamp(age / life, 0.0, 1.0);
  vec3 moved = position + max(age, 0.0) * drift;
  float over = ((modelMatrix * vec4(moved, 1.0)).z - floorHeight) / floorDepth;
  float seen = opacity * strength * pow(1.0 - share, 1.5) * clamp(over, 0.0, 1.0);
  colour = vec4(mix(shade, tone, toned), seen);
  vec4 eye = modelViewMatrix * vec4(moved, 1.0);
  vec3 way = cross((modelViewMatrix * vec4(along, 0.0)).xyz, normalize(eye.xyz));
  // A path along the line of sight has no side to widen to: there the ribbon narrows.
  way /= max(max(length(way), 0.25 * length(along)), 1e-9);
  eye.xyz += way * side * slim * 0.5 * width * mix(1.0, spread, share);
  gl_Position = projectionMatrix * eye;
}`;

// Points younger than now are not flown yet; the cut runs through the fragments, so it is sharp between samples.
const FRAGMENT = `
uniform float soft;
varying vec4 colour;
varying float age, across;
void main() {
  if (age < 0.0) discard;
  gl_FragColor = vec4(colour.rgb, colour.a * smoothstep(0.0, soft, 1.0 - abs(across)));
}`;

// Below this share of its largest speed a path narrows, down to this share of its width: a ribbon cannot turn round
// on a point.
const [SLOW, SLIMMEST] = [0.5, 0.05];

// Metres per beat at every point; zero for points of one instant.
function speedsAlong(points, shed) {
  return shed.map((_, k) => {
    const [before, after] = [Math.max(k - 1, 0), Math.min(k + 1, shed.length - 1)];
    const older = shed[after] - shed[before];
    if (older === 0) return 0;
    return Math.hypot(...[0, 1, 2].map((i) => (points[3 * after + i] - points[3 * before + i]) / older));
  });
}

export class Ribbon {
  // `points`: flat [m]; `shed`: phase of every point; `shades`: flat colours, sRGB 0..1, or none for one tone;
  // `strengths`: opacity of every point; `width` [m]; `spread`: width at the end of `life` [beats] over that at the
  // start; `drift`: [m] per beat; `soft`: share of the half width that fades out.
  constructor({ points, shed, shades, strengths, width, spread, life, drift = [0, 0, 0], soft, opacity }) {
    [this.shed, this.life] = [shed, life];
    const count = shed.length;
    const arrays = { position: [], along: [], shade: [], shed: [], strength: [], side: [], slim: [] };
    const speeds = speedsAlong(points, shed);
    const fast = SLOW * Math.max(...speeds);
    for (let k = 0; k < count; k++) {
      const before = Math.max(k - 1, 0);
      const after = Math.min(k + 1, count - 1);
      const older = shed[after] - shed[before];
      const along = [0, 1, 2].map((i) => points[3 * after + i] - points[3 * before + i] - older * drift[i]);
      for (const side of [-1, 1]) {
        arrays.position.push(points[3 * k], points[3 * k + 1], points[3 * k + 2]);
        arrays.along.push(...along);
        arrays.shade.push(...(shades ? shades.slice(3 * k, 3 * k + 3) : [0, 0, 0]));
        arrays.shed.push(shed[k]);
        arrays.strength.push(strengths ? strengths[k] : 1);
        arrays.side.push(side);
        arrays.slim.push(fast > 0 ? Math.min(Math.max(speeds[k] / fast, SLIMMEST), 1) : 1);
      }
    }
    const geometry = new THREE.BufferGeometry();
    for (const [name, values] of Object.entries(arrays)) {
      geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, values.length / (2 * count)));
    }
    const index = [];
    for (let k = 0; k < count - 1; k++) index.push(2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 2, 2 * k + 1, 2 * k + 3);
    geometry.setIndex(index);
    const numbers = { now: 0, life, width, spread, opacity, soft, toned: shades ? 0 : 1, floorHeight: -1e6, floorDepth: 1 };
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        ...Object.fromEntries(Object.entries(numbers).map(([name, value]) => [name, { value }])),
        drift: { value: new THREE.Vector3(...drift) },
        tone: { value: new THREE.Vector3() },
      },
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
    });
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  // `floor`: height in the picture at which the ribbon ends [m], and the depth over which it fades above that.
  show(phase, floor = [-1e6, 1]) {
    const { uniforms } = this.mesh.material;
    uniforms.now.value = phase;
    // Only what is seen: from the end of life to the first point that is not flown yet.
    const from = Math.max(this.shed.findIndex((shed) => shed > phase - this.life) - 1, 0);
    const later = this.shed.findIndex((shed) => shed > phase);
    const until = later < 0 ? this.shed.length - 1 : later;
    this.mesh.geometry.setDrawRange(6 * from, 6 * Math.max(until - from, 0));
    [uniforms.floorHeight.value, uniforms.floorDepth.value] = floor;
  }

  // One colour for the whole ribbon, as CSS writes it.
  tint(tone) {
    const { r, g, b } = new THREE.Color(tone).getRGB({}, THREE.SRGBColorSpace);
    this.mesh.material.uniforms.tone.value.set(r, g, b);
  }
}
