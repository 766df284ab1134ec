// Ground and sky behind the animal, with the horizon at its place: squares and stubble pass at the flight's speed and
// fade into haze. All colours are of vertices, because without a graphics card every operation on a pixel costs.

import * as THREE from "three";
import { Backdrop } from "./backdrop.js";
import { round } from "./writing.js";

// Squares from the animal to the edge of the pattern; every fourth line is a heavy one.
const [REACH, HEAVY] = [24, 4];
const PARTS = 8; // of a line, so that it can fade along its way
const TUFTS = 800;
// Height of the ground under the animal, over the semi-span.
const HEIGHT = -1.15;
const LINES = { light: "#57543f", dark: "#a9bdb2" };

const VERTEX = `
attribute float passes, strength, spacing;
uniform float passed, passing, reach, sight;
varying float seen;
void main() {
  vec3 at = position;
  if (passes > 0.0) at.x = mod(at.x - passed + reach, 2.0 * reach) - reach;
  vec4 world = modelMatrix * vec4(at, 1.0);
  float edge = 1.0 - smoothstep(0.4 * reach, 0.95 * reach, length(at.xy));
  float blurred = passes * smoothstep(0.2, 0.6, passing / spacing);
  seen = strength * edge * exp(-distance(world.xyz, cameraPosition) / sight) * (1.0 - blurred);
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

const FRAGMENT = `
uniform vec3 line;
varying float seen;
void main() {
  gl_FragColor = vec4(line, seen);
}`;

export class Ground {
  constructor() {
    const numbers = { passed: 0, passing: 0, reach: REACH, sight: 1 };
    this.backdrop = new Backdrop();
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        ...Object.fromEntries(Object.entries(numbers).map(([name, value]) => [name, { value }])),
        line: { value: new THREE.Vector3() },
      },
      transparent: true,
      depthWrite: false,
    });
    // In squares; `fit` gives them their size.
    this.lines = new THREE.LineSegments(pattern(), material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = -1;
    this.group = new THREE.Group();
    this.group.add(this.backdrop.mesh, this.lines);
  }

  // Squares that suit an animal of a semi-span [m].
  fit(span) {
    this.cell = round(0.3 * span);
    this.height = HEIGHT * span;
    this.lines.scale.setScalar(this.cell);
    this.lines.position.z = this.height;
    this.lines.material.uniforms.sight.value = 5 * span;
    this.backdrop.fit(this.height, 11 * span);
  }

  // `passed`: way flown over the ground [m]; `passing`: way from one picture to the next [m]. Lines across the way
  // vanish when that is about a square: they would seem to stand or run backwards.
  show(passed, passing) {
    this.passed = passed;
    const { uniforms } = this.lines.material;
    const squares = passed / this.cell;
    uniforms.passed.value = squares - 2 * REACH * Math.floor(squares / (2 * REACH));
    uniforms.passing.value = passing / this.cell;
  }

  tint(theme) {
    const { r, g, b } = new THREE.Color(LINES[theme]).getRGB({}, THREE.SRGBColorSpace);
    this.lines.material.uniforms.line.value.set(r, g, b);
    this.backdrop.tint(theme);
  }

  dispose() {
    this.lines.geometry.dispose();
    this.lines.material.dispose();
    this.backdrop.dispose();
  }
}

// Lines along and across the way, and upright stubble at random places: pairs of points, in squares.
function pattern() {
  const found = { position: [], passes: [], strength: [], spacing: [] };
  const add = (from, to, passes, strengths, spacing) => {
    found.position.push(...from, ...to);
    found.passes.push(passes, passes);
    found.strength.push(...strengths);
    found.spacing.push(spacing, spacing);
  };
  for (let line = -REACH; line < REACH; line++) {
    const heavy = line % HEAVY === 0;
    const strengths = heavy ? [0.6, 0.6] : [0.24, 0.24];
    for (let part = 0; part < PARTS; part++) {
      const [low, high] = [part, part + 1].map((end) => REACH * ((2 * end) / PARTS - 1));
      add([low, line, 0], [high, line, 0], 0, strengths, 1);
      add([line, low, 0], [line, high, 0], 1, strengths, heavy ? HEAVY : 1);
    }
  }
  const random = randoms(7);
  for (let tuft = 0; tuft < TUFTS; tuft++) {
    const [x, y] = [random(), random()].map((share) => REACH * 0.6 * (2 * share - 1));
    const [lean, sway, tall] = [0.1 * (random() - 0.5), 0.1 * (random() - 0.5), 0.06 + 0.12 * random()];
    add([x / 0.6, y, 0], [x / 0.6 + lean, y + sway, tall], 1, [0.75, 0.25], 4);
  }
  const geometry = new THREE.BufferGeometry();
  for (const [name, values] of Object.entries(found)) {
    geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, values.length / found.passes.length));
  }
  return geometry;
}

// Random numbers from 0 to 1 that are the same in every picture (mulberry32).
function randoms(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}
