// The three-dimensional picture: light, ground, cameras, and the animals in it. It moves along with the mean flight.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Animal, dispose } from "./animal.js";
import { themeOf } from "./colours.js";
import { Ground } from "./ground.js";
import { pixelsPerMetre } from "./scale_bar.js";
import { Shadow } from "./shadow.js";
import { drawsInSoftware, Sharpness } from "./sharpness.js";

// From where each camera looks, in semi-spans: ahead, to the left, above.
export const CAMERAS = {
  oblique: [2.3, 2.5, 0.8],
  side: [0, -4, 0],
  front: [4, 0, 0],
  top: [-0.001, 0, 4.2],
  following: [-3, 0, 1],
};
const GHOST = 0.32;

export class Stage {
  constructor(canvas, flights, ghost) {
    const inSoftware = drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !inSoftware, alpha: true });
    this.sharpness = new Sharpness(this.renderer, inSoftware, () => {
      if (this.due !== undefined) return false;
      this.render();
      return true;
    });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    this.controls.addEventListener("change", () => this.draw());
    this.sky = new THREE.HemisphereLight(0xf4f7ff, 0xa89a86);
    const sun = new THREE.DirectionalLight(0xfff4e2, 2.4);
    sun.position.set(0.9, 1.4, 4);
    this.scene.add(this.sky, sun);
    this.shadow = new Shadow(this.scene);
    this.ground = new Ground();
    this.scene.add(this.ground.group);
    this.animals = [];
    this.retired = [];
    this.body = new THREE.Vector3();
    this.follows = false;
    this.setFlights(flights, ghost);
  }

  // One flight, or two: beside one another, or the second as a ghost in the place of the first.
  setFlights(flights, ghost) {
    const before = this.animals;
    this.animals = flights.map((flight, nth) => this.flown(before[nth], flight, nth && ghost ? GHOST : 1));
    for (const { group } of before.filter((animal) => !this.animals.includes(animal))) {
      this.scene.remove(group);
      this.retired.push(group);
    }
    this.span = Math.max(...flights.map((flight) => flight.semi_span));
    this.ground.fit(this.span);
    const [first, second] = this.animals;
    const apart = ghost ? 0 : 1.25 * this.span;
    this.offsets = second && new Map([[first, apart], [second, -apart]]);
    // How near the camera comes, in spans: in a wide picture, and in a narrow one over its aspect.
    this.near = second && !ghost ? [1.45, 2.3] : [1, 1.15];
    if (this.ink) this.tint(this.ink);
    this.setCamera(this.view ?? "oblique");
  }

  // An animal in a flight: the one that was in its place, if it is the same.
  flown(before, flight, opacity) {
    if (before?.suits(flight, opacity)) {
      this.retired.push(before.fly(flight));
      return before;
    }
    const animal = new Animal(flight, opacity);
    this.scene.add(animal.group);
    return animal;
  }

  // Only once their successors are drawn: else their programs are thrown away, and compiled again for these.
  dismiss() {
    this.retired.forEach(dispose);
    this.retired = [];
  }

  show(phase, look) {
    // The wake ends at the ground.
    const floor = look.ground ? [this.ground.height, 0.5 * this.span] : undefined;
    for (const animal of this.animals) {
      animal.show(phase, { ...look, floor, offset: this.offsets?.get(animal) ?? 0 });
    }
    const flight = this.animals[0].flight;
    const place = flight.locate(phase);
    const [x, z] = flight.pivot(phase, place);
    // The ground passes; height is taken off, so that it stays in the picture in a climb.
    this.ground.group.visible = look.ground;
    const way = look.still ? 0 : flight.advance;
    this.ground.show(look.still ? 0 : x + look.laps * way, (look.passing * way) / flight.last);
    const body = new THREE.Vector3(flight.number("x", place) - x, 0, flight.number("z", place) - z);
    if (this.follows) {
      const moved = body.clone().sub(this.body);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
      this.controls.update();
    }
    this.body.copy(body);
    const width = this.offsets ? 2 * Math.max(...this.offsets.values()) : 0;
    this.shadow.place(body, this.ground.height, this.span, width);
    this.shadow.ground.visible = look.ground;
    this.draw();
  }

  setCamera(name) {
    this.view = name;
    this.follows = name === "following";
    const target = this.follows ? this.body : new THREE.Vector3();
    const [wide, narrow] = this.near;
    const away = this.span * Math.max(wide, narrow / (this.camera.aspect || 1));
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(new THREE.Vector3(...CAMERAS[name]), away);
    this.controls.update();
    this.draw();
  }

  tint(ink) {
    this.ink = ink;
    for (const animal of this.animals) animal.tint(ink);
    const theme = themeOf(ink);
    this.ground.tint(theme);
    this.shadow.tint(theme);
    this.sky.intensity = theme === "dark" ? 2.4 : 1.7; // else a bat cannot be told from the night behind it
    this.draw();
  }

  resize(width, height) {
    const was = this.camera.aspect;
    this.sharpness.fit();
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (Math.abs(was - this.camera.aspect) > 0.1) this.setCamera(this.view);
    this.draw();
  }

  // However often it is asked for, the picture is drawn once, when the browser next shows one.
  draw() {
    this.due ??= requestAnimationFrame(() => {
      this.due = undefined;
      this.sharpness.moves();
      this.render();
    });
  }

  render() {
    this.shadow.draw(this.renderer);
    this.renderer.render(this.scene, this.camera);
    this.dismiss();
    this.onDraw?.();
  }

  // Pixels of the page for one metre at the animal.
  get perMetre() {
    return pixelsPerMetre(this.camera, this.controls.target, this.renderer.domElement.clientHeight);
  }

  dispose() {
    cancelAnimationFrame(this.due);
    this.sharpness.dispose();
    this.dismiss();
    for (const { group } of this.animals) dispose(group);
    this.ground.dispose();
    this.shadow.dispose();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
