// The static explorer: a folder with a catalogue and a file of data for each animal and model. Each is a script that calls
// `open` or `hold`, because a page that opens from disk may not fetch.

import { Between } from "./between.js";
import { Face } from "./face.js";
import { make } from "./shared.js";

export class Folder {
  constructor(element, catalogue) {
    this.catalogue = catalogue;
    this.lattices = new Map();
    this.pushes = new Map();
    this.asked = catalogue.start;
    this.face = new Face(element, {});
    this.face.onask = (asked) => this.ask(asked);
    this.face.curve.onslide = (speed) => this.slide(speed);
    this.face.onpush = () => this.push();
    this.face.onpushed = () => this.link();
    this.face.has = ({ animal, model, push }) => catalogue.files.includes(file(animal, model, push));
    this.face.pushSpeed = ({ species, model }) => this.pushSpeed(species, model);
    window.addEventListener("hashchange", () => this.follow());
    this.follow();
  }

  // Show what the page's address asks for.
  follow() {
    const given = this.fragment();
    this.asked = chosen(this.asked, given);
    this.face.linked.want(given.push ?? "");
    this.ask(this.asked);
  }

  // Choices in the page's address, so that a link shows the same flight; unknown ones are left out.
  fragment() {
    const given = new URLSearchParams(location.hash.slice(1));
    const found = {};
    if (this.catalogue.animals.some(({ name }) => name === given.get("animal"))) found.animal = given.get("animal");
    if (this.catalogue.models.some(({ name }) => name === given.get("model"))) found.model = given.get("model");
    if (Number.isFinite(parseFloat(given.get("speed")))) found.speed = parseFloat(given.get("speed"));
    if (given.get("push")) found.push = given.get("push");
    return found;
  }

  // The models with which an animal was computed.
  models(animal) {
    return this.catalogue.models.filter(({ name }) => this.catalogue.files.includes(file(animal, name)));
  }

  ask(asked) {
    const models = this.models(asked.animal);
    const model = models.some(({ name }) => name === asked.model) ? asked.model : models[0].name;
    // Another animal begins at a speed of its own; another model of the same animal keeps the speed.
    const speed = asked.animal === this.asked.animal ? asked.speed : undefined;
    this.asked = { ...asked, model, speed };
    if (this.listed !== asked.animal) this.face.setChoices({ animals: this.catalogue.animals, models }, this.asked);
    this.listed = asked.animal;
    this.load();
  }

  load() {
    const { asked } = this;
    const key = `${asked.animal}/${asked.model}`;
    if (this.lattices.has(key)) return this.show(this.lattices.get(key));
    this.face.say("Loading …");
    this.read(file(asked.animal, asked.model));
  }

  read(name) {
    const failed = () => this.face.say(`The file data/${name} could not be read.`);
    document.head.append(make("script", { src: `data/${name}`, onerror: failed }));
  }

  async hold(animal, model, text) {
    const lattice = await this.decompressed(text);
    if (!lattice) return;
    for (const { gauges } of lattice.answers) for (const gauge of gauges) gauge.source ??= lattice.sources[gauge.name];
    this.lattices.set(`${animal}/${model}`, lattice);
    if (this.asked.animal === animal && this.asked.model === model) this.show(lattice);
  }

  // Flights through gusts lie in a file of their own, and are of the flight that an animal begins with.
  pushSpeed(animal, model) {
    const lattice = this.lattices.get(`${animal}/${model}`);
    return this.catalogue.files.includes(file(animal, model, true)) ? lattice?.speed : undefined;
  }

  push() {
    const { animal, model } = this.asked;
    const held = this.pushes.get(`${animal}/${model}`);
    if (held) return this.face.showPushes(held);
    this.face.say("Loading the gusts …");
    this.read(file(animal, model, true));
  }

  async holdPushes(animal, model, text) {
    const pushes = await this.decompressed(text);
    if (!pushes) return;
    this.pushes.set(`${animal}/${model}`, pushes);
    const { asked } = this;
    const wanted = asked.animal === animal && asked.model === model && asked.speed === this.pushSpeed(animal, model);
    if (wanted) this.face.showPushes(pushes);
  }

  async decompressed(text) {
    try {
      return await decompressed(text);
    } catch {
      this.face.say("This browser cannot unpack the data; a newer one can.");
      return undefined;
    }
  }

  // Show the answer that is nearest in speed.
  show(lattice) {
    const away = ({ speed }) => Math.abs(speed - (this.asked.speed ?? lattice.speed));
    const answer = lattice.answers.reduce((best, each) => (away(each) < away(best) ? each : best));
    if (this.shown !== lattice) {
      this.face.showCurve(lattice.curve);
      this.between = new Between(lattice.answers);
    }
    this.shown = lattice;
    this.asked.speed = answer.speed;
    this.face.showAnswer(answer);
    this.link();
  }

  // While the point is on its way, the animal flies between two computed speeds; the numbers stay those of the nearest.
  slide(speed) {
    this.sliding = speed;
    this.due ??= requestAnimationFrame(() => {
      this.due = undefined;
      const flight = this.sliding === undefined ? undefined : this.between?.at(this.sliding);
      if (flight || this.isBetween) this.face.showBetween(flight);
      this.isBetween = Boolean(flight);
    });
  }

  // Write what is shown into the page's address.
  link() {
    const { animal, model, speed } = this.asked;
    const push = this.face.linked.name;
    history.replaceState(null, "", `#${new URLSearchParams({ animal, model, speed, ...(push && { push }) })}`);
  }
}

// What a link asks for: an animal begins at a speed of its own.
function chosen(before, { animal, model, speed }) {
  const asked = animal ? { animal, speed } : { animal: before.animal, speed: speed ?? before.speed };
  return { ...asked, model: model ?? before.model };
}

async function decompressed(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return JSON.parse(await new Response(stream).text());
}

function file(animal, model, push = false) {
  return `${animal}-${model}${push ? "-pushes" : ""}.js`;
}
