// Sky, horizon and the ground's colour: rows across the picture, whose colours depend on how far down they look.

import * as THREE from "three";

const ROWS = 24; // above the horizon, and as many below
const THEMES = {
  light: { zenith: "#bcd5ec", haze: "#eef1ee", soil: "#d3cfba" },
  dark: { zenith: "#0a1220", haze: "#2b3947", soil: "#161c1a" },
};

// The camera never rolls, so that the horizon is a row of the picture.
const VERTEX = `
uniform float horizon, pitch, halfway, above, clearness;
uniform vec3 zenith, haze, soil;
varying vec3 colour;
void main() {
  float split = clamp(horizon, -1.0, 1.0);
  float share = position.y * position.y;
  float row = position.y > 0.0 ? mix(split, 1.0, share) : mix(split, -1.0, share);
  float angle = pitch + atan(row * halfway);
  vec3 sky = mix(haze, zenith, smoothstep(0.0, 0.55, angle));
  float far = above / max(sin(-angle), 1e-4);
  float clear = 0.22 + 0.78 * exp(-pow(max(far, 0.0) / clearness, 1.2));
  bool ground = above > 0.0 && (position.z > 0.5 || horizon > 1.0) && horizon > -1.0;
  colour = ground ? mix(haze, soil, clear) : sky;
  gl_Position = vec4(position.x, row, 1.0, 1.0);
}`;

const FRAGMENT = `
varying vec3 colour;
void main() {
  gl_FragColor = vec4(colour, 1.0);
}`;

export class Backdrop {
  constructor() {
    const colours = Object.keys(THEMES.light).map((name) => [name, { value: new THREE.Vector3() }]);
    const numbers = ["horizon", "pitch", "halfway", "above", "clearness"].map((name) => [name, { value: 0 }]);
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: Object.fromEntries([...colours, ...numbers]),
      side: THREE.DoubleSide,
      depthTest: false,
      depthWrite: false,
    });
    this.mesh = new THREE.Mesh(rows(), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -2;
    const looks = new THREE.Vector3();
    this.mesh.onBeforeRender = (_renderer, _scene, camera) => {
      const { uniforms } = material;
      camera.getWorldDirection(looks);
      const pitch = Math.asin(Math.min(Math.max(looks.z, -1), 1));
      const halfway = Math.tan((camera.fov * Math.PI) / 360);
      uniforms.pitch.value = pitch;
      uniforms.halfway.value = halfway;
      uniforms.horizon.value = -Math.tan(pitch) / halfway;
      uniforms.above.value = camera.position.z - this.height;
      material.uniformsNeedUpdate = true;
    };
  }

  // Height of the ground [m], and the way after which haze hides it [m].
  fit(height, clearness) {
    this.height = height;
    this.mesh.material.uniforms.clearness.value = clearness;
  }

  tint(theme) {
    for (const [name, colour] of Object.entries(THEMES[theme])) {
      const { r, g, b } = new THREE.Color(colour).getRGB({}, THREE.SRGBColorSpace);
      this.mesh.material.uniforms[name].value.set(r, g, b);
    }
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

// Bands from edge to edge of the picture; y from -1 (bottom) over 0 (horizon) to 1 (top), z: 1 for the ground. The
// horizon has two rows of points, one of the sky and one of the ground.
function rows() {
  const points = [];
  const index = [];
  for (const ground of [1, 0]) {
    const first = points.length / 3;
    for (let row = 0; row <= ROWS; row++) {
      const y = (ground ? -1 : 1) * (row / ROWS);
      points.push(-1, y, ground, 1, y, ground);
    }
    for (let row = 0; row < ROWS; row++) {
      const [a, b] = [first + 2 * row, first + 2 * row + 2];
      index.push(a, a + 1, b, b, a + 1, b + 1);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  geometry.setIndex(index);
  return geometry;
}
