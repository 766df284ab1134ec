// The static explorer: a folder with a catalogue and a file of data for each animal, model and axis. Each is a script that calls
// `open` or `hold`, because a page that opens from disk may not fetch.

import { Between } from "./between.js";
import { Face } from "./face.js";
import { SPEED } from "./numbers.js";
import { make } from "./shared.js";

export class Folder {
  constructor(element, catalogue) {
    this.catalogue = catalogue;
    this.lattices = new Map();
    this.pushes = new Map();
    this.asked = catalogue.start;
    this.face = new Face(element, {});
    this.face.onask = (asked) => this.ask(asked);
    this.face.curve.onslide = (value) => this.slide(value);
    this.face.onpush = () => this.push();
    this.face.onpushed = () => this.link();
    this.face.has = (asked) => this.has(asked);
    this.face.pushedAt = ({ species: animal, model, axis = SPEED }) => this.pushedAt({ animal, model, along: axis.name });
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
    for (const { name } of this.catalogue.axes) {
      if (Number.isFinite(parseFloat(given.get(name)))) [found.along, found.at] = [name, parseFloat(given.get(name))];
    }
    if (given.get("push")) found.push = given.get("push");
    return found;
  }

  // Whether there is a file of these flights; with `push`, of their gusts.
  has({ push = false, ...asked }) {
    return this.catalogue.files.includes(`${stem(asked)}${push ? "-pushes" : ""}.js`);
  }

  // What the curves of an animal run along.
  axes(animal) {
    const { axes, models } = this.catalogue;
    return axes.filter(({ name: along }) => models.some(({ name: model }) => this.has({ animal, model, along })));
  }

  // The models with which an animal was computed along an axis.
  models(animal, along) {
    return this.catalogue.models.filter(({ name: model }) => this.has({ animal, model, along }));
  }

  ask(asked) {
    const { animal } = asked;
    const axes = this.axes(animal);
    const along = axes.some(({ name }) => name === asked.along) ? asked.along : axes[0].name;
    const models = this.models(animal, along);
    const model = models.some(({ name }) => name === asked.model) ? asked.model : models[0].name;
    // Another animal, and another axis, begin at a value of their own; another model of the same animal keeps it.
    const isSame = animal === this.asked.animal && along === asked.along;
    this.asked = { animal, along, model, at: isSame ? asked.at : undefined };
    const listed = `${animal}/${along}`;
    if (this.listed !== listed) this.face.setChoices({ animals: this.catalogue.animals, models, axes }, this.asked);
    this.listed = listed;
    this.load();
  }

  load() {
    const name = stem(this.asked);
    if (this.lattices.has(name)) return this.show(this.lattices.get(name));
    this.face.say("Loading …");
    this.read(name);
  }

  read(name) {
    const src = `data/${name}.js`;
    document.head.append(make("script", { src, onerror: () => this.face.say(`The file ${src} could not be read.`) }));
  }

  // `name`: that of the file, without its end.
  async hold(name, text) {
    const lattice = await this.decompressed(text);
    if (!lattice) return;
    for (const answer of lattice.answers) {
      answer.axis = lattice.axis;
      for (const gauge of answer.gauges) gauge.source ??= lattice.sources[gauge.name];
    }
    this.lattices.set(name, lattice);
    if (stem(this.asked) === name) this.show(lattice);
  }

  // Flights through gusts lie in a file of their own, and are of the flight that an animal begins with.
  pushedAt(asked) {
    return this.has({ ...asked, push: true }) ? this.lattices.get(stem(asked))?.first : undefined;
  }

  push() {
    const name = stem(this.asked);
    const held = this.pushes.get(name);
    if (held) return this.face.showPushes(held);
    this.face.say("Loading the gusts …");
    this.read(`${name}-pushes`);
  }

  async holdPushes(name, text) {
    const pushes = await this.decompressed(text);
    if (!pushes) return;
    this.pushes.set(name, pushes);
    const { asked } = this;
    if (stem(asked) === name && asked.at === this.pushedAt(asked)) this.face.showPushes(pushes);
  }

  async decompressed(text) {
    try {
      return await decompressed(text);
    } catch {
      this.face.say("This browser cannot unpack the data; a newer one can.");
      return undefined;
    }
  }

  // Show the answer that is nearest on the axis.
  show(lattice) {
    const { name } = lattice.axis;
    const away = (answer) => Math.abs(answer[name] - (this.asked.at ?? lattice.first));
    const answer = lattice.answers.reduce((best, each) => (away(each) < away(best) ? each : best));
    if (this.shown !== lattice) {
      this.face.showCurve(lattice.curve, lattice.axis);
      this.between = new Between(lattice.answers, lattice.axis);
    }
    this.shown = lattice;
    this.asked.at = answer[name];
    this.face.showAnswer(answer);
    this.link();
  }

  // While the point is on its way, the animal flies between two computed flights; the numbers stay those of the nearest.
  slide(value) {
    this.sliding = value;
    this.due ??= requestAnimationFrame(() => {
      this.due = undefined;
      const flight = this.sliding === undefined ? undefined : this.between?.at(this.sliding);
      if (flight || this.isBetween) this.face.showBetween(flight);
      this.isBetween = Boolean(flight);
    });
  }

  // Write what is shown into the page's address.
  link() {
    const { animal, model, along, at } = this.asked;
    const push = this.face.linked.name;
    history.replaceState(null, "", `#${new URLSearchParams({ animal, model, [along]: at, ...(push && { push }) })}`);
  }
}

// What a link asks for: an animal begins at a value of its own.
function chosen(before, { animal, model, along, at }) {
  const kept = animal ? { animal, along, at } : { animal: before.animal, along: along ?? before.along, at: at ?? before.at };
  return { ...kept, model: model ?? before.model };
}

async function decompressed(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return JSON.parse(await new Response(stream).text());
}

// The name of a lattice's file, without its end; that of speeds does not say what changes.
function stem({ animal, model, along = SPEED.name }) {
  return [animal, model, ...(along === SPEED.name ? [] : [along])].join("-");
}
