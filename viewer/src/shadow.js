// Light from the sky and from the sun, and the sun's shadow on the animal and on the ground under it.

import * as THREE from "three";

const SUN = [0.7, 1.1, 3.2]; // direction to the sun

export class Shadow {
  constructor(renderer, scene) {
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFShadowMap;
    // The shadow changes with the phase alone, not with the camera.
    renderer.shadowMap.autoUpdate = false;
    this.map = renderer.shadowMap;
    this.sky = new THREE.HemisphereLight(0xf4f7ff, 0xb8a990, 1.9);
    this.sun = new THREE.DirectionalLight(0xfff4e2, 2.3);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.radius = 3;
    this.ground = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), new THREE.ShadowMaterial({ opacity: 0.25 }));
    this.ground.receiveShadow = true;
    scene.add(this.sky, this.sun, this.sun.target, this.ground);
  }

  // Fit light and ground to animals of a semi-span [m].
  fit(span) {
    const camera = this.sun.shadow.camera;
    Object.assign(camera, { left: -1.5 * span, right: 1.5 * span, top: 1.5 * span, bottom: -1.5 * span });
    Object.assign(camera, { near: 0.1 * span, far: 12 * span });
    camera.updateProjectionMatrix();
    this.sun.shadow.normalBias = 0.006 * span;
    this.ground.scale.set(8 * span, 8 * span, 1);
    this.span = span;
  }

  // Move with the body; the ground is at a height [m].
  follow(body, height) {
    this.sun.target.position.copy(body);
    this.sun.position.copy(body).addScaledVector(new THREE.Vector3(...SUN), 1.3 * this.span);
    // A hair above the lines of the ground.
    this.ground.position.set(body.x, 0, height + 0.002 * this.span);
    this.map.needsUpdate = true;
  }

  dispose() {
    this.ground.geometry.dispose();
    this.ground.material.dispose();
    this.sun.dispose();
  }
}
