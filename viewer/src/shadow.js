// The soft shadow of the animals on the ground: a small picture of their outline, seen along the sun's rays, lies there.
// A shadow map of the whole scene would take software rendering three times as long as the animal itself.

import * as THREE from "three";

const SLOPE = [-0.22, -0.34]; // metres that a shadow moves forward and to the left for every metre down
const REACH = 1.7; // half the side of the picture, in semi-spans
const PIXELS = 256;
export const CASTS = 1; // the layer of all that casts a shadow

export class Shadow {
  constructor(scene) {
    this.scene = scene;
    this.target = new THREE.WebGLRenderTarget(PIXELS, PIXELS, { samples: 4, depthBuffer: false });
    this.black = new THREE.MeshBasicMaterial({ color: 0x000000, side: THREE.DoubleSide });
    this.camera = new THREE.Camera();
    this.camera.matrixAutoUpdate = false;
    this.camera.layers.set(CASTS);
    const material = new THREE.MeshBasicMaterial({ map: this.target.texture, transparent: true, depthWrite: false });
    this.ground = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    scene.add(this.ground);
  }

  // Where the ground is: under a point [m], at a height [m]; for animals of a semi-span [m] in a row of a width [m].
  place(point, height, span, width) {
    const drop = point.z - height;
    const centre = [point.x + SLOPE[0] * drop, point.y + SLOPE[1] * drop];
    const half = [REACH * span, REACH * span + 0.5 * width];
    this.ground.position.set(...centre, height + 0.002 * span);
    this.ground.scale.set(...half, 1);
    // From the world to the picture: along the rays to the ground, then to -1..1.
    this.camera.projectionMatrix.set(
      ...[1 / half[0], 0, SLOPE[0] / half[0], -(centre[0] + SLOPE[0] * height) / half[0]],
      ...[0, 1 / half[1], SLOPE[1] / half[1], -(centre[1] + SLOPE[1] * height) / half[1]],
      ...[0, 0, 0, 0],
      ...[0, 0, 0, 1],
    );
    this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert();
    this.stale = true;
  }

  tint(theme) {
    this.ground.material.opacity = theme === "dark" ? 0.6 : 0.26;
  }

  // Draw the picture of the shadow where something moved since the last one.
  draw(renderer) {
    if (!this.stale) return;
    this.stale = false;
    this.scene.overrideMaterial = this.black;
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(this.scene, this.camera);
    renderer.setRenderTarget(null);
    this.scene.overrideMaterial = null;
  }

  dispose() {
    this.ground.geometry.dispose();
    this.ground.material.dispose();
    this.black.dispose();
    this.target.dispose();
  }
}
